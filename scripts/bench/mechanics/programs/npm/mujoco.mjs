// SPDX-License-Identifier: GPL-2.0-or-later
import load from '@mujoco/mujoco';
import { local, middle, named, notPossible, rotate, serve } from './serve.mjs';

const M = await load();
const words = (v) => v.join(' ');

function bodyXml(body, index) {
  const geom = body.extents ? `type="box" size="${words(body.extents.map((x) => x / 2))}"` : `type="mesh" mesh="mesh${index}"`;
  const joint = body.mass !== null ? '<freejoint/>' : body.shaken ? '<joint type="slide" axis="1 0 0"/>' : '';
  const mass = body.mass ?? (body.shaken ? 1e6 : 0);
  return `<body name="${body.name}" pos="${words(body.position)}" quat="${words(body.orientation)}">${joint}
    <geom ${geom} ${mass ? `mass="${mass}"` : ''}/><site name="${body.name}"/></body>`;
}

function jointXml(joint, scene) {
  const second = named(scene, joint.second), first = named(scene, joint.first);
  if (joint.kind === 'weld') return `<weld body1="${joint.first}" body2="${joint.second}"/>`;
  return joint.points.map((p) => `<connect body1="${joint.second}" body2="${joint.first}" anchor="${words(local(p, second))}"/>`).join('');
}

function xml(scene, dt, options) {
  const springs = scene.joints.filter((joint) => joint.kind === 'spring');
  return `<mujoco><option ${options.option ?? ''} timestep="${dt}" gravity="0 0 ${-scene.gravity}"/><size memory="200M"/>
    <default><geom friction="${scene.friction} 0.005 0.0001"/></default>
    <asset>${scene.bodies.map((body, i) => (body.corners ? `<mesh name="mesh${i}" vertex="${words(body.corners.flat())}"/>` : '')).join('')}</asset>
    <worldbody>${scene.bodies.map(bodyXml).join('')}</worldbody>
    <equality>${scene.joints.filter((joint) => joint.kind !== 'spring').map((joint) => jointXml(joint, scene)).join('')}</equality>
    <tendon>${springs.map((joint) => `<spatial stiffness="${joint.stiffness}"><site site="${joint.first}"/><site site="${joint.second}"/></spatial>`).join('')}</tendon>
    </mujoco>`;
}

// Indices of each body's coordinates.
function addresses(scene) {
  const found = {};
  let q = 0, v = 0;
  scene.bodies.forEach((body, i) => {
    found[body.name] = { q, v, id: i + 1 };
    if (body.mass !== null) { q += 7; v += 6; } else if (body.shaken) { q += 1; v += 1; }
  });
  return found;
}

function make(scene, dt, options) {
  if (scene.restitution > 0) notPossible('no restitution');
  if (scene.removed) notPossible('no removal of bodies');
  const model = M.MjModel.from_xml_string(xml(scene, dt, options)), data = new M.MjData(model), at = addresses(scene);
  for (const body of scene.bodies) {
    const { v } = at[body.name];
    const [w, x, y, z] = body.orientation;
    if (body.mass !== null) {
      body.velocity.forEach((value, k) => { data.qvel[v + k] = value; });
      rotate(body.spin, [w, -x, -y, -z]).forEach((value, k) => { data.qvel[v + 3 + k] = value; });
    }
  }
  M.mj_forward(model, data);
  const state = (name) => {
    const body = named(scene, name), { q, v, id } = at[name];
    if (body.mass === null) {
      const x = body.position[0] + (body.shaken ? data.qpos[q] : 0);
      return [[x, body.position[1], body.position[2]], body.orientation, [body.shaken ? data.qvel[v] : 0, 0, 0], [0, 0, 0]];
    }
    const place = Array.from(data.qpos.subarray(q, q + 7)), speed = Array.from(data.qvel.subarray(v, v + 6));
    return [place.slice(0, 3), place.slice(3), speed.slice(0, 3), rotate(speed.slice(3), place.slice(3))];
  };
  return {
    step: () => M.mj_step(model, data),
    state,
    move: (name, x, velocity) => {
      const { q, v } = at[name], from = named(scene, name).position[0];
      data.qpos[q] = x - from - velocity * dt; // the step adds the way
      data.qvel[v] = velocity;
      data.qfrc_applied[v + 0] = 0;
    },
    push: (name, force) => { data.xfrc_applied[6 * at[name].id] = force; },
    twist: (name, torque) => { data.xfrc_applied[6 * at[name].id + 5] = torque; },
    support: () => {
      M.mj_rnePostConstraint(model, data);
      return data.cfrc_ext[6 * at[scene.weighed].id + 5];
    },
    free: () => { data.delete(); model.delete(); },
  };
}

await serve(make);
