// A try that is over, played again: one time for the robot, the strokes, joints and levels.

import { allow, allowed, part, say, shape } from "./dom.js";
import { Pace } from "./playing.js";
import { read } from "./task.js";

/** A time axis has at most so many numbers. */
const MOST_TICKS = 8;

export class Playback {
  /** Play on a stage, with the strokes in a view; `changed()` is called when it begins or ends. */
  constructor(stage, view, changed) {
    Object.assign(this, { stage, view, changed, tried: null, first: null, at: 0 });
    this.pace = new Pace(24);
    part("time").addEventListener("input", () => {
      this.stop();
      this.seek(Number(part("time").value));
    });
    part("play").addEventListener("click", () => {
      if (!allowed(part("play"))) return;
      if (this.plays) this.stop();
      else this.play(1);
    });
  }

  /** Whether it goes on by itself. */
  get plays() {
    return this.pace.runs;
  }

  /** How long the try lasts [s]. */
  get seconds() {
    return (this.tried.film.poses.length - 1) / this.tried.film.rate_hz;
  }

  /** Take a try {film, path, begins, motion}, and the first one as a ghost behind it, or none. */
  load(tried, first = null) {
    this.stop();
    Object.assign(this, { tried, first });
    this.stage.whole(tried.film, tried.begins);
    this.stage.ghost(first?.film ?? null);
    this.view.mark({ first: first?.path ?? null, rest: tried.path });
    const time = part("time");
    time.max = this.seconds.toFixed(3);
    time.step = (1 / tried.film.rate_hz).toFixed(3);
    part("time-axis").replaceChildren(...axis(this.seconds, tried.begins, tried.motion));
    this.seek(this.seconds);
    this.#label();
  }

  /** Play from the beginning, or go on, at so many times its speed; then call `ended`. */
  play(speed, ended = () => {}) {
    const from = this.at >= this.seconds - 1e-3 ? 0 : this.at;
    this.pace.period = this.stage.period;
    this.pace.start((elapsed) => {
      this.seek(Math.min(from + (speed * elapsed) / 1000, this.seconds));
      if (this.at < this.seconds) return true;
      queueMicrotask(() => {
        this.#label();
        ended();
      });
      return false;
    });
    this.#label();
  }

  /** Stop where it is. */
  stop() {
    this.pace.stop();
    this.#label();
  }

  /** Show a moment [s]. */
  seek(seconds) {
    this.at = seconds;
    const { path } = this.tried;
    const rows = Math.round((seconds / this.seconds) * (path.length - 1)) + 1;
    this.view.mark({ done: path.slice(0, rows), tip: path[rows - 1] });
    this.stage.at(seconds);
    part("time").value = seconds;
    const told = `${seconds.toFixed(1)} of ${this.seconds.toFixed(1)} s`;
    part("time").setAttribute("aria-valuetext", told);
    say(part("time-value"), told);
  }

  /** Forget the try. */
  close() {
    this.stop();
    Object.assign(this, { tried: null, first: null });
    this.stage.ghost(null);
    this.view.mark({ first: null, rest: null, tip: null });
    part("time-axis").replaceChildren();
    say(part("time-value"), "");
    this.#label();
  }

  #label() {
    allow(part("play"), Boolean(this.tried));
    part("play").setAttribute("aria-label", this.plays ? "Pause" : "Play this try");
    part("play").classList.toggle("playing", this.plays);
    part("time").disabled = !this.tried;
    this.changed();
  }
}

/** Return seconds, and where primitives begin, as the parts of an SVG as wide as the slider. */
function axis(seconds, begins, motion) {
  const at = (time) => `${((100 * time) / seconds).toFixed(2)}%`;
  const parts = [];
  const step = [0.5, 1, 2, 5].find((each) => seconds / each <= MOST_TICKS) ?? 5;
  for (let time = 0; time <= seconds + 1e-6; time += step) {
    parts.push(shape("line", { class: "tick", x1: at(time), x2: at(time), y1: 0, y2: 4 }));
    parts.push(shape("text", { x: at(time), y: 15 }, `${time}`));
  }
  const { signs } = read(motion);
  begins.forEach((begin, i) => {
    const x = at(begin);
    if (i) parts.push(shape("line", { class: "begin", x1: x, x2: x, y1: 0, y2: 30 }));
    parts.push(shape("text", { class: "sign", x, dx: i ? 4 : -4, y: 29 }, signs[i] ?? ""));
  });
  return parts;
}
