// SPDX-License-Identifier: GPL-2.0-or-later
/// Motion of rigid bodies, and when the collider must look again.
#pragma once
#include <pch.hpp>

namespace yade {

class SymplecticIntegrator : public GlobalEngine {
	void push(Body::id_t, State&) const;
	template <class Number> void turn(State* const* states, size_t count) const;
	void move(Body::id_t first) const;

public:
	void action() override;
	// clang-format off
	YADE_CLASS_BASE_DOC(SymplecticIntegrator, GlobalEngine,
		"Leapfrog for rigid bodies: positions at full, velocities and angular momenta at half steps. The free rotation within a step is composed of exact rotations about the principal axes "
		"(Dullweber, Leimkuhler and McLachlan 1997): second order, time-reversible, symplectic, and it keeps the angular momentum exactly. It replaces NewtonIntegrator, which gains energy in free rotation. "
		"No numerical damping. Blocked degrees of freedom get no force; a body with all of them blocked keeps its velocity.");
	// clang-format on
};
REGISTER_SERIALIZABLE(SymplecticIntegrator);

class CollisionTrigger : public GlobalEngine {
	/// A body when the collider ran.
	struct Seen {
		Vector3r    place;
		Quaternionr turn;
		Vector3r    span; ///< largest distance of its core's points from the centre along its axes; 0 for other shapes [m]
		Real        margin; ///< of its box [m]
	};
	/// How a body has moved since then.
	struct Motion {
		Vector3r way; ///< of its centre [m]
		Real     turned; ///< bound of the way of its points against the centre [m]
	};
	std::vector<Seen>   seen; ///< by id
	std::vector<Motion> motions; ///< by id
	Motion motionOf(const Body&) const;
	bool mayHaveLeft();
	void remember();

public:
	void action() override;
	/// Bound of how much nearer any points of two bodies can be than they were when the collider ran. [m]
	Real approach(Body::id_t id1, Body::id_t id2) const { return (motions[id2].way - motions[id1].way).norm() + motions[id1].turned + motions[id2].turned; }
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(CollisionTrigger, GlobalEngine,
		"Lets the collider behind it run only when a body may have left its bounding box, or bodies came or went. Stands right before the collider.",
		((Real, margin, 5e-3, , "That of the boxes of slow bodies, :yref:`Bo1_RoundedPolyhedron_Aabb.margin<Bo1_RoundedPolyhedron_Aabb>`. [m]"))
		((int, runs, 0, Attr::readonly, "How often the collider ran. [-]")));
	// clang-format on
};
REGISTER_SERIALIZABLE(CollisionTrigger);

} // namespace yade
