// SPDX-License-Identifier: GPL-2.0-or-later
import * as C from 'cannon-es';
import { hexahedronFaces, local, middle, named, serve } from './serve.mjs';

const vec = (v) => new C.Vec3(v[0], v[1], v[2]), list = (v) => [v.x, v.y, v.z];

function shapeOf(body) {
  if (body.extents) return new C.Box(vec(body.extents.map((x) => x / 2)));
  return new C.ConvexPolyhedron({ vertices: body.corners.map(vec), faces: hexahedronFaces(body.corners) });
}

// Created unrotated, since the inertia is taken from the first pose.
function create(world, material, body) {
  const type = body.mass !== null ? C.Body.DYNAMIC : body.shaken ? C.Body.KINEMATIC : C.Body.STATIC;
  const made = new C.Body({ mass: body.mass ?? 0, type, shape: shapeOf(body), material, linearDamping: 0, angularDamping: 0 });
  const [w, x, y, z] = body.orientation;
  made.position.set(...body.position);
  made.quaternion.set(x, y, z, w);
  if (body.mass !== null) {
    made.velocity.set(...body.velocity);
    made.angularVelocity.set(...body.spin);
  }
  made.updateInertiaWorld(true);
  world.addBody(made);
  return made;
}

function constraint(joint, scene, made) {
  const [first, second] = [made[joint.first], made[joint.second]], at = middle(joint.points);
  const [a, b] = [joint.first, joint.second].map((name) => vec(local(at, named(scene, name))));
  if (joint.kind === 'weld') return new C.LockConstraint(first, second);
  if (joint.kind === 'ball') return new C.PointToPointConstraint(first, a, second, b);
  return new C.HingeConstraint(first, second, { pivotA: a, pivotB: b, axisA: new C.Vec3(0, 1, 0), axisB: new C.Vec3(0, 1, 0) });
}

function make(scene, dt) {
  const world = new C.World({ gravity: new C.Vec3(0, 0, -scene.gravity) }), material = new C.Material(), made = {}, springs = [];
  world.addContactMaterial(new C.ContactMaterial(material, material, { friction: scene.friction, restitution: scene.restitution }));
  for (let k = 0; k < scene.removed; k++) {
    world.removeBody(create(world, material, { extents: [0.3, 0.3, 0.3], position: [50 + k, 0, 5], orientation: [1, 0, 0, 0], mass: 1, velocity: [0, 0, 0], spin: [0, 0, 0] }));
  }
  for (const body of scene.bodies) made[body.name] = create(world, material, body);
  for (const joint of scene.joints) {
    if (joint.kind === 'spring') springs.push(new C.Spring(made[joint.first], made[joint.second], { restLength: 1, stiffness: joint.stiffness, damping: 0 }));
    else world.addConstraint(constraint(joint, scene, made));
  }
  return {
    step: () => { for (const spring of springs) spring.applyForce(); world.step(dt); },
    state: (name) => {
      const body = made[name], q = body.quaternion;
      return [list(body.position), [q.w, q.x, q.y, q.z], list(body.velocity), list(body.angularVelocity)];
    },
    move: (name, x, velocity) => made[name].velocity.set(velocity, 0, 0),
    push: (name, force) => made[name].applyForce(new C.Vec3(force, 0, 0)),
    twist: (name, torque) => made[name].applyTorque(new C.Vec3(0, 0, torque)),
    support: () => world.contacts.reduce((sum, equation) => sum + equation.multiplier, 0),
  };
}

await serve(make);
