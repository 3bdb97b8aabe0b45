// SPDX-License-Identifier: GPL-2.0-or-later
/// Motion of rigid bodies, and when the collider must look again.
#pragma once
#include <pch.hpp>

namespace yade {

class SymplecticIntegrator : public GlobalEngine {
	void move(Body&) const;

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
	};
	std::vector<Seen> seen; ///< by id
	Real motionOf(const Body&) const;
	Real largestMotion();
	void remember();

public:
	std::vector<Real> motions; ///< bounds of how far any point of a body is away from where it was when the collider ran, by id [m]
	void action() override;
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(CollisionTrigger, GlobalEngine,
		"Lets the collider behind it run only when a body may have left its bounding box, or bodies came or went. Stands right before the collider.",
		((Real, margin, 5e-3, , "Distance by which the bounding boxes are larger than the bodies, see :yref:`Bo1_RoundedPolyhedron_Aabb.margin<Bo1_RoundedPolyhedron_Aabb>`. [m]"))
		((Real, moved, NaN, Attr::readonly, "Largest bound of how far a point of a body is away from where it was when the collider ran. [m]"))
		((int, runs, 0, Attr::readonly, "How often the collider ran. [-]")));
	// clang-format on
};
REGISTER_SERIALIZABLE(CollisionTrigger);

} // namespace yade
