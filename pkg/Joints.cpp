// SPDX-License-Identifier: GPL-2.0-or-later
#include <Joints.hpp>
#include <kernel/threads.hpp>
#include <validation.hpp>
#include <set>

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
	if (!envelope.empty()) return validateEnvelope();
	require(softeningStretch > strength / kn && std::isfinite(softeningStretch), "TimberJoint.softeningStretch", softeningStretch,
	        "finite and > strength / kn with the law slip");
	require(ultimateStretch > softeningStretch && std::isfinite(ultimateStretch), "TimberJoint.ultimateStretch", ultimateStretch,
	        "finite and > softeningStretch with the law slip");
}

void TimberJoint::validateEnvelope() const
{
	std::ostringstream points;
	Real largest = 0;
	for (const Vector2r& point : envelope) {
		points << (largest > 0 ? ", " : "") << point.x() << " " << point.y();
		largest = math::max(largest, point.y());
	}
	const char* const unmet = timber::SlipLaw::unmetBy(kn, envelopePoints(1));
	require(!unmet, "TimberJoint.envelope", points.str(), unmet ? unmet : "");
	require(math::abs(strength - largest) <= 1e-9 * largest, "TimberJoint.strength", strength, "the largest force of TimberJoint.envelope");
}

void TimberJoint::postLoad(TimberJoint&)
{
	readSprings(stretches, forces);
	if (packed) packed->isCurrent = false;
	packed.reset();
	isSlip = law == "slip";
	validate();
	const bool hasSprings = !anchors1.empty() && !anchors2.empty();
	if (hasSprings) broken.resize(anchors1.size(), 0);
	intact = size_t(std::count(broken.begin(), broken.end(), 0));
	if (!hasSprings) return;
	forces.resize(anchors1.size(), Vector3r::Zero());
	stretches.resize(anchors1.size(), Vector3r::Zero());
	if (yields()) {
		slip = { stiffness().normal, frictionShare, backbone() };
		plasticStretches.resize(anchors1.size(), Vector3r::Zero());
		largestStretches.resize(anchors1.size(), 0);
	}
	for (size_t k = 0; k < broken.size(); ++k)
		if (broken[k]) breakSpring(k);
}

void TimberJoint::breakSpring(size_t spring)
{
	const timber::JointSprings changed = springs();
	if (!broken[spring]) --intact;
	broken[spring] = 1;
	forces[spring] = stretches[spring] = Vector3r::Zero();
	if (packed) packed->set(index, changed);
}

void TimberJoint::breakAll()
{
	for (size_t k = 0; k < broken.size(); ++k)
		breakSpring(k);
}

void TimberJoint::pack(const shared_ptr<timber::PackedJoints>& to)
{
	const timber::JointSprings unpacked = springs();
	packed = to;
	index = packed->joints.size();
	if (!modes.haveAnchors(springGroup())) modes.state.springs = 0; // changed in the session
	packed->add({ id1, id2, yields(), stiffness(), jointStrength(), normal }, unpacked);
}

void TimberJoint::readSprings(vector<Vector3r>& stretched, vector<Vector3r>& pulling) const
{
	if (!packed || yields()) {
		stretched = stretches;
		pulling = forces;
		return;
	}
	stretched.resize(forces.size());
	pulling.resize(forces.size());
	timber::unpackSprings(packed->first(packed->joints[index]), stretched, pulling);
}

timber::JointSprings TimberJoint::springs()
{
	readSprings(stretches, forces);
	return { anchors1, anchors2, broken, stretches, forces };
}

vector<Vector3r> TimberJoint::springForces() const
{
	vector<Vector3r> stretched, pulling;
	readSprings(stretched, pulling);
	return pulling;
}

vector<Vector3r> TimberJoint::springStretches() const
{
	vector<Vector3r> stretched, pulling;
	readSprings(stretched, pulling);
	return stretched;
}

timber::JointStiffness TimberJoint::stiffness() const
{
	const Real share = perJoint ? Real(1) / anchors1.size() : 1;
	return { share * kn, share * ks };
}

std::vector<timber::BackbonePoint> TimberJoint::envelopePoints(Real share) const
{
	std::vector<timber::BackbonePoint> points;
	for (const Vector2r& point : envelope)
		points.push_back({ point.x(), share * point.y() });
	return points;
}

std::vector<timber::BackbonePoint> TimberJoint::backbone() const
{
	const Real share = perJoint ? Real(1) / anchors1.size() : 1;
	if (!envelope.empty()) return envelopePoints(share);
	return { { strength / kn, share * strength }, { softeningStretch, share * strength }, { ultimateStretch, 0 } };
}

Real TimberJoint::loadOf(const timber::JointForce& total) const { return (perJoint ? total.sum : math::sqrt(total.largestSquared)) / strength; }

Real TimberJoint::load() const
{
	timber::JointForce total;
	for (const Vector3r& f : springForces()) {
		total.sum += f.norm();
		total.largestSquared = math::max(total.largestSquared, Real(f.squaredNorm()));
	}
	return loadOf(total);
}

boost::python::list TimberJoint::pySprings() const
{
	const vector<Vector3r> pulling = springForces(), stretched = springStretches();
	boost::python::list all;
	for (size_t k = 0; k < broken.size(); ++k) {
		boost::python::dict one;
		one["force"] = Vector3r(pulling[k]);
		one["stretch"] = stretched[k].norm();
		one["broken"] = bool(broken[k]);
		all.append(one);
	}
	return all;
}

boost::python::dict TimberJoint::pyDictCustom() const
{
	boost::python::dict all;
	all["forces"] = springForces();
	all["stretches"] = springStretches();
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

bool JointEngine::hasBody(Body::id_t id) const { return id >= 0 && size_t(id) < bodies.size() && bodies[id].exists; }

void JointEngine::collectBodies()
{
	bodies.resize(scene->bodies->size());
	for (size_t id = 0; id < bodies.size(); ++id) {
		const Body* b = (*scene->bodies)[id].get();
		bodies[id].exists = b;
		if (!b) continue;
		bodies[id].axes = b->state->ori.toRotationMatrix();
		bodies[id].position = b->state->pos;
	}
}

void JointEngine::checkJoints() const
{
	std::set<const TimberJoint*> known;
	const auto refuse = [](size_t k, const string& fault) { throw std::runtime_error("JointEngine.joints[" + std::to_string(k) + "]: " + fault); };
	const auto isId = [this](Body::id_t id) { return id >= 0 && size_t(id) < scene->bodies->size(); };
	for (size_t k = 0; k < joints.size(); ++k) {
		const TimberJoint& joint = *joints[k];
		if (!known.insert(&joint).second) refuse(k, "the same joint is in the list before");
		if (!isId(joint.id1) || !isId(joint.id2) || joint.id1 == joint.id2)
			refuse(k, "id1 = " + std::to_string(joint.id1) + ", id2 = " + std::to_string(joint.id2) + ": they must be ids of two bodies");
	}
}

/// Packs the joints again if there are others, or if attributes have changed.
void JointEngine::packJoints()
{
	if (packed->isCurrent && packed->joints.size() == joints.size()) return;
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
	if (!joint.isActive) total = {};
	else if (joint.yields) {
		TimberJoint& j = *joints[index];
		total = timber::slipForces(j.slipLaw(), placement(joint), j.slipAxis(), j.springs(), j.slipHistories());
	} else timber::springForces(joint.stiffness, placement(joint), joint.normal, packed->first(joint), packed->end(joint), total);
}

void JointEngine::computeForces()
{
	jointForces.resize(joints.size());
	timber::forAll(int(joints.size()), [this](int k) { computeForce(k); });
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
	        timber::springBreaks(joint.stiffness(), joint.jointStrength(), placement(packed->joints[index]), joint.normal, joint.springs(), motion))
		breakSpring(index, found);
	computeForce(index);
}

/// Breaks the springs of a joint that have reached their ultimate stretch; they have no force any more.
void JointEngine::breakYielded(size_t index)
{
	TimberJoint& joint = *joints[index];
	for (const timber::SpringBreak& found :
	        timber::slipBreaks(joint.slipLaw(), placement(packed->joints[index]), joint.normal, joint.springs(), joint.slipHistories()))
		breakSpring(index, found);
}

/// Breaks and sums in the order of the joints: results do not depend on the number of threads.
void JointEngine::breakAndSum()
{
	elastic = 0;
	sums.clear(bodies.size());
	for (size_t k = 0; k < joints.size(); ++k) {
		const timber::PackedJoint& joint = packed->joints[k];
		if (!joint.isActive) continue;
		if (joint.yields) breakYielded(k);
		else if (timber::isOverloaded(joint.strength, jointForces[k])) breakSprings(k);
		const timber::JointForce& total = jointForces[k];
		yielded += total.dissipated;
		if (total.energy == 0) continue; // all springs broken or unstretched
		elastic += total.energy;
		sums.add(joint.bodyA, total.force, total.torqueA);
		sums.add(joint.bodyB, -total.force, total.torqueB);
	}
}

Real JointEngine::elasticPower(const Scene& current) const
{
	Real power = 0;
	vector<Vector3r> stretches, forces;
	for (const shared_ptr<TimberJoint>& j : joints) {
		const Body *b1 = bodyAt(current, j->id1), *b2 = bodyAt(current, j->id2);
		j->readSprings(stretches, forces);
		for (size_t k = 0; b1 && b2 && k < j->broken.size(); ++k) {
			if (j->broken[k]) continue;
			const State &s1 = *b1->state, &s2 = *b2->state;
			const Vector3r end = s2.pos + s2.ori * j->anchors2[k];
			power += forces[k].dot(timber::relativeVelocity<double>(end - s1.pos, end - s2.pos, s1.vel, s1.angVel, s2.vel, s2.angVel));
		}
	}
	return power;
}

void JointEngine::addSprings(const Scene& current, std::vector<timber::PointSpring>& springs) const
{
	for (const shared_ptr<TimberJoint>& j : joints) {
		const Body *b1 = bodyAt(current, j->id1), *b2 = bodyAt(current, j->id2);
		const timber::JointStiffness stiffness = j->stiffness();
		const vector<Vector3r> forces = j->springForces();
		for (size_t k = 0; b1 && b2 && k < j->broken.size(); ++k) {
			if (j->broken[k]) continue;
			const State &s1 = *b1->state, &s2 = *b2->state;
			const Vector3r x = s1.pos + s1.ori * j->anchors1[k];
			springs.push_back({ j->id1, j->id2, x - s1.pos, x - s2.pos, s1.ori * j->normal, stiffness.normal, stiffness.shear, -forces[k] });
		}
	}
}

void JointEngine::action()
{
	packJoints();
	collectBodies();
	computeForces();
	breakAndSum();
	sums.handOver(*scene);
}

} // namespace yade
