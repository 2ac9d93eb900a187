// All the ways in which a person shows a motion: pointer, keys, webcam. Each makes a stroke.

import { composable } from "./compose.js";
import { allowed, part, say } from "./dom.js";
import { pathAlong, rowsUntil, waysThrough } from "./paths.js";
import { drawable } from "./pen.js";
import { Pace } from "./playing.js";
import { Stroke } from "./stroke.js";
import { task } from "./task.js";
import { Webcam } from "./webcam.js";

export class Showing {
  /**
   * @param {View} view
   * @param {object} to - `may()` says whether a motion may be shown now, `follows()` whether the
   *   robot's arm is to follow it; `send`, `began`, `ended`, `touched`, `changed`, `tell` are called
   *   as their names say.
   */
  constructor(view, to) {
    Object.assign(this, {
      view,
      to,
      sent: 0,
      stroke: null,
      keyed: "",
      wanted: false,
      pace: new Pace(30),
    });
    const surface = part("surface");
    drawable(surface, {
      at: (x, y) => view.at(x, y),
      down: (point) => {
        to.touched();
        return this.#begin(point, "drawn");
      },
      move: (points) => this.#add(points),
      up: () => this.#end(),
    });
    composable(surface, {
      choose: (place) => {
        to.touched();
        view.mark({ hand: task.places[place].at, plan: null });
      },
      planned: (places) => {
        to.touched();
        const plan = places.map((place) => task.places[place].at);
        view.mark({ plan, hand: plan.at(-1) });
      },
      perform: (places) => this.#perform(places),
      gaveUp: () => view.mark({ plan: null, hand: null }),
      keyed: (state) => {
        this.keyed = state;
        to.changed();
      },
      tell: to.tell,
    });
    this.webcam = new Webcam(part("webcam-picture"), (place, t) => this.#red(place, t));
    part("webcam").addEventListener("click", () => allowed(part("webcam")) && this.#switched());
    part("webcam-show").addEventListener("click", () => {
      if (!allowed(part("webcam-show"))) return;
      if (this.drawing) this.#end();
      else this.#show();
    });
  }

  /** Whether a motion is being shown. */
  get drawing() {
    return this.stroke !== null;
  }

  /** Whether the camera is on. */
  get filmed() {
    return this.webcam.on;
  }

  /** Forget the motion under way, as when the connection is lost. */
  drop() {
    this.pace.stop();
    this.stroke?.drop();
    this.stroke = null;
    this.#label();
  }

  #begin(point, source) {
    if (this.drawing || !this.to.may()) return false;
    this.to.began();
    this.stroke = new Stroke(this.to.send, source, this.to.follows(), () => {
      this.to.tell("That was as long as a motion can be. The robot looks at what it saw.");
      this.#done();
    });
    this.stroke.begin(point);
    this.sent += 1;
    this.view.draw([point]);
    this.#label();
    return true;
  }

  #add(points) {
    if (!this.stroke) return;
    this.view.draw(points);
    this.sent += points.length;
    this.stroke.add(points);
  }

  #end() {
    if (!this.stroke) return;
    this.stroke.end();
    this.#done();
  }

  #done() {
    this.stroke = null;
    this.pace.stop();
    this.#label();
    this.to.ended();
  }

  /** Send a motion that was composed with the keys, in the time a hand would take. */
  #perform(places) {
    const ways = waysThrough(places.map((place) => task.places[place].at));
    const path = pathAlong(ways, performance.now());
    if (!this.#begin(path[0], "drawn")) return;
    let sent = 1;
    this.pace.start((elapsed) => {
      const until = rowsUntil(path, path[0][0] + elapsed);
      if (until > sent) this.#add(path.slice(sent, until));
      sent = Math.max(sent, until);
      this.view.mark({ hand: path[sent - 1] });
      if (sent < path.length) return true;
      this.view.mark({ hand: null });
      this.#end();
      return false;
    });
  }

  async #switched() {
    this.to.touched();
    if (this.filmed) {
      if (this.drawing) this.#end();
      this.webcam.stop();
      this.view.mark({ hand: null });
    } else {
      try {
        await this.webcam.start();
      } catch (error) {
        this.webcam.stop();
        const why = error.name === "NotAllowedError" ? "was not allowed" : "could not be opened";
        this.to.tell(`The camera ${why}. You can draw with the mouse, a pen or a finger instead.`);
      }
    }
    this.wanted = false;
    part("webcam-inset").hidden = part("webcam-show").hidden = !this.filmed;
    part("webcam").setAttribute("aria-pressed", String(this.filmed));
    this.#label();
    this.to.changed();
  }

  #show() {
    this.wanted = true;
    this.#label();
  }

  /** Take where the red thing is; the stroke begins with the first sight of it. */
  #red(place, t) {
    if (!place) return;
    if (this.wanted && !this.drawing) {
      this.wanted = false;
      this.#begin([t, ...place], "webcam");
    } else if (this.stroke?.source === "webcam") this.#add([[t, ...place]]);
    this.view.mark({ hand: place });
  }

  #label() {
    say(
      part("webcam-show"),
      this.drawing ? "Stop showing" : this.wanted ? "Looking for red …" : "Start showing",
    );
    say(part("webcam"), this.filmed ? "Webcam off" : "Webcam");
  }
}
