// Words that are explained when they are pressed; Escape, or a press elsewhere, closes it again.

import { made, part, shape } from "./dom.js";
import { WORDS } from "./words.js";

/** Return a word of `WORDS` as it stands in a text, to be pressed. */
export const term = (word, text) =>
  made("button", "term", text, { type: "button", "data-word": word, popovertarget: "word" });

/** Let every word on the page be pressed, also those that come later. */
export function explain() {
  const note = part("word");
  let shown = "";
  document.addEventListener("click", ({ target }) => {
    const button = target.closest("[data-word]");
    if (!button) return;
    // By the keyboard another word can be pressed while one is explained.
    if (note.matches(":popover-open") && shown !== button.dataset.word) note.hidePopover();
    shown = button.dataset.word;
    note.replaceChildren(...explanation(WORDS[shown]));
  });
}

function explanation({ title, sentence, source, picture }) {
  const parts = [made("h2", "", title), made("p", "", sentence)];
  if (picture) {
    const svg = shape("svg", { viewBox: "0 0 120 48", "aria-hidden": "true" });
    svg.append(...picture.map(([kind, d]) => shape("path", { class: kind, d })));
    parts.splice(1, 0, svg);
  }
  return source ? [...parts, made("p", "source", source)] : parts;
}
