// What is drawn into the eye view: lines, places, the caregiver's hand, and a flat table.

import { colourAt, task } from "./task.js";

/** Draw a line through pixels; `rim` lifts it off the ground, `arrow` gives it a head. */
export function line(context, pixels, { colour, width, rim, dash = [], arrow = false }) {
  if (pixels.length < 2) return;
  context.lineCap = context.lineJoin = "round";
  const passes = rim
    ? [
        [rim, width + 4, []],
        [colour, width, dash],
      ]
    : [[colour, width, dash]];
  for (const [stroke, thickness, dashes] of passes) {
    context.strokeStyle = stroke;
    context.lineWidth = thickness;
    context.setLineDash(dashes);
    context.beginPath();
    pixels.forEach(([x, y], i) => (i ? context.lineTo(x, y) : context.moveTo(x, y)));
    context.stroke();
  }
  context.setLineDash([]);
  if (arrow) head(context, pixels, colour);
}

function head(context, pixels, colour) {
  const [x, y] = pixels.at(-1);
  const before = pixels.findLast(([a, b]) => Math.hypot(x - a, y - b) > 8);
  if (!before) return;
  const angle = Math.atan2(y - before[1], x - before[0]);
  context.fillStyle = colour;
  context.beginPath();
  context.moveTo(x + 9 * Math.cos(angle), y + 9 * Math.sin(angle));
  for (const side of [2.5, -2.5])
    context.lineTo(x + 12 * Math.cos(angle + side), y + 12 * Math.sin(angle + side));
  context.fill();
}

/** Chevrons that say which way a line goes: how far apart, how far beside it, how large [px]. */
const [APART, BESIDE, SIZE] = [64, 13, 6];

/**
 * Say which way a line goes: chevrons on its right, so that a way down and one up again over it are
 * told apart, and a disc where it begins.
 */
export function direction(context, pixels, { colour, rim }) {
  if (pixels.length < 2) return;
  disc(context, ...pixels[0], SIZE, rim);
  disc(context, ...pixels[0], SIZE - 2, colour);
  let left = APART / 2;
  for (let i = 1; i < pixels.length; i += 1) {
    const [[x, y], [ahead, below]] = [pixels[i - 1], pixels[i]];
    const long = Math.hypot(ahead - x, below - y);
    for (; left <= long; left += APART) {
      const along = [(ahead - x) / long, (below - y) / long];
      const at = [x + left * along[0] - BESIDE * along[1], y + left * along[1] + BESIDE * along[0]];
      chevron(context, at, along, colour, rim);
    }
    left -= long;
  }
}

function chevron(context, [x, y], [along, down], colour, rim) {
  const wing = (side) => [
    x - SIZE * along - side * SIZE * down,
    y - SIZE * down + side * SIZE * along,
  ];
  context.lineCap = context.lineJoin = "round";
  for (const [stroke, width] of [
    [rim, 6],
    [colour, 3],
  ]) {
    Object.assign(context, { strokeStyle: stroke, lineWidth: width });
    context.beginPath();
    context.moveTo(...wing(1));
    context.lineTo(x, y);
    context.lineTo(...wing(-1));
    context.stroke();
  }
}

/** Draw a place: a ring with its name, in the colour of what comes about there. */
export function placeAt(context, view, name) {
  const { at } = task.places[name];
  const [x, y] = view.pixel(at);
  const { ink, card, [colourAt(name)]: button } = view.colours;
  for (const [colour, width] of button
    ? [
        [card, 8],
        [button, 4],
      ]
    : [
        [card, 5],
        [ink, 1.5],
      ]) {
    context.strokeStyle = colour;
    context.lineWidth = width;
    context.beginPath();
    context.arc(x, y, 17, 0, 2 * Math.PI);
    context.stroke();
  }
  const aside = at[0] > 0.5 ? 1 : -1;
  context.font = `600 13px ${getComputedStyle(document.body).fontFamily}`;
  context.textAlign = aside > 0 ? "left" : "right";
  context.textBaseline = "middle";
  context.lineJoin = "round";
  context.lineWidth = 4;
  context.strokeStyle = card;
  context.fillStyle = ink;
  context.strokeText(name, x + 27 * aside, y);
  context.fillText(name, x + 27 * aside, y);
}

/** Draw the caregiver's hand below its red marker, which is at a pixel; `scale` 1 is 680 px wide. */
export function hand(context, [x, y], { hand: red, card }, scale) {
  context.save();
  context.translate(x, y);
  context.scale(scale, scale);
  context.lineCap = "round";
  limb(
    context,
    [
      [44, -30],
      [16, 34],
    ],
    44,
    "#38706b",
  );
  limb(
    context,
    [
      [0, 0],
      [2, 30],
    ],
    6,
    "#73787f",
  );
  disc(context, 2, 47, 30, "#e5c2a8");
  limb(
    context,
    [
      [-22, 44],
      [-14, 60],
    ],
    13,
    "#d8b196",
  );
  disc(context, 0, 0, 15, card);
  disc(context, 0, 0, 12, red);
  context.restore();
}

function limb(context, [from, to], width, colour) {
  context.strokeStyle = colour;
  context.lineWidth = width;
  context.beginPath();
  context.moveTo(...from);
  context.lineTo(...to);
  context.stroke();
}

/** Draw a disc at a pixel. */
export function disc(context, x, y, radius, colour) {
  context.fillStyle = colour;
  context.beginPath();
  context.arc(x, y, radius, 0, 2 * Math.PI);
  context.fill();
}

/** Draw the table and its buttons where no picture of the scene can be rendered. */
export function flatGround(context, view) {
  const c = view.colours;
  context.fillStyle = c.band;
  context.fillRect(0, 0, view.width, view.height);
  for (const [name, { at }] of Object.entries(task.places)) {
    if (!colourAt(name)) continue;
    const [x, y] = view.pixel(at);
    context.fillStyle = c[colourAt(name)];
    context.beginPath();
    context.ellipse(x, y, 0.075 * view.width, 0.05 * view.width, 0, 0, 2 * Math.PI);
    context.fill();
  }
}
