// What was seen, as large arrows and likely motions, and whether the robot says that it can do it.

import { made, part, say } from "./dom.js";
import { named } from "./naming.js";
import { inWords, pictured, read } from "./task.js";

const NOTHING = () => made("span", "nothing", "nothing yet");

/** Show what was seen {motion, share}, the likeliest first; it is named `motion` from now on. */
function showSeen(seen, motion = seen[0]?.motion ?? "") {
  showMotion(motion);
  part("seen").replaceChildren(...seen.map(bar));
}

/** Show the motion that all this is about, or none. */
export function showMotion(motion) {
  const own = motion && !read(motion).start;
  const shown = own ? [named(motion)] : motion ? pictured(motion) : [NOTHING()];
  part("verdict-arrows").replaceChildren(...shown);
}

function bar({ motion, share }) {
  const measure = { min: 0, max: 1, value: share, "aria-label": motion };
  return made("li", "", [
    made("span", "", motion, { "aria-hidden": "true" }),
    made("meter", "", [], measure),
  ]);
}

/** Show whether the robot says that it can do it, and what that is known by; null for nothing. */
export function showClaim(claim) {
  if (!claim) {
    showAnswer("–", "");
    return;
  }
  const { made: claims, foretold_cm: foretold, expected_cm: expected } = claim;
  const expects = expected === null ? "" : `; expects to miss by ${cm(expected)}`;
  showAnswer(claims ? "It says yes" : "Not yet", `Foretold the end to ${cm(foretold)}${expects}`);
}

function showAnswer(answer, why) {
  say(part("claim"), answer);
  say(part("claim-why"), why);
}

/** Show what was seen so far; nothing is spoken while a person draws. */
export function showUnderstanding({ seen }) {
  part("verdict").classList.add("tentative");
  say(part("verdict-label"), "So far the robot sees");
  showSeen(seen);
  showClaim(null);
}

/** Show what was seen; whether it can be done is not known yet. */
export function showSaw({ seen }) {
  part("verdict").classList.remove("tentative");
  say(part("verdict-label"), "The robot saw");
  showSeen(seen);
  showAnswer("Thinking …", "");
}

/** Show a verdict, and speak it. */
export function showVerdict({ motion, seen, sentence, claim }) {
  part("verdict").classList.remove("tentative");
  say(part("verdict-label"), "The robot saw");
  showSeen(seen, motion);
  showClaim(claim);
  say(part("verdict-spoken"), read(motion).start ? `${inWords(motion)}. ${sentence}` : sentence);
}

/** Show what a try has come to. */
export function showResult({ good, error_cm: error, pushes }) {
  const done = pushes.filter((push) => push.made).length;
  const pressed = pushes.length ? `, pressed ${done} of ${pushes.length}` : "";
  showAnswer(good ? "It did" : "Not yet", `Missed by ${cm(error)}${pressed}`);
}

/** Show that nothing is understood yet. */
export function clearVerdict() {
  part("verdict").classList.remove("tentative");
  say(part("verdict-label"), "The robot saw");
  say(part("verdict-spoken"), "");
  showSeen([]);
  showClaim(null);
}

const cm = (value) => `${value.toFixed(1)} cm`;
