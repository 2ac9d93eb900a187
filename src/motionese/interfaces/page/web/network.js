// The network as levels, from fast to slow, with their sizes and time constants.

import { shape, titled } from "./dom.js";

const [ACROSS, STEP, FIRST] = [264, 62, 28];
const UNITS_IN_A_ROW = 20;
const LINE = 16;

let drawnAs = "";

/** Show levels {name, size, tau}, those not open yet as outlines; channels are what IO is wired to. */
export function showNetwork(place, levels, open, channels) {
  const wanted = JSON.stringify([levels, open]);
  if (wanted === drawnAs) return;
  drawnAs = wanted;
  const places = levels.length;
  const wired = byUnit(channels);
  const tall = FIRST + STEP * (places - 1) + 34 + LINE * wired.length;
  const said = levels.map(
    (l) =>
      `${titled(l.name)}, ${l.size} units, time constant ${told(l.tau)} steps` +
      (open.includes(l.name) ? "" : ", not grown yet"),
  );
  const svg = shape("svg", {
    viewBox: `0 0 ${ACROSS} ${tall}`,
    role: "img",
    "aria-label": `${said.join("; ")}; input and output: ${wired.join("; ")}`,
  });
  const height = (index) => FIRST + STEP * (places - 1 - index);
  for (let i = 1; i < places; i += 1) {
    svg.append(
      shape("line", {
        class: "link",
        x1: 178,
        x2: 178,
        y1: height(i) + 14,
        y2: height(i - 1) - 14,
      }),
    );
  }
  levels.forEach((level, i) => {
    const group = drawn(level, height(i), open.includes(level.name));
    if (i > 1 && i === places - 1) group.classList.add("slow");
    svg.append(group);
  });
  wired.forEach((line, i) =>
    svg.append(shape("text", { class: "tau", x: 0, y: height(0) + 14 + LINE * (i + 1) }, line)),
  );
  place.replaceChildren(svg);
}

/** Return the channels in lines, a line a unit: "shoulder, armpit [rad]". */
export function byUnit(channels) {
  const lines = new Map();
  for (const { name, unit } of channels) lines.set(unit, [...(lines.get(unit) ?? []), name]);
  return [...lines].map(([unit, names]) => names.join(", ") + (unit ? ` [${unit}]` : ""));
}

function drawn(level, y, isOpen) {
  const group = shape("g", { class: `${level.name.toLowerCase()} ${isOpen ? "" : "waiting"}` });
  group.append(shape("text", { x: 0, y: y - 3 }, `${titled(level.name)} · ${level.size}`));
  group.append(
    shape(
      "text",
      { class: "tau", x: 0, y: y + 14 },
      isOpen ? `τ ${told(level.tau)} steps` : "not grown yet",
    ),
  );
  const shown = Math.min(level.size, 2 * UNITS_IN_A_ROW);
  const rows = Math.ceil(shown / UNITS_IN_A_ROW);
  const inRow = Math.ceil(shown / rows);
  const radius = inRow > 10 ? 3 : 5.5;
  const gap = inRow > 10 ? 8.2 : 17;
  for (let unit = 0; unit < shown; unit += 1) {
    group.append(
      shape("circle", {
        class: "unit",
        r: radius,
        cx: 178 + gap * ((unit % inRow) - (inRow - 1) / 2),
        cy: y + 10 * (Math.floor(unit / inRow) - (rows - 1) / 2),
      }),
    );
  }
  return group;
}

function told(tau) {
  if (!Array.isArray(tau)) return String(tau);
  const [low, high] = [Math.min(...tau), Math.max(...tau)];
  return low === high ? String(low) : `${low}–${high}`;
}
