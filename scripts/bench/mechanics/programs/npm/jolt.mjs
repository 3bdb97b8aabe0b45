// SPDX-License-Identifier: GPL-2.0-or-later
import initialise from 'jolt-physics';
import { middle, named, serve } from './serve.mjs';

const CONVEX_RADIUS = 0.001; // [m]
const J = await initialise();

function makeWorld() {
  const settings = new J.JoltSettings(), pairs = new J.ObjectLayerPairFilterTable(2);
  settings.mMaxWorkerThreads = 0;
  pairs.EnableCollision(0, 1);
  pairs.EnableCollision(1, 1);
  const layers = new J.BroadPhaseLayerInterfaceTable(2, 2);
  for (const k of [0, 1]) layers.MapObjectToBroadPhaseLayer(k, new J.BroadPhaseLayer(k));
  settings.mObjectLayerPairFilter = pairs;
  settings.mBroadPhaseLayerInterface = layers;
  settings.mObjectVsBroadPhaseLayerFilter = new J.ObjectVsBroadPhaseLayerFilterTable(layers, 2, pairs, 2);
  return new J.JoltInterface(settings);
}

const vec = (v) => new J.Vec3(v[0], v[1], v[2]), point = (v) => new J.RVec3(v[0], v[1], v[2]);

function shapeOf(body) {
  if (body.extents) return new J.BoxShape(vec(body.extents.map((x) => x / 2)), CONVEX_RADIUS, null);
  const settings = new J.ConvexHullShapeSettings();
  for (const corner of body.corners) settings.mPoints.push_back(vec(corner));
  settings.mMaxConvexRadius = CONVEX_RADIUS;
  return settings.Create().Get();
}

function create(bodies, scene, body, options) {
  const moves = body.mass !== null, [w, x, y, z] = body.orientation;
  const type = moves ? J.EMotionType_Dynamic : body.shaken ? J.EMotionType_Kinematic : J.EMotionType_Static;
  const settings = new J.BodyCreationSettings(shapeOf(body), point(body.position), new J.Quat(x, y, z, w), type, moves || body.shaken ? 1 : 0);
  Object.assign(settings, { mFriction: scene.friction, mRestitution: scene.restitution, mLinearDamping: 0, mAngularDamping: 0, mAllowSleeping: !options.awake });
  if (moves) {
    settings.mOverrideMassProperties = J.EOverrideMassProperties_CalculateInertia;
    settings.mMassPropertiesOverride.mMass = body.mass;
    settings.mLinearVelocity = vec(body.velocity);
    settings.mAngularVelocity = vec(body.spin);
  }
  const made = bodies.CreateBody(settings);
  bodies.AddBody(made.GetID(), type === J.EMotionType_Static ? J.EActivation_DontActivate : J.EActivation_Activate);
  return made;
}

function constraint(joint, scene, made) {
  const [first, second] = [made[joint.first], made[joint.second]], at = middle(joint.points);
  let settings;
  if (joint.kind === 'weld') {
    settings = new J.FixedConstraintSettings();
    settings.mAutoDetectPoint = true;
  } else if (joint.kind === 'ball') {
    settings = new J.PointConstraintSettings();
    settings.mPoint1 = settings.mPoint2 = point(at);
  } else if (joint.kind === 'hinge') {
    settings = new J.HingeConstraintSettings();
    settings.mPoint1 = settings.mPoint2 = point(at);
    settings.mHingeAxis1 = settings.mHingeAxis2 = new J.Vec3(0, 1, 0);
    settings.mNormalAxis1 = settings.mNormalAxis2 = new J.Vec3(1, 0, 0);
  } else {
    settings = new J.DistanceConstraintSettings();
    settings.mPoint1 = point(named(scene, joint.first).position);
    settings.mPoint2 = point(named(scene, joint.second).position);
    settings.mMinDistance = settings.mMaxDistance = 1;
    settings.mLimitsSpringSettings.mMode = J.ESpringMode_StiffnessAndDamping;
    settings.mLimitsSpringSettings.mStiffness = joint.stiffness;
    settings.mLimitsSpringSettings.mDamping = 0;
  }
  return settings.Create(first, second);
}

function make(scene, dt, options) {
  const jolt = makeWorld(), system = jolt.GetPhysicsSystem(), bodies = system.GetBodyInterface(), made = {};
  system.SetGravity(new J.Vec3(0, 0, -scene.gravity));
  for (let k = 0; k < scene.removed; k++) {
    const extra = create(bodies, scene, { extents: [0.3, 0.3, 0.3], position: [50 + k, 0, 5], orientation: [1, 0, 0, 0], mass: 1, velocity: [0, 0, 0], spin: [0, 0, 0] }, options);
    bodies.RemoveBody(extra.GetID());
    bodies.DestroyBody(extra.GetID());
  }
  for (const body of scene.bodies) made[body.name] = create(bodies, scene, body, options);
  for (const joint of scene.joints) system.AddConstraint(constraint(joint, scene, made));
  const list = (v) => [v.GetX(), v.GetY(), v.GetZ()];
  return {
    step: () => jolt.Step(dt, 1),
    state: (name) => {
      const body = made[name], q = body.GetRotation();
      return [list(body.GetCenterOfMassPosition()), [q.GetW(), q.GetX(), q.GetY(), q.GetZ()], list(body.GetLinearVelocity()), list(body.GetAngularVelocity())];
    },
    move: (name, x, velocity) => made[name].SetLinearVelocity(new J.Vec3(velocity, 0, 0)),
    push: (name, force) => { bodies.ActivateBody(made[name].GetID()); made[name].AddForce(new J.Vec3(force, 0, 0)); },
    twist: (name, torque) => { bodies.ActivateBody(made[name].GetID()); made[name].AddTorque(new J.Vec3(0, 0, torque)); },
    free: () => J.destroy(jolt),
  };
}

await serve(make);
