// SPDX-License-Identifier: GPL-2.0-or-later
import R from '@dimforge/rapier3d-compat';
import { local, middle, named, serve } from './serve.mjs';

await R.init();
const vec = (v) => ({ x: v[0], y: v[1], z: v[2] }), list = (v) => [v.x, v.y, v.z];
const quat = ([w, x, y, z]) => ({ x, y, z, w });

function create(world, scene, body, options) {
  const kind = body.mass !== null ? R.RigidBodyDesc.dynamic() : body.shaken ? R.RigidBodyDesc.kinematicVelocityBased() : R.RigidBodyDesc.fixed();
  kind.setCanSleep(!options.awake).setTranslation(...body.position).setRotation(quat(body.orientation));
  if (body.mass !== null) kind.setLinvel(...body.velocity).setAngvel(vec(body.spin));
  const made = world.createRigidBody(kind);
  const shape = body.extents ? R.ColliderDesc.cuboid(...body.extents.map((x) => x / 2)) : R.ColliderDesc.convexHull(new Float32Array(body.corners.flat()));
  shape.setFriction(scene.friction).setRestitution(scene.restitution);
  if (body.mass !== null) shape.setMass(body.mass);
  world.createCollider(shape, made);
  return made;
}

function jointData(joint, scene) {
  const at = middle(joint.points), bodies = [joint.first, joint.second].map((name) => named(scene, name));
  const [a, b] = bodies.map((body) => vec(local(at, body)));
  const inverse = bodies.map(({ orientation: [w, x, y, z] }) => ({ w, x: -x, y: -y, z: -z }));
  if (joint.kind === 'weld') return R.JointData.fixed(a, inverse[0], b, inverse[1]);
  if (joint.kind === 'ball') return R.JointData.spherical(a, b);
  if (joint.kind === 'hinge') return R.JointData.revolute(a, b, { x: 0, y: 1, z: 0 });
  return R.JointData.spring(1, joint.stiffness, 0, { x: 0, y: 0, z: 0 }, { x: 0, y: 0, z: 0 });
}

function make(scene, dt, options) {
  const world = new R.World({ x: 0, y: 0, z: -scene.gravity }), made = {};
  world.timestep = dt;
  for (let k = 0; k < scene.removed; k++) {
    world.removeRigidBody(create(world, scene, { extents: [0.3, 0.3, 0.3], position: [50 + k, 0, 5], orientation: [1, 0, 0, 0], mass: 1, velocity: [0, 0, 0], spin: [0, 0, 0] }, options));
  }
  for (const body of scene.bodies) made[body.name] = create(world, scene, body, options);
  for (const joint of scene.joints) world.createImpulseJoint(jointData(joint, scene), made[joint.first], made[joint.second], true);
  return {
    step: () => world.step(),
    state: (name) => {
      const body = made[name], q = body.rotation();
      return [list(body.translation()), [q.w, q.x, q.y, q.z], list(body.linvel()), list(body.angvel())];
    },
    move: (name, x, velocity) => made[name].setLinvel({ x: velocity, y: 0, z: 0 }, true),
    push: (name, force) => { made[name].resetForces(true); made[name].addForce({ x: force, y: 0, z: 0 }, true); },
    twist: (name, torque) => { made[name].resetTorques(true); made[name].addTorque({ x: 0, y: 0, z: torque }, true); },
    support: () => {
      let sum = 0;
      world.contactPair(made.floor.collider(0), made[scene.weighed].collider(0), (manifold) => {
        for (let i = 0; i < manifold.numContacts(); i++) sum += manifold.contactImpulse(i);
      });
      return sum / dt;
    },
    free: () => world.free(),
  };
}

await serve(make);
