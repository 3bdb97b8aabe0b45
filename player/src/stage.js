// SPDX-License-Identifier: GPL-2.0-or-later
// One run in 3D on its canvas. Frame: x east, y north, z up [m], fixed to the viewer.
import { DirectionalLight, Fog, Group, HemisphereLight, PCFShadowMap, Scene, Vector3, WebGLRenderer } from "three";
import { Ground } from "./ground.js";
import { House, Sheathing } from "./house.js";
import { Joints } from "./joints.js";
import { Ghost, Glass, Person } from "./surroundings.js";

/** From the best to the fastest: pixels of the picture per pixel of the page, at most; whether there are shadows. */
const QUALITIES = [[2, true], [1, true], [1, false], [0.7, false], [0.5, false]];
const SOFTWARE = /swiftshader|llvmpipe|software|basic render/i; // names of renderers on the processor
const HORIZON = 0xe9eef0;

/** Draws a run for the shared camera. Throws when the browser has no WebGL. */
export class Stage {
  constructor(canvas, run, box) {
    Object.assign(this, { canvas, run });
    this.renderer = new WebGLRenderer({ canvas, antialias: !drawsOnProcessor(), alpha: true, powerPreference: "high-performance" });
    this.quality = 0;
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.house = new House(run);
    this.sheathing = new Sheathing(run);
    this.joints = new Joints(run);
    Object.assign(this, { ghost: new Ghost(run), walls: new Glass(run), person: new Person(box) });
    this.moving = new Group().add(this.house, this.sheathing, this.joints, this.ghost, this.walls, this.person, new Ground(box));
    const [sky, sun] = lights(box);
    this.sun = sun;
    this.scene = new Scene().add(this.moving, sky, sun, sun.target);
    this.scene.fog = new Fog(HORIZON);
  }

  /** Fit the canvas to its size on the page. */
  resize(fov) {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    this.aspect = width / height;
    const [most, shadows] = QUALITIES[this.quality];
    const ratio = Math.min(devicePixelRatio, most);
    this.sun.castShadow = shadows;
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(width, height, false);
    this.joints.resize(height * ratio, fov, ratio);
  }

  /** Draw faster, and less. */
  simplify(fov) {
    if (this.quality === QUALITIES.length - 1) return;
    this.quality += devicePixelRatio <= QUALITIES[this.quality + 1][0] && QUALITIES[this.quality + 1][1] ? 2 : 1; // the next one that differs
    this.resize(fov);
  }

  /** Draw the current state of the run. shaken: whether the ground moves relative to the camera; the other options: whether a thing is shown. */
  draw(view, { shaken, joints, ghost, walls, person }) {
    this.house.update();
    this.sheathing.update();
    this.joints.update();
    if (walls) this.walls.update();
    [this.joints.visible, this.ghost.visible, this.walls.visible, this.person.visible] = [joints, ghost, walls, person];
    if (shaken) this.moving.position.fromArray(this.run.ground);
    else this.moving.position.set(0, 0, 0);
    view.shape(this.aspect);
    const depth = Math.max(0, view.size / 2 - 15); // of the part of a town behind its middle that stays clear
    this.scene.fog.near = view.distance + depth;
    this.scene.fog.far = view.distance + 2 * depth + 45;
    this.renderer.render(this.scene, view.camera);
  }

  /** Position on the page of a point [m, frame of the ground]: {x, y} [pixel]. */
  screen(point, view) {
    view.shape(this.aspect);
    const seen = new Vector3(...point).add(this.moving.position).project(view.camera);
    const place = this.canvas.getBoundingClientRect();
    return { x: place.left + ((seen.x + 1) / 2) * place.width, y: place.top + ((1 - seen.y) / 2) * place.height };
  }
}

/** Soft light from the sky, and a sun in the south-east whose shadows cover house and wreckage. */
function lights(box) {
  const [middle, size] = [box.getCenter(new Vector3()), box.getSize(new Vector3())];
  const sky = new HemisphereLight(0xffffff, 0xb9ab97, 1.9);
  const sun = new DirectionalLight(0xfff4e2, 2.1);
  const half = Math.max(size.x, size.y) / 2 + 7;
  const away = Math.max(1, half / 20); // farther from a town
  sun.position.set(13, -5, 17).multiplyScalar(away).add(middle);
  sun.target.position.copy(middle);
  sun.shadow.mapSize.set(2048, 2048);
  Object.assign(sun.shadow.camera, { left: -half, right: half, top: half, bottom: -half, near: 1, far: 60 * away });
  Object.assign(sun.shadow, { bias: -0.0006, normalBias: 0.02, radius: 2.5 });
  return [sky, sun];
}

/** Whether WebGL has no graphics card: smoothing of edges then takes most of the time. */
function drawsOnProcessor() {
  const probe = document.createElement("canvas").getContext("webgl2");
  const names = probe?.getExtension("WEBGL_debug_renderer_info");
  return !!names && SOFTWARE.test(probe.getParameter(names.UNMASKED_RENDERER_WEBGL));
}
