// How a motion was shown: its pauses, pace and roundness beside those of the scripted caregiver.

import { made, part } from "./dom.js";
import { pictured } from "./task.js";

/** Who shows it, in the order of the columns. */
const SHOWN_BY = { you: "you", adult: "as to an adult", motionese: "with motionese" };
const MEASURES = {
  pauses: pausesInWords,
  pace: ({ pace }) => pace?.toFixed(1),
  roundness: ({ roundness }) => roundness?.toFixed(2),
};

/** Show a `manner` {motion, measures by who shows it}; null for nothing shown yet. */
export function showManner(manner) {
  const table = part("manner");
  table.hidden = !manner;
  if (!manner) return;
  const { motion, measures } = manner;
  const columns = Object.keys(SHOWN_BY).filter((who) => who in measures);
  const heads = columns.map((who) => made("th", "", SHOWN_BY[who], { scope: "col" }));
  const rows = Object.keys(MEASURES).map((name) =>
    made("tr", "", [
      made("th", "", name, { scope: "row" }),
      ...columns.map((who) => value(name, measures[who])),
    ]),
  );
  table.tHead.replaceChildren(made("tr", "", [made("td", "", pictured(motion)), ...heads]));
  table.tBodies[0].replaceChildren(...rows);
}

function value(name, measured) {
  const told = MEASURES[name](measured);
  if (told) return made("td", "", told);
  const why = measured.undefined[name === "pauses" ? "pause_count" : name];
  return made("td", "undefined", `undefined: ${why}`);
}

function pausesInWords({ pause_count: count, pause }) {
  if (!count) return count === 0 ? "none" : undefined;
  return `${count}, ${pause.toFixed(1)}\u00a0s${count > 1 ? " on average" : ""}`;
}
