// SPDX-License-Identifier: GPL-2.0-or-later
// A recorded run: unpacking, and the state at a time.
import { Quaternion, Vector3 } from "three";

/** Text made by packing.py -> Run. Throws when the text is damaged. */
export async function unpack(text) {
  const packed = Uint8Array.from(atob(text.trim()), (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
  const length = new DataView(bytes.buffer).getUint32(0, true);
  const info = JSON.parse(new TextDecoder().decode(bytes.subarray(4, 4 + length)));
  let offset = 4 + length;
  const arrays = {};
  for (const { name, shape, step } of info.arrays) {
    const count = shape.reduce((a, b) => a * b, 1);
    arrays[name] = decode(bytes.subarray(offset, offset + 4 * count), shape[0], step);
    offset += 4 * count;
  }
  return new Run(info, arrays);
}

/** Four byte planes of zigzag differences, series after series -> Float64Array, row after row. */
function decode(planes, rows, step) {
  const count = planes.length / 4;
  const width = rows ? count / rows : 0;
  const values = new Float64Array(count);
  for (let series = 0, k = 0; series < width; series++) {
    for (let row = 0, sum = 0; row < rows; row++, k++) {
      const z = planes[k] | (planes[k + count] << 8) | (planes[k + 2 * count] << 16) | (planes[k + 3 * count] << 24);
      sum += (z >>> 1) ^ -(z & 1);
      values[row * width + series] = sum * step;
    }
  }
  return values;
}

/** Largest k with times[k] <= t, at least 0. */
export function rowAt(times, t) {
  let low = 0;
  let high = times.length;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= t) low = middle;
    else high = middle;
  }
  return low;
}

/** One run: `info` (title, result, events, names, ...; see player.py) and its arrays. */
export class Run {
  constructor(info, arrays) {
    Object.assign(this, arrays);
    this.info = info;
    this.elements = info.elements.length;
    this.columns = info.elements.flatMap(({ kind }, k) => (kind === "column" ? [k] : []));
    this.joints = info.joints;
    this.sheets = info.sheets;
    this.apart = new Set(info.sheets.flat());
    this.end = this.time.at(-1);
    this.position = new Float32Array(3 * this.elements); // at the time of the last call of `at` [m], frame of the ground
    this.orientation = new Float32Array(4 * this.elements); // x, y, z, w
    this.joint = { place: new Float32Array(3 * this.joints), load: new Float32Array(this.joints), state: new Uint8Array(this.joints) };
    this.ground = [0, 0, 0]; // displacement of the ground [m]
    this.frame = 0;
  }

  /** Interpolate all elements and joints to a time [s]. Allocates nothing. */
  at(t) {
    const k = (this.frame = rowAt(this.time, t));
    const next = Math.min(k + 1, this.time.length - 1);
    const weight = next > k ? Math.min(Math.max((t - this.time[k]) / (this.time[next] - this.time[k]), 0), 1) : 0;
    this.placeElements(k, next, weight);
    this.placeJoints(k, next, weight);
    this.moveGround(t);
  }

  placeElements(k, next, weight) {
    const { position, orientation, positions, orientations } = this;
    const a = k * position.length;
    const b = next * position.length;
    for (let i = 0; i < position.length; i++) position[i] = positions[a + i] * (1 - weight) + positions[b + i] * weight;
    const c = k * orientation.length;
    const d = next * orientation.length;
    for (let i = 0; i < orientation.length; i += 4) Quaternion.slerpFlat(orientation, i, orientations, c + i, orientations, d + i, weight);
  }

  placeJoints(k, next, weight) {
    const { place, load, state } = this.joint;
    const { body, anchor, loads, position, orientation } = this;
    for (let j = 0; j < this.joints; j++) {
      rotated(place, 3 * j, anchor, 3 * j, orientation, 4 * body[j]);
      for (let i = 0; i < 3; i++) place[3 * j + i] += position[3 * body[j] + i];
      load[j] = loads[k * this.joints + j] * (1 - weight) + loads[next * this.joints + j] * weight;
      state[j] = this.stateOf(k, j);
    }
  }

  /** State of joint j in frame k. */
  stateOf(k, j) {
    const broken = this.broken[k * this.joints + j];
    return this.damaged[j] ? STATE.before : broken === 0 ? STATE.whole : broken < this.springs[j] ? STATE.partly : STATE.broken;
  }

  /** Whether any joint is in a state at any time. */
  occurs(state) {
    for (let k = 0; k < this.time.length; k++) for (let j = 0; j < this.joints; j++) if (this.stateOf(k, j) === state) return true;
    return false;
  }

  /** Transform a point (Vector3 [m]) from the body frame of element k to its current position; returns it. */
  placed(k, point) {
    const [q, p] = [this.orientation.subarray(4 * k), this.position.subarray(3 * k)];
    return point.applyQuaternion({ x: q[0], y: q[1], z: q[2], w: q[3] }).add({ x: p[0], y: p[1], z: p[2] });
  }

  /** The point of the body frame of element k that is at a position now (Vector3 [m]); changes and returns it. */
  local(k, point) {
    const [q, p] = [this.orientation.subarray(4 * k), this.position.subarray(3 * k)];
    return point.sub({ x: p[0], y: p[1], z: p[2] }).applyQuaternion({ x: -q[0], y: -q[1], z: -q[2], w: q[3] });
  }

  /** Numbers of the joints of element k. */
  jointsOf(k) {
    return Array.from({ length: this.joints }, (_, j) => j).filter((j) => this.a[j] === k || this.b[j] === k);
  }

  /** Largest load of some joints in each frame: { values, at(run, t) -> { load, joint or null } }. */
  loadOver(joints) {
    const values = Float32Array.from(this.time, (_, k) => joints.reduce((most, j) => Math.max(most, this.loads[k * this.joints + j]), 0));
    const at = (run) => joints.reduce((most, j) => (most.joint === null || run.joint.load[j] > most.load ? { load: run.joint.load[j], joint: j } : most), { load: 0, joint: null });
    return { values, at };
  }

  /** Current corners of element k: list of Vector3 [m]. */
  corners(k) {
    const [from, to] = [this.vertex_start[k], this.vertex_start[k + 1]];
    return Array.from({ length: to - from }, (_, i) => this.placed(k, new Vector3().fromArray(this.vertices, 3 * (from + i))));
  }

  /** Current number of joints in a state, without those of wall sheets. */
  count(state) {
    let found = 0;
    for (let j = 0; j < this.joints; j++) found += this.joint.state[j] === state && !this.apart.has(j);
    return found;
  }

  /** Current state of a wall sheet, as in recording/record.py. */
  sheetState(sheet) {
    const broken = this.sheets[sheet].filter((j) => this.joint.state[j] !== STATE.whole).length;
    return broken === 0 ? "whole" : broken < this.sheets[sheet].length ? "partly" : "broken";
  }

  /** Current number of wall sheets in a state. */
  countSheets(state) {
    return this.sheets.filter((_, sheet) => this.sheetState(sheet) === state).length;
  }

  /** Current number of columns that have fallen. */
  countFallen() {
    const across = (q, k) => 2 * (q[k] * q[k + 2] - q[k + 3] * q[k + 1]);
    const along = (q, k) => 2 * (q[k + 1] * q[k + 2] + q[k + 3] * q[k]);
    const up = (q, k) => 1 - 2 * (q[k] ** 2 + q[k + 1] ** 2);
    const upright = (k) => [across, along, up].reduce((sum, part) => sum + part(this.orientation, 4 * k) * part(this.orientations, 4 * k), 0);
    return this.columns.filter((k) => upright(k) < FALLEN).length;
  }

  moveGround(t) {
    const { dt, start } = this.info.motion ?? {};
    if (!dt) return;
    const last = this.displacement.length / 3 - 1;
    const place = Math.min(Math.max((t - start) / dt, 0), last);
    const k = Math.min(Math.floor(place), Math.max(last - 1, 0));
    const next = Math.min(k + 1, last);
    for (let i = 0; i < 3; i++) {
      const from = this.displacement[3 * k + i];
      this.ground[i] = from + (place - k) * (this.displacement[3 * next + i] - from);
    }
  }
}

const FALLEN = Math.cos(Math.PI / 4); // of the inclination beyond which a column has fallen, as in recording/damage.py

/** States of a joint, as numbers for the shader of joints.js. */
export const STATE = { whole: 0, partly: 1, broken: 2, before: 3 };

/** out[o..] = vector v[i..] rotated by the quaternion q[k..] (x, y, z, w). */
function rotated(out, o, v, i, q, k) {
  const [x, y, z, w] = [q[k], q[k + 1], q[k + 2], q[k + 3]];
  const [a, b, c] = [v[i], v[i + 1], v[i + 2]];
  const tx = 2 * (y * c - z * b);
  const ty = 2 * (z * a - x * c);
  const tz = 2 * (x * b - y * a);
  out[o] = a + w * tx + y * tz - z * ty;
  out[o + 1] = b + w * ty + z * tx - x * tz;
  out[o + 2] = c + w * tz + x * ty - y * tx;
}
