// SPDX-License-Identifier: GPL-2.0-or-later
// The camera that all stages share: from the front (east), from the side (north), or anywhere.
import { Box3, PerspectiveCamera, Spherical, Vector3 } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

const FOV = 32; // [degree]
const GLIDE = 450; // [ms] from one camera to the next
const ROOM = 1.12; // around the house
const LIFT = 0.012; // of the house over the middle, by the distance: words stand below it

/** Azimuth from east to north and height over the horizon [degree], and what is left and right. */
const CAMERAS = {
  front: { azimuth: 0, height: 5, name: "From the east: south is left, north is right" },
  side: { azimuth: 90, height: 5, name: "From the north: east is left, west is right" },
  free: { azimuth: 38, height: 20, name: "" },
};
export const CAMERA_NAMES = Object.keys(CAMERAS);

export class View {
  /** points: what shall be in the picture (Vector3); changed: called when the picture has to be drawn again. */
  constructor(points, changed) {
    Object.assign(this, { points, changed, name: "free", fov: FOV, glide: null });
    this.camera = new PerspectiveCamera(FOV, 1, 0.5, 300);
    this.camera.up.set(0, 0, 1);
    this.target = new Vector3();
    this.controls = [];
  }

  get distance() {
    return this.camera.position.distanceTo(this.target);
  }

  /** What the picture shows, in words; empty for the free camera. */
  get words() {
    return CAMERAS[this.name].name;
  }

  /** Azimuth of the camera as seen from the house, from east to north. [rad] */
  get azimuth() {
    return Math.atan2(this.camera.position.y - this.target.y, this.camera.position.x - this.target.x);
  }

  /** Let mouse and fingers on a canvas turn, move and zoom the camera. */
  listen(canvas) {
    const control = new OrbitControls(this.camera, canvas);
    Object.assign(control, { target: this.target, maxPolarAngle: Math.PI / 2 - 0.01, minDistance: 2, maxDistance: 90, zoomSpeed: 1.4 });
    control.addEventListener("start", () => this.take("free"));
    control.addEventListener("change", () => this.changed());
    this.controls.push(control);
  }

  /** Width by height of the picture that is drawn next. */
  shape(aspect) {
    if (this.camera.aspect === aspect) return;
    this.camera.aspect = aspect;
    this.camera.updateProjectionMatrix();
  }

  /** The place of the pictures has another shape: see the houses whole again, unless the user has moved the camera. */
  resize(aspect) {
    this.shape(aspect);
    if (!this.moved) this.set(this.name);
  }

  /** The user has moved the camera: it stays where it is. */
  take(name) {
    Object.assign(this, { name, moved: true, glide: null });
    this.changed();
  }

  /** Go to a camera, at once or (smooth) within GLIDE. */
  set(name, smooth = false) {
    Object.assign(this, { name, moved: false });
    const from = [this.camera.position.clone(), this.target.clone()];
    const to = this.goal(name);
    this.glide = smooth ? { from, to, start: performance.now() } : null;
    if (!smooth) this.put(...to);
    this.changed();
  }

  /** Turn and zoom from the keyboard: angles [rad], factor on the distance. */
  turn(azimuth, height, factor = 1) {
    const place = new Spherical().setFromVector3(swap(this.camera.position.clone().sub(this.target)));
    place.theta += azimuth;
    place.phi = Math.min(Math.max(place.phi - height, 0.02), Math.PI / 2 - 0.01);
    place.radius *= factor;
    this.put(swapBack(new Vector3().setFromSpherical(place)).add(this.target), this.target.clone());
    this.take("free");
  }

  /** Go on with a glide; whether there is one. */
  step(now) {
    if (!this.glide) return false;
    const { from, to, start } = this.glide;
    const x = Math.min((now - start) / GLIDE, 1);
    const s = x * x * (3 - 2 * x);
    this.put(arc(from, to, s), from[1].clone().lerp(to[1], s));
    if (x === 1) this.glide = null;
    return true;
  }

  put(position, target) {
    this.target.copy(target);
    this.camera.position.copy(position);
    this.camera.lookAt(target);
    this.camera.updateMatrixWorld();
  }

  /** [position, target] of the nearest camera that has the whole house in the picture, in its middle. */
  goal(name) {
    const { azimuth, height } = CAMERAS[name];
    const toward = direction(azimuth, height);
    const right = new Vector3(-toward.y, toward.x, 0).normalize();
    const up = toward.clone().cross(right);
    const target = new Box3().setFromPoints(this.points).getCenter(new Vector3());
    let away = 0;
    for (let round = 0; round < 4; round++) {
      away = this.distanceFor(target, toward, right, up);
      const seen = (axis) => this.points.map((p) => offset.copy(p).sub(target).dot(axis) / (away - offset.dot(toward)));
      for (const axis of [right, up]) target.addScaledVector(axis, away * middle(seen(axis)));
    }
    target.addScaledVector(up, -LIFT * away);
    return [toward.clone().multiplyScalar(away).add(target), target];
  }

  /** Distance from the target [m] at which all points are in the picture. */
  distanceFor(target, toward, right, up) {
    const tangent = Math.tan((FOV * Math.PI) / 360) / ROOM;
    return this.points.reduce((most, p) => {
      offset.copy(p).sub(target);
      const half = Math.max(Math.abs(offset.dot(right)) / this.camera.aspect, Math.abs(offset.dot(up)));
      return Math.max(most, half / tangent + offset.dot(toward));
    }, 0);
  }
}

const offset = new Vector3();
const middle = (values) => (values.reduce((a, b) => Math.min(a, b)) + values.reduce((a, b) => Math.max(a, b))) / 2;

function direction(azimuth, height) {
  const [a, h] = [(azimuth * Math.PI) / 180, (height * Math.PI) / 180];
  return new Vector3(Math.cos(h) * Math.cos(a), Math.cos(h) * Math.sin(a), Math.sin(h));
}

/** Position between two cameras on the way around the house, not through it. */
function arc([a, ta], [b, tb], s) {
  const [from, to] = [a.clone().sub(ta), b.clone().sub(tb)];
  const length = from.length() * (1 - s) + to.length() * s;
  const way = from.normalize().lerp(to.normalize(), s);
  if (way.lengthSq() < 1e-4) way.set(0, 0, 1);
  return way.setLength(length).add(ta.clone().lerp(tb, s));
}

/** Spherical has y up: (x, y, z) -> (y, z, x) and back. */
const swap = (v) => v.set(v.y, v.z, v.x);
const swapBack = (v) => v.set(v.z, v.x, v.y);
