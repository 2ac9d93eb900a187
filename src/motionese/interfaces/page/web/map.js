// The map of initial states, beside the eye view: which way does the hand go from each of them?

import { made, colours, fitted, onScheme, part, say, titled } from "./dom.js";
import { colourAt, primitivesOf, task } from "./task.js";

const SEND_EVERY_MS = 60;
/** Room for the axes' names, and for what lies at the rim [px]. */
const [MARGIN, RIM] = [30, 8];
const STEPS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
/** Colours of ways to places where nothing comes about. */
const PAINTS = ["orange", "pink", "sky", "amber"];
const ORDINALS = ["first", "second"];
/** What a stroke does that goes no way of the task. */
const ASTRAY = { elsewhere: "another way", hardly: "it hardly moves" };
/** Labels keep so far from points and from each other [px]. */
const [BESIDE, HIGH] = [9, 15];

export class StateMap {
  /** `wanted(at, primitive)` is called for a point whose motion is wanted. */
  constructor(wanted) {
    this.canvas = part("map");
    [this.choice, this.which] = [part("map-primitive"), part("map-stroke")];
    Object.assign(this, { wanted, map: null, cell: null, places: [] });
    for (const choice of [this.choice, this.which])
      choice.addEventListener("change", () => this.#ask());
    for (const name of ["pointermove", "pointerdown"])
      this.canvas.addEventListener(name, (event) => this.#point(this.#cellAt(event)));
    this.canvas.addEventListener("focus", () => this.#begin());
    this.canvas.addEventListener("keydown", (event) => this.#key(event));
    new ResizeObserver(() => this.draw()).observe(this.canvas);
    onScheme(() => this.draw());
  }

  /** Take a `map`; what was chosen stays so. */
  take(map) {
    const chosen = this.choice.value;
    this.map = map;
    const names = Object.keys(map.primitives);
    this.choice.replaceChildren(
      ...names.map((name) => made("option", "", `State of ${name}`, { value: name })),
    );
    if (names.includes(chosen)) this.choice.value = chosen;
    else this.#chooseForks();
    const [level, below] = [titled(map.level), titled(map.below)];
    const title = map.slow ? `The same ${below}, another ${level}` : `Another ${level}`;
    say(part("map-title"), `${title}: which way?`);
    this.#ask();
  }

  /** Forget the map: it is of another network. */
  clear() {
    this.map = this.cell = null;
    say(part("map-told"), "");
    this.draw();
  }

  /** Whether a motion is of the point that is chosen. */
  isChosen({ slow, primitive }) {
    return this.cell && String(slow) === String(this.#at()) && primitive === this.choice.value;
  }

  draw() {
    const { context, width } = fitted(this.canvas);
    if (!width) return;
    const c = colours();
    context.clearRect(0, 0, width, width);
    context.font = `12px ${getComputedStyle(document.body).fontFamily}`;
    Object.assign(context, { fillStyle: c.soft, textAlign: "center", textBaseline: "alphabetic" });
    if (!this.map) {
      context.fillText("Drawing the map …", width / 2, width / 2);
      return;
    }
    this.#axes(context, width);
    this.#arrows(context, c);
    this.#points(context, c, width);
  }

  /** Return the stroke that the arrows show. */
  get #strokes() {
    return this.map.primitives[this.choice.value][Number(this.which.value)];
  }

  #ask() {
    if (!this.map) return;
    this.#note();
    this.#ways();
    this.draw();
    if (this.cell) this.#want();
    else this.#begin();
  }

  /** Begin in the middle where keys would move a point. */
  #begin() {
    const isFocused = document.activeElement === this.canvas;
    if (this.map && !this.cell && isFocused) this.#point(this.#middle());
  }

  #note() {
    const { level, below, slow, points } = this.map;
    const what = slow
      ? `${titled(below)} is held as the robot recalls it for ${this.choice.value}; ` +
        `every arrow is another ${titled(level)}.`
      : `There is no slow level yet, so this is a map of ${titled(level)}, ` +
        (points.length ? "over what was learned." : "of which nothing was learned.");
    const marks = points.length ? " Dots are learned motions." : "";
    say(part("map-note"), `${what}${marks} Point at an arrow to see its motion.`);
  }

  /** Choose what may go most ways: how it begins, or what a slow level decides, how it goes on. */
  #chooseForks() {
    const which = this.map.slow ? 1 : 0;
    const ways = Object.entries(this.map.primitives).map(([name, strokes]) => [
      name,
      strokes[which].known.length,
    ]);
    [this.choice.value] = ways.toSorted((a, b) => b[1] - a[1])[0];
    this.which.value = String(which);
  }

  /** Say which way how much of the map goes. */
  #ways() {
    const { known, way } = this.#strokes;
    const said = [...known, ...Object.keys(ASTRAY)].map((name) => [
      name,
      way.filter((each) => each === name).length / way.length,
    ]);
    part("map-ways").replaceChildren(
      ...said
        .filter(([name, share]) => share || known.includes(name))
        .map(([name, share]) => {
          const swatch = made("i", `swatch ${paintOf(name)}`, "", { "aria-hidden": "true" });
          return made("li", "", [swatch, wayInWords(name), made("b", "", ` ${percent(share)}`)]);
        }),
    );
  }

  #axes(context, width) {
    const { axis, level, slow } = this.map;
    const [unit, far] = [slow ? "unit" : "axis", axis.at(-1).toFixed(0)];
    const middle = MARGIN + (width - MARGIN - RIM) / 2;
    context.fillText(`first ${unit} of ${titled(level)}₀, −${far} to ${far}`, middle, width - 9);
    context.save();
    context.rotate(-Math.PI / 2);
    context.fillText(`second ${unit}`, -(width - middle), 18);
    context.restore();
  }

  #arrows(context, c) {
    const { axis } = this.map;
    const { direction, length, way } = this.#strokes;
    const long = 0.86 * (this.#pixel([1, 0])[0] - this.#pixel([0, 0])[0]);
    direction.forEach((angle, at) => {
      const cell = [Math.floor(at / axis.length), at % axis.length];
      const isChosen = String(cell) === String(this.cell);
      const half = (long / 2) * Math.min(Math.max(length[at], 0.15), 1);
      context.strokeStyle = c[paintOf(way[at])];
      context.lineWidth = isChosen ? 4 : 2;
      arrow(context, this.#pixel(cell), angle, half);
      if (!isChosen) return;
      const [x, y] = this.#pixel(cell);
      Object.assign(context, { strokeStyle: c.ink, lineWidth: 2 });
      context.strokeRect(x - long / 1.7, y - long / 1.7, long / 0.85, long / 0.85);
    });
  }

  /** Mark where the learned motions lie; a label that finds no room is left out, and told. */
  #points(context, c, width) {
    const taken = [];
    this.places = together(this.map.points).map((place) => ({
      ...place,
      pixel: this.#pixel(place.at.map((value) => this.#index(value))),
    }));
    for (const { pixel } of this.places) {
      Object.assign(context, { fillStyle: c.ink, strokeStyle: c.card, lineWidth: 3 });
      context.beginPath();
      context.arc(...pixel, 5, 0, 2 * Math.PI);
      context.stroke();
      context.fill();
      taken.push([pixel[0] - 6, pixel[1] - 6, 12, 12]);
    }
    for (const { motions, pixel } of this.places) {
      const [first, ...others] = motions;
      const label = others.length ? `${first} +${others.length}` : first;
      const room = roomFor(pixel, context.measureText(label).width, taken, width);
      if (!room) continue;
      taken.push(room);
      Object.assign(context, { fillStyle: c.card, textAlign: "left", globalAlpha: 0.85 });
      context.fillRect(room[0] - 2, room[1], room[2] + 4, room[3]);
      Object.assign(context, { fillStyle: c.ink, globalAlpha: 1 });
      context.fillText(label, room[0], room[1] + HIGH - 4);
    }
  }

  /** Return the place of a value on the axis, in cells, also between and beyond them. */
  #index(value) {
    const { axis } = this.map;
    return ((value - axis[0]) / (axis.at(-1) - axis[0])) * (axis.length - 1);
  }

  get #size() {
    return (this.canvas.clientWidth - MARGIN - RIM) / this.map.axis.length;
  }

  #pixel([i, k]) {
    return [
      MARGIN + this.#size * (i + 0.5),
      RIM + this.#size * (this.map.axis.length - k - 0.5),
    ];
  }

  #cellAt(event) {
    if (!this.map) return null;
    const cells = this.map.axis.length;
    const at = [
      Math.floor((event.offsetX - MARGIN) / this.#size),
      cells - 1 - Math.floor((event.offsetY - RIM) / this.#size),
    ];
    return at.every((v) => v >= 0 && v < cells) ? at : null;
  }

  #middle() {
    const middle = Math.floor(this.map.axis.length / 2);
    return [middle, middle];
  }

  #key(event) {
    if (!(event.key in STEPS) || !this.map) return;
    const last = this.map.axis.length - 1;
    const [from, step] = [this.cell ?? this.#middle(), STEPS[event.key]];
    this.#point(from.map((v, i) => Math.min(Math.max(v + step[i], 0), last)));
    event.preventDefault();
  }

  #point(cell) {
    if (!cell || String(cell) === String(this.cell)) return;
    this.cell = cell;
    this.draw();
    this.#want();
  }

  /** Return the values of the point that is chosen. */
  #at() {
    return this.cell.map((i) => this.map.axis[i]);
  }

  /** Say what there is at a point, and ask for its motion: at once, and then not too often. */
  #want() {
    const { axis, level, primitives } = this.map;
    const at = this.cell[0] * axis.length + this.cell[1];
    const ways = primitives[this.choice.value].map(({ way }) => wayInWords(way[at]));
    const here = this.places.filter(({ at: there }) =>
      there.every((value, i) => Math.round(this.#index(value)) === this.cell[i]),
    );
    const names = here.flatMap(({ motions }) => motions).join(", ");
    const values = this.#at().map((value) => value.toFixed(1).replace("-", "−"));
    const learned = names && ` Learned here: ${names}.`;
    const point = `${titled(level)}₀ = (${values.join(", ")})`;
    say(part("map-told"), `${point}: ${ways.join(", then ")}.${learned}`);
    if (this.waiting) return;
    this.wanted(this.#at(), this.choice.value);
    const asked = String([...this.cell, this.choice.value]);
    this.waiting = setTimeout(() => {
      this.waiting = undefined;
      if (this.cell && String([...this.cell, this.choice.value]) !== asked) this.#want();
    }, SEND_EVERY_MS);
  }
}

const percent = (share) => `${Math.round(100 * share)} %`;

/** Return a way in words: "down, to LR". */
function wayInWords(name) {
  if (name in ASTRAY) return ASTRAY[name];
  const [{ words, end }] = primitivesOf(name);
  return `${words}, to ${end}`;
}

/** Return the name of a way's colour: that of the place it leads to. */
function paintOf(name) {
  if (name in ASTRAY) return "soft";
  const { end } = primitivesOf(name)[0];
  const others = Object.keys(task.places).filter((place) => !colourAt(place));
  return colourAt(end) ?? PAINTS[others.indexOf(end) % PAINTS.length];
}

function arrow(context, [x, y], angle, half) {
  const [dx, dy] = [half * Math.cos(angle), -half * Math.sin(angle)];
  context.lineCap = "round";
  context.beginPath();
  context.moveTo(x - dx, y - dy);
  context.lineTo(x + dx, y + dy);
  for (const turn of [2.6, -2.6]) {
    context.moveTo(x + dx, y + dy);
    context.lineTo(
      x + dx + 0.7 * half * Math.cos(angle + turn),
      y + dy - 0.7 * half * Math.sin(angle + turn),
    );
  }
  context.stroke();
}

/** Return room [x, y, wide, high] for a label beside a point, clear of what is taken. */
function roomFor([x, y], wide, taken, width) {
  const rooms = [
    [x + BESIDE, y - HIGH / 2],
    [x - BESIDE - wide, y - HIGH / 2],
    [x - wide / 2, y - BESIDE - HIGH],
    [x - wide / 2, y + BESIDE],
    [x + BESIDE, y - HIGH - 4],
    [x + BESIDE, y + 4],
    [x - BESIDE - wide, y - HIGH - 4],
    [x - BESIDE - wide, y + 4],
  ];
  return rooms
    .map((corner) => [...corner, wide, HIGH])
    .find(
      (room) =>
        room[0] >= MARGIN &&
        room[0] + wide <= width &&
        room[1] >= 0 &&
        room[1] + HIGH <= width - MARGIN &&
        !taken.some((other) => overlap(room, other)),
    );
}

const overlap = ([x, y, wide, high], [a, b, broad, tall]) =>
  x < a + broad && a < x + wide && y < b + tall && b < y + high;

/** Bring motions together whose points lie on each other, so that their names can be read. */
function together(points) {
  const places = new Map();
  for (const { motion, at } of points) {
    const key = at.map(Math.round).join();
    const place = places.get(key) ?? { motions: [], at };
    if (!place.motions.includes(motion)) place.motions.push(motion);
    places.set(key, place);
  }
  return [...places.values()];
}
