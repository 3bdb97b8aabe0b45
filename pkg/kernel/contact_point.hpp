// SPDX-License-Identifier: GPL-2.0-or-later
/// A contact point from touch to separation. Its geometry is the ContactPoint of the manifold with the same index; its
/// record is saved with the scene; its step is prepared for the solver, which owns it, and lasts for one time step.
#pragma once
#include "impact.hpp"
#include "manifold.hpp"
#include "portable_math.hpp"
#include "solver_body.hpp"

namespace timber {

/// State of a point's springs. Forces act on B.
template <class Number> struct PointSprings {
	Number unloadedOverlap = 0.; ///< initial overlap that carries no force, see initialOverlap() [m]
	Number crushed = 0.; ///< plastic overlap c [m]
	Number overlap = 0.; ///< elastic overlap n = overlap - crushed - unloadedOverlap, at most the limit [m]
	Number stiffness = 0.; ///< K_n [N/m]
	Number normalForce = 0.; ///< elastic normal force e_n [N]
	/// U(n) of the normal spring; beyond the limit, where the force is constant, it grows linearly [J]
	Number energy = 0.;
	Vec3Of<Number> shearForce = Vec3Of<Number>::Constant(Number(0.)); ///< elastic tangential force e_s [N]
};

/// History of a contact point.
struct PointRecord : PointSprings<double> {
	FeatureId id;
	Vec3 dashpotForce = Vec3::Zero(); ///< contact force of the last step minus the elastic force, on B [N]
	/// A: work of the bodies on the springs that these have neither returned nor dissipated [J]
	double normalStored = 0, shearStored = 0;
	ImpactState impact;

	/// Without force, stiffness and energy: its impulse is zero, and a step leaves its history as it is. Crushed points
	/// are idle until the surfaces come as close again.
	bool isIdle() const
	{
		return stiffness == 0 && normalForce == 0 && normalStored == 0 && shearStored == 0 && !impact.isActive()
		        && shearForce.isZero(0) && dashpotForce.isZero(0);
	}
};

/// A contact point in a step of the solver. Symbols: contact_solver.hpp.
struct PointStep {
	using Quad = PairVector::Quad; ///< normal, tangent, second tangent, 0
	PairVector rows[3]; ///< of J R
	Quad before, velocity; ///< v, u0 [m/s]
	Quad impulse; ///< p: warm start; after the sweeps the contact impulse on B in these axes [N s]
	Quad factor, bias, mass; ///< f, B, M
	Quad column; ///< a_n, a_nt, a_nu: velocity change by a unit normal impulse [1/kg]
	Quad shearResponse; ///< a_tt, a_tu, a_uu: by tangential impulses [1/kg]
	double friction; ///< mu
	double rebound, energy, shearEnergy; ///< w, A_n, A_s
	double hardening, exponent, overlap, overlapLeft,
	        damping; ///< c n_0^q, q, n_0, overlap left to the limit (> 0 if the point hardens), C_n
	double step; ///< h
	double strength; ///< h F_Y
	bool bounded; ///< whether (6) limited the impulse in the last visit
	bool idle; ///< no impulse, whatever the bodies do
	// Not read by the sweeps
	Vec3 axes[3]; ///< unit: normal from A to B, tangent, second tangent
	Vec3 armA, armB; ///< from the centres of mass to the point [m]

	double response() const { return column[0]; } ///< a_n
};

/// s^q, q: exponent of a contact law, which for Hertz's is a matter of a square root.
template <class Number> Number powerOf(Number s, double q)
{
	if (q == 1.5) return s * sqrt(s);
	if constexpr (std::is_same_v<Number, double>) return power(s, q);
	else return eachLane(s, [q](double x) { return power(x, q); });
}

} // namespace timber
