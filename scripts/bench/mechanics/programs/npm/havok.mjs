// SPDX-License-Identifier: GPL-2.0-or-later
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import load from '@babylonjs/havok';
import { local, middle, named, rotate, serve } from './serve.mjs';

const wasm = fileURLToPath(new URL('HavokPhysics.wasm', import.meta.resolve('@babylonjs/havok')));
const H = await load({ wasmBinary: readFileSync(wasm) });
const AXES = ['LINEAR_X', 'LINEAR_Y', 'LINEAR_Z', 'ANGULAR_X', 'ANGULAR_Y', 'ANGULAR_Z'];
const FREE = { weld: [], ball: AXES.slice(3), hinge: ['ANGULAR_X'], spring: ['LINEAR_X'] }; // a hinge turns about the x of its frame
const IMPULSE = 34; // of a collision event, its index as a 32 bit number

const value = ([result, answer]) => {
  if (result !== H.Result.RESULT_OK) throw new Error('the engine refuses a call');
  return answer;
};

function shapeOf(body) {
  if (body.extents) return value(H.HP_Shape_CreateBox([0, 0, 0], [0, 0, 0, 1], body.extents));
  const numbers = body.corners.flat(), place = H._malloc(4 * numbers.length);
  new Float32Array(H.HEAPU8.buffer, place, numbers.length).set(numbers);
  return value(H.HP_Shape_CreateConvexHull(place, body.corners.length));
}

// Combine rules are set for each shape, since new ones inherit them.
function create(world, scene, body, options) {
  const made = value(H.HP_Body_Create()), shape = shapeOf(body), [w, x, y, z] = body.orientation, rule = H.MaterialCombine.GEOMETRIC_MEAN;
  H.HP_Shape_SetMaterial(shape, [scene.friction, scene.friction, scene.restitution, rule, rule]);
  H.HP_Body_SetShape(made, shape);
  H.HP_Body_SetMotionType(made, body.mass !== null ? H.MotionType.DYNAMIC : body.shaken ? H.MotionType.KINEMATIC : H.MotionType.STATIC);
  H.HP_Body_SetQTransform(made, [body.position, [x, y, z, w]]);
  if (body.mass !== null) {
    const [centre, , inertia, turn] = value(H.HP_Shape_BuildMassProperties(shape));
    H.HP_Body_SetMassProperties(made, [centre, body.mass, inertia, turn]);
    H.HP_Body_SetLinearDamping(made, 0);
    H.HP_Body_SetAngularDamping(made, 0);
    H.HP_Body_SetLinearVelocity(made, body.velocity);
    H.HP_Body_SetAngularVelocity(made, body.spin);
    H.HP_Body_SetEventMask(made, H.EventType.COLLISION_STARTED.value | H.EventType.COLLISION_CONTINUED.value);
    if (options.awake) H.HP_Body_SetActivationControl(made, H.ActivationControl.ALWAYS_ACTIVE);
  }
  H.HP_World_AddBody(world, made, false);
  return made;
}

function constrain(joint, scene, made) {
  const result = value(H.HP_Constraint_Create()), free = FREE[joint.kind];
  const [x, y] = joint.kind === 'hinge' ? [[0, 1, 0], [1, 0, 0]] : [[1, 0, 0], [0, 1, 0]];
  const anchor = (name) => {
    const body = named(scene, name), [w, ...v] = body.orientation, back = [w, ...v.map((each) => -each)];
    return [joint.kind === 'spring' ? [0, 0, 0] : local(middle(joint.points), body), rotate(x, back), rotate(y, back)];
  };
  H.HP_Constraint_SetParentBody(result, made[joint.first]);
  H.HP_Constraint_SetChildBody(result, made[joint.second]);
  H.HP_Constraint_SetAnchorInParent(result, ...anchor(joint.first));
  H.HP_Constraint_SetAnchorInChild(result, ...anchor(joint.second));
  for (const axis of AXES) H.HP_Constraint_SetAxisMode(result, H.ConstraintAxis[axis], H.ConstraintAxisLimitMode[free.includes(axis) ? 'FREE' : 'LOCKED']);
  if (joint.kind === 'spring') {
    const axis = H.ConstraintAxis.LINEAR_X, length = named(scene, joint.second).position[0] - named(scene, joint.first).position[0];
    H.HP_Constraint_SetAxisMode(result, axis, H.ConstraintAxisLimitMode.LIMITED);
    H.HP_Constraint_SetAxisMinLimit(result, axis, length);
    H.HP_Constraint_SetAxisMaxLimit(result, axis, length);
    H.HP_Constraint_SetAxisStiffness(result, axis, joint.stiffness);
    H.HP_Constraint_SetAxisDamping(result, axis, 0);
  }
  H.HP_Constraint_SetCollisionsEnabled(result, true);
  H.HP_Constraint_SetEnabled(result, true);
}

function make(scene, dt, options) {
  const world = value(H.HP_World_Create()), made = {};
  H.HP_World_SetGravity(world, [0, 0, -scene.gravity]);
  H.HP_World_SetIdealStepTime(world, dt);
  for (let k = 0; k < scene.removed; k++) {
    H.HP_World_RemoveBody(world, create(world, scene, { extents: [0.3, 0.3, 0.3], position: [50 + k, 0, 5], orientation: [1, 0, 0, 0], mass: 1, velocity: [0, 0, 0], spin: [0, 0, 0] }, options));
  }
  for (const body of scene.bodies) made[body.name] = create(world, scene, body, options);
  for (const joint of scene.joints) constrain(joint, scene, made);
  return {
    step: () => H.HP_World_Step(world, dt),
    state: (name) => {
      const body = made[name], [x, y, z, w] = value(H.HP_Body_GetOrientation(body));
      return [value(H.HP_Body_GetPosition(body)), [w, x, y, z], value(H.HP_Body_GetLinearVelocity(body)), value(H.HP_Body_GetAngularVelocity(body))];
    },
    move: (name, x, velocity) => {
      const place = named(scene, name).position;
      H.HP_Body_SetTargetQTransform(made[name], [[x + velocity * dt, place[1], place[2]], [0, 0, 0, 1]]);
    },
    push: (name, force) => H.HP_Body_ApplyImpulse(made[name], value(H.HP_Body_GetPosition(made[name])), [force * dt, 0, 0]),
    twist: (name, torque) => H.HP_Body_ApplyAngularImpulse(made[name], [0, 0, torque * dt]),
    support: () => {
      let sum = 0, event = H.HP_World_GetCollisionEvents(world)[1]; // none before the first step and of bodies asleep
      for (; event; event = H.HP_World_GetNextCollisionEvent(Number(world), event)) sum += new Float32Array(H.HEAPU8.buffer, event)[IMPULSE];
      return sum / dt;
    },
    free: () => H.HP_World_Release(world),
  };
}

await serve(make);
