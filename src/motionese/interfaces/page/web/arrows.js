// Motions as the project writes them, "UR ↓←": a start corner and an arrow for every stroke.

import { made } from "./dom.js";

const CORNERS = { UR: "upper right", UL: "upper left", LR: "lower right", LL: "lower left" };
const NAMES = { "↓": "down", "↑": "up", "←": "left", "→": "right" };
/** Where a stroke leads from a corner, whether the task has it or not. */
const LEADS = {
  "UR↓": "LR",
  "LR↑": "UR",
  "UR←": "UL",
  "UL→": "UR",
  "UL↓": "LL",
  "LL↑": "UL",
  "LR←": "LL",
  "LL→": "LR",
};

/** Split a motion's name into start corner and arrows. */
export function read(motion) {
  const [start, ...rest] = (motion || "").trim().split(/\s+/);
  return {
    start: start in CORNERS ? start : "",
    arrows: [...rest.join("")].filter((a) => a in NAMES),
  };
}

/** Return a motion in words: "from the upper right: down, left". */
export function inWords(motion) {
  const { start, arrows } = read(motion);
  if (!start) return "nothing";
  return `from the ${CORNERS[start]}: ${arrows.map((a) => NAMES[a]).join(", ") || "resting"}`;
}

/** Return a corner in words. */
export const cornerInWords = (corner) => CORNERS[corner] || corner;

/** Return the corner a stroke leads to, undefined where it leads off the task. */
export const leadsTo = (corner, arrow) => LEADS[corner + arrow];

/** Return the corners a motion visits. */
export function visited(motion) {
  const { start, arrows } = read(motion);
  const corners = [start];
  for (const arrow of arrows) corners.push(leadsTo(corners.at(-1), arrow));
  return corners.filter(Boolean);
}

/** Return a motion as elements: a badge, an arrow a stroke, and its name for those who cannot see. */
export function pictured(motion) {
  const { start, arrows } = read(motion);
  const parts = [made("span", "away", `${start} ${arrows.join("")}`.trim())];
  if (start) parts.push(made("span", "corner", start, { "aria-hidden": "true" }));
  if (start && !arrows.length) parts.push(made("span", "nothing", "?", { "aria-hidden": "true" }));
  return [...parts, ...arrows.map(drawn)];
}

function drawn(sign) {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  svg.setAttribute("class", `arrow ${NAMES[sign]}`);
  svg.setAttribute("aria-hidden", "true");
  const use = document.createElementNS("http://www.w3.org/2000/svg", "use");
  use.setAttribute("href", "#arrow");
  svg.append(use);
  return svg;
}
