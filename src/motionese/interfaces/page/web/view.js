// The robot's eye view: what it sees, what is drawn over it, and what it makes of that.

import { colours, fitted } from "./dom.js";
import { direction, disc, flatGround, hand, line, placeAt } from "./marks.js";
import { task } from "./task.js";

/** Width of what a person draws [px]: broad, so that what is recognised can be seen upon it. */
const CRAYON = 11;

/** Three layers: the ground (drawn once), the ink (drawn on, never redrawn), and marks over them. */
export class View {
  constructor({ ground, ink, surface }) {
    Object.assign(this, { ground, ink, surface, marks: {} });
    new ResizeObserver(() => this.refresh()).observe(surface);
  }

  /** Show another scene; `picture(width, height)` returns what the eye sees, or null. */
  take(picture) {
    this.picture = picture;
    this.refresh();
  }

  /** Draw everything anew, as after a change of size or colours. */
  refresh() {
    this.colours = colours();
    const { context, width, height } = fitted(this.ground);
    Object.assign(this, { width, height });
    if (!width) return;
    this.pen = fitted(this.ink).context;
    this.over = fitted(this.surface).context;
    this.#ground(context);
    this.clearInk();
    this.#marks();
  }

  /** Turn a place in the window into one of the view, both coordinates in [0, 1]. */
  at(clientX, clientY) {
    const box = this.surface.getBoundingClientRect();
    const shares = [(clientX - box.left) / box.width, (clientY - box.top) / box.height];
    return shares.map((share) => Math.min(Math.max(share, 0), 1));
  }

  /** Turn a place of the view into CSS pixels of the picture. */
  pixel([x, y]) {
    return [x * this.width, y * this.height];
  }

  /** Show marks: paths, and the places of the hand and of the tip of what is done. */
  mark(marks) {
    Object.assign(this.marks, marks);
    this.pending ??= requestAnimationFrame(() => this.#marks());
  }

  clearInk() {
    this.pen?.clearRect(0, 0, this.width, this.height);
    this.tip = null;
  }

  /** Draw on, from where the ink ended. */
  draw(points) {
    const pen = this.pen;
    pen.strokeStyle = this.colours.crayon;
    Object.assign(pen, { lineWidth: CRAYON, lineCap: "round", lineJoin: "round" });
    pen.beginPath();
    pen.moveTo(...(this.tip ?? this.pixel(points[0].slice(1))));
    for (const point of points) {
      this.tip = this.pixel(point.slice(1));
      pen.lineTo(...this.tip);
    }
    pen.stroke();
  }

  #ground(context) {
    const seen = this.picture?.(this.width, this.height);
    if (seen) context.drawImage(seen, 0, 0, this.width, this.height);
    else flatGround(context, this);
    for (const name of Object.keys(task.places)) placeAt(context, this, name);
  }

  #marks() {
    cancelAnimationFrame(this.pending);
    this.pending = undefined;
    const { over, marks, colours: c } = this;
    if (!over) return;
    over.clearRect(0, 0, this.width, this.height);
    const path = (points) => (points || []).map((p) => this.pixel(p.slice(-2)));
    line(over, path(marks.drawn), { colour: c.crayon, width: CRAYON });
    line(over, path(marks.plan), {
      colour: c.crayon,
      width: CRAYON,
    });
    line(over, path(marks.recognised), { colour: c.blue, width: 4 });
    line(over, path(marks.next), { colour: c.blue, width: 4, dash: [9, 9], arrow: true });
    line(over, path(marks.first), { colour: c.soft, width: 3, dash: [2, 7] });
    over.globalAlpha = 0.35;
    line(over, path(marks.rest), { colour: c.green, width: 4 });
    over.globalAlpha = 1;
    line(over, path(marks.done), { colour: c.green, width: 4 });
    direction(over, path(marks.drawn), { colour: c.ink, rim: c.card });
    if (marks.tip) disc(over, ...this.pixel(marks.tip), 7, c.green);
    line(over, path(marks.hovered), { colour: c.ink, width: 4, rim: c.card, arrow: true });
    direction(over, path(marks.hovered), { colour: c.ink, rim: c.card });
    line(over, path(marks.promise), { colour: c.hand, width: 3, dash: [3, 9], arrow: true });
    line(over, path(marks.shown), { colour: c.hand, width: 4 });
    if (marks.hand) hand(over, this.pixel(marks.hand.slice(-2)), c, this.width / 680);
  }
}
