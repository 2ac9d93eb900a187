// Which primitives are clear yet: the measures of the experiment, of the robot on the page.

import { made, shape, titled } from "./dom.js";
import { pictured, primitivesOf } from "./task.js";

const [WIDE, HIGH] = [100, 12];

/** Show an `emergence`. */
export function showEmergence(place, { levels, slow, clear, directions, first, order, read }) {
  const [below, top] = levels.slice(-2).map(titled);
  const swapped = slow ? `${top}₀` : "slow states";
  place.replaceChildren(
    made("ul", "clear-strokes", directions.map((each) => direction(each, slow, clear))),
    made("p", "key-note", [
      made("i", "key now", "now"),
      " ",
      made("i", "key newborn", "as a newborn"),
      ...(slow ? [" ", made("i", "key enough", `clear from ${percent(clear)}`)] : []),
    ]),
    made("div", "exchanges", [
      exchange(`When two motions swap their ${swapped}, how one begins`, first, below, top),
      exchange("… and which way it goes on", order, below, top),
      readOut(read),
    ]),
  );
}

function direction(each, slow, clear) {
  const { primitive, share, newborn, learned, sentence, history } = each;
  const [{ words, end }] = primitivesOf(primitive);
  const now = learned ? "now" : "now chance";
  const svg = bar([
    ["track", 0, 1, 0, 8],
    [now, 0, share, 0, 8],
    ["newborn", 0, newborn, 9, 3],
    ...(slow ? [["enough", clear, 0.006, 0, 8]] : []),
  ]);
  return made("li", each.clear && slow ? "clear" : "", [
    made("span", "what", pictured(primitive)),
    made("span", "words", `${words}, to ${end}`),
    history.length > 1 ? course(history) : "",
    svg,
    made("span", "said", `${sentence}.`),
    made("span", "away", ` As a newborn: ${percent(newborn)}.`),
  ]);
}

const percent = (share) => `${Math.round(100 * share)} %`;

/** Return a bar of parts: class, begin and width as shares, top and height [px]. */
function bar(parts) {
  const svg = shape("svg", {
    class: "bar",
    viewBox: `0 0 ${WIDE} ${HIGH}`,
    preserveAspectRatio: "none",
    "aria-hidden": "true",
  });
  for (const [name, begin, width, y, height] of parts)
    svg.append(shape("rect", { class: name, x: WIDE * begin, y, width: WIDE * width, height }));
  return svg;
}

/** Return how a share came to be what it is, lesson after lesson. */
function course(history) {
  const [wide, high, rim] = [56, 18, 3];
  const at = history.map((share, i) => [
    rim + ((wide - 2 * rim) * i) / Math.max(history.length - 1, 1),
    high - rim - (high - 2 * rim) * share,
  ]);
  const told = history.map((share) => Math.round(100 * share)).join(", ");
  const svg = shape("svg", {
    class: "sparkline",
    viewBox: `0 0 ${wide} ${high}`,
    role: "img",
    "aria-label": `lesson after lesson: ${told} %`,
  });
  svg.append(shape("title", {}, `lesson after lesson: ${told} %`));
  svg.append(shape("polyline", { class: "line", points: at.map((p) => p.join(",")).join(" ") }));
  const [x, y] = at.at(-1);
  svg.append(shape("circle", { class: "dot", cx: x, cy: y, r: 2.5 }));
  return svg;
}

/** Return whose strokes follow in exchanges, or why none could be tried. */
function exchange(words, { lower, upper, neither, missing }, below, top) {
  if (missing) return made("p", "undefined", `${words}: not measurable yet. ${missing}`);
  const all = lower + upper + neither;
  const parts = [
    ["cf", below, lower],
    ["cs", top, upper],
    ["none", "neither", neither],
  ].filter(([, , count]) => count);
  let begin = 0;
  const bars = parts.map(([name, , count]) => {
    const at = begin;
    begin += count / all;
    return [name, at, count / all, 0, 8];
  });
  const counts = parts.map(([, name, count]) => `${name} in ${count} of ${all}`).join(", ");
  const said = made("p", "", [`${words} follows `, made("b", "", counts), "."]);
  return made("div", "", [said, bar(bars)]);
}

/** Return how well the order is read out of every level, where that is defined. */
function readOut(read) {
  if (!read.length) return "";
  const told = read.map(({ level, score }) => `${titled(level)} ${percent(score)}`).join(", ");
  return made("p", "", [
    "Where ways part, the units alone tell a reader which way comes: ",
    made("b", "", told),
    ` (guessing: ${percent(read[0].chance)}).`,
  ]);
}
