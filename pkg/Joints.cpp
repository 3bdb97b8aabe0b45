// SPDX-License-Identifier: GPL-2.0-or-later
#include <Joints.hpp>
#include <kernel/threads.hpp>

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
	if (broken.empty()) broken.resize(anchors1.size(), 0);
	if (anchors1.size() != anchors2.size() || broken.size() != anchors1.size()) {
		anchors1.clear(); // what is refused has been set already: a joint that does not fit together holds nothing
		anchors2.clear();
		broken.clear();
		throw std::invalid_argument("TimberJoint: anchors1, anchors2 and broken must have the same length");
	}
	if (!(kn > 0 && ks > 0 && strength > 0)) throw std::invalid_argument("TimberJoint: kn, ks and strength must be > 0 (the strength may be infinite)");
	forces.resize(anchors1.size(), Vector3r::Zero());
	stretches.resize(anchors1.size(), Vector3r::Zero());
	for (size_t k = 0; k < broken.size(); ++k)
		if (broken[k]) forces[k] = stretches[k] = Vector3r::Zero();
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
	if (joint->anchors1.empty() || joint->anchors1.size() != joint->anchors2.size()) throw std::invalid_argument("JointEngine.append: a joint needs anchors1 and anchors2");
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
	const auto                   f = timber::springForce<double>(joint.stiffness(), way, axes[joint.id1] * joint.normal);
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
timber::JointPull JointEngine::pullOf(TimberJoint& joint) const
{
	const Body *b1 = bodyAt(*scene, joint.id1), *b2 = bodyAt(*scene, joint.id2);
	if (!b1 || !b2) { // taken out of the scene, and its joints with it
		joint.broken.assign(joint.broken.size(), 1);
		joint.forces.assign(joint.broken.size(), Vector3r::Zero());
		joint.stretches.assign(joint.broken.size(), Vector3r::Zero());
		return {};
	}
	const timber::JointPlacement place { axes[joint.id1], axes[joint.id2], b2->state->pos - b1->state->pos };
	return timber::pullSprings(joint.stiffness(), place, joint.normal, joint.anchors1, joint.anchors2, joint.broken, joint.stretches, joint.forces);
}

bool JointEngine::isOverloaded(size_t index) const
{
	const TimberJoint& joint = *joints[index];
	return joint.perJoint ? pulls[index].sum > joint.strength : pulls[index].largest > joint.strength * joint.strength;
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
	pulls.assign(count, timber::JointPull());
	timber::forAll(count, [this](int k) {
		if (!joints[k]->isFinished()) pulls[k] = pullOf(*joints[k]);
	});
}

/// Breaks and sums in the order of the joints, so that threads change nothing.
void JointEngine::sumPulls()
{
	elastic = 0;
	sums.clear(axes.size());
	for (size_t k = 0; k < joints.size(); ++k) {
		if (isOverloaded(k)) breakSprings(k);
		const timber::JointPull& pull = pulls[k];
		if (pull.energy == 0) continue; // finished, or not stretched at all
		const TimberJoint& joint = *joints[k];
		elastic += pull.energy;
		sums.add(joint.id1, pull.force, pull.torqueA);
		sums.add(joint.id2, -pull.force, pull.torqueB);
	}
}

Real JointEngine::elasticPower(const Scene& of) const
{
	Real power = 0;
	for (const shared_ptr<TimberJoint>& j : joints) {
		const Body *b1 = bodyAt(of, j->id1), *b2 = bodyAt(of, j->id2);
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
