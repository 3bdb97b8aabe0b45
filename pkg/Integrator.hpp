// SPDX-License-Identifier: GPL-2.0-or-later
/// Motion of rigid bodies.
#pragma once
#include <pch.hpp>

namespace yade {

class SymplecticIntegrator : public GlobalEngine {
	void kickAndDrift(Body::id_t, State&) const;
	void moveFixed(State&) const;
	template <class Number> void rotate(State* const* states, size_t count) const;
	void moveGroup(Body::id_t first) const;

public:
	void action() override;
	// clang-format off
	YADE_CLASS_BASE_DOC(SymplecticIntegrator, GlobalEngine,
		"Leapfrog for rigid bodies: positions at full, velocities and angular momenta at half steps. The free "
		"rotation within a step is composed of exact rotations about the principal axes "
		"(Dullweber, Leimkuhler and McLachlan 1997): second order, time-reversible, symplectic, with exact "
		"conservation of angular momentum. It replaces NewtonIntegrator, whose energy grows in free rotation. "
		"No numerical damping. A body with all degrees of freedom blocked moves with its prescribed velocity "
		"and angular velocity.");
	// clang-format on
};
REGISTER_SERIALIZABLE(SymplecticIntegrator);

} // namespace yade
