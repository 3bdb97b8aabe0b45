// SPDX-License-Identifier: GPL-2.0-or-later
// What can be switched on for scale: the house at the start, walls of glass that move with their columns, a person.
import { BufferAttribute, BufferGeometry, CapsuleGeometry, DoubleSide, Group, Mesh, MeshBasicMaterial, MeshLambertMaterial, SphereGeometry, Vector3 } from "three";
import { House } from "./house.js";

const SAME_WALL = 0.2; // columns this far from the outermost one stand in its wall [m]
const TORN = 1.35; // a pane whose sides have grown by this factor is gone
const PERSON = 1.7; // height [m]

/** The elements as they were at the start, transparent. */
export class Ghost extends Group {
  constructor(run) {
    super();
    run.at(0);
    const material = new MeshBasicMaterial({ color: 0x2b6cb0, transparent: true, opacity: 0.16, depthWrite: false });
    const house = new House(run, material);
    house.update();
    this.add(house);
  }
}

/** Panes between neighbouring columns of the outer walls. */
export class Glass extends Mesh {
  constructor(run) {
    run.at(0);
    const panes = outerPairs(run);
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(new Float32Array(12 * panes.length), 3));
    geometry.setIndex(panes.flatMap((_, k) => [0, 1, 2, 0, 2, 3].map((i) => 4 * k + i)));
    super(geometry, new MeshBasicMaterial({ color: 0x9fc7d8, transparent: true, opacity: 0.28, side: DoubleSide, depthWrite: false }));
    Object.assign(this, { run, panes, frustumCulled: false, renderOrder: 1 });
    this.sizes = panes.map((pane) => sides(this.corners(pane)));
  }

  /** Current corners of a pane: foot and head of one column, head and foot of the other. */
  corners([a, b]) {
    return [[a, "foot"], [a, "head"], [b, "head"], [b, "foot"]].map(([column, end]) => this.run.placed(column.number, column[end].clone()));
  }

  update() {
    const place = this.geometry.attributes.position;
    this.panes.forEach((pane, k) => {
      const corners = this.corners(pane);
      const torn = sides(corners).some((length, i) => length > TORN * this.sizes[k][i]);
      corners.forEach((corner, i) => place.setXYZ(4 * k + i, ...(torn ? corners[0] : corner).toArray()));
    });
    place.needsUpdate = true;
  }
}

const sides = (corners) => corners.map((corner, i) => corner.distanceTo(corners[(i + 1) % 4]));

/** Pairs of neighbouring columns in the outer walls of each storey of each structure. Needs the run at its start. */
function outerPairs(run) {
  const storeys = new Map();
  run.info.elements.forEach(({ kind, group, storey }, number) => {
    if (kind !== "column") return;
    const key = `${group} ${storey}`;
    storeys.set(key, [...(storeys.get(key) ?? []), column(run, number)]);
  });
  return [...storeys.values()].flatMap((columns) => ["x", "y"].flatMap((across) => ["min", "max"].flatMap((end) => wall(columns, across, end))));
}

/** Neighbours in the wall at one end of an axis. */
function wall(columns, across, end) {
  const along = across === "x" ? "y" : "x";
  const edge = Math[end](...columns.map(({ middle }) => middle[across]));
  const found = columns.filter(({ middle }) => Math.abs(middle[across] - edge) < SAME_WALL).sort((p, q) => p.middle[along] - q.middle[along]);
  return found.slice(1).map((column, k) => [found[k], column]);
}

/** A column: number, middle [m], and the middles of its ends in its body frame. */
function column(run, number) {
  const corners = run.corners(number);
  const heights = corners.map(({ z }) => z);
  const [low, high] = [Math.min(...heights), Math.max(...heights)];
  const middle = corners.reduce((sum, p) => sum.add(p), new Vector3()).divideScalar(corners.length);
  const end = (z) => run.local(number, new Vector3(middle.x, middle.y, z));
  return { number, middle, foot: end(low), head: end(high) };
}

/** A person of PERSON metres beside the house in `box` (Box3). */
export class Person extends Group {
  constructor(box) {
    super();
    const material = new MeshLambertMaterial({ color: 0x4d5a66 });
    const part = (geometry, x, z) => {
      const mesh = new Mesh(geometry, material);
      mesh.position.set(0, x, z * PERSON);
      mesh.castShadow = true;
      if (geometry.type === "CapsuleGeometry") mesh.rotation.x = Math.PI / 2;
      this.add(mesh);
    };
    part(new SphereGeometry(0.065 * PERSON, 20, 14), 0, 0.93);
    part(new CapsuleGeometry(0.085 * PERSON, 0.2 * PERSON, 6, 14), 0, 0.66);
    for (const side of [-1, 1]) {
      part(new CapsuleGeometry(0.042 * PERSON, 0.4 * PERSON, 6, 12), side * 0.05 * PERSON, 0.24);
      part(new CapsuleGeometry(0.03 * PERSON, 0.3 * PERSON, 6, 10), side * 0.125 * PERSON, 0.64);
    }
    this.position.set(box.max.x + 1.2, box.min.y + 0.4, box.min.z);
  }
}
