// SPDX-License-Identifier: GPL-2.0-or-later
// Marks of the joints: colour and size show the load, the shape shows the state.
import { BufferAttribute, BufferGeometry, Color, GreaterDepth, Group, LessEqualDepth, Points, ShaderMaterial } from "three";

/** Colours from no load to the strength (dark: high load), and of the three kinds of damage (Okabe and Ito 2008). */
export const LOAD_COLORS = ["#fff7e0", "#f4a3c0", "#b0308a", "#3f0a5c"];
export const DAMAGE_COLORS = { partly: "#e69f00", broken: "#d55e00", before: "#ffffff" };

const VERTEX = `
attribute float load;
attribute float state;
uniform float pixels; // pixels per metre at distance 1 m
uniform float ratio; // device pixels per pixel
varying float vLoad;
varying float vState;
void main() {
  vLoad = clamp(load, 0.0, 1.0);
  vState = state;
  vec4 seen = modelViewMatrix * vec4(position, 1.0);
  seen.xyz *= 1.0 - 0.16 / max(length(seen.xyz), 1.0); // in front of the members it connects
  gl_Position = projectionMatrix * seen;
  bool whole = state < 0.5;
  float size = whole ? mix(0.075, 0.17, vLoad) : state < 1.5 ? 0.24 : 0.26; // [m]
  float least = whole ? mix(1.5, 5.0, vLoad) : 9.0; // [pixel]
  gl_PointSize = clamp(size * pixels / max(-seen.z, 0.1), least * ratio, 26.0 * ratio);
}`;

const FRAGMENT = `
uniform vec3 loads[4];
uniform vec3 partly;
uniform vec3 broken;
uniform vec3 before;
uniform float ghost;
varying float vLoad;
varying float vState;
vec3 loadColor() {
  float x = vLoad * 3.0;
  return x < 1.0 ? mix(loads[0], loads[1], x) : x < 2.0 ? mix(loads[1], loads[2], x - 1.0) : mix(loads[2], loads[3], x - 2.0);
}
float cross2(vec2 p) {
  p = abs(vec2(p.x + p.y, p.x - p.y) * 0.7071);
  return min(max(p.x - 0.78, p.y - 0.2), max(p.y - 0.78, p.x - 0.2));
}
float triangle(vec2 p) {
  return max(abs(p.x) * 0.866 - p.y * 0.5 - 0.36, p.y - 0.5);
}
void main() {
  if (ghost > 0.5 && vState < 0.5) discard;
  vec2 p = gl_PointCoord * 2.0 - 1.0;
  float inside = vState < 0.5 ? length(p) - 0.75 : vState < 1.5 ? triangle(p) : vState < 2.5 ? cross2(p) : length(p) - 0.55;
  float soft = fwidth(p.x) * 0.75 + 0.001;
  vec3 color = vState < 0.5 ? loadColor() : vState < 1.5 ? partly : vState < 2.5 ? broken : before;
  vec3 rim = vState > 1.5 && vState < 2.5 ? vec3(1.0) : vec3(0.08);
  float width = vState < 0.5 ? 0.14 : vState < 2.5 ? 0.16 : 0.28;
  float alpha = 1.0 - smoothstep(width - soft, width + soft, inside);
  if (alpha < 0.02) discard;
  gl_FragColor = vec4(mix(color, rim, smoothstep(-soft, soft, inside)), alpha * (ghost > 0.5 ? 0.28 : 1.0));
  #include <colorspace_fragment>
}`;

/** One point per joint, drawn twice: once where it is visible, and damaged joints in pale where a face hides them. */
export class Joints extends Group {
  constructor(run) {
    super();
    this.run = run;
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(run.joint.place, 3));
    geometry.setAttribute("load", new BufferAttribute(run.joint.load, 1));
    geometry.setAttribute("state", new BufferAttribute(run.joint.state, 1));
    this.attributes = Object.values(geometry.attributes);
    this.shared = { pixels: { value: 1 }, ratio: { value: 1 } };
    for (const ghost of [false, true]) {
      const points = new Points(geometry, material(ghost, this.shared));
      points.frustumCulled = false;
      points.renderOrder = ghost ? 2 : 3;
      this.add(points);
    }
  }

  /** Upload the current state of the run's joints. */
  update() {
    for (const attribute of this.attributes) attribute.needsUpdate = true;
  }

  /** Height of the picture [device pixels], field of view [degree], device pixels per pixel. */
  resize(height, fov, ratio) {
    this.shared.pixels.value = height / (2 * Math.tan((fov * Math.PI) / 360));
    this.shared.ratio.value = ratio;
  }
}

function material(ghost, shared) {
  const damage = Object.fromEntries(Object.entries(DAMAGE_COLORS).map(([name, color]) => [name, { value: new Color(color) }]));
  return new ShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    uniforms: { ...shared, ...damage, loads: { value: LOAD_COLORS.map((color) => new Color(color)) }, ghost: { value: ghost ? 1 : 0 } },
    transparent: true,
    depthWrite: false,
    depthFunc: ghost ? GreaterDepth : LessEqualDepth,
  });
}
