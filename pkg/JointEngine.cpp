// SPDX-License-Identifier: GPL-2.0-or-later
#include <JointEngine.hpp>
#include <Integrator.hpp>
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

	/// Calls visit(joint, its springs, index of the spring, states of the bodies) for each unbroken spring between
	/// bodies of a scene.
	template <class Visit> void visitSprings(timber::JointSet& set, const Scene& scene, Visit visit)
	{
		for (const timber::JointEntry& j : set.joints) {
			const Body *b1 = bodyAt(scene, j.bodyA), *b2 = bodyAt(scene, j.bodyB);
			const timber::JointSprings springs = set.springs(j);
			for (size_t k = 0; b1 && b2 && k < springs.count; ++k)
				if (springs.isIntact(k)) visit(j, springs, k, *b1->state, *b2->state);
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
	joint->validate(joint->areBroken().size());
	joint->moveTo(set);
	set->joints.back().total = {};
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
	for (timber::JointEntry& joint : set->joints)
		if (joint.bodyA == id || joint.bodyB == id) set->breakAll(joint);
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
		bodies[id].velocity = b->state->vel;
		bodies[id].spin = b->state->angVel;
	}
}

/// Breaks joints of a body that was erased and whose id has gone to another one.
void JointEngine::breakReplaced()
{
	if (std::none_of(bodies.begin(), bodies.end(), [](const Placement& p) { return p.isOther; })) return;
	for (size_t k = 0; k < math::min(computed, set->joints.size()); ++k)
		for (const Body::id_t id : { set->joints[k].bodyA, set->joints[k].bodyB })
			if (hasBody(id) && bodies[id].isOther) set->breakAll(set->joints[k]);
}

/// The states of stiff joints belong to the poses to which the solver has moved the bodies: joints of bodies moved by
/// hand enter it anew.
void JointEngine::softenMoved()
{
	const std::vector<bool> moved = movedByHand(*scene, false);
	if (moved.empty()) return;
	for (timber::JointEntry& joint : set->joints)
		for (const Body::id_t id : { joint.bodyA, joint.bodyB })
			if (hasBody(id) && moved[id]) joint.soften();
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

/// Takes the joints into a new set, also those that another engine has taken.
void JointEngine::takeJoints()
{
	set.reset(new timber::JointSet);
	for (const shared_ptr<TimberJoint>& joint : joints)
		joint->moveTo(set);
	set->findLines();
}

void JointEngine::computeForce(size_t index)
{
	timber::JointEntry& joint = set->joints[index];
	if (!joint.isBroken() && !(hasBody(joint.bodyA) && hasBody(joint.bodyB))) set->breakAll(joint);
	if (joint.isBroken() || joint.isStiff()) {
		joint.total = {};
		return;
	}
	const bool wasKnown = joint.total.isKnown;
	if (wasKnown) joint.created = halfWork(joint) - joint.total.energy;
	if (joint.yields())
		joint.total = yieldingForces(joint.springLaw(), placement(joint), joint.axis(), set->springs(joint));
	else springForces(joint.stiffness, placement(joint), joint.normal, set->springs(joint), joint.total);
	// Beyond the work of the forces before and after the last motion, where the law is not linear
	if (wasKnown) joint.created += joint.total.energy + joint.total.dissipated + halfWork(joint);
}

/// Work of the springs' forces on the bodies in half a step of the last motion. [J]
Real JointEngine::halfWork(const timber::JointEntry& joint) const
{
	return scene->dt / 2 * joint.total.power(motion(joint.bodyA), motion(joint.bodyB));
}

void JointEngine::computeForces()
{
	computed = set->joints.size();
	timber::forAll(int(computed), [this](int k) {
		set->joints[k].created = 0;
		computeForce(k);
	});
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
	set->breakSpring(set->joints[joint], event.spring);
}

/// Breaks the overloaded springs of a joint and computes the forces of the others again. Those that yield break at the
/// ultimate stretch, where they have no force any more.
void JointEngine::breakSprings(size_t index)
{
	timber::JointEntry& joint = set->joints[index];
	if (joint.yields()) {
		if (!joint.total.isSpent) return;
		for (const timber::SpringBreak& event : timber::spentSprings(joint.springLaw(), joint.stiffness,
		             bodies[joint.bodyA].axes, joint.normal, set->springs(joint)))
			breakSpring(index, event);
		return;
	}
	if (!timber::isOverloaded(joint.strength, joint.total)) return;
	const timber::JointMotion moving { motion(joint.bodyA), motion(joint.bodyB), scene->dt };
	for (const timber::SpringBreak& event : timber::springBreaks(
	             joint.stiffness, joint.strength, placement(joint), joint.normal, set->springs(joint), moving))
		breakSpring(index, event);
	computeForce(index);
}

/// Breaks and sums in the order of the joints: results do not depend on the number of threads.
void JointEngine::breakAndSum()
{
	elastic = 0;
	sums.clear(bodies.size());
	for (size_t k = 0; k < set->joints.size(); ++k) {
		const timber::JointEntry& joint = set->joints[k];
		if (joint.isBroken() || joint.isStiff()) continue;
		breakSprings(k);
		const timber::JointForce& total = joint.total;
		yielded += total.dissipated;
		created += joint.created;
		if (total.energy == 0) continue; // all springs broken or unstretched
		elastic += total.energy;
		sums.add(joint.bodyA, total.force, total.torqueA);
		sums.add(joint.bodyB, -total.force, total.torqueB);
	}
}

Real JointEngine::elasticPower(const Scene& current) const
{
	Real power = 0;
	visitSprings(
	        *set, current, [&](const auto& j, const auto& springs, size_t k, const State& s1, const State& s2) {
		        if (j.isStiff()) return;
		        const Vector3r end = s2.pos + s2.ori * springs.anchorB(k);
		        power += springs.force(k).dot(timber::relativeVelocity<double>(
		                end - s1.pos, end - s2.pos, s1.vel, s1.angVel, s2.vel, s2.angVel));
	        });
	return power;
}

void JointEngine::addSprings(const Scene& current, std::vector<timber::PointSpring>& added) const
{
	visitSprings(
	        *set, current, [&](const auto& j, const auto& springs, size_t k, const State& s1, const State& s2) {
		        const Vector3r x = s1.pos + s1.ori * springs.anchorA(k);
		        added.push_back({ j.bodyA, j.bodyB, x - s1.pos, x - s2.pos, s1.ori * j.normal,
		                j.stiffness.normal, j.stiffness.shear, -springs.force(k) });
	        });
}

void JointEngine::action()
{
	if (set->isChanged) {
		checkJoints();
		takeJoints();
		set->isChanged = false;
	}
	collectBodies();
	breakReplaced();
	softenMoved();
	computeForces();
	breakAndSum();
	sums.handOver(*scene);
}

} // namespace yade
