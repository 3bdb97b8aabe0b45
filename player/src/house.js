// SPDX-License-Identifier: GPL-2.0-or-later
// The elements of a run as two batches, timber and snow, and its wall sheets as a third. One draw call each.
import { BatchedMesh, BufferAttribute, BufferGeometry, Color, Group, Matrix4, MeshLambertMaterial, Quaternion, Vector3 } from "three";

const EDGE = 0.5; // brightness of the lines along edges

const CHOSEN = new Color("#ffd400");

/** All elements but the ground. material: of all of them, instead of timber and snow. */
export class House extends Group {
  constructor(run, material = null) {
    super();
    this.run = run;
    const shown = run.info.elements.map((element, number) => ({ ...element, number })).filter(({ kind }) => kind !== "ground");
    this.batches = [
      batch(run, shown.filter(({ kind }) => kind !== "snow"), material ?? timber()),
      batch(run, shown.filter(({ kind }) => kind === "snow"), material ?? snow()),
    ].filter((one) => one.userData.numbers.length);
    this.add(...this.batches);
  }

  /** The nearest element on a ray (Raycaster): { number, distance [m] }, or null. */
  hit(ray) {
    const found = ray.intersectObjects(this.batches, false)[0];
    return found ? { number: found.object.userData.numbers[found.batchId], distance: found.distance } : null;
  }

  /** Colour one element, or none (null). */
  highlight(number) {
    for (const mesh of this.batches) {
      const { numbers, colors } = mesh.userData;
      numbers.forEach((own, i) => mesh.setColorAt(i, own === number ? CHOSEN : colors[i]));
    }
  }

  /** Copy the current placement of the run's elements. */
  update() {
    for (const one of this.batches) follow(one, this.run, one.userData.numbers);
  }
}

/** The plates of the wall sheets, each with a column; torn ones of broken sheets (pictures/panels.py). */
export class Sheathing extends Group {
  constructor(run) {
    super();
    this.run = run;
    const { plates } = run.info;
    if (!plates.length) return;
    const parts = Object.fromEntries(SHAPES.map((name) => [name, run[`plate_${name}`]]));
    this.colors = Object.fromEntries(Object.entries(run.info.sheet_colors).map(([state, color]) => [state, new Color(color)]));
    this.mesh = mesh(plates.map((_, k) => solid(parts, k)), plates.map(() => this.colors.whole), timber());
    this.bodies = plates.map(({ body }) => body);
    this.add(this.mesh);
  }

  /** Copy the current placement of the columns, and show the states of the sheets. */
  update() {
    if (!this.mesh) return;
    follow(this.mesh, this.run, this.bodies);
    this.run.info.plates.forEach(({ sheet, torn }, k) => {
      const state = this.run.sheetState(sheet);
      this.mesh.setVisibleAt(k, torn === (state === "broken"));
      this.mesh.setColorAt(k, this.colors[state]);
    });
  }
}

/** Place the instances of a batch where the elements of these numbers are. */
function follow(batch, { position, orientation }, numbers) {
  for (let i = 0; i < numbers.length; i++) {
    place.fromArray(position, 3 * numbers[i]);
    turn.fromArray(orientation, 4 * numbers[i]);
    batch.setMatrixAt(i, matrix.compose(place, turn, unit));
  }
}

const SHAPES = ["vertices", "vertex_start", "faces", "face_start", "element_start"]; // arrays of an element's shape

const [place, turn, unit, matrix] = [new Vector3(), new Quaternion(), new Vector3(1, 1, 1), new Matrix4()];

function batch(run, elements, material) {
  const tints = new Map(run.info.kinds.map(({ kind, color }) => [kind, new Color(color)]));
  const colors = elements.map(({ kind }) => tints.get(kind));
  const made = mesh(elements.map(({ number }) => solid(run, number)), colors, material);
  Object.assign(made.userData, { colors, numbers: elements.map(({ number }) => number) });
  return made;
}

/** One draw call for geometries, each with a colour. */
function mesh(shapes, colors, material) {
  const size = shapes.reduce((sum, shape) => sum + shape.attributes.position.count, 0);
  const made = new BatchedMesh(shapes.length, size, 0, material);
  shapes.forEach((shape, i) => {
    made.addInstance(made.addGeometry(shape));
    made.setColorAt(i, colors[i]);
  });
  made.perObjectFrustumCulled = made.sortObjects = made.frustumCulled = false;
  made.castShadow = made.receiveShadow = true;
  return made;
}

/** Triangles of a body: each face as a fan around its middle. parts: arrays of shapes; `border`: distance to the face's edge [m]. */
function solid(parts, number) {
  const [position, normal, border] = [[], [], []];
  const { vertices, vertex_start, faces, face_start, element_start } = parts;
  const corner = (i) => new Vector3().fromArray(vertices, 3 * (vertex_start[number] + i));
  for (let f = element_start[number]; f < element_start[number + 1]; f++) {
    const ring = Array.from(faces.subarray(face_start[f], face_start[f + 1]), corner);
    const middle = ring.reduce((sum, p) => sum.add(p), new Vector3()).divideScalar(ring.length);
    ring.forEach((a, i) => {
      const b = ring[(i + 1) % ring.length];
      const along = b.clone().sub(a);
      const across = along.clone().cross(middle.clone().sub(a));
      for (const p of [middle, a, b]) {
        position.push(p.x, p.y, p.z);
        normal.push(...across.clone().normalize().toArray());
      }
      border.push(across.length() / along.length(), 0, 0);
    });
  }
  const geometry = new BufferGeometry();
  for (const [name, values, size] of [["position", position, 3], ["normal", normal, 3], ["border", border, 1]])
    geometry.setAttribute(name, new BufferAttribute(new Float32Array(values), size));
  return geometry;
}

function timber() {
  return edged(new MeshLambertMaterial({ color: 0xffffff }));
}

/** White without edge lines, with drifts and grains in its brightness, bluish in the shade. */
function snow() {
  const material = new MeshLambertMaterial({ color: 0xffffff, emissive: 0x8fa9c4, emissiveIntensity: 0.2 });
  material.onBeforeCompile = (shader) => {
    shader.vertexShader = shader.vertexShader
      .replace("#include <common>", "#include <common>\nvarying vec3 vGrain;")
      .replace("#include <begin_vertex>", "#include <begin_vertex>\nvGrain = position;");
    shader.fragmentShader = shader.fragmentShader.replace("#include <common>", `#include <common>\nvarying vec3 vGrain;\n${NOISE}`).replace(
      "#include <color_fragment>",
      `#include <color_fragment>
      float drifts = noise(vGrain * 1.3) * 0.6 + noise(vGrain * 3.7) * 0.4;
      float grains = noise(vGrain * 38.0) * (1.0 - smoothstep(0.3, 1.0, length(fwidth(vGrain)) * 38.0));
      diffuseColor.rgb = mix(vec3(0.72, 0.79, 0.88), vec3(0.90, 0.92, 0.94), smoothstep(0.15, 0.75, drifts)) * (0.93 + 0.10 * grains);`,
    );
  };
  return material;
}

const NOISE = `
float hash(vec3 p) { return fract(sin(dot(p, vec3(127.1, 311.7, 74.7))) * 43758.5453); }
float noise(vec3 p) {
  vec3 i = floor(p), f = fract(p);
  f = f * f * (3.0 - 2.0 * f);
  vec4 low = vec4(hash(i), hash(i + vec3(1, 0, 0)), hash(i + vec3(0, 1, 0)), hash(i + vec3(1, 1, 0)));
  vec4 high = vec4(hash(i + vec3(0, 0, 1)), hash(i + vec3(1, 0, 1)), hash(i + vec3(0, 1, 1)), hash(i + vec3(1, 1, 1)));
  vec4 z = mix(low, high, f.z);
  return mix(mix(z.x, z.y, f.x), mix(z.z, z.w, f.x), f.y);
}`;

/** Draws lines along the edges of the faces, about a pixel wide, paler where a member is only a few pixels wide. */
function edged(material) {
  material.onBeforeCompile = (shader) => {
    shader.vertexShader = shader.vertexShader
      .replace("#include <common>", "#include <common>\nattribute float border;\nvarying float vBorder;")
      .replace("#include <begin_vertex>", "#include <begin_vertex>\nvBorder = border;");
    shader.fragmentShader = shader.fragmentShader
      .replace("#include <common>", "#include <common>\nvarying float vBorder;")
      .replace(
        "#include <color_fragment>",
        `#include <color_fragment>
        float pixel = max(fwidth(vBorder), 1e-6);
        float line = (1.0 - smoothstep(0.4, 1.4, vBorder / pixel)) * clamp(0.028 / pixel, 0.25, 1.0);
        diffuseColor.rgb *= mix(1.0, ${EDGE.toFixed(2)}, line);`,
      );
  };
  return material;
}
