// SPDX-License-Identifier: GPL-2.0-or-later
#include <HouseMonitor.hpp>

namespace yade {

YADE_PLUGIN((HouseMonitor)(HealthCheck));

namespace {
	bool isFree(const Body& b) { return b.state->blockedDOFs != State::DOF_ALL; }
}

Real HouseMonitor::kineticEnergy() const
{
	Real sum = 0;
	for (const shared_ptr<Body>& b : *scene->bodies) {
		if (!b || !isFree(*b)) continue;
		sum += (b->state->mass * b->state->vel.squaredNorm() + b->state->angMom.dot(b->state->angVel)) / 2;
	}
	return sum;
}

/// Relative to the reference positions, at the half step to which the velocities belong.
Real HouseMonitor::gravityEnergy() const
{
	Real sum = 0;
	for (const shared_ptr<Body>& b : *scene->bodies) {
		if (!b || !isFree(*b)) continue;
		const State& s = *b->state;
		sum -= s.mass * gravity.dot(s.pos - s.refPos - scene->dt / 2 * s.vel);
	}
	return sum;
}

Vector3r HouseMonitor::meanDisplacement(int level) const
{
	Vector3r sum   = Vector3r::Zero();
	int      count = 0;
	for (size_t k = 0; k < bodies.size(); ++k) {
		if (levels[k] != level) continue;
		const State& s = *Body::byId(bodies[k], scene)->state;
		sum += s.pos - s.refPos;
		++count;
	}
	return count > 0 ? Vector3r(sum / count) : sum;
}

int HouseMonitor::brokenJoints() const
{
	const JointEngine* engine = find<JointEngine>();
	if (!engine) return 0;
	return int(std::count_if(engine->joints.begin(), engine->joints.end(), [](const auto& j) { return j->isFinished(); }));
}

boost::python::dict HouseMonitor::energy()
{
	if (!scene) scene = Omega::instance().getScene().get();
	boost::python::dict all;
	all["kinetic"] = kineticEnergy();
	all["gravity"] = gravityEnergy();
	if (const ContactForces* c = find<ContactForces>()) {
		all["elastic_normal"] = c->elasticNormal();
		all["elastic_shear"]  = c->elasticShear();
		all["dashpot_normal"] = c->dashpotNormal;
		all["dashpot_shear"]  = c->dashpotShear;
		all["friction"]       = c->friction;
		all["lost_contacts"]  = c->lost;
	}
	if (const JointEngine* j = find<JointEngine>()) {
		all["elastic_joints"] = j->elastic();
		all["broken_springs"] = j->released;
	}
	if (const GroundMotionEngine* g = find<GroundMotionEngine>()) all["ground_motion"] = g->work;
	return all;
}

boost::python::list HouseMonitor::pyColumns() const
{
	boost::python::list names;
	names.append("time [s]");
	for (int level = 1; level <= storeys; ++level)
		for (const char* what : { "drift_ns", "drift_ew", "drop" })
			names.append(string(what) + std::to_string(level) + (what[1] == 'r' && what[2] == 'o' ? " [m]" : " [-]"));
	for (const char* name : { "broken_joints [-]", "broken_springs [-]", "kinetic [J]", "gravity [J]", "elastic_normal [J]", "elastic_shear [J]", "elastic_joints [J]", "ground_motion [J]", "dashpot_normal [J]",
	             "dashpot_shear [J]", "friction [J]", "released_by_breaks [J]", "lost_contacts [J]" })
		names.append(name);
	return names;
}

void HouseMonitor::record()
{
	rows.push_back(scene->time);
	Vector3r below = Vector3r::Zero();
	peak.resize(2 * storeys, 0);
	for (int level = 1; level <= storeys; ++level) {
		const Vector3r above = meanDisplacement(level);
		const Real     ns = (above - below).y() / storeyHeight, ew = (above - below).x() / storeyHeight;
		peak[2 * level - 2] = math::max(peak[2 * level - 2], math::abs(ns));
		peak[2 * level - 1] = math::max(peak[2 * level - 1], math::abs(ew));
		if (!(tiltTime >= 0) && math::max(math::abs(ns), math::abs(ew)) > tiltDrift) {
			tiltTime      = scene->time;
			tiltDirection = math::abs(ns) > math::abs(ew) ? "ns" : "ew";
		}
		if (!(collapseTime >= 0) && above.z() < -storeyHeight / 2) collapseTime = scene->time;
		rows.insert(rows.end(), { ns, ew, -above.z() });
		below = above;
	}
	const JointEngine*        j = find<JointEngine>();
	const ContactForces*      c = find<ContactForces>();
	const GroundMotionEngine* g = find<GroundMotionEngine>();
	rows.insert(rows.end(), { Real(brokenJoints()), Real(j ? j->breaks.size() : 0), kineticEnergy(), gravityEnergy() });
	rows.insert(rows.end(), { c ? c->elasticNormal() : 0, c ? c->elasticShear() : 0, j ? j->elastic() : 0, g ? g->work : 0 });
	rows.insert(rows.end(), { c ? c->dashpotNormal : 0, c ? c->dashpotShear : 0, c ? c->friction : 0, j ? j->released : 0, c ? c->lost : 0 });
}

void HouseMonitor::action()
{
	if (scene->time < nextSample - scene->dt / 2) return;
	record();
	nextSample += interval;
}

void HealthCheck::action()
{
	if (scene->iter % every != 0) return;
	for (const shared_ptr<Body>& b : *scene->bodies) {
		if (!b) continue;
		const State& s = *b->state;
		if (s.pos.allFinite() && s.vel.allFinite() && s.angVel.allFinite() && s.ori.coeffs().allFinite() && s.vel.norm() <= speedLimit) continue;
		std::ostringstream what;
		what << "body " << b->getId() << " left the physical range at step " << scene->iter << " (t = " << scene->time << " s): position " << s.pos.transpose() << " m, velocity " << s.vel.transpose()
		     << " m/s; the time step " << scene->dt << " s is probably too large";
		throw std::runtime_error(what.str());
	}
}

} // namespace yade
