// SPDX-License-Identifier: GPL-2.0-or-later
#include <Sampler.hpp>
#include <EnergyBalance.hpp>
#include <PackedScene.hpp>
#include <bodies.hpp>
#include <sampling.hpp>
#include <validation.hpp>

namespace yade {

YADE_PLUGIN((Sampler));

namespace {
	/// Columns of each group and their units.
	const std::pair<const char*, const char*> groupColumns[] = { { "x", " [m]" }, { "y", " [m]" }, { "z", " [m]" },
		{ "px", " [kg m/s]" }, { "py", " [kg m/s]" }, { "pz", " [kg m/s]" } };

	/// Number of joints without a spring left.
	int brokenJoints(const JointEngine& engine)
	{
		const std::vector<timber::JointEntry>& joints = engine.jointSet().joints;
		return int(std::count_if(joints.begin(), joints.end(), [](const auto& j) { return j.isBroken(); }));
	}

	/// Whether each body has a joint with a spring left; all without a JointEngine.
	std::vector<bool> joinedBodies(const Scene& scene)
	{
		const JointEngine* engine = findEngine<JointEngine>(scene);
		std::vector<bool> joined(scene.bodies->size(), !engine);
		for (size_t k = 0; engine && k < engine->jointSet().joints.size(); ++k) {
			const timber::JointEntry& j = engine->jointSet().joints[k];
			if (!j.isBroken() && bodyAt(scene, j.bodyA) && bodyAt(scene, j.bodyB))
				joined[j.bodyA] = joined[j.bodyB] = true;
		}
		return joined;
	}

	size_t countOf(const std::vector<int>& groups)
	{
		return groups.empty() ? 0 : size_t(*std::max_element(groups.begin(), groups.end())) + 1;
	}

	/// Mass of a group of bodies, its first moment of displacements since the start, its momentum.
	struct Group {
		Real mass = 0; ///< [kg]
		Vector3r moment = Vector3r::Zero(), momentum = Vector3r::Zero(); ///< [kg m, kg m/s]
	};

	void append(std::vector<Real>& row, const Vector3r& v) { row.insert(row.end(), { v.x(), v.y(), v.z() }); }

	void raise(Real& largest, Real value) { largest = math::max(largest, value); }
}

void Sampler::validate() const
{
	requireNonNegative("Sampler.interval", interval);
	requireNonNegative("Sampler.jointInterval", jointInterval);
	for (int group : groups)
		require(group >= 0, "Sampler.groups", group, ">= 0");
	const bool isComplete = !groups.empty() && !bodies.empty(); // attributes may be set one after the other
	require(!isComplete || groups.size() == bodies.size(), "Sampler.groups: length", groups.size(),
	        "that of Sampler.bodies; set both with updateAttrs()");
}

boost::python::list Sampler::pyColumns() const
{
	boost::python::list names;
	for (const char* name : { "time [s]", "broken_joints [-]", "broken_springs [-]" })
		names.append(name);
	for (const EnergyTerm& term : energyTerms)
		names.append(string(term.name) + " [J]");
	for (size_t group = 0; group < countOf(groups); ++group)
		for (const auto& [name, unit] : groupColumns)
			names.append(name + std::to_string(group) + unit);
	return names;
}

boost::python::tuple Sampler::pyTake()
{
	const boost::python::tuple taken = boost::python::make_tuple(bytes(rows), bytes(axes));
	rows.clear();
	axes.clear();
	return taken;
}

boost::python::object Sampler::pyPeaks() const
{
	std::vector<Real> all;
	for (const vector<Real>* values : { &load, &pull, &shear, &opening })
		all.insert(all.end(), values->begin(), values->end());
	return bytes(all);
}

void Sampler::recordRow()
{
	const JointEngine* joints = findEngine<JointEngine>(*scene);
	rows.push_back(scene->time);
	rows.push_back(joints ? brokenJoints(*joints) : 0);
	rows.push_back(joints ? joints->breaks.size() : 0);
	const EnergySources sources = energySources(*scene);
	for (const EnergyTerm& term : energyTerms)
		rows.push_back(term.value(sources));
	recordGroups();
}

void Sampler::recordGroups()
{
	std::vector<Group> sums(countOf(groups));
	for (size_t k = 0; k < math::min(bodies.size(), groups.size()); ++k) {
		const Body* b = bodyAt(*scene, bodies[k]);
		if (!b) continue;
		const State& s = *b->state;
		Group& sum = sums[groups[k]];
		sum.mass += s.mass;
		sum.moment += s.mass * (s.pos - s.refPos);
		sum.momentum += s.mass * s.vel;
	}
	for (const Group& sum : sums) {
		append(rows, sum.mass > 0 ? Vector3r(sum.moment / sum.mass) : Vector3r::Constant(NaN));
		append(rows, sum.momentum);
	}
}

void Sampler::recordAxes()
{
	const std::vector<bool> joined = joinedBodies(*scene);
	for (const int member : members) {
		const Body* b = bodyAt(*scene, member);
		append(axes,
		        b && joined[member]
		                ? Vector3r(b->state->ori * (b->state->refOri.conjugate() * Vector3r::UnitZ()))
		                : Vector3r::Constant(NaN));
	}
}

void Sampler::recordJoint(const timber::JointEntry& joint, size_t k)
{
	const Body *b1 = bodyAt(*scene, joint.bodyA), *b2 = bodyAt(*scene, joint.bodyB);
	if (!b1 || !b2) return;
	const State &s1 = *b1->state, &s2 = *b2->state;
	const Vector3r normal = s1.ori * joint.normal;
	raise(opening[k], (s2.pos - s1.pos + s2.ori * joint.centreB - s1.ori * joint.centreA).dot(normal));
	if (joint.isBroken()) return;
	const Real along = joint.total.force.dot(normal); // on body 1
	const bool isWall
	        = joint.stiffness.shear == 0; // its springs act along the normal, which lies in the plane of the wall
	if (!isWall) raise(pull[k], along);
	raise(shear[k], isWall ? math::abs(along) : (joint.total.force - along * normal).norm());
	raise(load[k], joint.strength.load(joint.total));
}

void Sampler::recordJoints()
{
	const JointEngine* engine = findEngine<JointEngine>(*scene);
	const size_t count = engine ? engine->jointSet().joints.size() : 0;
	for (vector<Real>* values : { &pull, &shear, &load, &opening })
		values->resize(count, 0);
	for (size_t k = 0; k < count; ++k)
		recordJoint(engine->jointSet().joints[k], k);
}

void Sampler::action()
{
	if (isSampleDue(*scene, jointInterval, nextJoints)) recordJoints();
	if (!isSampleDue(*scene, interval, nextSample)) return;
	recordRow();
	if (!members.empty()) recordAxes();
}

} // namespace yade
