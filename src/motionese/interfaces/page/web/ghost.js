// A demonstration without a hand: a red hand that moves over the view by itself.

import { prefersStillness } from "./dom.js";
import { rowsUntil } from "./paths.js";

const PAUSE_MS = 1400;

export class Ghost {
  constructor(view, pace) {
    Object.assign(this, { view, pace, plays: false });
  }

  /** Play a path once, then call `ended`; shown at once to those who want things still. */
  play(path, ended = () => {}) {
    this.stop();
    this.plays = true;
    const from = path[0][0];
    const until = prefersStillness() ? from : path.at(-1)[0];
    const finish = () => {
      this.plays = false;
      this.view.mark({ hand: path.at(-1), shown: path });
      ended();
    };
    this.pace.start((elapsed) => {
      if (from + elapsed >= until) {
        finish();
        return false;
      }
      this.#show(path, from + elapsed);
      return true;
    });
  }

  /** Invite: play a path again and again until it is stopped. */
  invite(path) {
    this.stop();
    this.plays = true;
    this.view.mark({ promise: path, hand: path[0], shown: null });
    if (prefersStillness()) return;
    const period = path.at(-1)[0] + PAUSE_MS;
    // It rests where one must press: whoever does as it does begins there.
    this.pace.start((elapsed) => {
      const t = Math.max((elapsed % period) - PAUSE_MS, 0);
      if (!document.hidden) this.#show(path, t);
      return true;
    });
  }

  /** Stop and go. */
  stop() {
    this.pace.stop();
    if (this.plays) this.view.mark({ hand: null, shown: null, promise: null });
    this.plays = false;
  }

  #show(path, t) {
    const rows = path.slice(0, Math.max(rowsUntil(path, t), 1));
    this.view.mark({ hand: rows.at(-1), shown: rows });
  }
}
