// SPDX-License-Identifier: GPL-2.0-or-later
import load from 'ammojs3';
import { local, middle, named, serve } from './serve.mjs';

const A = await load();
const vec = (v) => new A.btVector3(v[0], v[1], v[2]), list = (v) => [v.x(), v.y(), v.z()];

function transform(position, [w, x, y, z]) {
  const frame = new A.btTransform();
  frame.setIdentity();
  frame.setOrigin(vec(position));
  frame.setRotation(new A.btQuaternion(x, y, z, w));
  return frame;
}

function shapeOf(body) {
  if (body.extents) return new A.btBoxShape(vec(body.extents.map((x) => x / 2)));
  const hull = new A.btConvexHullShape();
  for (const corner of body.corners) hull.addPoint(vec(corner), true);
  return hull;
}

// Friction and restitution of a pair are products.
function create(world, scene, body, options) {
  const shape = shapeOf(body), inertia = vec([0, 0, 0]), mass = body.mass ?? 0;
  if (mass) shape.calculateLocalInertia(mass, inertia);
  const info = new A.btRigidBodyConstructionInfo(mass, new A.btDefaultMotionState(transform(body.position, body.orientation)), shape, inertia);
  const made = new A.btRigidBody(info);
  made.setFriction(Math.sqrt(scene.friction));
  made.setRestitution(Math.sqrt(scene.restitution));
  if (mass) {
    if (options.awake) made.setActivationState(4);
    made.setLinearVelocity(vec(body.velocity));
    made.setAngularVelocity(vec(body.spin));
  } else if (body.shaken) {
    made.setCollisionFlags(made.getCollisionFlags() | 2);
    made.setActivationState(4);
  }
  world.addRigidBody(made);
  return made;
}

function constraint(joint, scene, made) {
  const at = middle(joint.points), bodies = [joint.first, joint.second].map((name) => named(scene, name));
  const [first, second] = [made[joint.first], made[joint.second]], [a, b] = bodies.map((body) => local(at, body));
  const frames = [a, b].map((place, k) => {
    const [w, x, y, z] = bodies[k].orientation;
    return transform(place, [w, -x, -y, -z]);
  });
  if (joint.kind === 'weld') return new A.btFixedConstraint(first, second, ...frames);
  if (joint.kind === 'ball') return new A.btPoint2PointConstraint(first, second, vec(a), vec(b));
  if (joint.kind === 'hinge') return new A.btHingeConstraint(first, second, vec(a), vec(b), vec([0, 1, 0]), vec([0, 1, 0]), false);
  const spring = new A.btGeneric6DofSpringConstraint(first, second, ...frames, true);
  spring.setLinearLowerLimit(vec([1, 0, 0]));
  spring.setLinearUpperLimit(vec([-1, 0, 0]));
  spring.enableSpring(0, true);
  spring.setStiffness(0, joint.stiffness);
  spring.setDamping(0, 1);
  spring.setEquilibriumPoint(0, 0);
  return spring;
}

function make(scene, dt, options) {
  const configuration = new A.btDefaultCollisionConfiguration(), dispatcher = new A.btCollisionDispatcher(configuration);
  const world = new A.btDiscreteDynamicsWorld(dispatcher, new A.btDbvtBroadphase(), new A.btSequentialImpulseConstraintSolver(), configuration);
  world.setGravity(vec([0, 0, -scene.gravity]));
  for (let k = 0; k < scene.removed; k++) {
    world.removeRigidBody(create(world, scene, { extents: [0.3, 0.3, 0.3], position: [50 + k, 0, 5], orientation: [1, 0, 0, 0], mass: 1, velocity: [0, 0, 0], spin: [0, 0, 0] }, options));
  }
  const made = {}, constraints = [];
  for (const body of scene.bodies) made[body.name] = create(world, scene, body, options);
  for (const joint of scene.joints) {
    const made_ = constraint(joint, scene, made);
    if (joint.strength) made_.setBreakingImpulseThreshold(joint.strength * dt);
    world.addConstraint(made_, false);
    constraints.push(made_);
  }
  return {
    step: () => world.stepSimulation(dt, 0),
    state: (name) => {
      const body = made[name], frame = body.getCenterOfMassTransform(), q = frame.getRotation();
      return [list(frame.getOrigin()), [q.w(), q.x(), q.y(), q.z()], list(body.getLinearVelocity()), list(body.getAngularVelocity())];
    },
    move: (name, x) => {
      const place = named(scene, name).position;
      made[name].getMotionState().setWorldTransform(transform([x, place[1], place[2]], [1, 0, 0, 0]));
    },
    push: (name, force) => { made[name].activate(true); made[name].applyForce(vec([force, 0, 0]), vec([0, 0, 0])); },
    twist: (name, torque) => { made[name].activate(true); made[name].applyTorque(vec([0, 0, torque])); },
    support: () => {
      let sum = 0;
      for (let i = 0; i < dispatcher.getNumManifolds(); i++) {
        const manifold = dispatcher.getManifoldByIndexInternal(i);
        for (let k = 0; k < manifold.getNumContacts(); k++) sum += manifold.getContactPoint(k).getAppliedImpulse();
      }
      return sum / dt;
    },
    broken: () => constraints.some((each) => !each.isEnabled()),
  };
}

await serve(make);
