// SPDX-License-Identifier: GPL-2.0-or-later
/// Constraint of a contact point: coefficients of equations (2) to (8) of contact_solver.hpp, whose glossary explains the symbols.
#pragma once
#include "impact.hpp"
#include "kinematics.hpp"
#include "solver_body.hpp"

namespace timber {

/// Input of the prepare phase: one contact point.
template <class Number> struct ContactInput {
	Vec3Of<Number> armA, armB; ///< from the centres of mass to the point [m]
	Vec3Of<Number> normal; ///< unit, from A to B
	Number elasticNormal; ///< e_n >= 0 [N]
	Vec3Of<Number> elasticShear; ///< e_s on B, before Coulomb's limit [N]
	Number normalDamping, shearDamping; ///< C_n, C_s [N s/m]
	Number friction; ///< mu [-]
	Vec3Of<Number> impulse; ///< warm start: estimate of the total contact impulse on B [N s]
	Number normalStiffness = 0., shearStiffness = 0.; ///< K_n, K_s [N/m]
	Number release = noRebound; ///< r: overlap over the step [m/s]
	Number energy = 0.; ///< U [J]
	Number hardening = 0.; ///< c; 0: linear spring [N/m^1.5]
	Number overlap = 0.; ///< n_0; only read where the spring hardens [m]
};

/// One contact point of a pair: input and output of the sweeps.
template <class Number> struct ContactConstraint {
	Vec3Of<Number> armA, armB, normal, tangent; ///< tangent: unit; the second one is normal x tangent
	Vec3Of<Number> impulse; ///< p: warm start; after the sweeps total contact impulse on B [N s]
	Number response, release, energy; ///< a_n, r, U
	Number rebound; ///< w
};
/// work(member of x, the same member of y) for all members of a constraint.
template <class ConstraintX, class ConstraintY, class Work> void forMembers(ConstraintX& x, ConstraintY& y, Work work)
{
	work(x.armA, y.armA);
	work(x.armB, y.armB);
	work(x.normal, y.normal);
	work(x.tangent, y.tangent);
	work(x.impulse, y.impulse);
	work(x.response, y.response);
	work(x.release, y.release);
	work(x.energy, y.energy);
	work(x.rebound, y.rebound);
}

/// A point in the sweeps. Symbols: glossary of contact_solver.hpp.
struct SweepPoint {
	using Quad = PairVector::Quad; ///< normal, tangent, second tangent, 0
	PairVector rows[3]; ///< of G
	Quad velocity; ///< u0 [m/s]
	Quad impulse; ///< p
	Quad factor, bias, mass; ///< f, b, M
	Quad coupling; ///< 0 for the normal, c_s
	double friction; ///< mu
	double rebound, release, response, energy; ///< w, r, a_n, U
	double hardening, overlap, damping, closing, step; ///< c, n_0, C_n, -h v (>= 0), h
};

/// A point with its constraint, or a group of points.
template <class Number> struct PreparedPoint {
	using Quad = Number[4]; ///< as in SweepPoint
	ContactConstraint<Number> constraint;
	Number rows[3][12];
	Quad velocity, impulse, factor, bias, mass, coupling;
	Number friction, hardening, overlap, damping, closing;
	double step;

	/// For a step of h [s]. rootA, rootB: of the bodies.
	PreparedPoint(
	        const ContactInput<Number>& p, const SolverBody& a, const SolverBody& b, const InverseRootMass& rootA, const InverseRootMass& rootB, double h);
	/// Writes the first `count` points of the group.
	void store(SweepPoint* to, size_t count) const;
};

/// Impulse of explicit springs and dashpots (Eqs. 17, 18, 21-24). As in the paper, the elastic force alone decides whether a point
/// slides, and a sliding point has no dashpot. With long steps this rule makes loaded light members chatter between the limits.
template <class Number> Vec3Of<Number> explicitImpulse(const ContactInput<Number>& p, const SolverBody& a, const SolverBody& b, double h);

/// p in the world frame: impulse in the axes of the constraint.
Vec3s worldImpulse(const ContactConstraint<Lanes>& c, const Lanes* impulse);

/// v, shortened to the length if it is longer.
template <class Number> Vec3Of<Number> clipped(const Vec3Of<Number>& v, Number length)
{
	const Number square = v.squaredNorm();
	return selectLazily(
	        square > length * length, [&] { return Vec3Of<Number>(v * Number(length / sqrt(square))); }, [&] { return v; });
}

} // namespace timber
