// SPDX-License-Identifier: GPL-2.0-or-later
#include <JointEngine.hpp>
#include <threads.hpp>

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
	stretches.resize(anchors1.size(), Vector3r::Zero());
}

timber::JointStiffness TimberJoint::stiffness() const
{
	const Real share = perJoint ? Real(1) / anchors1.size() : 1;
	return { share * kn, share * ks };
}

Real TimberJoint::load() const
{
	Real sum = 0, largest = 0;
	for (const Vector3r& f : forces) {
		sum += f.norm();
		largest = math::max(largest, Real(f.norm()));
	}
	return (perJoint ? sum : largest) / strength;
}

boost::python::list TimberJoint::pySprings() const
{
	boost::python::list all;
	for (size_t k = 0; k < broken.size(); ++k) {
		boost::python::dict one;
		one["force"]   = Vector3r(forces[k]);
		one["stretch"] = stretches[k].norm();
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

void JointEngine::collectAxes()
{
	axes.resize(scene->bodies->size());
	for (const shared_ptr<Body>& b : *scene->bodies)
		if (b) axes[b->getId()] = b->state->ori.toRotationMatrix();
}

void JointEngine::breakSpring(size_t index, size_t spring, const State& s1, const State& s2)
{
	static const char* const     names[] = { "tension", "compression", "shear" };
	TimberJoint&                 joint   = *joints[index];
	Vector3r &                   force = joint.forces[spring], &way = joint.stretches[spring];
	const timber::SpringForce    f = timber::springForce(joint.stiffness(), way, axes[joint.id1] * joint.normal);
	const shared_ptr<JointBreak> entry(new JointBreak);
	entry->time   = scene->time;
	entry->joint  = int(index);
	entry->spring = int(spring);
	entry->cause  = names[int(timber::breakCause(f))];
	entry->force  = force.norm();
	breaks.push_back(entry);
	const Vector3r end2 = s2.pos + axes[joint.id2] * joint.anchors2[spring];
	released += f.energy - scene->dt / 2 * force.dot(partingVelocity(s1, s2, end2));
	joint.broken[spring] = 1;
	force                = Vector3r::Zero();
	way                  = Vector3r::Zero();
}

/// Stretches the joint's springs to the bodies' placement.
JointEngine::Pull JointEngine::pullOf(TimberJoint& joint) const
{
	Pull pull;
	const Body *b1 = bodyAt(*scene, joint.id1), *b2 = bodyAt(*scene, joint.id2);
	if (!b1 || !b2) { // taken out of the scene, and its joints with it
		joint.broken.assign(joint.broken.size(), 1);
		joint.forces.assign(joint.broken.size(), Vector3r::Zero());
		joint.stretches.assign(joint.broken.size(), Vector3r::Zero());
		return pull;
	}
	const timber::JointStiffness stiffness = joint.stiffness();
	const Vector3r               normal = axes[joint.id1] * joint.normal, apart = b2->state->pos - b1->state->pos;
	Real                         sum = 0, largest = 0;
	for (size_t k = 0; k < joint.broken.size(); ++k) {
		if (joint.broken[k]) continue;
		const Vector3r arm2        = axes[joint.id2] * joint.anchors2[k];
		joint.stretches[k]         = apart + arm2 - axes[joint.id1] * joint.anchors1[k];
		const timber::SpringForce f = timber::springForce(stiffness, joint.stretches[k], normal);
		joint.forces[k]            = f.force;
		pull.energy += f.energy;
		pull.force += f.force;
		pull.torque1 += (apart + arm2).cross(f.force); // unequal stiffnesses: the force leaves the line of the ends, both bodies take it in one point
		pull.torque2 -= arm2.cross(f.force);
		largest = math::max(largest, f.force.squaredNorm());
		if (joint.perJoint) sum += f.force.norm();
	}
	pull.overloaded = joint.perJoint ? sum > joint.strength : largest > joint.strength * joint.strength;
	return pull;
}

/// Breaks what is overloaded; what is left pulls on.
void JointEngine::breakSprings(size_t index)
{
	TimberJoint& joint = *joints[index];
	const State &s1 = *Body::byId(joint.id1, scene)->state, &s2 = *Body::byId(joint.id2, scene)->state;
	for (size_t k = 0; k < joint.broken.size(); ++k)
		if (!joint.broken[k] && (joint.perJoint || joint.forces[k].squaredNorm() > joint.strength * joint.strength)) breakSpring(index, k, s1, s2);
	pulls[index] = pullOf(joint);
}

void JointEngine::stretchAll()
{
	const int count = int(joints.size());
	pulls.assign(count, Pull());
#pragma omp parallel for schedule(static) if (count > smallLoop)
	for (int k = 0; k < count; ++k)
		if (!joints[k]->isFinished()) pulls[k] = pullOf(*joints[k]);
}

/// Breaks and sums in the order of the joints, so that threads change nothing.
void JointEngine::sumPulls()
{
	elastic = 0;
	sums.clear(axes.size());
	for (size_t k = 0; k < joints.size(); ++k) {
		if (pulls[k].overloaded) breakSprings(k);
		const Pull& pull = pulls[k];
		if (pull.energy == 0) continue; // finished, or not stretched at all
		const TimberJoint& joint = *joints[k];
		elastic += pull.energy;
		sums.add(joint.id1, pull.force, pull.torque1);
		sums.add(joint.id2, -pull.force, pull.torque2);
	}
}

Real JointEngine::elasticPower() const
{
	Real power = 0;
	for (const shared_ptr<TimberJoint>& j : joints) {
		const Body *b1 = bodyAt(*scene, j->id1), *b2 = bodyAt(*scene, j->id2);
		for (size_t k = 0; b1 && b2 && k < j->broken.size(); ++k)
			if (!j->broken[k]) power += j->forces[k].dot(partingVelocity(*b1->state, *b2->state, b2->state->pos + b2->state->ori * j->anchors2[k]));
	}
	return power;
}

void JointEngine::action()
{
	collectAxes();
	stretchAll();
	sumPulls();
	sums.handOver(*scene);
}

} // namespace yade
