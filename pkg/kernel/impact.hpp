// SPDX-License-Identifier: GPL-2.0-or-later
/// Impact of a contact point: from the touch of the surfaces to their separation, in many steps or in a fraction of
/// one.
///
/// A point that acts alone, with the spring F = c n^q and the dashpot C = 2 zeta sqrt(m dF/dn), moves as n'' = -a
/// max(0, F + C n'). In the variables x = 2/(q+1) n^((q+1)/2) and dt' = n^((q-1)/2) dt this is a linear oscillator with
/// the ratio of critical damping
///     zeta_c = zeta sqrt(a m 2q/(q+1))                                                          (1)
/// Its velocity n' = dx/dt' is largest where the force ends:
///     e_r = exp(-2 zeta_c acos(zeta_c) / sqrt(1 - zeta_c^2)),   zeta_c > 1: acosh, zeta_c^2 - 1         (2)
/// is the restitution at any speed (Schwager and Poeschel, Granular Matter 9 (2007), 465; Antypov and Elliott, EPL 94
/// (2011), 50004).
/// An impact of a few steps, or of a fraction of one, is not resolved by them: the solver bounds its velocity of
/// separation by w = e_r times the touch speed ((6) of docs/theory.md), for its duration and as long as the bound acts.
/// The steps resolve longer ones.
/// A contact that is pressed together by more than the touch speed within the duration, or within a longer step, is a
/// loaded one, without a bound.
///
/// Symbols: a inverse effective mass [1/kg], m equivalent mass (Eq. 43) [kg], n overlap [m], q exponent of the law (Hertz:
/// 1.5) [-].
/// A point with the strength F_Y has the total force min(F_Y, F + C n'). The unloading from rest at the overlap d ends
/// with e_r^1/2 times the velocity v(d) = (2 a U(d))^1/2. So does an impact that is crushed, d: the elastic overlap at
/// the strength. Otherwise d is that at which the loading ends. Both follow from one quadrature:
///     d(v^2)/dn = -2 a min(F_Y, F + C v),   v = n'                                              (3)
#pragma once
#include "bearing_strength.hpp"

namespace timber {

/// Velocity of separation without a bound. [m/s]
constexpr double noRebound = std::numeric_limits<double>::infinity();

/// State of a point's impact.
struct ImpactState {
	/// For which the separation is bounded; 0: the impact is over; < 0: the surfaces have not touched yet [s]
	double timeLeft = -1;
	double rebound = noRebound; ///< w [m/s]
	/// Velocity by which other contacts and forces may press the surfaces together in a step [m/s]
	double load = 0;

	static ImpactState over() { return { 0, noRebound, 0 }; }
	bool isPending() const { return timeLeft < 0; }
	bool isActive() const { return timeLeft > 0; }
	/// After a step of h [s]. bounded: whether the bound acted; pressing: velocity by which other contacts and
	/// forces pressed the surfaces together [m/s].
	void pass(double h, bool bounded, double pressing)
	{
		if (!bounded) timeLeft -= h;
		if (timeLeft <= 0 || pressing > load) *this = over();
	}
};

/// Restitution e_r (2). ratio: zeta_c >= 0 [-].
double restitution(double ratio);

/// Normal spring c n^q of a point at some overlap.
struct PowerSpring {
	double overlap, force, stiffness; ///< > 0 [m, N, N/m]

	double exponent() const; ///< q, without the rounding errors of force and stiffness [-]
	double energy() const { return force * overlap / (exponent() + 1); } ///< [J]
	double energyAt(double otherForce) const; ///< [J]
	/// Duration of the undamped impact of a mass [kg] with a speed > 0 [m/s]. [s]
	double duration(double mass, double speed) const;
};

/// Point that touches, alone or with others that share the impulse.
struct Touch {
	double dampingRatio; ///< C / (2 sqrt(m K)) [-]
	double mass; ///< m [kg]
	double response; ///< a: velocity change by a unit impulse of each of them [1/kg]
	double speed; ///< of closing, > 0 [m/s]
	BearingStrength strength;
	double crushed = 0; ///< plastic overlap [m]
};

/// Velocity after an impact (3) over v(d), with the overlap d at the strength. ratio: zeta_c; q: exponent; speed: of
/// closing, over v(d); crushing: out, share of the energy before the impact that is left at d and crushes beyond. [-]
double reboundAtStrength(double ratio, double q, double speed, double& crushing);

/// Impact of a point whose surfaces have touched in the last step. h: step [s].
ImpactState startImpact(const PowerSpring& spring, const Touch& touch, double h);

} // namespace timber
