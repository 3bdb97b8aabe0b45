// SPDX-License-Identifier: GPL-2.0-or-later
// Runs scenes that arrive as lines {scene, dt, options} on the standard input, and answers each with a line: its trajectory or a reason.
import { createInterface } from 'node:readline';

export const notPossible = (text) => { throw Object.assign(new Error(text), { notPossible: true }); };

// Local coordinates of a world point in a body's frame; orientation (w, x, y, z).
export function local(point, body) {
  const d = point.map((x, i) => x - body.position[i]), [w, x, y, z] = body.orientation;
  return rotate(d, [w, -x, -y, -z]);
}

export function rotate(v, [w, x, y, z]) {
  const t = [2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])];
  return [v[0] + w * t[0] + y * t[2] - z * t[1], v[1] + w * t[1] + z * t[0] - x * t[2], v[2] + w * t[2] + x * t[1] - y * t[0]];
}

// Faces of a hexahedron whose corner 4a + 2b + c has the indices a, b, c in three directions; outward, counterclockwise.
export function hexahedronFaces(corners) {
  const faces = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
  return faces.map((face) => {
    const [a, b, c] = face.map((i) => corners[i]);
    const u = b.map((x, i) => x - a[i]), v = c.map((x, i) => x - a[i]);
    const normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    return normal[0] * a[0] + normal[1] * a[1] + normal[2] * a[2] > 0 ? face : [...face].reverse();
  });
}

export const named = (scene, name) => scene.bodies.find((body) => body.name === name);
export const middle = (points) => [0, 1, 2].map((i) => points.reduce((sum, p) => sum + p[i], 0) / points.length);

// Displacement of a shaken body along x.
const shaken = ([acceleration, frequency], time) => {
  const omega = 2 * Math.PI * frequency;
  return -acceleration / omega ** 2 * Math.sin(omega * time);
};

// make(scene, dt, options): { step(), state(name) -> [position, orientation, velocity, spin], move(name, x, velocity), push(name, force),
// twist(name, torque), support(), broken() -> whether the joint has broken, free() }
function run(make, scene, dt, options) {
  const engine = make(scene, dt, options), every = Math.max(1, Math.round(scene.sample / dt)), count = Math.round(scene.duration / dt);
  const out = { times: [], support: [], broken: null, rows: Object.fromEntries(scene.bodies.map((b) => [b.name, [[], [], [], []]])) };
  const sample = (time) => {
    out.times.push(time);
    out.support.push(scene.weighed && engine.support ? engine.support() : null);
    for (const body of scene.bodies) engine.state(body.name).forEach((value, k) => out.rows[body.name][k].push([...value]));
  };
  sample(0);
  for (let k = 0; k < count; k++) {
    for (const body of scene.bodies) {
      if (body.shaken) {
        const from = shaken(scene.shaking, k * dt), to = shaken(scene.shaking, (k + 1) * dt);
        engine.move(body.name, body.position[0] + from, (to - from) / dt);
      }
      if (body.force_rate) engine.push(body.name, body.force_rate * (k + 1) * dt);
      if (body.torque) engine.twist(body.name, body.torque);
    }
    engine.step();
    if (out.broken === null && scene.joints.some((j) => j.strength) && engine.broken && engine.broken()) out.broken = (k + 1) * dt;
    if ((k + 1) % every === 0 || k + 1 === count) sample((k + 1) * dt);
  }
  engine.free?.();
  return out;
}

export async function serve(make) {
  for await (const line of createInterface({ input: process.stdin })) {
    const { scene, dt, options } = JSON.parse(line);
    let answer;
    try { answer = run(make, scene, dt, options); } catch (error) {
      answer = { [error.notPossible ? 'notPossible' : 'failed']: String(error.message ?? error) };
    }
    process.stdout.write(JSON.stringify(answer) + '\n');
  }
}
