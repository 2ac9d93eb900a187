// The list of everything that was shown, with how well the robot did it.

import { inWords, pictured } from "./task.js";
import { made } from "./dom.js";

const SOURCES = { drawn: "drawn", webcam: "webcam", scripted: "by itself" };

/** Show a notebook; `forget(entry)` is called by the buttons that undo. */
export function showNotebook(list, entries, forget) {
  list.replaceChildren(...entries.toReversed().map((entry) => row(entry, forget)));
}

function row({ entry, motion, source, errors, learned }, forget) {
  const what = made("span", "what", [
    ...pictured(motion),
    made("span", "source", SOURCES[source] ?? source),
  ]);
  if (learned) what.append(made("span", "learned", "learned"));
  const button = made("button", "quiet small", "Undo", {
    type: "button",
    "data-testid": "forget",
    "aria-label": `Undo entry ${entry}: ${inWords(motion)}`,
  });
  button.addEventListener("click", () => forget(entry));
  return made("li", "", [what, made("span", "errors", attempts(errors)), button], {
    "data-testid": "entry",
    "data-entry": entry,
  });
}

function attempts(errors) {
  const said = errors
    .slice(-4)
    .map((cm, i, all) =>
      i === all.length - 1 ? made("b", "", `${cm.toFixed(1)} cm`) : `${cm.toFixed(1)} → `,
    );
  if (!errors.length) said.push("not tried yet");
  return said;
}

/** Show the errors on the same motions before and after growing. */
export function showGrown(table, { before, after }) {
  const later = new Map(after.map(({ motion, cm }) => [motion, cm]));
  const rows = before.map(({ motion, cm }) =>
    made("tr", "", [
      made("th", "", pictured(motion), { scope: "row" }),
      made("td", "", `${cm.toFixed(1)} cm`),
      made("td", "", later.has(motion) ? `${later.get(motion).toFixed(1)} cm` : "–"),
    ]),
  );
  table.querySelector("tbody").replaceChildren(...rows);
  table.hidden = !rows.length;
}
