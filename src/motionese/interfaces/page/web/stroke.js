// A motion on its way to the robot, from whatever moves: pointer, keyboard or webcam.

const BATCH_MS = 40;
/** The server's limits on a drawing, kept with a margin. */
const LONGEST_MS = 19_800;
const MOST_POINTS = 3_950;

export class Stroke {
  /**
   * @param {(message: object) => boolean} send
   * @param {"drawn"|"webcam"} source
   * @param {boolean} follow - whether the robot's arm is to follow it.
   * @param {() => void} full - called when the robot cannot take more; the stroke has then ended.
   */
  constructor(send, source, follow, full) {
    this.send = send;
    this.full = full;
    this.points = 0;
    this.ended = false;
    this.source = source;
    this.follow = follow;
  }

  /** Begin at a point [t_ms, x, y]. */
  begin(point) {
    this.last = this.first = point[0];
    this.points = 1;
    this.waiting = [];
    const { source, follow } = this;
    this.send({ type: "pen", phase: "down", source, follow, points: [rounded(point)] });
  }

  /** Add points; times that stand still are moved on by the least that can be told apart. */
  add(points) {
    if (this.ended) return;
    for (const [t, x, y] of points) {
      this.last = Math.max(t, this.last + 0.01);
      this.waiting.push(rounded([this.last, x, y]));
      this.points += 1;
    }
    if (this.last - this.first > LONGEST_MS || this.points > MOST_POINTS) {
      this.end();
      this.full();
      return;
    }
    this.timer ??= setTimeout(() => this.#pass("move"), BATCH_MS);
  }

  /** End it; what has not been sent goes with the end. */
  end() {
    if (this.ended) return;
    this.ended = true;
    this.#pass("up");
  }

  /** Forget it; the robot is not there to see the end. */
  drop() {
    this.ended = true;
    clearTimeout(this.timer);
  }

  #pass(phase) {
    clearTimeout(this.timer);
    this.timer = undefined;
    this.send({ type: "pen", phase, points: this.waiting });
    this.waiting = [];
  }
}

const rounded = ([t, x, y]) => [+t.toFixed(2), +x.toFixed(5), +y.toFixed(5)];
