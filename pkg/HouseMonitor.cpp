// SPDX-License-Identifier: GPL-2.0-or-later
#include <HouseMonitor.hpp>
#include <Gravity.hpp>
#include <bodies.hpp>
#include <sampling.hpp>
#include <validation.hpp>
#include <pkg/common/GravityEngines.hpp>

namespace yade {

YADE_PLUGIN((HouseMonitor));

namespace {
	/// Columns of each level and their units.
	const std::pair<const char*, const char*> levelColumns[]
	        = { { "drift_ns", " [-]" }, { "drift_ew", " [-]" }, { "drop", " [m]" } };

	/// Acceleration of gravity, this package's or YADE's. [m/s2]
	Vector3r gravityOf(const Scene& scene)
	{
		if (const auto* engine = findEngine<UniformGravity>(scene)) return engine->gravity;
		const auto* other = findEngine<GravityEngine>(scene);
		return other ? other->gravity : Vector3r(Vector3r::Zero());
	}

	/// [J]
	Real kineticEnergy(const Scene& scene)
	{
		Real sum = 0;
		for (const shared_ptr<Body>& b : *scene.bodies) {
			if (!b || !isFree(*b->state)) continue;
			sum += (b->state->mass * b->state->vel.squaredNorm() + b->state->angMom.dot(b->state->angVel))
			        / 2;
		}
		return sum;
	}

	/// Relative to the reference positions, at the half step to which the velocities belong. [J]
	Real gravityEnergy(const Scene& scene)
	{
		const Vector3r gravity = gravityOf(scene);
		Real sum = 0;
		for (const shared_ptr<Body>& b : *scene.bodies) {
			if (!b || !isFree(*b->state)) continue;
			const State& s = *b->state;
			sum -= s.mass * gravity.dot(s.pos - s.refPos - scene.dt / 2 * s.vel);
		}
		return sum;
	}

	/// Number of joints without a spring left.
	int brokenJoints(const Scene& scene)
	{
		const JointEngine* engine = findEngine<JointEngine>(scene);
		if (!engine) return 0;
		return int(std::count_if(
		        engine->joints.begin(), engine->joints.end(), [](const auto& j) { return j->isBroken(); }));
	}

	/// Scene and the engines that store energies, also those that are switched off; null if there is none.
	struct EnergySources {
		const Scene& scene;
		const ContactForces* contacts;
		const JointEngine* joints;
		const GroundMotionEngine* motion;
	};

	/// Elastic energy of joints after a whole step. [J]
	Real jointEnergy(const EnergySources& s)
	{
		Real energy = s.contacts ? s.contacts->elasticJoints : 0;
		if (s.joints) energy += s.joints->elastic;
		if (s.joints && !s.joints->dead) energy += s.scene.dt / 2 * s.joints->elasticPower(s.scene);
		return energy;
	}

	/// A term of the energy balance after a whole step, see ``yade_timber.energy``.
	struct EnergyTerm {
		const char* name;
		Real (*value)(const EnergySources&); ///< [J]
	};
	using Sources = const EnergySources&;
	const EnergyTerm energyTerms[] = {
		{ "kinetic", [](Sources s) { return kineticEnergy(s.scene); } },
		{ "gravity", [](Sources s) { return gravityEnergy(s.scene); } },
		{ "elastic_contacts",
		        [](Sources s) {
		                const ContactForces* c = s.contacts;
		                return c ? c->elasticNormal + c->elasticShear - c->placed : 0;
		        } },
		{ "elastic_joints", jointEnergy },
		{ "ground_motion", [](Sources s) { return s.motion ? s.motion->workUntilNow(s.scene) : 0; } },
		{ "dashpot_normal", [](Sources s) { return s.contacts ? s.contacts->dashpotNormal : 0; } },
		{ "dashpot_shear", [](Sources s) { return s.contacts ? s.contacts->dashpotShear : 0; } },
		{ "friction", [](Sources s) { return s.contacts ? s.contacts->friction : 0; } },
		{ "broken_springs", [](Sources s) { return s.joints ? s.joints->released : 0; } },
		{ "lost_contacts", [](Sources s) { return s.contacts ? s.contacts->released : 0; } },
		{ "joint_dashpot", [](Sources s) { return s.contacts ? s.contacts->jointDashpot : 0; } },
		{ "joint_yield", [](Sources s) { return s.joints ? s.joints->yielded : 0; } },
	};

	EnergySources energySources(const Scene& scene)
	{
		return { scene, findEngine<ContactForces>(scene, true), findEngine<JointEngine>(scene, true),
			findEngine<GroundMotionEngine>(scene, true) };
	}
}

void HouseMonitor::validate() const
{
	requireNonNegative("HouseMonitor.interval", interval);
	requirePositive("HouseMonitor.tiltDrift", tiltDrift);
	for (Real height : heights)
		requirePositive("HouseMonitor.heights", height);
	for (int level : levels)
		require(level >= 0, "HouseMonitor.levels", level, ">= 0");
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
	if (!(mass > 0))
		throw std::runtime_error("HouseMonitor: level " + std::to_string(level) + " has no body with a mass");
	return sum / mass;
}

/// Of the current scene: before its first step, an engine of a loaded scene points to the previous one.
boost::python::dict HouseMonitor::pyEnergy() const
{
	boost::python::dict terms;
	const EnergySources sources = energySources(*Omega::instance().getScene());
	for (const EnergyTerm& term : energyTerms)
		terms[term.name] = term.value(sources);
	return terms;
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

void HouseMonitor::record()
{
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
		if (!(collapseTime >= 0) && above.z() < -height / 2) collapseTime = scene->time;
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
