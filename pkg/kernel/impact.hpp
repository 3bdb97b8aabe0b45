// SPDX-License-Identifier: GPL-2.0-or-later
/// Impact of a contact point: from the touch of the surfaces to their separation, in many steps or in a fraction of one.
///
/// A point that acts alone, with the spring F = c n^q and the dashpot C = 2 ratio sqrt(m dF/dn), moves as n'' = -a max(0, F + C n'). In the
/// variables x = 2/(q+1) n^((q+1)/2) and dt' = n^((q-1)/2) dt this is a linear oscillator with the ratio of critical damping
///     D = ratio sqrt(a m 2q/(q+1))                                                              (1)
/// Its velocity n' = dx/dt' is largest where the force ends:
///     restitution e = exp(-2 D acos(D) / sqrt(1 - D^2)),  D > 1: exp(-2 D acosh(D) / sqrt(D^2 - 1))     (2)
/// at any speed (Schwager and Poeschel, Granular Matter 9 (2007), 465; Antypov and Elliott, EPL 94 (2011), 50004).
/// For impacts of few steps, down to fractions of one, the solver takes the velocity of separation from (2): contact_solver.hpp. In longer ones,
/// which the steps resolve, only the energy is followed.
/// Loads that change the velocity within the duration, or within a longer step, by more than the touch speed take the velocity of separation
/// away: the contact is then a loaded one, of which only the energy is followed.
///
/// Symbols: a inverse effective mass [1/kg], m equivalent mass (Eq. 43) [kg], n overlap [m], q power of the law (Hertz: 1.5) [-].
#pragma once
#include <limits>

namespace timber {

/// Velocity of separation without a limit: the point is not in an impact. [m/s]
constexpr double noRebound = std::numeric_limits<double>::infinity();

/// State of a point's impact.
struct ImpactState {
	double touchSpeed = 0; ///< closing velocity at the touch [m/s]
	double duration = 0; ///< without dashpots and other forces [s]
	double timeLeft = 0; ///< in which the impact must end; 0: no impact; < 0: the surfaces have not touched yet [s]
	double rebound = noRebound; ///< velocity of separation at the end of a short impact [m/s]
	double stored = 0; ///< energy of the normal spring after the last step [J]

	bool isPending() const { return timeLeft < 0; }
	bool isActive() const { return timeLeft > 0; }
	bool isPast() const { return timeLeft == 0 && duration > 0; } ///< the contact went on after it
	/// The next compression will be an impact. energy: which the normal spring has already [J].
	void expect(double energy);
	/// No impact any more; the contact goes on.
	void cancel();
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

/// Starts the impact of a point whose surfaces have touched in the last step. dampingRatio: C / (2 sqrt(m K)) [-]; mass: m [kg]; response: a
/// [1/kg]; speed: of closing [m/s]; h: step [s].
void startImpact(ImpactState& impact, const PowerSpring& spring, double dampingRatio, double mass, double response, double speed, double h);

} // namespace timber
