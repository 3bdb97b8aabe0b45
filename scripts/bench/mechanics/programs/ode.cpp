// SPDX-License-Identifier: GPL-2.0-or-later
// Runs one scene of boxes in ODE. Reads it from the standard input as compiled.py writes it; prints, for each sample, the time,
// the contact force on the weighed body [N], and 13 numbers a body: position, orientation (w, x, y, z), velocity, spin.
#include <cmath>
#include <cstdio>
#include <iostream>
#include <map>
#include <ode/ode.h>
#include <string>
#include <vector>

struct Member {
	std::string name, kind; // fixed, shaken or free
	dVector3 start;
	dBodyID body;
	dGeomID geom;
	double forceRate, torque;
};

static dWorldID world;
static dSpaceID space;
static dJointGroupID contacts;
static double friction, restitution;
static dBodyID weighed = nullptr;
static std::vector<std::pair<dJointFeedback, bool>> feedbacks; // of contacts on the weighed body; whether it is the second one

static void collide(void*, dGeomID first, dGeomID second)
{
	const auto a = dGeomGetBody(first), b = dGeomGetBody(second);
	if ((!a || dBodyIsKinematic(a)) && (!b || dBodyIsKinematic(b))) return;
	dContactGeom points[8];
	const int count = dCollide(first, second, 8, points, sizeof(dContactGeom));
	for (int i = 0; i < count; ++i) {
		dContact contact {};
		contact.geom = points[i];
		contact.surface.mode = dContactApprox1 | dContactBounce;
		contact.surface.mu = friction;
		contact.surface.bounce = restitution;
		const auto joint = dJointCreateContact(world, contacts, &contact);
		dJointAttach(joint, a, b);
		if (weighed && (a == weighed || b == weighed)) {
			feedbacks.push_back({ {}, a != weighed });
			dJointSetFeedback(joint, &feedbacks.back().first);
		}
	}
}

static Member readBody(std::istream& in)
{
	Member member;
	double mass, q[4], v[3], w[3], e[3];
	in >> member.name >> member.kind >> mass >> member.start[0] >> member.start[1] >> member.start[2] >> q[0] >> q[1] >> q[2] >> q[3];
	in >> v[0] >> v[1] >> v[2] >> w[0] >> w[1] >> w[2] >> e[0] >> e[1] >> e[2] >> member.forceRate >> member.torque;
	member.geom = dCreateBox(space, e[0], e[1], e[2]);
	member.body = member.kind == "fixed" ? nullptr : dBodyCreate(world);
	if (member.body) {
		dMass inertia;
		dMassSetBoxTotal(&inertia, member.kind == "free" ? mass : 1, e[0], e[1], e[2]);
		dBodySetMass(member.body, &inertia);
		if (member.kind == "shaken") dBodySetKinematic(member.body);
		dGeomSetBody(member.geom, member.body);
	}
	dGeomSetPosition(member.geom, member.start[0], member.start[1], member.start[2]);
	dGeomSetQuaternion(member.geom, q);
	if (member.body) {
		dBodySetLinearVel(member.body, v[0], v[1], v[2]);
		dBodySetAngularVel(member.body, w[0], w[1], w[2]);
	}
	return member;
}

static void readJoint(std::istream& in, std::map<std::string, dBodyID>& bodies, double dt)
{
	std::string kind, first, second;
	double p[3], stiffness;
	in >> kind >> first >> second >> p[0] >> p[1] >> p[2] >> stiffness;
	const auto a = bodies[first], b = bodies[second];
	if (kind == "weld") {
		const auto joint = dJointCreateFixed(world, nullptr);
		dJointAttach(joint, a, b);
		dJointSetFixed(joint);
	} else if (kind == "ball") {
		const auto joint = dJointCreateBall(world, nullptr);
		dJointAttach(joint, a, b);
		dJointSetBallAnchor(joint, p[0], p[1], p[2]);
	} else if (kind == "hinge") {
		const auto joint = dJointCreateHinge(world, nullptr);
		dJointAttach(joint, a, b);
		dJointSetHingeAnchor(joint, p[0], p[1], p[2]);
		dJointSetHingeAxis(joint, 0, 1, 0);
	} else { // a stop with the CFM and ERP of an implicit spring (manual, section 3.8.2)
		const auto joint = dJointCreateSlider(world, nullptr);
		dJointAttach(joint, a, b);
		dJointSetSliderAxis(joint, 1, 0, 0);
		dJointSetSliderParam(joint, dParamLoStop, 0);
		dJointSetSliderParam(joint, dParamHiStop, 0);
		dJointSetSliderParam(joint, dParamStopERP, 1);
		dJointSetSliderParam(joint, dParamStopCFM, 1 / (dt * stiffness));
	}
}

static void print(double time, const std::vector<Member>& members)
{
	double force = 0;
	for (const auto& [feedback, second] : feedbacks)
		force += second ? feedback.f2[2] : feedback.f1[2];
	std::printf("%.12g %.9g", time, force);
	for (const auto& member : members) {
		const auto* p = dGeomGetPosition(member.geom);
		dQuaternion q;
		dGeomGetQuaternion(member.geom, q);
		const dReal none[3] = { 0, 0, 0 };
		const auto* v = member.body ? dBodyGetLinearVel(member.body) : none;
		const auto* w = member.body ? dBodyGetAngularVel(member.body) : none;
		std::printf(" %.12g %.12g %.12g %.12g %.12g %.12g %.12g %.12g %.12g %.12g %.12g %.12g %.12g", p[0], p[1], p[2], q[0],
		        q[1], q[2], q[3], v[0], v[1], v[2], w[0], w[1], w[2]);
	}
	std::printf("\n");
}

int main()
{
	double dt, gravity, peak, frequency;
	long steps, every;
	int removed, bodyCount, jointCount;
	std::string weighedName;
	std::cin >> dt >> steps >> every >> friction >> restitution >> gravity >> peak >> frequency >> removed >> weighedName >> bodyCount >> jointCount;
	dInitODE2(0);
	dAllocateODEDataForThread(dAllocateMaskAll);
	world = dWorldCreate();
	space = dHashSpaceCreate(nullptr);
	contacts = dJointGroupCreate(0);
	dWorldSetGravity(world, 0, 0, -gravity);
	feedbacks.reserve(64);
	for (int i = 0; i < removed; ++i)
		dBodyDestroy(dBodyCreate(world));
	std::vector<Member> members;
	std::map<std::string, dBodyID> bodies;
	for (int i = 0; i < bodyCount; ++i) {
		members.push_back(readBody(std::cin));
		bodies[members.back().name] = members.back().body;
	}
	if (bodies.count(weighedName)) weighed = bodies[weighedName];
	for (int i = 0; i < jointCount; ++i)
		readJoint(std::cin, bodies, dt);
	const double omega = 2 * M_PI * frequency;
	const auto shaken = [&](double time) { return omega > 0 ? -peak / (omega * omega) * std::sin(omega * time) : 0; };
	print(0, members);
	for (long k = 0; k < steps; ++k) {
		for (const auto& member : members) {
			if (member.kind == "shaken") {
				const double x = shaken(k * dt);
				dBodySetPosition(member.body, member.start[0] + x, member.start[1], member.start[2]);
				dBodySetLinearVel(member.body, (shaken((k + 1) * dt) - x) / dt, 0, 0);
			}
			if (member.forceRate) dBodyAddForce(member.body, member.forceRate * (k + 1) * dt, 0, 0);
			if (member.torque) dBodyAddTorque(member.body, 0, 0, member.torque);
		}
		feedbacks.clear();
		dSpaceCollide(space, nullptr, collide);
		dWorldStep(world, dt);
		if ((k + 1) % every == 0 || k + 1 == steps) print((k + 1) * dt, members);
		dJointGroupEmpty(contacts);
	}
}
