// SPDX-License-Identifier: GPL-2.0-or-later
#include <JointEngine.hpp>
#include <validation.hpp>
#include <kernel/threads.hpp>
#include <set>

namespace yade {

YADE_PLUGIN((JointBreak)(JointEngine));

namespace {
	template <class T> boost::python::list listOf(const vector<shared_ptr<T>>& objects)
	{
		boost::python::list list;
		for (const shared_ptr<T>& object : objects)
			list.append(object);
		return list;
	}

	/// Calls visit(joint, spring, force of the spring, states of the bodies) for each unbroken spring between
	/// bodies of a scene.
	template <class Visit>
	void visitSprings(const vector<shared_ptr<TimberJoint>>& joints, const Scene& scene, Visit visit)
	{
		for (const shared_ptr<TimberJoint>& j : joints) {
			const Body *b1 = bodyAt(scene, j->id1), *b2 = bodyAt(scene, j->id2);
			if (!b1 || !b2 || j->isBroken()) continue;
			const vector<Vector3r> forces = j->springForces();
			for (size_t k = 0; k < j->broken.size(); ++k)
				if (!j->broken[k]) visit(*j, k, forces[k], *b1->state, *b2->state);
		}
	}

	constexpr Real samePoint = 1e-4; ///< distance below which two anchors are the same [m]

	bool haveSameAnchors(const vector<Vector3r>& a, const vector<Vector3r>& b)
	{
		return std::equal(a.begin(), a.end(), b.begin(), b.end(),
		        [](const Vector3r& x, const Vector3r& y) { return (x - y).norm() < samePoint; });
	}

	bool haveSameBodies(const TimberJoint& a, const TimberJoint& b)
	{
		if (a.id1 == b.id1 && a.id2 == b.id2)
			return haveSameAnchors(a.anchors1, b.anchors1) && haveSameAnchors(a.anchors2, b.anchors2);
		return a.id1 == b.id2 && a.id2 == b.id1 && haveSameAnchors(a.anchors1, b.anchors2)
		        && haveSameAnchors(a.anchors2, b.anchors1);
	}

	bool haveSameLaw(const TimberJoint& a, const TimberJoint& b)
	{
		return a.kn == b.kn && a.ks == b.ks && a.strength == b.strength && a.perJoint == b.perJoint
		        && a.law == b.law && a.dampingRatio == b.dampingRatio
		        && (!a.yields()
		                || (a.softeningStretch == b.softeningStretch && a.ultimateStretch == b.ultimateStretch
		                        && a.frictionShare == b.frictionShare));
	}
}

int JointEngine::append(const shared_ptr<TimberJoint>& joint)
{
	if (!joint || joint->anchors1.empty() || joint->anchors2.empty())
		throw std::invalid_argument("JointEngine.append: joint: it must be a TimberJoint with anchors1 and "
		                            "anchors2");
	joint->validate();
	joints.push_back(joint);
	return int(joints.size()) - 1;
}

bool JointEngine::hasSame(const TimberJoint& joint) const
{
	return std::any_of(joints.begin(), joints.end(), [&](const shared_ptr<TimberJoint>& other) {
		return !other->isBroken() && haveSameLaw(joint, *other) && haveSameBodies(joint, *other);
	});
}

void JointEngine::breakJointsOf(Body::id_t id)
{
	for (const shared_ptr<TimberJoint>& joint : joints)
		if (joint->id1 == id || joint->id2 == id) joint->breakAll();
}

boost::python::list JointEngine::pyJoints() const { return listOf(joints); }
boost::python::list JointEngine::pyBreaks() const { return listOf(breaks); }

bool JointEngine::hasBody(Body::id_t id) const { return id >= 0 && size_t(id) < bodies.size() && bodies[id].exists; }

void JointEngine::collectBodies()
{
	bodies.resize(scene->bodies->size());
	for (size_t id = 0; id < bodies.size(); ++id) {
		const shared_ptr<Body>& b = (*scene->bodies)[id];
		const bool isSame = !bodies[id].body.owner_before(b) && !b.owner_before(bodies[id].body);
		bodies[id].isOther = bodies[id].exists && b && !isSame;
		bodies[id].exists = bool(b);
		if (!isSame) bodies[id].body = b;
		if (!b) continue;
		bodies[id].axes = b->state->ori.toRotationMatrix();
		bodies[id].position = b->state->pos;
	}
}

/// Breaks joints of a body that was erased and whose id has gone to another one.
void JointEngine::breakReplaced()
{
	if (std::none_of(bodies.begin(), bodies.end(), [](const Placement& p) { return p.isOther; })) return;
	for (size_t k = 0; k < jointForces.size(); ++k) // the joints of the step before
		for (const Body::id_t id : { joints[k]->id1, joints[k]->id2 })
			if (hasBody(id) && bodies[id].isOther) joints[k]->breakAll();
}

void JointEngine::checkJoints() const
{
	std::set<const TimberJoint*> visited, ofOthers;
	for (const shared_ptr<Engine>& e : scene->engines)
		if (const auto* other = dynamic_cast<const JointEngine*>(e.get()); other && other != this)
			for (const shared_ptr<TimberJoint>& joint : other->joints)
				ofOthers.insert(joint.get());
	const auto refuse = [](size_t k, const string& fault) {
		stopRun("JointEngine.joints[" + std::to_string(k) + "]: " + fault);
	};
	const auto isId = [this](Body::id_t id) { return id >= 0 && size_t(id) < scene->bodies->size(); };
	for (size_t k = 0; k < joints.size(); ++k) {
		const TimberJoint& joint = *joints[k];
		if (!visited.insert(&joint).second) refuse(k, "the same joint is in the list before");
		if (ofOthers.count(&joint)) refuse(k, "the same joint is in another JointEngine of O.engines");
		if (!isId(joint.id1) || !isId(joint.id2) || joint.id1 == joint.id2)
			refuse(k,
			        "id1 = " + std::to_string(joint.id1) + ", id2 = " + std::to_string(joint.id2)
			                + ": they must be ids of two bodies");
	}
}

/// Packs the joints again if there are others, or if attributes have changed.
void JointEngine::packJoints()
{
	if (areJointsCurrent()) return;
	checkJoints();
	packed.reset(new timber::PackedJoints);
	for (const shared_ptr<TimberJoint>& joint : joints)
		joint->pack(packed);
	packed->isCurrent = true;
}

void JointEngine::computeForce(size_t index)
{
	const timber::PackedJoint& joint = packed->joints[index];
	timber::JointForce& total = jointForces[index];
	if (joint.isActive && !(hasBody(joint.bodyA) && hasBody(joint.bodyB))) joints[index]->breakAll();
	if (!joint.isActive || joint.isStiff) total = {};
	else {
		const timber::JointForce before = total;
		if (joint.yields) total = joints[index]->yield(placement(joint));
		else
			timber::springForces(joint.stiffness, placement(joint), joint.normal, packed->first(joint),
			        packed->end(joint), total);
		if (before.isKnown) errors[index] = createdBetween(joint, before, total);
	}
}

/// Energy beyond the work of the forces before and after the last motion, where the law is not linear. [J]
Real JointEngine::createdBetween(
        const timber::PackedJoint& joint, const timber::JointForce& before, const timber::JointForce& now) const
{
	const timber::BodyKinematics a = kinematics(*bodyAt(*scene, joint.bodyA)->state),
	                             b = kinematics(*bodyAt(*scene, joint.bodyB)->state);
	return now.energy + now.dissipated - before.energy + scene->dt / 2 * (before.power(a, b) + now.power(a, b));
}

void JointEngine::computeForces()
{
	jointForces.resize(joints.size());
	errors.assign(joints.size(), 0);
	timber::forAll(int(joints.size()), [this](int k) { computeForce(k); });
}

void JointEngine::handOver(size_t joint)
{
	elastic -= lastForce(joint).energy;
	setForce(joint, {});
}

void JointEngine::breakSpring(size_t joint, const timber::SpringBreak& event)
{
	static const char* const names[] = { "tension", "compression", "shear" };
	const shared_ptr<JointBreak> entry(new JointBreak);
	entry->time = scene->time;
	entry->joint = int(joint);
	entry->spring = int(event.spring);
	entry->cause = names[int(event.cause)];
	entry->force = event.force;
	breaks.push_back(entry);
	released += event.energy;
	joints[joint]->breakSpring(event.spring);
}

/// Breaks the overloaded springs of a joint and computes the forces of the others again.
void JointEngine::breakSprings(size_t index)
{
	TimberJoint& joint = *joints[index];
	const State &s1 = *Body::byId(joint.id1, scene)->state, &s2 = *Body::byId(joint.id2, scene)->state;
	const timber::JointMotion motion { kinematics(s1), kinematics(s2), scene->dt };
	for (const timber::SpringBreak& event : timber::springBreaks(joint.stiffness(), joint.jointStrength(),
	             placement(packed->joints[index]), joint.normal, joint.springs(), motion))
		breakSpring(index, event);
	computeForce(index);
}

/// Breaks the springs of a joint that have reached their ultimate stretch; they have no force any more.
void JointEngine::breakYielded(size_t index)
{
	TimberJoint& joint = *joints[index];
	for (const timber::SpringBreak& event : joint.spentSprings(bodies[joint.id1].axes))
		breakSpring(index, event);
}

/// Breaks and sums in the order of the joints: results do not depend on the number of threads.
void JointEngine::breakAndSum()
{
	elastic = 0;
	sums.clear(bodies.size());
	for (size_t k = 0; k < joints.size(); ++k) {
		const timber::PackedJoint& joint = packed->joints[k];
		if (!joint.isActive || joint.isStiff) continue;
		if (joint.yields) breakYielded(k);
		else if (timber::isOverloaded(joint.strength, jointForces[k])) breakSprings(k);
		const timber::JointForce& total = jointForces[k];
		yielded += total.dissipated;
		created += errors[k];
		if (total.energy == 0) continue; // all springs broken or unstretched
		elastic += total.energy;
		sums.add(joint.bodyA, total.force, total.torqueA);
		sums.add(joint.bodyB, -total.force, total.torqueB);
	}
}

Real JointEngine::elasticPower(const Scene& current) const
{
	Real power = 0;
	visitSprings(joints, current,
	        [&](const TimberJoint& j, size_t k, const Vector3r& force, const State& s1, const State& s2) {
		        if (j.isStiff()) return;
		        const Vector3r end = s2.pos + s2.ori * j.anchors2[k];
		        power += force.dot(timber::relativeVelocity<double>(
		                end - s1.pos, end - s2.pos, s1.vel, s1.angVel, s2.vel, s2.angVel));
	        });
	return power;
}

void JointEngine::addSprings(const Scene& current, std::vector<timber::PointSpring>& springs) const
{
	visitSprings(joints, current,
	        [&](const TimberJoint& j, size_t k, const Vector3r& force, const State& s1, const State& s2) {
		        const timber::JointStiffness stiffness = j.stiffness();
		        const Vector3r x = s1.pos + s1.ori * j.anchors1[k];
		        springs.push_back({ j.id1, j.id2, x - s1.pos, x - s2.pos, s1.ori * j.normal, stiffness.normal,
		                stiffness.shear, -force });
	        });
}

void JointEngine::action()
{
	packJoints();
	collectBodies();
	breakReplaced();
	computeForces();
	breakAndSum();
	sums.handOver(*scene);
}

} // namespace yade
