// The robot in three dimensions, drawn when something has changed and never by itself.

import {
  DirectionalLight,
  HemisphereLight,
  Matrix4,
  PerspectiveCamera,
  Scene,
  Vector3,
  WebGLRenderer,
} from "./vendor/three.js";
import { isDark } from "./dom.js";
import { bodiesOf } from "./shapes.js";

const TARGET = new Vector3(0.3, -0.06, 0.99);
/** Bodies that the eye's view leaves out: what is around it, and its own arm, which moves. */
const NOT_SEEN = ["head", "arm"];
/** How much of a ghost is seen, and how far from the robot it must be to be shown. */
const [GHOSTLY, APART_M, APART_RAD] = [0.3, 0.002, 0.01];
/** A cap pressed further than this [mm] gives light. */
export const PRESSED_MM = 5;

/** Whether WebGL is computed by the processor: then every picture costs, and finery is left out. */
export function isSoftware() {
  const probe = document.createElement("canvas").getContext("webgl2");
  if (!probe) return true;
  const told = probe.getExtension("WEBGL_debug_renderer_info");
  const name = probe.getParameter(told ? told.UNMASKED_RENDERER_WEBGL : probe.RENDERER);
  probe.getExtension("WEBGL_lose_context")?.loseContext();
  return /SwiftShader|llvmpipe|software/i.test(name);
}

export class Robot {
  /** Draw on a canvas; throws where the browser has no WebGL. */
  constructor(canvas, software) {
    Object.assign(this, { canvas, software });
    this.ratio = software ? 1 : Math.min(window.devicePixelRatio || 1, 2);
    this.renderer = new WebGLRenderer({ canvas, antialias: !software });
    this.scene = new Scene();
    this.sun = new DirectionalLight("#ffffff", 1.7);
    this.sun.position.set(0.9, -1.2, 2.4);
    this.sky = new HemisphereLight("#ffffff", "#b9bec4", 1.9);
    this.sky.position.set(0, 0, 1);
    this.scene.add(this.sun, this.sky);
    this.camera = standing(new PerspectiveCamera(36, 1, 0.05, 12));
    this.orbit = { turn: -0.98, rise: 0.4, far: 1.85 };
    this.bodies = [];
    turnable(canvas, (turn, rise) => this.#turned(turn, rise));
    new ResizeObserver(() => this.draw()).observe(canvas);
  }

  /** Take the robot of a `scene`. */
  take(robot) {
    this.scene.remove(...this.bodies);
    this.bodies = bodiesOf(robot);
    this.scene.add(...this.bodies);
    this.floor = this.scene.getObjectByName("floor");
    // The caregiver's hand is parked beside the scene: what it does is shown in the eye's view.
    this.bodies
      .filter((body) => body.name === "caregiver")
      .forEach((body) => (body.visible = false));
    if (robot.pose) this.pose(robot.pose);
    this.scene.remove(...(this.ghosts ?? []));
    this.ghosts = this.bodies.map((body) => ghostOf(body));
    this.scene.add(...this.ghosts);
    this.draw();
  }

  /** Place all bodies: x, y, z and the quaternion w, x, y, z of each, one after the other. */
  pose(flat) {
    this.bodies.forEach((body, i) => place(body, flat, i));
  }

  /** Place a ghost where it is elsewhere than the robot; none for null. */
  ghost(flat) {
    this.ghosts?.forEach((body, i) => {
      body.visible = Boolean(flat) && this.bodies[i].visible;
      if (!body.visible) return;
      place(body, flat, i);
      const { position, quaternion } = this.bodies[i];
      body.visible =
        position.distanceTo(body.position) > APART_M ||
        quaternion.angleTo(body.quaternion) > APART_RAD;
    });
  }

  /** Light the caps, by the effects' names, that are pressed [mm]; return which are. */
  light(names, depths) {
    return names.map((name, i) => {
      const on = depths[i] > PRESSED_MM;
      const body = this.bodies.find((b) => b.name === name);
      body?.children.forEach((cap) =>
        cap.material.emissive.copy(cap.material.color).multiplyScalar(on ? 0.9 : 0),
      );
      return on;
    });
  }

  /** Draw one picture, as large as the canvas is on the page. */
  draw() {
    this.drawn(this.canvas.clientWidth, this.canvas.clientHeight);
  }

  /** Draw one picture so large [px], also on a canvas that is on no page. */
  drawn(width, height) {
    if (!width || !this.bodies.length) return;
    const { turn, rise, far } = this.orbit;
    const flat = far * Math.cos(rise);
    this.camera.position
      .set(flat * Math.cos(turn), flat * Math.sin(turn), far * Math.sin(rise))
      .add(TARGET);
    this.camera.lookAt(TARGET);
    this.#render(this.camera, width, height);
  }

  /** Return a picture of what the eye sees, without its own body; null before there is a robot. */
  seen({ position, right, up, ahead, fov_y_deg: fov }, width, height) {
    if (!this.bodies.length) return null;
    const eye = new PerspectiveCamera(fov, width / height, 0.02, 12);
    const [x, y, z] = [right, up, ahead.map((v) => -v)].map((axis) => new Vector3(...axis));
    eye.quaternion.setFromRotationMatrix(new Matrix4().makeBasis(x, y, z));
    eye.position.set(...position);
    const hidden = [
      ...this.bodies.filter((body) => NOT_SEEN.includes(body.name)),
      ...this.ghosts.filter((body) => body.visible),
    ];
    hidden.forEach((body) => (body.visible = false));
    this.#render(eye, width, height);
    hidden.forEach((body) => (body.visible = true));
    const picture = document.createElement("canvas");
    picture.width = this.canvas.width;
    picture.height = this.canvas.height;
    picture.getContext("2d").drawImage(this.canvas, 0, 0);
    this.draw();
    return picture;
  }

  /** Give back what was taken to draw. */
  release() {
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }

  #render(camera, width, height) {
    this.renderer.setPixelRatio(this.ratio);
    this.renderer.setSize(width, height, false);
    this.floor?.material.color.set(isDark() ? "#3a4147" : "#d4d7da");
    this.renderer.setClearColor(isDark() ? "#1e2429" : "#e6ecf1");
    this.sky.intensity = isDark() ? 1.15 : 1.9;
    this.sun.intensity = isDark() ? 1.2 : 1.7;
    camera.aspect = width / height;
    camera.updateProjectionMatrix();
    this.renderer.render(this.scene, camera);
  }

  #turned(turn, rise) {
    this.orbit.turn += turn;
    this.orbit.rise = Math.min(Math.max(this.orbit.rise + rise, 0.05), 1.4);
    this.pending ??= requestAnimationFrame(() => {
      this.pending = undefined;
      this.draw();
    });
  }
}

function place(body, flat, i) {
  const [x, y, z, qw, qx, qy, qz] = flat.slice(7 * i, 7 * i + 7);
  body.position.set(x, y, z);
  body.quaternion.set(qx, qy, qz, qw);
}

/** Return a body as a ghost: its shapes, seen through. */
function ghostOf(body) {
  const ghost = body.clone();
  ghost.visible = false;
  ghost.traverse((part) => {
    if (!part.material) return;
    part.material = part.material.clone();
    Object.assign(part.material, { transparent: true, opacity: GHOSTLY, depthWrite: false });
  });
  return ghost;
}

function standing(camera) {
  camera.up.set(0, 0, 1);
  return camera;
}

/** Let a canvas be turned by dragging or by arrow keys. */
function turnable(canvas, turned) {
  let last = null;
  canvas.addEventListener("pointerdown", (event) => {
    last = [event.clientX, event.clientY];
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!last) return;
    turned((last[0] - event.clientX) / 160, (event.clientY - last[1]) / 160);
    last = [event.clientX, event.clientY];
  });
  for (const name of ["pointerup", "pointercancel"])
    canvas.addEventListener(name, () => (last = null));
  const steps = {
    ArrowLeft: [-0.15, 0],
    ArrowRight: [0.15, 0],
    ArrowUp: [0, 0.1],
    ArrowDown: [0, -0.1],
  };
  canvas.addEventListener("keydown", (event) => {
    if (!(event.key in steps)) return;
    turned(...steps[event.key]);
    event.preventDefault();
  });
}
