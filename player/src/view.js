// SPDX-License-Identifier: GPL-2.0-or-later
// The camera shared by all stages: from the front (east), from the side (north), or free.
import { Box3, PerspectiveCamera, Spherical, Vector3 } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

const FOV = 32; // [degree]
const TRANSITION = 450; // [ms] from one camera to the next
const SPARE = 1.2; // size of the picture by the size of the house
const NEAREST = 2; // distance of the camera [m]
const LIFT = -0.03; // of the house above the middle, by the distance: the title lies above it

/** Azimuth from east to north and elevation [degree], and the title of the view. */
const CAMERAS = {
  front: { azimuth: 0, elevation: 5, title: "From the east: south is left, north is right" },
  side: { azimuth: 90, elevation: 5, title: "From the north: east is left, west is right" },
  free: { azimuth: 38, elevation: 20, title: "" },
};
export const CAMERA_NAMES = Object.keys(CAMERAS);

export class View {
  /** points (Vector3): kept in the picture; changed: called when the picture must be redrawn. */
  constructor(points, changed) {
    Object.assign(this, { points, changed, name: "free", fov: FOV, transition: null });
    this.size = new Box3().setFromPoints(points).getSize(new Vector3()).length(); // of a house or a town [m]
    this.farthest = Math.max(90, 5 * this.size); // distance of the camera [m]
    this.camera = new PerspectiveCamera(FOV, 1, 0.5, this.farthest + 2 * this.size + 100);
    this.camera.up.set(0, 0, 1);
    this.target = new Vector3();
    this.controls = [];
  }

  get distance() {
    return this.camera.position.distanceTo(this.target);
  }

  /** Title of the view; empty for the free camera. */
  get title() {
    return CAMERAS[this.name].title;
  }

  /** Azimuth of the camera seen from the house, from east to north. [rad] */
  get azimuth() {
    return Math.atan2(this.camera.position.y - this.target.y, this.camera.position.x - this.target.x);
  }

  /** Let mouse and fingers on a canvas turn, move and zoom the camera. */
  listen(canvas) {
    const control = new OrbitControls(this.camera, canvas);
    Object.assign(control, { target: this.target, maxPolarAngle: Math.PI / 2 - 0.01, minDistance: NEAREST, maxDistance: this.farthest, zoomSpeed: 1.4 });
    let held = false; // a press is not yet a movement of the camera
    control.addEventListener("start", () => (held = true));
    control.addEventListener("end", () => (held = false));
    control.addEventListener("change", () => (held ? this.take("free") : this.changed()));
    this.controls.push(control);
  }

  /** Set width by elevation of the next picture. */
  shape(aspect) {
    if (this.camera.aspect === aspect) return;
    this.camera.aspect = aspect;
    this.camera.updateProjectionMatrix();
  }

  /** Adapt to a new shape of the pictures: show the whole houses, unless the user has moved the camera. */
  resize(aspect) {
    this.shape(aspect);
    if (!this.moved) this.set(this.name);
  }

  /** The user has moved the camera: keep its position. */
  take(name) {
    Object.assign(this, { name, moved: true, transition: null });
    this.changed();
  }

  /** Go to a camera, at once or (smooth) within TRANSITION. */
  set(name, smooth = false) {
    Object.assign(this, { name, moved: false });
    const from = [this.camera.position.clone(), this.target.clone()];
    const to = this.goal(name);
    this.transition = smooth ? { from, to, start: performance.now() } : null;
    if (!smooth) this.put(...to);
    this.changed();
  }

  /** Turn and zoom from the keyboard: angles [rad], factor on the distance. */
  turn(azimuth, elevation, factor = 1) {
    const place = new Spherical().setFromVector3(swap(this.camera.position.clone().sub(this.target)));
    place.theta += azimuth;
    place.phi = Math.min(Math.max(place.phi - elevation, 0.02), Math.PI / 2 - 0.01);
    place.radius = Math.min(Math.max(place.radius * factor, NEAREST), this.farthest);
    this.put(swapBack(new Vector3().setFromSpherical(place)).add(this.target), this.target.clone());
    this.take("free");
  }

  /** Advance a transition; returns whether there is one. */
  step(now) {
    if (!this.transition) return false;
    const { from, to, start } = this.transition;
    const x = Math.min((now - start) / TRANSITION, 1);
    const s = x * x * (3 - 2 * x);
    this.put(arc(from, to, s), from[1].clone().lerp(to[1], s));
    if (x === 1) this.transition = null;
    return true;
  }

  put(position, target) {
    this.target.copy(target);
    this.camera.position.copy(position);
    this.camera.lookAt(target);
    this.camera.updateMatrixWorld();
  }

  /** [position, target] of the nearest camera that shows the whole house in the middle of the picture. */
  goal(name) {
    const { azimuth, elevation } = CAMERAS[name];
    const toward = direction(azimuth, elevation);
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

  /** Distance from the target [m] that shows all points. */
  distanceFor(target, toward, right, up) {
    const tangent = Math.tan((FOV * Math.PI) / 360) / SPARE;
    return this.points.reduce((most, p) => {
      offset.copy(p).sub(target);
      const half = Math.max(Math.abs(offset.dot(right)) / this.camera.aspect, Math.abs(offset.dot(up)));
      return Math.max(most, half / tangent + offset.dot(toward));
    }, 0);
  }
}

const offset = new Vector3();
const middle = (values) => (values.reduce((a, b) => Math.min(a, b)) + values.reduce((a, b) => Math.max(a, b))) / 2;

function direction(azimuth, elevation) {
  const [a, h] = [(azimuth * Math.PI) / 180, (elevation * Math.PI) / 180];
  return new Vector3(Math.cos(h) * Math.cos(a), Math.cos(h) * Math.sin(a), Math.sin(h));
}

/** Position between two cameras on an arc around the house. */
function arc([a, ta], [b, tb], s) {
  const [from, to] = [a.clone().sub(ta), b.clone().sub(tb)];
  const length = from.length() * (1 - s) + to.length() * s;
  const direction = from.normalize().lerp(to.normalize(), s);
  if (direction.lengthSq() < 1e-4) direction.set(0, 0, 1);
  return direction.setLength(length).add(ta.clone().lerp(tb, s));
}

/** Spherical has y up: (x, y, z) -> (y, z, x) and back. */
const swap = (v) => v.set(v.y, v.z, v.x);
const swapBack = (v) => v.set(v.z, v.x, v.y);
