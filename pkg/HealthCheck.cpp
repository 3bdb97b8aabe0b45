// SPDX-License-Identifier: GPL-2.0-or-later
#include <HealthCheck.hpp>

namespace yade {

YADE_PLUGIN((HealthCheck));

void HealthCheck::postLoad(HealthCheck&)
{
	if (every < 1) throw std::invalid_argument("HealthCheck.every = " + std::to_string(every) + ": it must be > 0");
}

void HealthCheck::action()
{
	if (scene->iter % every != 0) return;
	if (!(scene->dt > 0)) throw std::runtime_error("O.dt = " + std::to_string(scene->dt) + " s: it must be > 0");
	for (const shared_ptr<Body>& b : *scene->bodies) {
		if (!b) continue;
		if (b->isClump()) throw std::runtime_error("body " + std::to_string(b->getId()) + " is a clump: make one convex polyhedron of it, or join its parts");
		if (b->state->blockedDOFs != State::DOF_NONE && b->state->blockedDOFs != State::DOF_ALL)
			throw std::runtime_error("body " + std::to_string(b->getId()) + " has some degrees of freedom blocked: contacts know free and fixed bodies only");
		const State& s = *b->state;
		if (s.pos.allFinite() && s.vel.allFinite() && s.angVel.allFinite() && s.ori.coeffs().allFinite() && s.vel.norm() <= speedLimit) continue;
		std::ostringstream what;
		what << "body " << b->getId() << " left the physical range at step " << scene->iter << " (t = " << scene->time << " s): position " << s.pos.transpose() << " m, velocity " << s.vel.transpose()
		     << " m/s; the time step " << scene->dt << " s is probably too large";
		throw std::runtime_error(what.str());
	}
}

} // namespace yade
