// One picture of a lesson's film: eye view and robot side by side, the errors so far below.

import { direction, disc, flatGround, line, placeAt } from "./marks.js";
import { Robot } from "./robot.js";
import { inWords, task } from "./task.js";

export const [WIDTH, HEIGHT] = [960, 540];
const [HEAD, WIDE, HIGH, EDGE] = [44, 480, 360, 24];
const FOOT = HEAD + HIGH;
const CHART = { left: 640, right: 920, top: FOOT + 22, bottom: HEIGHT - 30 };
/** A hand that shows a motion is no steadier [cm]. */
const WELL_CM = 2;
const CRAYON = 9;

export class FilmPicture {
  /** Draw a lesson {tries, result}; `seen` is the robot whose side is shown, null for none. */
  constructor(scene, lesson, seen, colours) {
    this.canvas = Object.assign(document.createElement("canvas"), { width: WIDTH, height: HEIGHT });
    this.context = this.canvas.getContext("2d", { willReadFrequently: true });
    this.family = getComputedStyle(document.body).fontFamily;
    Object.assign(this, { lesson, colours });
    this.effects = scene.task.effects.map(({ name }) => name);
    if (seen) this.#robot(scene.robot, seen);
    this.ground = this.#ground(scene.view.camera);
  }

  /** Draw a part {attempt, speed, last} of the film, so long [s] after its beginning. */
  draw({ attempt, speed, last = false }, time) {
    const { film } = this.lesson.tries[attempt];
    const at = Math.min(time * speed * film.rate_hz, film.poses.length - 1);
    const ended = at === film.poses.length - 1;
    const { context: c, colours } = this;
    c.fillStyle = colours.paper;
    c.fillRect(0, 0, WIDTH, HEIGHT);
    this.#heading();
    this.#eye(attempt, at / (film.poses.length - 1));
    this.#body(attempt, Math.round(at));
    this.#caption(attempt, last, ended);
    this.#errors(attempt, last, ended);
  }

  /** Give back what was taken to draw. */
  release() {
    this.robot?.release();
  }

  #robot(model, { orbit, software }) {
    this.robot = new Robot(document.createElement("canvas"), software);
    Object.assign(this.robot.orbit, orbit);
    this.robot.take(model);
  }

  #ground(camera) {
    const ground = Object.assign(document.createElement("canvas"), { width: WIDE, height: HIGH });
    const context = ground.getContext("2d");
    const seen = this.robot && camera ? this.robot.seen(camera, WIDE, HIGH) : null;
    if (seen) context.drawImage(seen, 0, 0, WIDE, HIGH);
    else flatGround(context, this.#view);
    for (const name of Object.keys(task.places)) placeAt(context, this.#view, name);
    return ground;
  }

  /** What marks are drawn in. */
  get #view() {
    const pixel = ([x, y]) => [x * WIDE, y * HIGH];
    return { width: WIDE, height: HIGH, colours: this.colours, pixel };
  }

  #heading() {
    const { motion } = this.lesson.result;
    const words = inWords(motion);
    this.#write(words === "nothing" ? motion : words, EDGE, HEAD / 2 + 1, 600, 19, "ink");
    this.#write("motionese", WIDTH - EDGE, HEAD / 2 + 1, 400, 16, "soft", "right");
  }

  #eye(attempt, share) {
    const { context: c, colours } = this;
    const { tries } = this.lesson;
    const { path, drawn } = tries[attempt];
    const rows = Math.floor(share * (path.length - 1) + 1e-9) + 1;
    const pixels = (points) => points.map((point) => this.#view.pixel(point.slice(-2)));
    c.save();
    c.translate(0, HEAD);
    c.beginPath();
    c.rect(0, 0, WIDE, HIGH);
    c.clip();
    c.drawImage(this.ground, 0, 0);
    line(c, pixels(drawn), { colour: colours.crayon, width: CRAYON });
    if (attempt) line(c, pixels(tries[0].path), { colour: colours.soft, width: 3, dash: [2, 7] });
    const done = pixels(path.slice(0, rows));
    line(c, done, { colour: colours.green, width: 4 });
    direction(c, pixels(drawn), { colour: colours.ink, rim: colours.card });
    disc(c, ...done.at(-1), 7, colours.green);
    c.restore();
  }

  #body(attempt, row) {
    const { context: c, colours, robot } = this;
    if (!robot) {
      c.fillStyle = colours.band;
      c.fillRect(WIDE, HEAD, WIDE, HIGH);
      return;
    }
    const { poses, effects } = this.lesson.tries[attempt].film;
    const first = this.lesson.tries[0].film.poses;
    robot.pose(poses[row]);
    robot.ghost(attempt ? first[Math.min(row, first.length - 1)] : null);
    const depths = effects[Math.floor((row * effects.length) / poses.length)] ?? [];
    robot.light(this.effects, depths);
    robot.drawn(WIDE, HIGH);
    c.drawImage(robot.canvas, WIDE, HEAD, WIDE, HIGH);
  }

  #caption(attempt, last, ended) {
    const { tries, result } = this.lesson;
    if (last && ended) {
      this.#wrapped(result.sentence, EDGE, FOOT + 28, CHART.left - 4 * EDGE);
      return;
    }
    const practices = tries.length - 1;
    const which = attempt ? `Practice ${attempt} of ${practices}` : "Before practice";
    const told = last ? `What it kept${attempt ? "" : ": as before"}` : which;
    this.#write(told, EDGE, FOOT + 42, 600, 24, "ink");
    const error = `${tries[attempt].error_cm.toFixed(1)} cm off`;
    if (ended) this.#write(error, EDGE, FOOT + 76, 400, 22, "soft");
    if (attempt)
      this.#write("dotted, seen through: its first try", EDGE, HEIGHT - 24, 400, 15, "soft");
  }

  /** The error of every try so far, over its practices; a ring around the one that was kept. */
  #errors(attempt, last, ended) {
    const { context: c, colours } = this;
    const errors = this.lesson.result.tries;
    const shown = last ? errors.length : attempt + (ended ? 1 : 0);
    const most = Math.max(...errors, 2 * WELL_CM);
    const x = (i) => CHART.left + ((CHART.right - CHART.left) * i) / Math.max(errors.length - 1, 1);
    const y = (cm) => CHART.bottom - ((CHART.bottom - CHART.top) * cm) / most;
    const across = (cm) => [
      [CHART.left, y(cm)],
      [CHART.right, y(cm)],
    ];
    line(c, across(0), { colour: colours.rule, width: 1 });
    line(c, across(WELL_CM), { colour: colours.green, width: 1.5, dash: [4, 5] });
    this.#write(`${WELL_CM} cm`, CHART.left - 12, y(WELL_CM), 400, 14, "soft", "right");
    errors.forEach((_, i) => this.#write(`${i}`, x(i), HEIGHT - 15, 400, 14, "soft", "center"));
    this.#write("practice", CHART.left - 12, HEIGHT - 15, 400, 14, "soft", "right");
    const dots = errors.slice(0, shown).map((cm, i) => [x(i), y(cm)]);
    line(c, dots, { colour: colours.blue, width: 2.5 });
    dots.forEach((dot) => disc(c, ...dot, 5, colours.blue));
    if (!last) return;
    const [keptX, keptY] = dots[this.lesson.result.kept];
    Object.assign(c, { strokeStyle: colours.green, lineWidth: 3 });
    c.beginPath();
    c.arc(keptX, keptY, 9, 0, 2 * Math.PI);
    c.stroke();
  }

  #write(text, x, y, weight, size, colour, align = "left") {
    const c = this.context;
    c.font = `${weight} ${size}px ${this.family}`;
    Object.assign(c, { fillStyle: this.colours[colour], textAlign: align, textBaseline: "middle" });
    c.fillText(text, x, y);
  }

  /** Write a sentence, in lines so wide at most. */
  #wrapped(text, x, y, wide) {
    const c = this.context;
    c.font = `600 20px ${this.family}`;
    const lines = [""];
    for (const word of text.split(" ")) {
      const longer = `${lines.at(-1)} ${word}`.trim();
      if (c.measureText(longer).width <= wide) lines[lines.length - 1] = longer;
      else lines.push(word);
    }
    lines.forEach((one, i) => this.#write(one, x, y + 27 * i, 600, 20, "ink"));
  }
}
