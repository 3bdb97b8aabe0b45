// SPDX-License-Identifier: GPL-2.0-or-later
#include <Joints.hpp>
#include <kernel/threads.hpp>
#include <validation.hpp>

namespace yade {

YADE_PLUGIN((TimberJoint)(JointBreak)(JointEngine));

namespace {
	timber::BodyKinematics kinematics(const State& s) { return { s.pos, s.vel, s.angVel }; }

	/// Stiffness and strength may be missing (NaN) as long as a joint has no springs: attributes are set one after the other.
	void requireGiven(bool hasSprings, const char* attribute, Real value, bool mayBeInfinite)
	{
		if (!hasSprings && std::isnan(value)) return;
		require(value > 0 && (mayBeInfinite || std::isfinite(value)), attribute, value, mayBeInfinite ? "> 0" : "finite and > 0");
	}

	void requireAnchors(const char* attribute, const vector<Vector3r>& anchors)
	{
		for (const Vector3r& x : anchors)
			require(x.allFinite(), attribute, x.transpose(), "finite");
	}
}

void TimberJoint::validate() const
{
	const bool hasSprings = !anchors1.empty() && !anchors2.empty();
	requireGiven(hasSprings, "TimberJoint.kn", kn, false);
	if (hasSprings || !std::isnan(ks)) requireNonNegative("TimberJoint.ks", ks);
	requireGiven(hasSprings, "TimberJoint.strength", strength, true);
	require(dampingRatio >= 0 && dampingRatio <= 1, "TimberJoint.dampingRatio", dampingRatio, "between 0 and 1");
	require(math::abs(normal.squaredNorm() - 1) < 1e-9, "TimberJoint.normal", normal.transpose(), "of length 1");
	requireAnchors("TimberJoint.anchors1", anchors1);
	requireAnchors("TimberJoint.anchors2", anchors2);
	validateLaw();
	if (!hasSprings && broken.empty()) return; // not complete yet
	require(anchors1.size() == anchors2.size(), "number of TimberJoint.anchors2", anchors2.size(), "that of anchors1");
	require(broken.empty() || broken.size() == anchors1.size(), "number of TimberJoint.broken", broken.size(), "that of anchors1");
}

void TimberJoint::validateLaw() const
{
	require(law == "brittle" || yields(), "TimberJoint.law", law, "brittle or slip");
	require(frictionShare >= 0 && frictionShare <= 1, "TimberJoint.frictionShare", frictionShare, "in [0, 1]");
	require(softeningStretch > 0, "TimberJoint.softeningStretch", softeningStretch, "> 0");
	require(ultimateStretch > 0, "TimberJoint.ultimateStretch", ultimateStretch, "> 0");
	if (!yields() || std::isnan(kn)) return;
	require(kn == ks || ks == 0, "TimberJoint.ks", ks, "equal to kn, or 0, with the law slip");
	require(softeningStretch > strength / kn && std::isfinite(softeningStretch), "TimberJoint.softeningStretch", softeningStretch,
	        "finite and > strength / kn with the law slip");
	require(ultimateStretch > softeningStretch && std::isfinite(ultimateStretch), "TimberJoint.ultimateStretch", ultimateStretch,
	        "finite and > softeningStretch with the law slip");
}

void TimberJoint::postLoad(TimberJoint&)
{
	isSlip = law == "slip";
	validate();
	if (anchors1.empty() || anchors2.empty()) return;
	broken.resize(anchors1.size(), 0);
	forces.resize(anchors1.size(), Vector3r::Zero());
	stretches.resize(anchors1.size(), Vector3r::Zero());
	if (yields()) {
		plasticStretches.resize(anchors1.size(), Vector3r::Zero());
		largestStretches.resize(anchors1.size(), 0);
	}
	for (size_t k = 0; k < broken.size(); ++k)
		if (broken[k]) breakSpring(k);
}

void TimberJoint::breakSpring(size_t spring)
{
	broken[spring] = 1;
	forces[spring] = stretches[spring] = Vector3r::Zero();
}

void TimberJoint::breakAll()
{
	for (size_t k = 0; k < broken.size(); ++k)
		breakSpring(k);
}

timber::JointStiffness TimberJoint::stiffness() const
{
	const Real share = perJoint ? Real(1) / anchors1.size() : 1;
	return { share * kn, share * ks };
}

timber::SlipLaw TimberJoint::slipLaw() const
{
	const Real share = perJoint ? Real(1) / anchors1.size() : 1;
	return { share * kn, share * strength, frictionShare, softeningStretch, ultimateStretch };
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
		one["force"] = Vector3r(forces[k]);
		one["stretch"] = stretches[k].norm();
		one["broken"] = bool(broken[k]);
		all.append(one);
	}
	return all;
}

int JointEngine::append(const shared_ptr<TimberJoint>& joint)
{
	if (!joint || joint->anchors1.empty() || joint->anchors2.empty())
		throw std::invalid_argument("JointEngine.append: joint: it must be a TimberJoint with anchors1 and anchors2");
	joint->validate();
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

timber::JointForce JointEngine::forceOf(TimberJoint& joint) const
{
	const Body *b1 = bodyAt(*scene, joint.id1), *b2 = bodyAt(*scene, joint.id2);
	if (!b1 || !b2) {
		joint.breakAll(); // a body was erased
		return {};
	}
	const timber::JointPlacement placed = placement(joint, *b1->state, *b2->state);
	if (joint.yields()) return timber::slipForces(joint.slipLaw(), placed, joint.slipAxis(), joint.springs(), joint.slipHistories());
	return timber::springForces(joint.stiffness(), placed, joint.normal, joint.springs());
}

void JointEngine::computeForces()
{
	const int count = int(joints.size());
	jointForces.assign(count, timber::JointForce());
	timber::forAll(count, [this](int k) {
		if (!joints[k]->isBroken()) jointForces[k] = forceOf(*joints[k]);
	});
}

/// Breaks a spring and logs it.
void JointEngine::breakSpring(size_t joint, const timber::SpringBreak& found)
{
	static const char* const names[] = { "tension", "compression", "shear" };
	const shared_ptr<JointBreak> entry(new JointBreak);
	entry->time = scene->time;
	entry->joint = int(joint);
	entry->spring = int(found.spring);
	entry->cause = names[int(found.cause)];
	entry->force = found.force;
	breaks.push_back(entry);
	released += found.energy;
	joints[joint]->breakSpring(found.spring);
}

/// Breaks the overloaded springs of a joint and computes the forces of the others again.
void JointEngine::breakSprings(size_t index)
{
	TimberJoint& joint = *joints[index];
	const State &s1 = *Body::byId(joint.id1, scene)->state, &s2 = *Body::byId(joint.id2, scene)->state;
	const timber::JointMotion motion { kinematics(s1), kinematics(s2), scene->dt };
	for (const timber::SpringBreak& found :
	        timber::springBreaks(joint.stiffness(), joint.jointStrength(), placement(joint, s1, s2), joint.normal, joint.springs(), motion))
		breakSpring(index, found);
	jointForces[index] = forceOf(joint);
}

/// Breaks the springs of a joint that have reached their ultimate stretch; they have no force any more.
void JointEngine::breakYielded(size_t index)
{
	TimberJoint& joint = *joints[index];
	const Body *b1 = bodyAt(*scene, joint.id1), *b2 = bodyAt(*scene, joint.id2);
	if (!b1 || !b2) return;
	for (const timber::SpringBreak& found :
	        timber::slipBreaks(joint.slipLaw(), placement(joint, *b1->state, *b2->state), joint.normal, joint.springs(), joint.slipHistories()))
		breakSpring(index, found);
}

/// Breaks and sums in the order of the joints: results do not depend on the number of threads.
void JointEngine::breakAndSum()
{
	elastic = 0;
	sums.clear(axes.size());
	for (size_t k = 0; k < joints.size(); ++k) {
		const TimberJoint& joint = *joints[k];
		if (joint.yields()) breakYielded(k);
		else if (timber::isOverloaded(joint.jointStrength(), jointForces[k])) breakSprings(k);
		const timber::JointForce& total = jointForces[k];
		yielded += total.dissipated;
		if (total.energy == 0) continue; // all springs broken or unstretched
		elastic += total.energy;
		sums.add(joint.id1, total.force, total.torqueA);
		sums.add(joint.id2, -total.force, total.torqueB);
	}
}

Real JointEngine::elasticPower(const Scene& current) const
{
	Real power = 0;
	for (const shared_ptr<TimberJoint>& j : joints) {
		const Body *b1 = bodyAt(current, j->id1), *b2 = bodyAt(current, j->id2);
		for (size_t k = 0; b1 && b2 && k < j->broken.size(); ++k) {
			if (j->broken[k]) continue;
			const State &s1 = *b1->state, &s2 = *b2->state;
			const Vector3r end = s2.pos + s2.ori * j->anchors2[k];
			power += j->forces[k].dot(timber::relativeVelocity<double>(end - s1.pos, end - s2.pos, s1.vel, s1.angVel, s2.vel, s2.angVel));
		}
	}
	return power;
}

void JointEngine::addSprings(const Scene& current, std::vector<timber::PointSpring>& springs) const
{
	for (const shared_ptr<TimberJoint>& j : joints) {
		const Body *b1 = bodyAt(current, j->id1), *b2 = bodyAt(current, j->id2);
		const timber::JointStiffness stiffness = j->stiffness();
		for (size_t k = 0; b1 && b2 && k < j->broken.size(); ++k) {
			if (j->broken[k]) continue;
			const State &s1 = *b1->state, &s2 = *b2->state;
			const Vector3r x = s1.pos + s1.ori * j->anchors1[k];
			springs.push_back({ j->id1, j->id2, x - s1.pos, x - s2.pos, s1.ori * j->normal, stiffness.normal, stiffness.shear, -j->forces[k] });
		}
	}
}

void JointEngine::action()
{
	collectAxes();
	computeForces();
	breakAndSum();
	sums.handOver(*scene);
}

} // namespace yade
