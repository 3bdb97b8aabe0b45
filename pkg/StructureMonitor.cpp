// SPDX-License-Identifier: GPL-2.0-or-later
#include <StructureMonitor.hpp>
#include <sampling.hpp>
#include <validation.hpp>

namespace yade {

YADE_PLUGIN((StructureMonitor));

namespace {
	void raise(Real& largest, Real value) { largest = math::max(largest, value); }
}

void StructureMonitor::validate() const
{
	requireNonNegative("StructureMonitor.interval", interval);
	requireNonNegative("StructureMonitor.jointInterval", jointInterval);
	for (int part : parts)
		require(part >= 0, "StructureMonitor.parts", part, ">= 0");
	const bool isComplete = !parts.empty() && !bodies.empty(); // attributes may be set one after the other
	require(!isComplete || parts.size() == bodies.size(), "StructureMonitor.parts: length", parts.size(),
	        "that of StructureMonitor.bodies; set both with updateAttrs()");
}

void StructureMonitor::recordMomenta()
{
	const size_t count = parts.empty() ? 0 : size_t(*std::max_element(parts.begin(), parts.end())) + 1;
	std::vector<Vector3r> momenta(count, Vector3r::Zero());
	for (size_t k = 0; k < math::min(bodies.size(), parts.size()); ++k)
		if (const Body* b = bodyAt(*scene, bodies[k])) momenta[parts[k]] += b->state->mass * b->state->vel;
	rows.push_back(scene->time);
	for (const Vector3r& p : momenta)
		rows.insert(rows.end(), { p.x(), p.y(), p.z() });
}

void StructureMonitor::recordJoint(const TimberJoint& joint, const timber::JointForce& total, size_t k)
{
	const Body *b1 = bodyAt(*scene, joint.id1), *b2 = bodyAt(*scene, joint.id2);
	if (!b1 || !b2) return;
	const State &s1 = *b1->state, &s2 = *b2->state;
	const Vector3r normal = s1.ori * joint.normal;
	raise(opening[k], (s2.pos - s1.pos + s2.ori * joint.centre2() - s1.ori * joint.centre1()).dot(normal));
	if (joint.isBroken()) return;
	const Real along = total.force.dot(normal); // on body 1
	const bool isWall = joint.ks == 0; // its springs act along the normal, which lies in the plane of the wall
	if (!isWall) raise(pull[k], along);
	raise(shear[k], isWall ? math::abs(along) : (total.force - along * normal).norm());
	raise(load[k], joint.loadOf(total));
}

void StructureMonitor::recordJoints()
{
	const JointEngine* engine = findEngine<JointEngine>(*scene);
	const size_t count = engine ? engine->joints.size() : 0;
	for (vector<Real>* values : { &pull, &shear, &load, &opening })
		values->resize(count, 0);
	for (size_t k = 0; k < count; ++k)
		recordJoint(*engine->joints[k], engine->lastForce(k), k);
}

void StructureMonitor::action()
{
	if (isSampleDue(*scene, jointInterval, nextJoints)) recordJoints();
	if (isSampleDue(*scene, interval, nextSample)) recordMomenta();
}

} // namespace yade
