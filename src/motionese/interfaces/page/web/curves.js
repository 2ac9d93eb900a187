// How well every motion goes, lesson after lesson: a small chart for each, all on one scale.

import { made, shape } from "./dom.js";
import { inWords, pictured } from "./task.js";

const [WIDE, HIGH, LEFT, BOTTOM, TOP, RIGHT] = [112, 84, 18, 25, 8, 6];
/** A hand that shows a motion is no steadier [cm]. */
const WELL_CM = 2;

/** Show curves {motion, points: {n, error_cm, practised}}; `grown` are lessons at which levels opened. */
export function showCurves(place, curves, grown) {
  const points = curves.flatMap((curve) => curve.points);
  const scale = {
    lessons: Math.max(...points.map((p) => p.n), 1),
    cm: Math.ceil(Math.max(...points.map((p) => p.error_cm), 4) / 2) * 2,
  };
  place.replaceChildren(...curves.map((curve) => chart(curve, grown, scale)));
}

function chart({ motion, points }, grown, scale) {
  const x = (n) => LEFT + ((WIDE - LEFT - RIGHT) * n) / scale.lessons;
  const y = (cm) => HIGH - BOTTOM - ((HIGH - BOTTOM - TOP) * cm) / scale.cm;
  const last = points.at(-1).error_cm.toFixed(1);
  const svg = shape("svg", {
    viewBox: `0 0 ${WIDE} ${HIGH}`,
    role: "img",
    "aria-label": `${inWords(motion)}: errors after each lesson ${points.map((p) => p.error_cm.toFixed(1)).join(", ")} cm`,
  });
  for (const cm of [0, scale.cm]) {
    svg.append(shape("line", { class: "axis", x1: LEFT, x2: WIDE - RIGHT, y1: y(cm), y2: y(cm) }));
    svg.append(shape("text", { class: "end", x: LEFT - 4, y: y(cm) + 4 }, `${cm}`));
  }
  svg.append(
    shape("line", { class: "well", x1: LEFT, x2: WIDE - RIGHT, y1: y(WELL_CM), y2: y(WELL_CM) }),
  );
  for (const n of grown)
    svg.append(shape("line", { class: "grew", x1: x(n), x2: x(n), y1: TOP, y2: HIGH - BOTTOM }));
  for (const n of [0, scale.lessons])
    svg.append(shape("text", { class: "middle", x: x(n), y: HIGH - 11 }, `${n}`));
  svg.append(
    shape("text", { class: "middle", x: (x(0) + x(scale.lessons)) / 2, y: HIGH - 1 }, "lessons"),
  );
  const way = points.map((p) => `${x(p.n).toFixed(1)},${y(p.error_cm).toFixed(1)}`).join(" ");
  svg.append(shape("polyline", { class: "line", points: way }));
  for (const { n, error_cm: cm, practised } of points)
    if (practised) svg.append(shape("circle", { class: "dot", cx: x(n), cy: y(cm), r: 3 }));
  return made("figure", "", [
    made("figcaption", "", [...pictured(motion), made("b", "", `${last} cm`)]),
    svg,
  ]);
}

/** Return the errors of all tries [cm] as a small line, the last with a dot. */
export function sparkline(errors) {
  const [wide, high, rim] = [64, 22, 3];
  const most = Math.max(...errors, WELL_CM);
  const at = errors.map((cm, i) => [
    rim + ((wide - 2 * rim) * i) / Math.max(errors.length - 1, 1),
    high - rim - ((high - 2 * rim) * cm) / most,
  ]);
  const told = errors.map((cm) => cm.toFixed(1)).join(", ");
  const svg = shape("svg", {
    class: "sparkline",
    viewBox: `0 0 ${wide} ${high}`,
    role: "img",
    "aria-label": `errors of all tries: ${told} cm`,
  });
  svg.append(shape("title", {}, `${told} cm`));
  svg.append(shape("polyline", { class: "line", points: at.map((p) => p.join(",")).join(" ") }));
  const [x, y] = at.at(-1);
  svg.append(shape("circle", { class: "dot", cx: x, cy: y, r: 3 }));
  return svg;
}
