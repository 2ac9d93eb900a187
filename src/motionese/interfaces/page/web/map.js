// The map of the slow initial states: which way the hand goes from every point of it.

import { made, colours, fitted, onScheme, titled } from "./dom.js";

const SEND_EVERY_MS = 120;
const MARGIN = 26;
const STEPS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

export class SlowMap {
  /** `hovered(slow, primitive)` is called for a point that is pointed at, `left()` when none is. */
  constructor(canvas, choice, hovered, left) {
    Object.assign(this, { canvas, choice, hovered, left, map: null, cell: null });
    choice.addEventListener("change", () => this.draw());
    canvas.addEventListener("pointermove", (event) => this.#point(this.#cellAt(event)));
    canvas.addEventListener("pointerdown", (event) => this.#point(this.#cellAt(event)));
    canvas.addEventListener("pointerleave", () => this.#leave());
    canvas.addEventListener("blur", () => this.#leave());
    canvas.addEventListener("keydown", (event) => {
      if (!(event.key in STEPS) || !this.map) return;
      const last = this.map.axis.length - 1;
      const middle = [Math.round(last / 2), Math.round(last / 2)];
      this.#point(
        (this.cell ?? middle).map((v, i) => Math.min(Math.max(v + STEPS[event.key][i], 0), last)),
      );
      event.preventDefault();
    });
    new ResizeObserver(() => this.draw()).observe(canvas);
    onScheme(() => this.draw());
  }

  take(map) {
    this.map = map;
    const names = Object.keys(map.primitives);
    const chosen = names.includes(this.choice.value) ? this.choice.value : names[0];
    this.choice.replaceChildren(
      ...names.map((name) => made("option", "", `State of ${name}`, { value: name })),
    );
    this.choice.value = chosen;
    this.choice.disabled = !names.length;
    this.draw();
  }

  /** Forget the map: it is another robot's. */
  clear() {
    this.map = this.cell = null;
    this.choice.replaceChildren();
    this.choice.disabled = true;
    this.draw();
  }

  draw() {
    const { context, width } = fitted(this.canvas);
    const c = colours();
    context.clearRect(0, 0, width, width);
    context.font = `12px ${getComputedStyle(document.body).fontFamily}`;
    context.fillStyle = c.soft;
    context.textAlign = "center";
    if (!this.map) {
      context.fillText("Not drawn yet", width / 2, width / 2);
      return;
    }
    context.fillText(`first unit of ${titled(this.map.level)}₀`, width / 2, width - 8);
    context.save();
    context.rotate(-Math.PI / 2);
    context.fillText("second unit", -width / 2, 14);
    context.restore();
    this.#arrows(context, c);
    this.#points(context, c);
  }

  #arrows(context, c) {
    const { axis, primitives } = this.map;
    const paint = [c.orange, c.blue, c.pink, c.sky];
    const long = 0.86 * (this.#pixel([1, 0])[0] - this.#pixel([0, 0])[0]);
    const arrows = primitives[this.choice.value];
    // As long as a cell where the hand goes as far as in most places.
    const far = arrows.map(({ extent }) => extent).toSorted((a, b) => a - b)[
      Math.floor(0.7 * arrows.length)
    ];
    arrows.forEach(({ direction, extent }, at) => {
      const [i, k] = [Math.floor(at / axis.length), at % axis.length];
      const [x, y] = this.#pixel([i, k]);
      const half = (long / 2) * Math.min(Math.max(extent / far, 0.12), 1);
      const [dx, dy] = [half * Math.cos(direction), -half * Math.sin(direction)];
      // Quarters of the circle: left, down, right, up.
      const quarter = Math.round((direction - Math.PI) / (Math.PI / 2) + 8) % 4;
      const chosen = this.cell && this.cell[0] === i && this.cell[1] === k;
      context.strokeStyle = chosen ? c.ink : paint[quarter];
      context.lineWidth = chosen ? 3 : 1.6;
      context.beginPath();
      context.moveTo(x - dx, y - dy);
      context.lineTo(x + dx, y + dy);
      for (const turn of [2.6, -2.6]) {
        context.moveTo(x + dx, y + dy);
        context.lineTo(
          x + dx + 0.7 * half * Math.cos(direction + turn),
          y + dy - 0.7 * half * Math.sin(direction + turn),
        );
      }
      context.stroke();
    });
    this.canvas.setAttribute(
      "aria-label",
      `Map of the slow initial states, ${axis.length} by ${axis.length}; arrow keys move from point to point`,
    );
  }

  #points(context, c) {
    for (const { motions, slow } of together(this.map.points ?? [])) {
      const [x, y] = this.#pixel(slow.map((value) => this.#index(value)));
      const isRight = x > this.canvas.clientWidth / 2;
      const label = motions.length > 1 ? `${motions[0]} +${motions.length - 1}` : motions[0];
      Object.assign(context, { fillStyle: c.ink, strokeStyle: c.card, lineWidth: 3 });
      context.beginPath();
      context.arc(x, y, 5, 0, 2 * Math.PI);
      context.stroke();
      context.fill();
      context.textAlign = isRight ? "right" : "left";
      context.strokeText(label, x + (isRight ? -8 : 8), y + 4);
      context.fillText(label, x + (isRight ? -8 : 8), y + 4);
    }
  }

  /** Return the place of a value on the axis, in cells, also between and beyond them. */
  #index(value) {
    const { axis } = this.map;
    return ((value - axis[0]) / (axis.at(-1) - axis[0])) * (axis.length - 1);
  }

  #pixel([i, k]) {
    const cells = this.map.axis.length;
    const cell = (this.canvas.clientWidth - MARGIN - 8) / cells;
    return [MARGIN + cell * (i + 0.5), 8 + cell * (cells - k - 0.5)];
  }

  #cellAt(event) {
    if (!this.map) return null;
    const cells = this.map.axis.length;
    const cell = (this.canvas.clientWidth - MARGIN - 8) / cells;
    const at = [
      Math.floor((event.offsetX - MARGIN) / cell),
      cells - 1 - Math.floor((event.offsetY - 8) / cell),
    ];
    return at.every((v) => v >= 0 && v < cells) ? at : null;
  }

  #point(cell) {
    if (!cell || String(cell) === String(this.cell)) return;
    this.cell = cell;
    this.draw();
    // The last point wins; at most so many are asked for a second.
    this.waiting ??= setTimeout(() => {
      this.waiting = undefined;
      if (this.cell)
        this.hovered(
          this.cell.map((i) => this.map.axis[i]),
          this.choice.value,
        );
    }, SEND_EVERY_MS);
  }

  #leave() {
    if (!this.cell) return;
    this.cell = null;
    this.draw();
    this.left();
  }
}

/** Bring motions together whose points lie on each other, so that their names can be read. */
function together(points) {
  const places = new Map();
  for (const { motion, slow } of points) {
    const key = slow.map(Math.round).join();
    const place = places.get(key) ?? { motions: [], slow };
    if (!place.motions.includes(motion)) place.motions.push(motion);
    places.set(key, place);
  }
  return [...places.values()];
}
