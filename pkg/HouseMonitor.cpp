// SPDX-License-Identifier: GPL-2.0-or-later
#include <HouseMonitor.hpp>
#include <EnergyBalance.hpp>
#include <JointEngine.hpp>
#include <bodies.hpp>
#include <kernel/portable_math.hpp>
#include <sampling.hpp>
#include <validation.hpp>

namespace yade {

YADE_PLUGIN((HouseMonitor));

namespace {
	/// Columns of each level and their units.
	const std::pair<const char*, const char*> levelColumns[]
	        = { { "drift_ns", " [-]" }, { "drift_ew", " [-]" }, { "drop", " [m]" } };

	/// Number of joints without a spring left.
	int brokenJoints(const Scene& scene)
	{
		const JointEngine* engine = findEngine<JointEngine>(scene);
		if (!engine) return 0;
		return int(std::count_if(
		        engine->joints.begin(), engine->joints.end(), [](const auto& j) { return j->isBroken(); }));
	}

	/// Whether each body has a joint with a spring left; all without a JointEngine.
	std::vector<bool> joinedBodies(const Scene& scene)
	{
		const JointEngine* engine = findEngine<JointEngine>(scene);
		std::vector<bool> joined(scene.bodies->size(), !engine);
		for (size_t k = 0; engine && k < engine->joints.size(); ++k) {
			const TimberJoint& j = *engine->joints[k];
			if (!j.isBroken() && bodyAt(scene, j.id1) && bodyAt(scene, j.id2))
				joined[j.id1] = joined[j.id2] = true;
		}
		return joined;
	}

	/// Absolute values: the largest one, and that of the median. values: at least one, in any order; out: another
	/// one
	std::pair<Real, Real> largestAndMedian(std::vector<Real>& values)
	{
		const auto [low, high] = std::minmax_element(values.begin(), values.end());
		const Real largest = math::max(math::abs(*low), math::abs(*high));
		const size_t half = values.size() / 2;
		std::nth_element(values.begin(), values.begin() + half, values.end());
		const Real upper = values[half];
		if (values.size() % 2) return { largest, math::abs(upper) };
		return { largest, math::abs(upper + *std::max_element(values.begin(), values.begin() + half)) / 2 };
	}
}

void HouseMonitor::validate() const
{
	requireNonNegative("HouseMonitor.interval", interval);
	for (const auto& [name, limit] : { std::pair("HouseMonitor.tiltDrift", tiltDrift),
	             std::pair("HouseMonitor.fallDrop", fallDrop), std::pair("HouseMonitor.fallenAngle", fallenAngle) })
		require(limit > 0, name, limit, "> 0");
	for (Real height : heights)
		requirePositive("HouseMonitor.heights", height);
	for (int level : levels)
		require(level >= 0, "HouseMonitor.levels", level, ">= 0");
	for (int storey : columnStoreys)
		require(storey >= 1, "HouseMonitor.columnStoreys", storey, ">= 1");
	require(columnBodies.empty() || columnStoreys.empty() || columnBodies.size() == columnStoreys.size(),
	        "HouseMonitor.columnStoreys: length", columnStoreys.size(),
	        "that of HouseMonitor.columnBodies; set both with updateAttrs()");
	const bool isComplete = !levels.empty() && !bodies.empty(); // attributes may be set one after the other
	require(!isComplete || levels.size() == bodies.size(), "HouseMonitor.levels: length", levels.size(),
	        "that of HouseMonitor.bodies; set both with updateAttrs()");
}

Vector3r HouseMonitor::displacementOf(int level) const
{
	Vector3r sum = Vector3r::Zero();
	Real mass = 0;
	for (size_t k = 0; k < math::min(bodies.size(), levels.size()); ++k) {
		const Body* b = bodyAt(*scene, bodies[k]);
		if (!b || levels[k] != level) continue;
		const State& s = *b->state;
		sum += s.mass * (s.pos - s.refPos);
		mass += s.mass;
	}
	if (!(mass > 0)) stopRun("HouseMonitor: level " + std::to_string(level) + " has no body with a mass");
	return sum / mass;
}

boost::python::list HouseMonitor::pyColumns() const
{
	boost::python::list names;
	names.append("time [s]");
	for (size_t level = 1; level <= heights.size(); ++level)
		for (const auto& [name, unit] : levelColumns)
			names.append(name + std::to_string(level) + unit);
	for (const char* name : { "broken_joints [-]", "broken_springs [-]" })
		names.append(name);
	for (const EnergyTerm& term : energyTerms)
		names.append(string(term.name) + " [J]");
	return names;
}

void HouseMonitor::recordColumns()
{
	const std::vector<bool> joined = joinedBodies(*scene);
	const Real leastVertical = std::isfinite(fallenAngle) ? timber::cosine(fallenAngle) : -1;
	std::vector<std::vector<Real>> drifts(2 * heights.size()); // in the order of peak
	for (size_t k = 0; k < math::min(columnBodies.size(), columnStoreys.size()); ++k) {
		const Body* b = bodyAt(*scene, columnBodies[k]);
		if (!b || !joined[columnBodies[k]] || size_t(columnStoreys[k]) > heights.size()) continue;
		const Vector3r axis = b->state->ori * (b->state->refOri.conjugate() * Vector3r::UnitZ());
		if (axis.z() < leastVertical) continue;
		drifts[2 * columnStoreys[k] - 2].push_back(axis.y());
		drifts[2 * columnStoreys[k] - 1].push_back(axis.x());
	}
	columnPeak.resize(drifts.size(), 0);
	medianPeak.resize(drifts.size(), 0);
	for (size_t k = 0; k < drifts.size(); ++k) {
		if (drifts[k].empty()) continue;
		const auto [largest, median] = largestAndMedian(drifts[k]);
		columnPeak[k] = math::max(columnPeak[k], largest);
		medianPeak[k] = math::max(medianPeak[k], median);
	}
}

void HouseMonitor::record()
{
	if (!columnBodies.empty()) recordColumns();
	rows.push_back(scene->time);
	Vector3r below = Vector3r::Zero();
	peak.resize(2 * heights.size(), 0);
	for (size_t level = 1; level <= heights.size(); ++level) {
		const Vector3r above = displacementOf(level);
		const Real height = heights[level - 1];
		const Real ns = (above - below).y() / height, ew = (above - below).x() / height;
		peak[2 * level - 2] = math::max(peak[2 * level - 2], math::abs(ns));
		peak[2 * level - 1] = math::max(peak[2 * level - 1], math::abs(ew));
		const bool stood = !(tiltTime >= 0) && !(collapseTime >= 0);
		if (stood && math::max(math::abs(ns), math::abs(ew)) > tiltDrift) {
			tiltTime = scene->time;
			tiltDirection = math::abs(ns) > math::abs(ew) ? "ns" : "ew";
		}
		if (!(collapseTime >= 0) && above.z() < -fallDrop * height) collapseTime = scene->time;
		rows.insert(rows.end(), { ns, ew, -above.z() });
		below = above;
	}
	const JointEngine* joints = findEngine<JointEngine>(*scene);
	rows.push_back(brokenJoints(*scene));
	rows.push_back(joints ? joints->breaks.size() : 0);
	const EnergySources sources = energySources(*scene);
	for (const EnergyTerm& term : energyTerms)
		rows.push_back(term.value(sources));
}

void HouseMonitor::action()
{
	if (isSampleDue(*scene, interval, nextSample)) record();
}

} // namespace yade
