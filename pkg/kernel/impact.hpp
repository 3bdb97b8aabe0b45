// SPDX-License-Identifier: GPL-2.0-or-later
/// Impact of a contact point: from the touch of the surfaces to their separation, in many steps or in a fraction of
/// one.
///
/// A point that acts alone, with the spring F = c n^q and the dashpot C = 2 ratio sqrt(m dF/dn), moves as n'' = -a
/// max(0, F + C n'). In the variables x = 2/(q+1) n^((q+1)/2) and dt' = n^((q-1)/2) dt this is a linear oscillator with
/// the ratio of critical damping
///     D = ratio sqrt(a m 2q/(q+1))                                                              (1)
/// Its velocity n' = dx/dt' is largest where the force ends:
///     restitution e = exp(-2 D acos(D) / sqrt(1 - D^2)),  D > 1: exp(-2 D acosh(D) / sqrt(D^2 - 1))     (2)
/// at any speed (Schwager and Poeschel, Granular Matter 9 (2007), 465; Antypov and Elliott, EPL 94 (2011), 50004).
/// An impact of a few steps, or of a fraction of one, is not resolved by them: the solver bounds its velocity of
/// separation by w = e times the touch speed (contact_solver.hpp (6)), for its duration and as long as the bound acts.
/// The steps resolve longer ones.
/// A contact that is pressed together by more than the touch speed within the duration, or within a longer step, is a
/// loaded one, without a bound.
///
/// Symbols: a inverse effective mass [1/kg], m equivalent mass (Eq. 43) [kg], n overlap [m], q power of the law (Hertz:
/// 1.5) [-].
#pragma once
#include <limits>

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

/// Restitution e (2). ratio: D >= 0 [-].
double restitution(double ratio);

/// Normal spring c n^q of a point at some overlap.
struct PowerSpring {
	double overlap, force, stiffness; ///< > 0 [m, N, N/m]

	double power() const { return stiffness * overlap / force; } ///< q [-]
	double energy() const { return force * overlap / (power() + 1); } ///< [J]
	/// Duration of the undamped impact of a mass [kg] with a speed > 0 [m/s]. [s]
	double duration(double mass, double speed) const;
};

/// Impact of a point whose surfaces have touched in the last step. dampingRatio: C / (2 sqrt(m K)) [-]; mass: m [kg];
/// response: a [1/kg]; speed: of closing, > 0 [m/s]; h: step [s].
ImpactState startImpact(
        const PowerSpring& spring, double dampingRatio, double mass, double response, double speed, double h);

} // namespace timber
