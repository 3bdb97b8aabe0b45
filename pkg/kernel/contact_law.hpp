// SPDX-License-Identifier: GPL-2.0-or-later
/// Contact laws at one contact point (paper, sections 2.3 and 3.1): elastic forces, dashpot constants, sliding of the
/// tangential spring.
/// contact_solver.hpp applies the dashpots and Coulomb's limit of the total force.
/// Adapters: Law2_ManifoldGeom_TimberPhys_Hertz, Law2_ManifoldGeom_SnowPhys_Linear (pkg/ContactPhysics.hpp), by
/// elasticPair().
/// Signs: the normal points from body A to body B; forces act on B, A gets the opposite; a normal force is >= 0 and
/// pushes the bodies apart. Joints have the opposite convention (joint_law.hpp).
#pragma once
#include "bearing_strength.hpp"
#include "constants.hpp"
#include "contact_step.hpp"
#include "portable_math.hpp"
#include "preconditions.hpp"
#include <algorithm>
#include <cassert>
#include <cmath>
#include <type_traits>

namespace timber {

/// E* = (sum (1 - nu^2)/E)^-1 (Eq. 35). Young's moduli [Pa], Poisson's ratios [-]; returns [Pa].
inline double equivalentModulus(double young1, double poisson1, double young2, double poisson2)
{
	return 1 / ((1 - poisson1 * poisson1) / young1 + (1 - poisson2 * poisson2) / young2);
}

/// Half the harmonic mean: radius of Eq. 36 [m], mass of Eq. 43 [kg]. Infinite arguments stand for fixed bodies.
inline double reduced(double x, double y) { return 1 / (1 / x + 1 / y); }

/// Radius of the sphere of the same volume (section 3.1). volume [m3]; returns [m].
inline double equivalentRadius(double volume) { return power(3 * volume / (4 * M_PI), 1. / 3); }

// A law has force(n) [N], stiffness(n) = dF/dn [N/m], energy(n) = integral of F [J] and its inverse overlapOf(energy)
// [m], and the exponent q of its part that hardens: F = k n + c n^q with k, c >= 0. q = 1: no hardening.

/// Timber on timber: Hertz (Eqs. 37-39). overlap n [m].
struct HertzLaw {
	double modulus; ///< E* [Pa]
	double radius; ///< r [m]
	static constexpr double exponent = 1.5; ///< q [-]
	/// [N] (Eq. 37).
	template <class Number> Number force(Number n) const
	{
		return Number(4. / 3 * modulus) * sqrt(Number(radius) * n) * n;
	}
	/// [N/m] (Eq. 39).
	template <class Number> Number stiffness(Number n) const
	{
		return Number(2 * modulus) * sqrt(Number(radius) * n);
	}
	template <class Number> Number energy(Number n) const { return Number(0.4) * force(n) * n; } ///< [J]
	/// Inverse of energy() [m]
	double overlapOf(double energy) const
	{
		return timber::power(15 * energy / (8 * modulus * std::sqrt(radius)), 0.4);
	}
};

/// Constant stiffness. Snow: proportional to its mass (Table 1). overlap n [m].
struct LinearLaw {
	double constant; ///< [N/m]
	static constexpr double exponent = 1; ///< q [-]
	template <class Number> Number force(Number n) const { return Number(constant) * n; } ///< [N]
	template <class Number> Number stiffness(Number) const { return Number(constant); } ///< [N/m]
	template <class Number> Number energy(Number n) const { return Number(0.5 * constant) * n * n; } ///< [J]
	double overlapOf(double energy) const { return std::sqrt(2 * energy / constant); } ///< inverse of energy() [m]
};

/// Properties of a pair in contact.
struct PairProperties {
	double mass = 0; ///< m (Eq. 43) [kg]
	double friction = 0; ///< Coulomb coefficient [-]
	double shearRatio = 1; ///< K_s / K_n: 1/(2(1+nu)) for timber (Eq. 40), 1 for snow [-]
	double overlapLimit = 0; ///< the normal force is constant beyond it: the cores touch [m]
	double dampingRatio = 1; ///< share of critical damping, C = 2 ratio sqrt(m K) (Eqs. 41, 42: 1) [-]
	double exponent = HertzLaw::exponent; ///< exponent q of the law [-]
	BearingStrength strength; ///< of each point
};

/// Dashpot constants of a point, C_n (Eq. 41) and C_s (Eq. 42). stiffness: K_n [N/m]; returns [N s/m].
template <class Number> [[gnu::always_inline]] inline Number normalDamping(const PairProperties& pair, Number stiffness)
{
	return Number(2 * pair.dampingRatio) * sqrt(Number(pair.mass) * stiffness);
}
template <class Number>
[[gnu::always_inline]] inline Number shearDamping(const PairProperties& pair, Number normalDamping)
{
	return normalDamping * Number(std::sqrt(pair.shearRatio));
}

/// Overlap explained by the approach within a step: the closing displacement, bounded by the overlap that the kinetic
/// energy can compress. A stiff contact stops a fast light member within the step.
/// mass: equivalent, infinite between two fixed bodies [kg], speed: of closing, >= 0 [m/s], h: step [s]; returns [m].
template <class Law> double approachOverlap(const Law& law, double mass, double speed, double h)
{
	assert(mass > 0 && speed >= 0 && h > 0);
	if (speed == 0) return 0;
	return std::min(speed * h, law.overlapOf(mass / 2 * speed * speed));
}

/// Effective overlap of a new point: explained by its approach in the last step, or paid for by the energy released
/// with other points of the pair in that step (a vertex that slides over a border transfers its load to the crossing
/// edges). Kinds of contact that the paper ignores (vertex on edge) let a vertex penetrate before a face detects it; the
/// full force at once would create energy.
/// overlap [m] > 0, approach: approachOverlap() [m], energy [J]; returns [m].
template <class Law> double initialOverlap(const Law& law, double overlap, double approach, double energy)
{
	assert(overlap > 0 && approach >= 0 && std::isfinite(energy));
	return std::min(overlap, std::max(approach, law.overlapOf(std::max(0., energy))));
}

/// Elastic part n of an overlap `total` beyond the plastic one c, of which the rest is plastic as well: F(n) = F_Y(c +
/// total - n), or the whole, at most the limit, if its force is smaller. [m]
/// Newton's method from above: F is convex.
template <class Law>
double elasticOverlap(const Law& law, const BearingStrength& strength, double c, double total, double limit)
{
	double n = std::min(total, limit);
	for (int k = 0; k < yieldSteps; ++k) {
		const double plastic = c + total - n, excess = law.force(n) - strength.force(plastic), last = n;
		if (k == 0 && excess <= 0) break;
		n = std::max(0., n - excess / (law.stiffness(n) + strength.slope(plastic)));
		if (std::abs(n - last) <= yieldTolerance * last) break;
	}
	return n;
}
template <class Law>
Lanes elasticOverlap(const Law& law, const BearingStrength& strength, const Lanes& c, const Lanes& total, double limit)
{
	Lanes n = total;
	for (int i = 0; i < laneCount; ++i)
		n.v[i] = elasticOverlap(law, strength, c.v[i], total.v[i], limit);
	return n;
}

/// Energy of a tangential spring. [J]
template <class Number> Number shearEnergy(const Vec3Of<Number>& force, Number stiffness)
{
	return selectLazily(
	        stiffness > Number(0.), [&] { return Number(force.squaredNorm() / (Number(2.) * stiffness)); },
	        [] { return Number(0.); });
}

/// Rotates a tangential force with the contact: by the rotation vector [rad] of the bodies' mean spin, then into the
/// plane normal to n.
/// The magnitude is preserved.
template <class Number>
[[gnu::always_inline]] inline Vec3Of<Number> rotatedShear(
        const Vec3Of<Number>& shear, const Vec3& rotation, const Vec3Of<Number>& normal)
{
	assert(isFinite(rotation));
	const Number square = shear.squaredNorm(), none = 0.;
	Vec3Of<Number> t = shear + broadcast<Number>(rotation).cross(shear);
	t -= t.dot(normal) * normal;
	const Number remaining = t.squaredNorm();
	return t
	        * selectLazily(
	                remaining > none, [&] { return sqrt(Number(square / remaining)); }, [&] { return none; });
}

/// Normal force: the closed form (Eq. 37), or its increment form (Eq. 38), which sums K_n times the change of overlap.
enum class NormalForm { Closed, Increment };

/// Plastic part of a step: springs whose force exceeds the strength. total: overlap without the plastic and
/// the unloaded one [m], in-out.
template <class Law, class Number>
void crush(const Law& law, const PairProperties& pair, PointSprings<Number>& s, Number& total)
{
	const auto yields = s.normalForce > pair.strength.force(s.crushed);
	s.overlap = elasticOverlap(law, pair.strength, s.crushed, total, pair.overlapLimit);
	const Number plastic = select(yields, Number(total - s.overlap), Number(0.));
	s.crushed += plastic;
	total -= plastic;
	s.stiffness = law.stiffness(s.overlap);
	s.normalForce = law.force(s.overlap);
}

/// Elastic forces of one point for its new normal, overlap and displacement (Eqs. 15, 16, 19, 20).
/// The tangential spring keeps its force while n grows and loses force with K_s while n shrinks, so it never creates
/// energy. It slides in storeForces(), once the total normal force is known.
/// What the strength does not bear becomes plastic overlap. The increment form has no strength.
/// in: law, pair, point, motion, length h of the step [s]; in-out: springs (a new point has only its unloaded overlap).
template <class Law, class Point, class Number>
[[gnu::always_inline]] inline void elasticStep(const Law& law, const PairProperties& pair, const Point& point,
        const RelativeMotion<Number>& motion, double h, NormalForm form, PointSprings<Number>& springs)
{
	assert(h > 0 && pair.shearRatio > 0 && pair.overlapLimit >= 0);
	assert(form == NormalForm::Closed || !pair.strength.isLimited());
	const Number none = 0., limit = pair.overlapLimit;
	const Number above = max(none, Number(point.overlap - springs.crushed));
	springs.unloadedOverlap = min(springs.unloadedOverlap, above);
	const Number before = springs.overlap, stiffnessBefore = springs.stiffness;
	Number total = above - springs.unloadedOverlap;
	springs.overlap = min(total, limit);
	springs.stiffness = law.stiffness(springs.overlap);
	if (form == NormalForm::Closed) springs.normalForce = law.force(springs.overlap);
	else {
		const Number sum = springs.normalForce + springs.stiffness * (springs.overlap - before);
		springs.normalForce = select(springs.overlap > none, max(none, sum), none);
	}
	if (pair.strength.isLimited() && any(springs.normalForce > pair.strength.force(springs.crushed)))
		crush(law, pair, springs, total);
	springs.energy = law.energy(springs.overlap) + (total - springs.overlap) * springs.normalForce;

	springs.shearForce = rotatedShear<Number>(springs.shearForce, motion.spin * h, point.normal);
	springs.shearForce *= selectLazily(
	        springs.stiffness < stiffnessBefore, [&] { return Number(springs.stiffness / stiffnessBefore); },
	        [] { return Number(1.); });
	const Vec3Of<Number> slip = (motion.velocity - motion.velocity.dot(point.normal) * point.normal) * Number(h);
	springs.shearForce -= Number(pair.shearRatio) * springs.stiffness * slip;
}

} // namespace timber
