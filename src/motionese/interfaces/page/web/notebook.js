// The list of everything that was shown, with how well the robot did it.

import { sparkline } from "./curves.js";
import { made } from "./dom.js";
import { named } from "./naming.js";
import { inWords, pictured } from "./task.js";

const SOURCES = { drawn: "drawn", webcam: "webcam", scripted: "by itself" };

/** Show a notebook; `replay(entry)` and `forget(entry)` are called by its buttons. */
export function showNotebook(list, entries, replay, forget) {
  const focused = document.activeElement?.closest?.("#notebook button");
  const [entry, does] = focused ? [focused.dataset.entry, focused.dataset.testid] : [];
  list.replaceChildren(...entries.toReversed().map((each) => row(each, replay, forget)));
  // The list is made anew, and what had the focus has it again.
  list.querySelector(`button[data-entry="${entry}"][data-testid="${does}"]`)?.focus();
}

function row({ entry, motion, source, errors, learned, own }, replay, forget) {
  const what = made("span", "what", [
    ...(own ? [named(motion)] : pictured(motion)),
    made("span", "source", SOURCES[source] ?? source),
  ]);
  if (learned) what.append(made("span", "learned", "learned"));
  const button = (does, label, title, act) => {
    const attributes = { type: "button", "data-testid": does, "data-entry": entry };
    const name = `quiet small ${label ? "" : "play"}`;
    const it = made("button", name, label, { ...attributes, "aria-label": title, title });
    it.addEventListener("click", () => act(entry));
    return it;
  };
  const where = `entry ${entry}: ${inWords(motion)}`;
  const buttons = [
    button("replay", "", `Show again ${where}`, replay),
    button("forget", "Undo", `Undo ${where}`, forget),
  ];
  return made("li", "", [what, attempts(errors), made("span", "buttons", buttons)], {
    "data-testid": "entry",
    "data-entry": entry,
  });
}

function attempts(errors) {
  if (!errors.length) return made("span", "errors", "not tried yet");
  const count = errors.length === 1 ? "1 try" : `${errors.length} tries`;
  const last = made("b", "", `${errors.at(-1).toFixed(1)} cm`);
  return made("span", "errors", [sparkline(errors), last, made("small", "", count)]);
}

/** Show the errors on the same motions before and after growing. */
export function showGrown(table, { changes }) {
  const rows = changes.map(({ motion, before_cm: before, after_cm: after }) => {
    const worse = after > before + 0.05;
    return made("tr", worse ? "worse" : "", [
      made("th", "", pictured(motion), { scope: "row" }),
      made("td", "", `${before.toFixed(1)} cm`),
      made("td", "", `${after.toFixed(1)} cm${worse ? " · worse" : ""}`),
    ]);
  });
  table.querySelector("tbody").replaceChildren(...rows);
  table.hidden = !rows.length;
}
