// The robot's model as three.js objects. MuJoCo's sizes are halves; its long axes run along z.

import {
  BoxGeometry,
  CapsuleGeometry,
  CylinderGeometry,
  Group,
  Mesh,
  MeshLambertMaterial,
  PlaneGeometry,
  SphereGeometry,
} from "./vendor/three.js";

const upright = (geometry) => geometry.rotateX(Math.PI / 2);
const MADE = {
  plane: ([x, y]) => new PlaneGeometry(2 * (x || 3), 2 * (y || 3)),
  sphere: ([r]) => new SphereGeometry(r, 20, 14),
  ellipsoid: ([x, y, z]) => new SphereGeometry(1, 24, 16).scale(x, y, z),
  capsule: ([r, half]) => upright(new CapsuleGeometry(r, 2 * half, 6, 16)),
  cylinder: ([r, half]) => upright(new CylinderGeometry(r, r, 2 * half, 28)),
  box: ([x, y, z]) => new BoxGeometry(2 * x, 2 * y, 2 * z),
};

/** Return a group for every body, in the order of a pose, with its geoms in it. */
export function bodiesOf({ bodies, geoms }) {
  const groups = bodies.map((name) => Object.assign(new Group(), { name }));
  for (const geom of geoms) {
    if (!(geom.type in MADE)) continue;
    const mesh = new Mesh(MADE[geom.type](geom.size), material(geom));
    mesh.name = geom.name ?? "";
    mesh.position.set(...geom.pos);
    mesh.quaternion.set(geom.quat[1], geom.quat[2], geom.quat[3], geom.quat[0]);
    groups[geom.body].add(mesh);
  }
  return groups;
}

function material({ rgba: [red, green, blue, alpha] }) {
  const made = new MeshLambertMaterial({ transparent: alpha < 1, opacity: alpha });
  made.color.setRGB(red, green, blue, "srgb");
  return made;
}
