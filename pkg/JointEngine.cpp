// SPDX-License-Identifier: GPL-2.0-or-later
#include <JointEngine.hpp>

namespace yade {

YADE_PLUGIN((TimberJoint)(JointBreak)(JointEngine));

namespace {
	/// Velocity of a spring's end on body 2 as seen from body 1, with which the spring's normal turns. [m/s]
	Vector3r partingVelocity(const State& s1, const State& s2, const Vector3r& end2)
	{
		return s2.vel + s2.angVel.cross(end2 - s2.pos) - s1.vel - s1.angVel.cross(end2 - s1.pos);
	}
}

void TimberJoint::postLoad(TimberJoint&)
{
	if (anchors1.empty()) return;
	if (anchors2.empty()) return; // attributes are set one after the other
	if (anchors1.size() != anchors2.size()) throw std::invalid_argument("TimberJoint: anchors1 and anchors2 must have the same length");
	if (broken.empty()) broken.resize(anchors1.size(), 0);
	if (broken.size() != anchors1.size()) throw std::invalid_argument("TimberJoint.broken must have one entry for each spring");
	if (!(kn > 0 && ks > 0 && strength > 0)) throw std::invalid_argument("TimberJoint: kn, ks and strength must be > 0 (the strength may be infinite)");
	forces.resize(anchors1.size(), Vector3r::Zero());
	stretches.resize(anchors1.size(), 0);
}

timber::SpringForce TimberJoint::spring(size_t k, const State& s1, const State& s2, Vector3r& end1, Vector3r& end2) const
{
	const Real share = perJoint ? Real(1) / anchors1.size() : 1;
	end1             = s1.pos + s1.ori * anchors1[k];
	end2             = s2.pos + s2.ori * anchors2[k];
	return timber::springForce({ share * kn, share * ks }, end2 - end1, s1.ori * normal);
}

boost::python::list TimberJoint::pySprings() const
{
	boost::python::list all;
	for (size_t k = 0; k < broken.size(); ++k) {
		boost::python::dict one;
		one["force"]   = Vector3r(forces[k]);
		one["stretch"] = stretches[k];
		one["broken"]  = bool(broken[k]);
		all.append(one);
	}
	return all;
}

int JointEngine::append(const shared_ptr<TimberJoint>& joint)
{
	joints.push_back(joint);
	return int(joints.size()) - 1;
}

boost::python::list JointEngine::pyJoints() const
{
	boost::python::list all;
	for (const auto& j : joints)
		all.append(j);
	return all;
}

boost::python::list JointEngine::pyBreaks() const
{
	boost::python::list all;
	for (const auto& b : breaks)
		all.append(b);
	return all;
}

void JointEngine::breakSpring(size_t joint, const Acting& broken, const State& s1, const State& s2)
{
	static const char* const     names[] = { "tension", "compression", "shear" };
	const timber::SpringForce&   f       = broken.force;
	const size_t                 spring  = broken.spring;
	const shared_ptr<JointBreak> entry(new JointBreak);
	entry->time   = scene->time;
	entry->joint  = int(joint);
	entry->spring = int(spring);
	entry->cause  = names[int(timber::breakCause(f))];
	entry->force  = f.force.norm();
	breaks.push_back(entry);
	released += f.energy - scene->dt / 2 * f.force.dot(partingVelocity(s1, s2, broken.end2));
	joints[joint]->broken[spring]    = 1;
	joints[joint]->forces[spring]    = Vector3r::Zero();
	joints[joint]->stretches[spring] = 0;
}

void JointEngine::act(size_t index)
{
	TimberJoint& joint = *joints[index];
	const shared_ptr<Body>&b1 = Body::byId(joint.id1, scene), &b2 = Body::byId(joint.id2, scene);
	if (!b1 || !b2) { // taken out of the scene, and its joints with it
		joint.broken.assign(joint.broken.size(), 1);
		return;
	}
	const State &s1 = *b1->state, &s2 = *b2->state;
	Real         sum = 0;
	acting.clear();
	for (size_t k = 0; k < joint.broken.size(); ++k) {
		if (joint.broken[k]) continue;
		acting.push_back({ k, {}, {}, {} });
		acting.back().force = joint.spring(k, s1, s2, acting.back().end1, acting.back().end2);
		sum += acting.back().force.force.norm();
	}
	Vector3r force = Vector3r::Zero(), torque1 = Vector3r::Zero(), torque2 = Vector3r::Zero();
	for (const Acting& s : acting) {
		const Vector3r f = s.force.force;
		if ((joint.perJoint ? sum : f.norm()) > joint.strength) {
			breakSpring(index, s, s1, s2);
			continue;
		}
		joint.forces[s.spring]    = f;
		joint.stretches[s.spring] = (s.end2 - s.end1).norm();
		elastic += s.force.energy;
		force += f;
		torque1 += (s.end2 - s1.pos).cross(f); // unequal stiffnesses: the force leaves the line of the ends, both bodies take it in one point
		torque2 -= (s.end2 - s2.pos).cross(f);
	}
	scene->forces.addForce(joint.id1, force);
	scene->forces.addTorque(joint.id1, torque1);
	scene->forces.addForce(joint.id2, -force);
	scene->forces.addTorque(joint.id2, torque2);
}

Real JointEngine::elasticPower() const
{
	Real power = 0;
	for (const shared_ptr<TimberJoint>& j : joints) {
		const shared_ptr<Body>&b1 = Body::byId(j->id1, scene), &b2 = Body::byId(j->id2, scene);
		for (size_t k = 0; b1 && b2 && k < j->broken.size(); ++k)
			if (!j->broken[k]) power += j->forces[k].dot(partingVelocity(*b1->state, *b2->state, b2->state->pos + b2->state->ori * j->anchors2[k]));
	}
	return power;
}

void JointEngine::action()
{
	elastic = 0;
	for (size_t k = 0; k < joints.size(); ++k)
		if (!joints[k]->isFinished()) act(k);
}

} // namespace yade
