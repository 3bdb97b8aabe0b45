// SPDX-License-Identifier: GPL-2.0-or-later
// The elements of a run as two batches: timber, and translucent snow. One draw call each.
import { BatchedMesh, BufferAttribute, BufferGeometry, Color, Group, Matrix4, MeshLambertMaterial, Quaternion, Vector3 } from "three";

const SNOW_OPACITY = 0.8;
const EDGE = 0.5; // brightness of the lines along edges

/** All elements but the ground. */
export class House extends Group {
  constructor(run) {
    super();
    this.run = run;
    const shown = run.info.elements.map((element, number) => ({ ...element, number })).filter(({ kind }) => kind !== "ground");
    this.batches = [
      batch(run, shown.filter(({ kind }) => kind !== "snow"), timber()),
      batch(run, shown.filter(({ kind }) => kind === "snow"), snow()),
    ].filter((one) => one.userData.numbers.length);
    this.add(...this.batches);
  }

  /** Copy the current placement of the run's elements. */
  update() {
    const { position, orientation } = this.run;
    for (const one of this.batches) {
      const { numbers } = one.userData;
      for (let i = 0; i < numbers.length; i++) {
        const k = numbers[i];
        place.fromArray(position, 3 * k);
        turn.fromArray(orientation, 4 * k);
        one.setMatrixAt(i, matrix.compose(place, turn, unit));
      }
    }
  }
}

const [place, turn, unit, matrix] = [new Vector3(), new Quaternion(), new Vector3(1, 1, 1), new Matrix4()];

function batch(run, elements, material) {
  const shapes = elements.map(({ number }) => solid(run, number));
  const size = shapes.reduce((sum, shape) => sum + shape.attributes.position.count, 0);
  const mesh = new BatchedMesh(elements.length, size, 0, material);
  const colors = new Map(run.info.kinds.map(({ kind, color }) => [kind, new Color(color)]));
  elements.forEach(({ kind }, i) => {
    mesh.addInstance(mesh.addGeometry(shapes[i]));
    mesh.setColorAt(i, colors.get(kind));
  });
  mesh.userData.numbers = elements.map(({ number }) => number);
  mesh.perObjectFrustumCulled = mesh.sortObjects = mesh.frustumCulled = false;
  mesh.castShadow = mesh.receiveShadow = true;
  return mesh;
}

/** Triangles of an element: each face as a fan around its middle. `border`: distance to the face's edge [m]. */
function solid(run, number) {
  const [position, normal, border] = [[], [], []];
  const { vertices, vertex_start, faces, face_start, element_start } = run;
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

function snow() {
  return edged(new MeshLambertMaterial({ color: 0xffffff, transparent: true, opacity: SNOW_OPACITY, emissive: 0xb5c4d0, emissiveIntensity: 0.3 }));
}

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
