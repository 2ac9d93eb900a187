// What the robot believes is being shown: a bar for every likely motion, and one for none of them.

import { made, part } from "./dom.js";

/** Motions that have a bar; where more were learned, it is the likeliest. */
const MOST = 6;

/** Show beliefs {motion, share}, of which the last is that in none; nothing where there are none. */
export function showBelief(belief) {
  const none = belief.at(-1);
  const others = belief.slice(0, -1);
  const likely = others.toSorted((a, b) => b.share - a.share).slice(0, MOST);
  // In the order in which they were learned, so that a bar stays where it is.
  const shown = belief.filter((one) => one === none || likely.includes(one));
  part("belief").replaceChildren(...shown.map((one) => bar(one, one === none ? "none" : "")));
  part("belief").hidden = !shown.length;
}

function bar({ motion, share }, name) {
  const measure = { min: 0, max: 1, value: share, "aria-label": motion };
  return made("li", name, [
    made("span", "", motion, { "aria-hidden": "true" }),
    made("meter", "", [], measure),
  ]);
}
