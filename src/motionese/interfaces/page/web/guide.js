// The one line that says what to do now.

import { primitivesOf, read } from "./task.js";

const BUSY = {
  recognising: "It is thinking about what it saw …",
  performing: "Watch it try.",
  learning: "It is practising: watch every try; the first one stays as a ghost.",
  growing: "A slow level is growing.",
  demonstrating: "Watch the red hand: the robot is watching it, too.",
  "drawing the map": "It is trying out every slow state.",
  comparing: "Every robot tries every motion that was shown.",
  "waking up": "This robot is waking up …",
  "opening a session": "The session is being opened …",
  "beginning anew": "A new robot is babbling: it moves its arm and sees what comes of it.",
};

const KEYS = {
  choosing: "Arrow keys choose the place to start from. Space begins.",
  planning: "Arrow keys draw from place to place. Enter finishes, Escape gives up.",
};

/** Return the invitation to show a motion. */
function invitation(motion, first, short = false) {
  const strokes = primitivesOf(motion);
  if (!strokes.length) return "Show it a motion.";
  const way = strokes.map(({ words, end }) => `${words} to ${end}`).join(", then ");
  if (first) return `Press on the red ball and draw it ${way}.`;
  return `${short ? "Next" : "Show it more"}: press on ${read(motion).start} and draw ${way}.`;
}

/** Return what to do now, from the state of everything. */
export function guide(now) {
  const { worker, busy, step, performed, learned, suggest, next } = now;
  if (now.connection !== "open") return "Waiting for the robot …";
  if (!now.yours) return "This robot is being taught on another page.";
  if (!now.watching) return worker.sentence || "The robot is waking up …";
  if (now.drawing && now.webcam) return "Move the red thing, and press Stop showing at the end.";
  if (now.drawing) return "Go on, and lift when the motion is done.";
  if (now.webcam) return "Hold something red before the camera, then press Start showing.";
  if (now.ghost) return "Watch the red hand: the robot is watching it, too.";
  if (busy) return BUSY[busy] ?? "One moment …";
  if (now.keyed === "planning" || (now.keyed && !step)) return KEYS[now.keyed];
  if (step === "judged") return judged(now.verdict);
  if (step === "performed") {
    const learn = performed.advice === "learn" ? " Press Learn this to let it practise." : "";
    return `${performed.sentence}${learn || ` ${invitation(next, false, true)}`}`;
  }
  if (step === "replayed") return replayed(now.replayed);
  if (step === "grown") return now.grown.sentence;
  if (step === "learned" && !suggest) return `${learned.sentence} ${invitation(next, false, true)}`;
  if (step === "learned") return `${learned.sentence} ${suggest}`;
  if (suggest) return suggest;
  return invitation(next, now.first);
}

const ADVICE = { imitate: "Press Imitate to see it try.", learn: "Press Learn this to teach it." };

const judged = ({ sentence, advice }) => `“${sentence}” ${ADVICE[advice]}`;

const replayed = ({ attempt, sentence, advice }) =>
  `Here is its try ${attempt} again. ${sentence}${advice === "learn" ? " Press Learn this to let it practise." : ""}`;
