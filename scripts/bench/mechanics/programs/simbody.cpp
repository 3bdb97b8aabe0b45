// SPDX-License-Identifier: GPL-2.0-or-later
// Runs one scene of boxes in Simbody. Reads it from the standard input as compiled.py writes it; prints what ode.cpp prints.
// Free boxes are bricks. The fixed or shaken box without joints is the half space below its upper face.
#include <Simbody.h>
#include <cstdio>
#include <iostream>
#include <map>
#include <string>
#include <vector>

using namespace SimTK;

struct Member {
	std::string name, kind; // fixed, shaken or free
	double mass;
	Transform pose;
	Vec3 velocity, spin, extents;
	MobilizedBody body; // ground for fixed ones
};

struct Link {
	std::string kind, first, second;
	Vec3 place;
	double stiffness;
};

static Vec3 readVector(std::istream& in)
{
	Vec3 v;
	in >> v[0] >> v[1] >> v[2];
	return v;
}

static Member readMember(std::istream& in)
{
	Member member;
	double w, force, torque;
	in >> member.name >> member.kind >> member.mass;
	const auto place = readVector(in);
	in >> w;
	const auto turn = readVector(in);
	member.pose = Transform(Rotation(Quaternion(w, turn[0], turn[1], turn[2])), place);
	member.velocity = readVector(in), member.spin = readVector(in), member.extents = readVector(in);
	in >> force >> torque;
	return member;
}

static Link readLink(std::istream& in)
{
	Link link;
	in >> link.kind >> link.first >> link.second;
	link.place = readVector(in);
	in >> link.stiffness;
	return link;
}

static MobilizedBody mobilized(Member& member, const Body& body, const Link* link, std::map<std::string, Member*>& members,
        GeneralForceSubsystem& forces, MobilizedBody ground)
{
	if (!link) return MobilizedBody::Free(ground, Transform(), body, Transform());
	auto& parent = members[link->first]->body;
	const auto base = members[link->first]->kind == "fixed" ? Transform() : members[link->first]->pose;
	Rotation turn; // the axis of a pin is z, of a slider x
	if (link->kind == "hinge") turn = Rotation(-Pi / 2, XAxis);
	const Transform frame(turn, link->kind == "spring" ? member.pose.p() : link->place), in = ~base * frame, out = ~member.pose * frame;
	if (link->kind == "weld") return MobilizedBody::Weld(parent, in, body, out);
	if (link->kind == "ball") return MobilizedBody::Ball(parent, in, body, out);
	if (link->kind == "hinge") return MobilizedBody::Pin(parent, in, body, out);
	MobilizedBody::Slider slider(parent, in, body, out);
	Force::MobilityLinearSpring(forces, slider, MobilizerQIndex(0), link->stiffness, 0);
	return slider;
}

int main()
{
	double dt, friction, restitution, gravity, peak, frequency, stiffness, dissipation, accuracy, transition;
	long steps, every;
	int removed, memberCount, linkCount;
	std::string weighed;
	std::cin >> stiffness >> dissipation >> accuracy >> transition;
	std::cin >> dt >> steps >> every >> friction >> restitution >> gravity >> peak >> frequency >> removed >> weighed >> memberCount >> linkCount;
	std::vector<Member> members;
	for (int i = 0; i < memberCount; ++i)
		members.push_back(readMember(std::cin));
	std::map<std::string, Link> links; // by the second body
	std::map<std::string, Member*> named;
	for (auto& member : members)
		named[member.name] = &member;
	std::map<std::string, bool> joined;
	for (int i = 0; i < linkCount; ++i) {
		const auto link = readLink(std::cin);
		links[link.second] = link;
		joined[link.first] = joined[link.second] = true;
	}

	MultibodySystem system;
	SimbodyMatterSubsystem matter(system);
	GeneralForceSubsystem forces(system);
	ContactTrackerSubsystem tracker(system);
	CompliantContactSubsystem contacts(system, tracker);
	contacts.setTransitionVelocity(transition);
	Force::Gravity(forces, matter, Vec3(0, 0, -gravity));
	const ContactMaterial material(stiffness, restitution == 1 ? 0 : dissipation, friction, friction);
	const Rotation down(Pi / 2, YAxis); // a half space fills its positive x
	const double omega = 2 * Pi * frequency;
	for (auto& member : members) {
		const Vec3 half = member.extents / 2;
		const Transform top(down, Vec3(0, 0, half[2]));
		if (member.kind == "fixed") {
			member.body = matter.updGround();
			if (!joined[member.name]) member.body.updBody().addContactSurface(member.pose * top, ContactSurface(ContactGeometry::HalfSpace(), material));
			continue;
		}
		const double mass = member.mass ? member.mass : 1;
		Body::Rigid body(MassProperties(mass, Vec3(0), mass * UnitInertia::brick(half)));
		if (member.kind == "shaken") {
			body.addContactSurface(top, ContactSurface(ContactGeometry::HalfSpace(), material));
			member.body = MobilizedBody::Slider(matter.updGround(), member.pose, body, Transform());
			Motion::Sinusoid(member.body, Motion::Position, -peak / (omega * omega), omega, 0);
			continue;
		}
		if (!joined[member.name]) body.addContactSurface(Transform(), ContactSurface(ContactGeometry::Brick(half), material));
		const auto link = links.find(member.name);
		member.body = mobilized(member, body, link == links.end() ? nullptr : &link->second, named, forces, matter.updGround());
	}
	State state = system.realizeTopology();
	system.realizeModel(state);
	for (auto& member : members) {
		if (member.kind != "free") continue;
		if (!links.count(member.name)) member.body.setQToFitTransform(state, member.pose);
		else if (links[member.name].kind != "spring") continue;
		system.realize(state, Stage::Position);
		member.body.setUToFitVelocity(state, SpatialVec(member.spin, member.velocity));
	}
	RungeKuttaMersonIntegrator integrator(system);
	integrator.setMaximumStepSize(dt);
	integrator.setAccuracy(accuracy);
	TimeStepper stepper(system, integrator);
	stepper.initialize(state);
	for (long k = 0; k <= steps; ++k) {
		if (k % every && k != steps) continue;
		if (k) stepper.stepTo(k * dt);
		const auto& now = integrator.getState();
		system.realize(now, Stage::Dynamics);
		double force = 0;
		for (int i = 0; i < contacts.getNumContactForces(now); ++i)
			force += std::abs(contacts.getContactForce(now, i).getForceOnSurface2()[1][2]);
		std::printf("%.12g %.9g", k * dt, force);
		for (const auto& member : members) {
			const bool fixed = member.kind == "fixed";
			const Transform pose = fixed ? member.pose : member.body.getBodyTransform(now);
			const auto q = pose.R().convertRotationToQuaternion();
			const SpatialVec speed = fixed ? SpatialVec(Vec3(0), Vec3(0)) : member.body.getBodyVelocity(now);
			std::printf(" %.12g %.12g %.12g %.12g %.12g %.12g %.12g", pose.p()[0], pose.p()[1], pose.p()[2], q[0], q[1], q[2], q[3]);
			std::printf(" %.12g %.12g %.12g %.12g %.12g %.12g", speed[1][0], speed[1][1], speed[1][2], speed[0][0], speed[0][1], speed[0][2]);
		}
		std::printf("\n");
	}
}
