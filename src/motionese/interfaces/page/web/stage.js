// The robot on its stage: three dimensions, what goes on inside it, and the buttons it presses.

import { Activity } from "./charts.js";
import { made, onScheme, part } from "./dom.js";
import { Pace, Player } from "./playing.js";

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
  take({ robot, levels, task: { effects } }) {
    this.model = robot;
    this.robot?.take(robot);
    this.activity.build(robot.joints, levels);
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
    if (frames.from === 0) this.charted = -1;
    this.depths = frames.from === 0 ? frames.effects : [...this.depths, ...frames.effects];
    this.activity.take(frames);
    this.player.take(frames);
  }

  /** Forget the performance that was shown last. */
  clear() {
    this.player.stop();
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
    if (row === poses.length - 1 || seconds - this.charted >= 0.2) {
      this.charted = seconds;
      this.activity.show(seconds);
    }
  }
}
