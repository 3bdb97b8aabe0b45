// SPDX-License-Identifier: GPL-2.0-or-later
// The ground: a pale plane with a grid of 1 m that fades into the sky, the house's shadow, and the four directions.
import { CanvasTexture, Group, Mesh, MeshBasicMaterial, PlaneGeometry, ShaderMaterial, ShadowMaterial, SRGBColorSpace, Vector3 } from "three";

const EXTENT = 120; // under one house; a town has more [m]

const VERTEX = `
varying vec2 place;
void main() {
  place = position.xy;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;

const FRAGMENT = `
varying vec2 place;
uniform float scale;
float lines(vec2 p) {
  vec2 width = fwidth(p);
  vec2 near = abs(fract(p - 0.5) - 0.5) / max(width, 1e-6);
  vec2 shown = (1.0 - smoothstep(0.2, 1.0, near)) * (1.0 - smoothstep(0.15, 0.5, width));
  return max(shown.x, shown.y);
}
void main() {
  float far = smoothstep(9.0 * scale, 52.0 * scale, length(place));
  float grid = max(0.30 * lines(place), 0.5 * lines(place / 5.0));
  vec3 color = mix(vec3(0.83, 0.82, 0.77), vec3(0.45, 0.46, 0.44), grid);
  gl_FragColor = vec4(color, 1.0 - far);
}`;

/** A ground under a house in `box` (Box3); the letters lie 2 m outside. */
export class Ground extends Group {
  constructor(box) {
    super();
    const [middle, size] = [box.getCenter(new Vector3()), box.getSize(new Vector3())];
    const reach = Math.max(size.x, size.y) / 2;
    const scale = Math.max(1, reach / 15);
    const plane = new PlaneGeometry(scale * EXTENT, scale * EXTENT);
    const soil = new Mesh(plane, new ShaderMaterial({ uniforms: { scale: { value: scale } }, vertexShader: VERTEX, fragmentShader: FRAGMENT, transparent: true, depthWrite: false }));
    const shadow = new Mesh(plane, new ShadowMaterial({ opacity: 0.26, depthWrite: false }));
    shadow.receiveShadow = true;
    soil.renderOrder = -3;
    shadow.renderOrder = -2;
    this.add(soil, shadow);
    for (const [letter, east, north] of [["N", 0, 1], ["E", 1, 0], ["S", 0, -1], ["W", -1, 0]]) this.add(sign(letter, east * (reach + 2), north * (reach + 2)));
    this.position.set(middle.x, middle.y, box.min.z);
  }
}

/** A letter on the ground, readable from outside. */
function sign(letter, x, y) {
  const canvas = Object.assign(document.createElement("canvas"), { width: 128, height: 128 });
  const pen = canvas.getContext("2d");
  Object.assign(pen, { font: "bold 96px system-ui, sans-serif", textAlign: "center", textBaseline: "middle", fillStyle: "#6b6a64" });
  pen.fillText(letter, 64, 70);
  const map = new CanvasTexture(canvas);
  map.colorSpace = SRGBColorSpace;
  map.anisotropy = 8;
  const mesh = new Mesh(new PlaneGeometry(1.3, 1.3), new MeshBasicMaterial({ map, transparent: true, depthWrite: false }));
  mesh.position.set(x, y, 0);
  mesh.rotation.z = Math.atan2(x, -y);
  mesh.renderOrder = -1;
  return mesh;
}
