// A lesson as it is seen: every practice played quickly as it comes, the first as a ghost behind.

import { part, prefersStillness, say } from "./dom.js";

/** Practices are played so many times as quickly as they were. */
const SPEED = 3;

export class Lesson {
  /** `ended(learned, tries)` is called when the lesson is over and was seen, or skipped. */
  constructor(playback, ended) {
    Object.assign(this, { playback, ended, tries: [], waiting: [], result: null, shown: 0 });
    part("skip").addEventListener("click", () => this.skip());
  }

  /** Whether practices are being played. */
  get plays() {
    return this.playing || this.waiting.length > 0;
  }

  /** Take a practice, the first of which is how it was before. */
  take(practice) {
    if (practice.attempt === 0) this.drop();
    this.tries[practice.attempt] = practice;
    if (prefersStillness() || this.skipped) return;
    this.waiting.push(practice);
    if (!this.playing) this.#next();
  }

  /** Take what the lesson has brought. */
  learned(result) {
    this.result = result;
    if (!this.plays) this.#finish();
  }

  /** Play no more of this lesson. */
  skip() {
    this.waiting = [];
    this.skipped = true;
    if (this.playing) this.playback.stop();
    this.playing = false;
    this.#finish();
  }

  /** Forget a lesson that was stopped: the robot is idle, and no result has come. */
  stopped() {
    if (!this.result && this.tries.length) {
      this.playback.stop();
      this.drop();
    }
  }

  /** Forget the lesson. */
  drop() {
    Object.assign(this, { tries: [], waiting: [], result: null, playing: false, skipped: false });
  }

  #next() {
    const practice = this.waiting.shift();
    this.playing = Boolean(practice);
    if (!practice) {
      this.#finish();
      return;
    }
    this.shown += 1;
    const { attempt, of, error_cm: error } = practice;
    const which = attempt ? `Practice ${attempt} of ${of}` : "Before practice";
    say(part("attempt"), `${which}: ${error.toFixed(1)} cm off`);
    this.playback.load(practice, attempt ? this.tries[0] : null);
    this.playback.play(SPEED, () => this.#next());
  }

  #finish() {
    const { result, tries } = this;
    if (!result) return;
    const kept = tries[result.kept];
    if (kept) this.playback.load(kept, result.kept ? tries[0] : null);
    this.drop();
    this.ended(result, tries);
  }
}
