// The task: its places, and sequences as the project writes them, "UR ↓←": a place, a sign a stroke.

import { made } from "./dom.js";

/** Signs that are drawn, by the way they are turned; others are written. */
const TURNED = { "↓": "down", "↑": "up", "←": "left", "→": "right" };
/** Colours of what comes about at a place, in the order of the task's effects. */
const COLOURS = ["button-right", "button-left", "orange", "pink"];
/** A key leads to a place that lies at least so much in its direction (cosine). */
const AHEAD = 0.8;

export let task = { places: {}, primitives: [], effects: [], motions: [] };
let aspect = 1;

/** Take the task of a `scene`, whose view is `wide` times as wide as high. */
export function takeTask(told, wide) {
  task = told;
  aspect = wide;
}

/** Split a motion's name into start place and signs. */
export function read(motion) {
  const [start, ...rest] = (motion || "").trim().split(/\s+/);
  const known = new Set(task.primitives.map(({ sign }) => sign));
  const signs = [...rest.join("")];
  // A motion of one's own may begin with any word.
  const isSequence = start in task.places && signs.every((sign) => known.has(sign));
  return isSequence ? { start, signs } : { start: "", signs: [] };
}

/** Return the primitives that a motion consists of. */
export function primitivesOf(motion) {
  const { start, signs } = read(motion);
  const parts = [];
  for (const sign of signs) {
    const from = parts.at(-1)?.end ?? start;
    parts.push(task.primitives.find((one) => one.start === from && one.sign === sign));
    if (!parts.at(-1)) return parts.slice(0, -1);
  }
  return parts;
}

/** Return a motion in words: "from UR: down, to the left"; one of a person's own by its name. */
export function inWords(motion) {
  const { start } = read(motion);
  if (!start) return motion || "nothing";
  const strokes = primitivesOf(motion).map(({ words }) => words);
  return `from ${start}: ${strokes.join(", ") || "resting"}`;
}

/** Return a sentence as parts, in which places look as they do in the view. */
export function withPlaces(sentence) {
  return sentence
    .split(/(\p{L}+)/u)
    .map((word) => (word in task.places ? made("b", colourAt(word) ?? "", word) : word));
}

/** Return the place that lies most in a direction [x, y] from another; undefined if none does. */
export function placeTowards(name, [dx, dy]) {
  const [x, y] = task.places[name].at;
  const along = Object.entries(task.places)
    .filter(([other]) => other !== name)
    .map(([other, { at }]) => {
      const [rx, ry] = [aspect * (at[0] - x), at[1] - y];
      return [other, (rx * dx + ry * dy) / Math.hypot(rx, ry)];
    })
    .toSorted((a, b) => b[1] - a[1])[0];
  return along?.[1] > AHEAD ? along[0] : undefined;
}

/** Return the name of the colour of what comes about at a place, undefined where nothing does. */
export function colourAt(name) {
  const index = task.effects.findIndex(({ places }) => places.includes(name));
  return index < 0 ? undefined : COLOURS[index % COLOURS.length];
}

/** Return a motion as elements: a badge, a sign a stroke, and its name for those who cannot see.
    A motion that is no sequence of the task is its name. */
export function pictured(motion) {
  const { start, signs } = read(motion);
  if (!start) return [made("span", "named", motion)];
  const parts = [made("span", "away", `${start} ${signs.join("")}`.trim())];
  parts.push(made("span", "corner", start, { "aria-hidden": "true" }));
  if (!signs.length) parts.push(made("span", "nothing", "?", { "aria-hidden": "true" }));
  return [...parts, ...signs.map(drawn)];
}

function drawn(sign) {
  if (!(sign in TURNED)) return made("span", "sign", sign, { "aria-hidden": "true" });
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  svg.setAttribute("class", `arrow ${TURNED[sign]}`);
  svg.setAttribute("aria-hidden", "true");
  const use = document.createElementNS("http://www.w3.org/2000/svg", "use");
  use.setAttribute("href", "#arrow");
  svg.append(use);
  return svg;
}
