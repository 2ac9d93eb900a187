// Showing a motion with the keyboard: a cursor goes from place to place along straight strokes.

import { placeTowards, task } from "./task.js";

const KEYS = {
  ArrowDown: [0, 1],
  ArrowUp: [0, -1],
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
};

/**
 * Let a surface be operated by keys.
 *
 * @param {HTMLElement} surface
 * @param {object} to - `choose(place)` shows the cursor, `planned(places)` the motion so far,
 *   `perform(places)` sends it, `gaveUp()` removes it, `tell(sentence)` speaks,
 *   `keyed("choosing" | "planning" | "")` says what the keys do now.
 */
export function composable(surface, to) {
  let chosen = "";
  let places = null;

  /** The place of the cursor; undefined before there is a task. */
  const here = () => (chosen in task.places ? chosen : Object.keys(task.places)[0]);
  const plan = (wanted) => {
    places = wanted;
    to.keyed(wanted ? "planning" : "choosing");
  };
  const finish = () => {
    if (places.length > 1) to.perform(places);
    else to.gaveUp();
    plan(null);
  };
  const walk = (direction) => {
    const next = placeTowards(here(), direction);
    if (!next) {
      to.tell(`There is no place that way from ${here()}.`);
      return;
    }
    chosen = next;
    if (!places) {
      to.choose(chosen);
      return;
    }
    places.push(chosen);
    to.planned(places);
  };
  surface.addEventListener("keydown", (event) => {
    if (!here()) return;
    if (event.key in KEYS) walk(KEYS[event.key]);
    else if (event.key === " " || event.key === "Enter") {
      if (places) finish();
      else {
        plan([here()]);
        to.planned(places);
      }
    } else if (event.key === "Escape" && places) {
      plan(null);
      to.gaveUp();
    } else return;
    event.preventDefault();
  });
  surface.addEventListener("focus", () => {
    if (!surface.matches(":focus-visible") || !here()) return;
    to.choose(here());
    to.keyed("choosing");
  });
  surface.addEventListener("blur", () => {
    if (places) to.gaveUp();
    places = null;
    to.keyed("");
  });
}
