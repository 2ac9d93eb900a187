// Showing a motion with the keyboard: a cursor goes from corner to corner along the strokes.

import { cornerInWords, leadsTo } from "./arrows.js";

const ARROWS = { ArrowDown: "↓", ArrowUp: "↑", ArrowLeft: "←", ArrowRight: "→" };

/**
 * Let a surface be operated by keys.
 *
 * @param {HTMLElement} surface
 * @param {object} to - `choose(corner)` shows the cursor, `planned(corners)` the motion so far,
 *   `perform(corners)` sends it, `gaveUp()` removes it, `tell(sentence)` speaks,
 *   `keyed("choosing" | "planning" | "")` says what the keys do now.
 */
export function composable(surface, to) {
  let corner = "UR";
  let corners = null;

  const plan = (wanted) => {
    corners = wanted;
    to.keyed(wanted ? "planning" : "choosing");
  };
  const finish = () => {
    if (corners.length > 1) to.perform(corners);
    else to.gaveUp();
    plan(null);
  };
  const walk = (arrow) => {
    const next = leadsTo(corner, arrow);
    if (!next) {
      to.tell(`There is no corner that way from the ${cornerInWords(corner)}.`);
      return;
    }
    corner = next;
    if (!corners) {
      to.choose(corner);
      return;
    }
    corners.push(corner);
    to.planned(corners);
  };
  surface.addEventListener("keydown", (event) => {
    if (event.key in ARROWS) walk(ARROWS[event.key]);
    else if (event.key === " " || event.key === "Enter") {
      if (corners) finish();
      else {
        plan([corner]);
        to.planned(corners);
      }
    } else if (event.key === "Escape" && corners) {
      plan(null);
      to.gaveUp();
    } else return;
    event.preventDefault();
  });
  surface.addEventListener("focus", () => {
    if (!surface.matches(":focus-visible")) return;
    to.choose(corner);
    to.keyed("choosing");
  });
  surface.addEventListener("blur", () => {
    if (corners) to.gaveUp();
    corners = null;
    to.keyed("");
  });
}
