// Something that goes on in time, drawn when there is something new to draw and at no other moment.

/** Runs `step(elapsed_ms)` at most so many times a second until it returns false. */
export class Pace {
  constructor(hz) {
    this.period = 1000 / hz;
  }

  /** Start from zero; what ran before is stopped. */
  start(step) {
    this.stop();
    const from = performance.now();
    const tick = () => {
      const now = performance.now();
      if (step(now - from) === false) {
        this.timer = undefined;
        return;
      }
      this.timer = setTimeout(tick, Math.max(this.period - (performance.now() - now), 4));
    };
    tick();
  }

  /** Whether it runs. */
  get runs() {
    return this.timer !== undefined;
  }

  stop() {
    clearTimeout(this.timer);
    this.timer = undefined;
  }
}

/** Frames that a performance may be behind what has arrived, as where it follows a quick pen. */
const LATE = 4;

/** Plays the poses of a performance as they arrive, in the time they were taken in. */
export class Player {
  /**
   * @param {Pace} pace
   * @param {(row: number, poses: number[][], seconds: number) => void} show
   */
  constructor(pace, show) {
    Object.assign(this, { pace, show, poses: [], complete: false, held: false });
  }

  /** Take a chunk of `frames`; one that begins at row 0 begins a new performance. */
  take({ from, rate_hz: rate, poses, last }) {
    if (from === 0) {
      this.pace.stop();
      Object.assign(this, { poses: [], complete: false, shown: -1 });
    }
    this.rate = rate;
    this.poses.push(...poses);
    this.complete = last;
    if (from === 0) this.pace.start((elapsed) => this.#step(elapsed));
  }

  /** Hold the picture still (while a person draws); the performance goes on unseen. */
  hold(held) {
    this.held = held;
    if (!held && this.poses.length && !this.pace.runs) this.#show(this.poses.length - 1);
  }

  #step(elapsed) {
    const newest = this.poses.length - 1;
    const due = Math.max(Math.floor((elapsed / 1000) * this.rate), newest - LATE);
    const row = Math.min(due, newest);
    if (!this.held && row !== this.shown) this.#show(row);
    return !this.complete || row < newest;
  }

  /** Leave a performance whose end will not come. */
  stop() {
    this.pace.stop();
  }

  #show(row) {
    this.shown = row;
    this.show(row, this.poses, row / this.rate);
  }
}
