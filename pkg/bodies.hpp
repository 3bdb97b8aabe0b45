// SPDX-License-Identifier: GPL-2.0-or-later
/// Helpers for YADE's bodies and engines, and sums of forces.
#pragma once
#include <kernel/kinematics.hpp>
#include <omp.h>
#include <pch.hpp>

namespace yade {

/// Whether a body is not fixed: at least one degree of freedom is not blocked.
inline bool isFree(const State& s) { return s.blockedDOFs != State::DOF_ALL; }

/// References to the state's vectors.
inline timber::BodyKinematics kinematics(const State& s) { return { s.pos, s.vel, s.angVel }; }

/// The body of that id; null if it does not exist or was erased.
inline Body* bodyAt(const Scene& scene, Body::id_t id)
{
	const BodyContainer& bodies = *scene.bodies;
	return id >= 0 && size_t(id) < bodies.size() ? bodies[id].get() : nullptr;
}

/// The first engine of that class, or null. alsoDead: without one, the first that is switched off.
template <class E> E* findEngine(const Scene& scene, bool alsoDead = false)
{
	E* dead = nullptr;
	for (const shared_ptr<Engine>& e : scene.engines) {
		E* match = e->dead && (!alsoDead || dead) ? nullptr : dynamic_cast<E*>(e.get());
		if (match && !e->dead) return match;
		if (match) dead = match;
	}
	return dead;
}

/// YADE's own parallel loops run on one thread while an object of this class exists: they are short, and OpenMP's
/// threads spin for milliseconds after each of them (kernel/threads.hpp).
class OneThread {
	const int before = omp_get_max_threads();

public:
	OneThread() { omp_set_num_threads(1); }
	~OneThread() { omp_set_num_threads(before); }
	OneThread(const OneThread&) = delete;
	OneThread& operator=(const OneThread&) = delete;
};

/// Sums the forces that the engines have added so far.
inline void syncForces(Scene& scene)
{
	const OneThread serial;
	scene.forces.sync();
}

/// Adds mass times acceleration [m/s2] to every free body.
inline void addBodyForce(Scene& scene, const Vector3r& acceleration)
{
	for (const shared_ptr<Body>& b : *scene.bodies)
		if (b && isFree(*b->state)) scene.forces.addForce(b->getId(), b->state->mass * acceleration);
}

/// Forces and torques about the centres, by body id. YADE's container sums them in the order of its threads. Sums made
/// here and handed over once do not depend on the number of threads.
struct BodyForces {
	std::vector<Vector3r> force, torque; ///< [N, N m]

	void clear(size_t bodies)
	{
		force.assign(bodies, Vector3r::Zero());
		torque.assign(bodies, Vector3r::Zero());
	}
	void add(Body::id_t id, const Vector3r& f, const Vector3r& t)
	{
		force[id] += f;
		torque[id] += t;
	}
	void handOver(Scene& scene) const
	{
		for (size_t id = 0; id < force.size(); ++id) {
			if (force[id].isZero(0) && torque[id].isZero(0)) continue;
			scene.forces.addForce(id, force[id]);
			scene.forces.addTorque(id, torque[id]);
		}
	}
};

} // namespace yade
