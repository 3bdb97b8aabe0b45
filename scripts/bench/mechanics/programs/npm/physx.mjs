// SPDX-License-Identifier: GPL-2.0-or-later
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { local, middle, named, serve } from './serve.mjs';

// The package is built for browsers alone.
Object.defineProperty(process, 'versions', { value: {} });
globalThis.window = globalThis;
const { default: load } = await import('physx-js-webidl');
const wasm = fileURLToPath(import.meta.resolve('physx-js-webidl/physx-js-webidl.wasm'));
const P = await load({ wasmBinary: readFileSync(wasm) }), top = P.PxTopLevelFunctions.prototype;
const foundation = top.CreateFoundation(P.PHYSICS_VERSION, new P.PxDefaultAllocator(), new P.PxDefaultErrorCallback());
const tolerances = new P.PxTolerancesScale(), physics = top.CreatePhysics(P.PHYSICS_VERSION, foundation, tolerances);
top.InitExtensions(physics);
const flags = new P.PxShapeFlags(P.PxShapeFlagEnum.eSIMULATION_SHAPE);
const vec = (v) => new P.PxVec3(v[0], v[1], v[2]), list = (v) => [v.x, v.y, v.z];
const frame = (p, [w, x, y, z]) => new P.PxTransform(vec(p), new P.PxQuat(x, y, z, w));

function geometryOf(body) {
  if (body.extents) return new P.PxBoxGeometry(...body.extents.map((x) => x / 2));
  const points = new P.PxArray_PxVec3(body.corners.length), desc = new P.PxConvexMeshDesc();
  body.corners.forEach((corner, i) => points.set(i, vec(corner)));
  desc.flags = new P.PxConvexFlags(P.PxConvexFlagEnum.eCOMPUTE_CONVEX);
  desc.points.count = body.corners.length;
  desc.points.stride = 12;
  desc.points.data = points.begin();
  return new P.PxConvexMeshGeometry(top.CreateConvexMesh(new P.PxCookingParams(tolerances), desc));
}

function create(scene, material, world, body, options) {
  const shape = physics.createShape(geometryOf(body), material, true, flags);
  shape.setSimulationFilterData(new P.PxFilterData(1, 1, 0, 0));
  const pose = frame(body.position, body.orientation), moves = body.mass !== null || body.shaken;
  const made = moves ? physics.createRigidDynamic(pose) : physics.createRigidStatic(pose);
  made.attachShape(shape);
  if (body.mass !== null) {
    P.PxRigidBodyExt.prototype.setMassAndUpdateInertia(made, body.mass);
    made.setLinearDamping(0);
    if (options.awake) made.setSleepThreshold(0);
    made.setAngularDamping(0);
    made.setLinearVelocity(vec(body.velocity), true);
    made.setAngularVelocity(vec(body.spin), true);
  } else if (body.shaken) made.setRigidBodyFlag(P.PxRigidBodyFlagEnum.eKINEMATIC, true);
  world.addActor(made);
  return made;
}

function constraint(joint, scene, made) {
  const names = [joint.first, joint.second], at = joint.kind === 'spring' ? null : middle(joint.points);
  const turn = joint.kind === 'hinge' ? [Math.SQRT1_2, 0, 0, Math.SQRT1_2] : [1, 0, 0, 0]; // its axis is x
  const frames = names.map((name) => {
    const body = named(scene, name), [w, x, y, z] = body.orientation;
    return frame(at ? local(at, body) : [0, 0, 0], joint.kind === 'hinge' ? turn : [w, -x, -y, -z]);
  });
  const kind = { weld: 'FixedJointCreate', ball: 'SphericalJointCreate', hinge: 'RevoluteJointCreate', spring: 'DistanceJointCreate' }[joint.kind];
  const result = top[kind](physics, made[joint.first], frames[0], made[joint.second], frames[1]);
  result.setConstraintFlag(P.PxConstraintFlagEnum.eCOLLISION_ENABLED, true);
  if (joint.strength) result.setBreakForce(joint.strength, 1e30);
  if (joint.kind === 'spring') {
    result.setMinDistance(1);
    result.setMaxDistance(1);
    result.setStiffness(joint.stiffness);
    result.setDamping(0);
    for (const flag of ['eMIN_DISTANCE_ENABLED', 'eMAX_DISTANCE_ENABLED', 'eSPRING_ENABLED']) result.setDistanceJointFlag(P.PxDistanceJointFlagEnum[flag], true);
  }
  return result;
}

// Contact impulses of a step, which callbacks alone report.
function reporting(desc) {
  const shader = new P.PassThroughFilterShaderImpl(), events = new P.PxSimulationEventCallbackImpl(), points = new P.PxArray_PxContactPairPoint(64), found = { sum: 0 };
  const wanted = ['eCONTACT_DEFAULT', 'eNOTIFY_TOUCH_FOUND', 'eNOTIFY_TOUCH_PERSISTS', 'eNOTIFY_CONTACT_POINTS'];
  shader.filterShader = () => { shader.outputPairFlags = wanted.reduce((sum, name) => sum | P.PxPairFlagEnum[name], 0); return 0; };
  for (const name of ['onConstraintBreak', 'onWake', 'onSleep', 'onTrigger']) events[name] = () => {};
  events.onContact = (header, first, count) => {
    for (let k = 0; k < count; k++) {
      const pair = P.NativeArrayHelpers.prototype.getContactPairAt(P.wrapPointer(first, P.PxContactPair), k);
      const number = pair.extractContacts(points.begin(), 64);
      for (let i = 0; i < number; i++) found.sum += Math.abs(points.get(i).impulse.z);
    }
  };
  top.setupPassThroughFilterShader(desc, shader);
  desc.simulationEventCallback = events;
  return found;
}

function make(scene, dt, options) {
  const desc = new P.PxSceneDesc(tolerances);
  desc.gravity = vec([0, 0, -scene.gravity]);
  desc.cpuDispatcher = top.DefaultCpuDispatcherCreate(0);
  desc.filterShader = top.DefaultFilterShader();
  const found = scene.weighed ? reporting(desc) : null;
  const world = physics.createScene(desc), material = physics.createMaterial(scene.friction, scene.friction, scene.restitution), made = {};
  for (let k = 0; k < scene.removed; k++) {
    const extra = create(scene, material, world, { extents: [0.3, 0.3, 0.3], position: [50 + k, 0, 5], orientation: [1, 0, 0, 0], mass: 1, velocity: [0, 0, 0], spin: [0, 0, 0] }, options);
    world.removeActor(extra);
    extra.release();
  }
  for (const body of scene.bodies) made[body.name] = create(scene, material, world, body, options);
  const joints = scene.joints.map((joint) => constraint(joint, scene, made));
  return {
    step: () => { if (found) found.sum = 0; world.simulate(dt); world.fetchResults(true); },
    support: () => found.sum / dt,
    state: (name) => {
      const body = made[name], pose = body.getGlobalPose(), q = pose.q, still = named(scene, name).mass === null;
      const speeds = still ? [[0, 0, 0], [0, 0, 0]] : [list(body.getLinearVelocity()), list(body.getAngularVelocity())];
      return [list(pose.p), [q.w, q.x, q.y, q.z], ...speeds];
    },
    move: (name, x, velocity) => {
      const place = named(scene, name).position;
      made[name].setKinematicTarget(frame([x + velocity * dt, place[1], place[2]], [1, 0, 0, 0]));
    },
    push: (name, force) => made[name].addForce(vec([force, 0, 0])),
    twist: (name, torque) => made[name].addTorque(vec([0, 0, torque])),
    broken: () => joints.some((joint) => joint.getConstraintFlags().isSet(P.PxConstraintFlagEnum.eBROKEN)),
  };
}

await serve(make);
