// The one line that says what to do now, and the chapter that it leads through.

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

/** How what is to be shown is asked for, by chapter. */
const ASKED = { push: "Show it a push", grow: "Now a pair in one go" };

/** Return the invitation to show a motion. */
function invitation(motion, asked) {
  const strokes = primitivesOf(motion);
  if (!strokes.length) return "Show it a motion.";
  const way = strokes.map(({ words, end }) => `${words} to ${end}`).join(", then ");
  return `${asked}: press on ${read(motion).start} and draw ${way}.`;
}

/** Return what is to be done now {act, motion}: what the line says, and which button is marked. */
export function due({ session, step, verdict, performed, learned, replayed, next }) {
  const { chapter, suggest } = session;
  const told = { judged: verdict, performed, learned, replayed }[step]?.advice;
  if (step === "judged") return { act: told, motion: "" };
  if (chapter) return chapter;
  if (told === "learn") return { act: "learn", motion: "" };
  return suggest ? { act: "grow", motion: "" } : { act: "show", motion: next };
}

function inWords(now) {
  const { act, motion } = due(now);
  const { chapter, suggest } = now.session;
  const grow = "Press Grow, below, to open a slow level.";
  const again = now.step === "learned" ? "again" : "to let it practise";
  return {
    show: () => invitation(motion, ASKED[chapter?.name] ?? "Show it next"),
    imitate: () => "Press Imitate to see it try.",
    learn: () => `Press Learn this ${again}.`,
    grow: () => (chapter ? grow : suggest),
    map: () =>
      now.mapped
        ? "Point at the map: the same fast state, another slow one. Where does its hand go?"
        : "Press Explore the map, below: what do its slow states do?",
  }[act]();
}

/** Return what has just come about, as far as it is still on the page. */
function news({ step, verdict, performed, learned, replayed, grown }) {
  if (step === "judged") return `“${verdict.line}”`;
  if (step === "replayed") return `Here is its try ${replayed.attempt} again. ${replayed.sentence}`;
  return { performed, learned, grown }[step]?.sentence ?? "";
}

/** Return what to do now, from the state of everything. */
export function guide(now) {
  const { worker, step } = now;
  if (now.connection !== "open") return "Waiting for the robot …";
  if (!now.yours) return "This robot is being taught on another page.";
  if (!now.watching) return worker.sentence || "The robot is waking up …";
  if (now.drawing && now.webcam) return "Move the red thing, and press Stop showing at the end.";
  if (now.drawing) return "Go on, and lift when the motion is done.";
  if (now.webcam) return "Hold something red before the camera, then press Start showing.";
  if (now.ghost) return "Watch the red hand: the robot is watching it, too.";
  if (now.busy) return BUSY[now.busy] ?? "One moment …";
  if (now.keyed === "planning" || (now.keyed && !step)) return KEYS[now.keyed];
  return `${news(now)} ${inWords(now)}`.trim();
}

/** Return which chapter this is, "2 of 5 · Watch it fail"; empty after the last. */
export const chapterInWords = ({ chapter }) =>
  chapter ? `${chapter.number} of ${chapter.of} · ${chapter.title}` : "";
