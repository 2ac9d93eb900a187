// What the robot understands: large arrows, how sure it is, and how far its path is off.

import { inWords, pictured, read } from "./task.js";
import { made, part, say } from "./dom.js";

function show(motion, confidence, error) {
  const known = read(motion).start;
  part("verdict-arrows").replaceChildren(
    ...(known ? pictured(motion) : [made("span", "nothing", "nothing yet")]),
  );
  const sure = confidence === null ? "–" : `${Math.round(100 * confidence)} %`;
  say(part("confidence-value"), sure);
  part("confidence").value = confidence ?? 0;
  part("verdict-error").replaceChildren(
    ...(error === null ? ["–"] : [error.toFixed(1), made("small", "", " cm")]),
  );
}

/** Show what is understood so far; nothing is spoken while a person draws. */
export function showUnderstanding({ arrows, confidence }) {
  part("verdict").classList.add("tentative");
  say(part("verdict-label"), "So far it understands");
  show(arrows, confidence, null);
}

/** Show a verdict, and speak it. */
export function showVerdict({ motion, confidence, error_cm: error, alternatives }) {
  part("verdict").classList.remove("tentative");
  say(part("verdict-label"), "The robot understands");
  show(motion, confidence, error);
  const other = (alternatives ?? []).find((one) => one.motion !== motion && one.confidence >= 0.05);
  part("alternative").replaceChildren(...(other ? ["or ", ...pictured(other.motion)] : []));
  say(
    part("verdict-spoken"),
    read(motion).start
      ? `Understood: ${inWords(motion)}; confidence ${Math.round(100 * confidence)} percent, off by ${error.toFixed(1)} centimetres.`
      : "Not understood.",
  );
}

/** Show that nothing is understood yet. */
export function clearVerdict() {
  part("verdict").classList.remove("tentative");
  say(part("verdict-label"), "The robot understands");
  part("alternative").replaceChildren();
  say(part("verdict-spoken"), "");
  show("", null, null);
}
