// SPDX-License-Identifier: GPL-2.0-or-later
/// Cyclic law of walls: shear over drift along one axis, pinched, with a friction force and a memory of each side (law:
/// wall). Adapter: JointEngine (pkg/JointEngine.hpp).
///
/// It is the SAWS law (Folz and Filiatrault, J. Struct. Eng. 127 (2001) 361-370) with the backbone by points: a spring
/// between two bounds, which unloads and reloads with the stiffness k,
///
///     F' = clamp(F + k (d' - d), -Up-(-d'), Up+(d'))                                          (1)
///
/// Up is the bound of a side at the displacement x towards it, with the largest displacement u of that side so far:
///
///     x <= x_s          p(x) = k_p x + F_f              pinched line, also for x < 0
///     x_s < x < x_t     line from (x_s, p(x_s)) to (x_t, B(x_t)),   x_t = beta u               reloading
///     else              B(x)                            backbone
///
/// On a side that has not passed d_2, where B meets the pinched line, x_s = x_t = d_2. Elsewhere one of
///
///     x_s = c s,  s = u - (B(u) - p(u)) / (k - k_p)     c: share of the slack s, where the unloading line meets p
///     slope of reloading = k_0 (d_0 / (beta u))^alpha   SAWS: S0 (F0 / (S0 beta u))^alpha
///
/// and x_s >= d_2. A line of given slope that is above p at d_2 is reached from there with the stiffness k. If
/// p(x_t) > B(x_t), p is followed until it meets B. A spring that has never passed 1.05 d_2 is elastic on B. beta > 1: the second and later cycles of an amplitude reach less than the first one.
/// u becomes the largest displacement R when the force has fallen below the bound for u = R, so that a small turn back
/// returns to the backbone and no force jumps.
/// Behind the largest force the backbone may fall below p: then p passes through (R, B(R)), with less k_p, and less F_f
/// where B(R) < F_f. Both sides have the lesser values.
///
/// Energy. With G = F - k_p d, the stored energy is that of the pinched spring and of the unloading one,
///
///     stored = k_p d2/2 + G2 / (2 (k - k_p))
///     dissipated = integral of G (k - K) / (k - k_p) dd,     K: slope of the bound that is followed      (2)
///
/// Unloading dissipates nothing. On a bound G dd >= 0 and K <= k: (2) is never negative. Where k_p and F_f fall, the
/// stored energy falls as well. Forces, history and energies do not depend on the length of the steps.
#pragma once
#include "spring_law.hpp"
#include <cstddef>

namespace timber {

struct BackbonePoint;

/// Parameters of a spring.
struct WallCycles {
	double stiffness = 0; ///< k: of unloading [N/m]
	double friction = 0; ///< F_f [N]
	double pinchedStiffness = 0; ///< k_p [N/m]
	double target = 1; ///< beta, >= 1 [-]
	double reloadShare = 0; ///< c, 0 to 1: used if reloadStiffness is 0 [-]
	double reloadStiffness = 0; ///< k_0 [N/m]
	double reloadStretch = 0; ///< d_0 [m]
	double reloadPower = 0; ///< alpha [-]
};

/// Of one spring, and what it remembers.
struct WallHistory {
	double stretch = 0; ///< d [m]
	double force = 0; ///< F [N]
	double largest[2] = { 0, 0 }; ///< R of the sides d > 0, d < 0 [m]
	double reversed[2] = { 0, 0 }; ///< u: likewise [m]
};

struct WallForce {
	double tangent; ///< dF/dd of the line that the update has reached [N/m]
	double energy; ///< stored [J]
	double dissipated; ///< in this update, >= 0 [J]
	WallHistory history; ///< after the update, with the force
};

class WallLaw {
	/// A point of the backbone; W: integral of B up to it.
	struct Knot {
		double stretch, force, work; ///< [m, N, J]
	};
	std::vector<Knot> knots; ///< the origin first
	WallCycles cycles;
	double peak = 0; ///< stretch of the largest force [m]
	double meeting = 0; ///< d_2 [m]

	/// Force over stretch.
	struct Line {
		double slope, offset; ///< at zero stretch [N/m, N]
		double at(double x) const { return slope * x + offset; }
		bool operator==(const Line& o) const { return slope == o.slope && offset == o.offset; }
	};
	/// The bound of a side.
	struct Bound {
		Line pinched; ///< p: k_p, F_f
		double start, end; ///< x_s, x_t [m]
		Line reload;
	};

public:
	/// Last bounds of a spring: they are computed again when their arguments have changed.
	class Bounds {
		friend class WallLaw;
		struct Known {
			double u = -1;
			Bound bound {};
		};
		Known ofReversed[2], ofLargest[2]; ///< of each side
	};

private:
	/// Where a spring that moves towards a side arrives.
	struct Arrival {
		double force, slope, dissipated; ///< [N, N/m, J]
	};

	class Path;

	std::size_t segment(double x) const;
	double slopeOf(std::size_t segment) const;
	double workTo(double x) const;
	double meetingWith(const Line&, double from) const;
	double crossing(const Line&, double from) const;
	double slackOf(double u, const Line& pinched) const;
	Line pinched(const WallHistory&) const;
	Bound bound(double u, const Line& pinched) const;
	const Bound& bound(Bounds::Known&, double u, const Line& pinched) const;
	double valueAt(const Bound&, double x) const;
	double energyOf(const Line& pinched, double x, double force) const;
	double strongest(const WallHistory&, double stretch) const;
	Arrival moveAlong(const Bound&, double x0, double force0, double x1, const Line& after) const;
	bool isElastic(const WallHistory&) const;
	WallForce elastic(double stretch, const WallHistory& next) const;

public:
	WallLaw() = default;
	/// points: behind the origin, of ascending stretches; a last force > 0 remains beyond it.
	WallLaw(const WallCycles&, const std::vector<BackbonePoint>& points);

	/// Condition that the points violate, null if none; condition on the numbers of the cycles likewise.
	static const char* unmetBy(const WallCycles&, const std::vector<BackbonePoint>& points);
	bool isValid() const { return knots.size() > 1; }
	double stiffness() const { return cycles.stiffness; } ///< k [N/m]
	double force(double stretch) const; ///< B [N]
	double steepestFall() const; ///< of B, >= 0 [N/m]
	/// Whether no strength is left: a side has passed the last point of a backbone that ends without force.
	bool isSpent(const WallHistory& history) const
	{
		const double end = knots.back().stretch;
		return knots.back().force == 0 && (history.largest[0] >= end || history.largest[1] >= end);
	}
	/// To another stretch [m]. An update with the same stretch again changes nothing.
	WallForce advance(const WallHistory& history, double stretch) const
	{
		Bounds none;
		return advance(history, none, stretch);
	}
	/// bounds: of the spring, in-out
	WallForce advance(const WallHistory&, Bounds& bounds, double stretch) const;
	/// The same for a step that does not resolve the spring: where the backbone falls on the path, the spring keeps
	/// the largest force of the path, as on a plateau. The history keeps its largest stretches.
	WallForce hold(const WallHistory&, double stretch) const;
	double energy(const WallHistory&) const; ///< stored [J]
};

/// The springs of a wall. Signs and frames as in slip_law.hpp: stretches are projected on the axis.
class WallSprings : public SpringLaw {
	struct Spring {
		WallHistory history;
		WallLaw::Bounds bounds;
	};
	WallLaw law;
	Vec3 axis;
	std::vector<Spring> springs;

	SpringState along(const WallForce& force) const;

public:
	/// axis: unit vector in the frame of A
	WallSprings(const WallLaw& law_, const Vec3& axis_);
	std::vector<WallHistory> histories() const; ///< of each spring
	void setHistories(const std::vector<WallHistory>&);
	SpringTrial trial(size_t spring, const Vec3& to, bool keepsForce) const override;
	SpringState commit(size_t spring, const Vec3& to) override;
	bool isSpent(size_t spring) const override { return law.isSpent(springs[spring].history); }
	double steepestFall() const override { return law.steepestFall(); }
};

} // namespace timber
