// The robot on its stage: three dimensions, what goes on inside it, and the buttons it presses.

import { Activity } from "./charts.js";
import { made, onScheme, part } from "./dom.js";
import { Pace, Player } from "./playing.js";

/** What frames tell of the robot, a row a frame or fewer. */
const COLUMNS = ["poses", "commanded", "actual", "effects"];
/** Pictures a second where the processor draws them, and where a graphics card does. */
const [SOFT_HZ, HARD_HZ] = [10, 24];

export class Stage {
  /** `ready()` is called when the robot can be drawn, which takes longer than the page itself. */
  constructor(ready) {
    this.frames = 0;
    this.activity = new Activity(part("charts"));
    this.lights = [];
    this.player = new Player(new Pace(SOFT_HZ), (...at) => this.#show(...at));
    this.#load(ready);
  }

  /** Take the robot, the network's levels and the task's effects of a `scene`. */
  take({ robot, levels, channels, task: { effects } }) {
    this.model = robot;
    this.robot?.take(robot);
    this.activity.build(robot.joints, levels, channels);
    this.effects = effects.map(({ name }) => name);
    this.lights = effects.map(({ name, title }, i) =>
      made("li", `effect-${i}`, title, { "data-testid": `light-${name}` }),
    );
    part("lights").replaceChildren(...this.lights);
    part("lights").hidden = !effects.length;
  }

  /** Take a chunk of a performance. */
  perform(frames) {
    this.frames += frames.poses.length;
    if (frames.from === 0) {
      this.charted = -1;
      this.film = { rate_hz: frames.rate_hz, activity: {} };
      this.robot?.ghost(null);
    }
    append(this.film, frames, COLUMNS);
    append(this.film.activity, frames.activity, Object.keys(frames.activity));
    this.depths = this.film.effects;
    this.activity.take(frames);
    this.player.take(frames);
  }

  /** Take a whole film, to be shown at any time of it. */
  whole(film, begins) {
    this.player.stop();
    Object.assign(this, { film, depths: film.effects, charted: -1 });
    this.activity.take({ from: 0, ...film });
    this.activity.whole(begins);
  }

  /** Take the film that is seen behind the other, or none. */
  ghost(film) {
    this.behind = film;
    if (!film) this.robot?.ghost(null);
  }

  /** Show a moment [s] of the whole film. */
  at(seconds) {
    const { poses, rate_hz: rate } = this.film;
    const row = Math.min(Math.round(seconds * rate), poses.length - 1);
    const ghosts = this.behind?.poses;
    this.robot?.pose(poses[row]);
    this.robot?.ghost(ghosts ? ghosts[Math.min(row, ghosts.length - 1)] : null);
    this.#show(row, poses, seconds);
  }

  /** Time between two pictures [ms]. */
  get period() {
    return this.player.pace.period;
  }

  /** Forget the performance that was shown last. */
  clear() {
    this.player.stop();
    this.ghost(null);
    this.activity.clear();
    this.activity.show(0);
  }

  /** Hold the picture still while a person draws. */
  hold(held) {
    this.player.hold(held);
  }

  /** Leave a performance whose end will not come. */
  stop() {
    this.player.stop();
  }

  /** Return a picture of the eye's view, or null where none can be drawn. */
  seen(camera, width, height) {
    return (camera && this.robot?.seen(camera, width, height)) || null;
  }

  async #load(ready) {
    const { Robot, isSoftware } = await import("./robot.js");
    const software = isSoftware();
    try {
      this.robot = new Robot(part("robot"), software);
    } catch {
      part("attempt").textContent = "This browser draws nothing in 3-D";
      return;
    }
    this.player.pace.period = 1000 / (software ? SOFT_HZ : HARD_HZ);
    onScheme(() => this.robot.draw());
    if (this.model) this.robot.take(this.model);
    ready();
  }

  #show(row, poses, seconds) {
    const at = (rows) =>
      rows[Math.min(Math.floor((row * rows.length) / poses.length), rows.length - 1)];
    if (this.robot) {
      this.robot.pose(poses[row]);
      const lit = this.robot.light(this.effects, at(this.depths) ?? []);
      this.lights.forEach((light, i) => light.classList.toggle("on", lit[i]));
      this.robot.draw();
    }
    // Charts cost as much as the robot: half as often, and at the end.
    if (
      row === poses.length - 1 ||
      Math.abs(seconds - this.charted) >= 0.2 ||
      this.activity.begins
    ) {
      this.charted = seconds;
      this.activity.show(seconds);
    }
  }
}

/** Append the rows of some columns. */
function append(to, from, columns) {
  for (const name of columns) to[name] = [...(to[name] ?? []), ...(from[name] ?? [])];
}
