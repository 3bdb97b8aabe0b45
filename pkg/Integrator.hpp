// SPDX-License-Identifier: GPL-2.0-or-later
/// Motion of rigid bodies.
#pragma once
#include <pch.hpp>

namespace yade {

class SymplecticIntegrator : public GlobalEngine {
	void push(Body::id_t, State&) const;
	void carryOn(State&) const;
	template <class Number> void turn(State* const* states, size_t count) const;
	void move(Body::id_t first) const;

public:
	void action() override;
	// clang-format off
	YADE_CLASS_BASE_DOC(SymplecticIntegrator, GlobalEngine,
		"Leapfrog for rigid bodies: positions at full, velocities and angular momenta at half steps. The free rotation within a step is composed of exact rotations about the principal axes "
		"(Dullweber, Leimkuhler and McLachlan 1997): second order, time-reversible, symplectic, and it keeps the angular momentum exactly. It replaces NewtonIntegrator, which gains energy in free rotation. "
		"No numerical damping. Blocked degrees of freedom get no force; a body with all of them blocked keeps its velocity and angular velocity, and moves with them.");
	// clang-format on
};
REGISTER_SERIALIZABLE(SymplecticIntegrator);

} // namespace yade
