// SPDX-License-Identifier: GPL-2.0-or-later
/// Elastic part of the contact laws at one contact point (paper, sections 2.3 and 3.1). Dashpots: contact_solver.hpp.
/// Signs: the normal runs from body A to body B; forces are those on B, A gets the opposite; a normal force is >= 0
/// and pushes the bodies apart.
#pragma once
#include "constants.hpp"
#include "contact_solver.hpp"
#include "simd.hpp"
#include "manifold.hpp"
#include <algorithm>
#include <cmath>

namespace timber {

/// E* = (sum (1 - nu^2)/E)^-1 (Eq. 35). Young's moduli [Pa], Poisson's ratios [-]; returns [Pa].
inline double equivalentModulus(double young1, double poisson1, double young2, double poisson2)
{
	return 1 / ((1 - poisson1 * poisson1) / young1 + (1 - poisson2 * poisson2) / young2);
}

/// Half the harmonic mean: radius of Eq. 36 [m], mass of Eq. 43 [kg]. Infinite arguments stand for fixed bodies.
inline double reduced(double x, double y) { return 1 / (1 / x + 1 / y); }

/// Radius of the sphere of the same volume (section 3.1). volume [m3]; returns [m].
inline double equivalentRadius(double volume) { return std::cbrt(3 * volume / (4 * M_PI)); }

/// Timber on timber: Hertz (Eqs. 37-39). overlap n [m].
struct HertzLaw {
	double modulus; ///< E* [Pa]
	double radius; ///< r [m]
	template <class Number> Number force(Number n) const { return Number(4. / 3 * modulus) * root(Number(radius) * n) * n; } ///< [N] (Eq. 37)
	template <class Number> Number stiffness(Number n) const { return Number(2 * modulus) * root(Number(radius) * n); } ///< [N/m] (Eq. 39)
	template <class Number> Number energy(Number n) const { return Number(0.4) * force(n) * n; } ///< [J]
	double overlapOf(double energy) const { return std::pow(15 * energy / (8 * modulus * std::sqrt(radius)), 0.4); } ///< inverse of energy() [m]
};

/// Snow: constant stiffness, proportional to the snow's mass (Table 1).
struct LinearLaw {
	double constant; ///< [N/m]
	template <class Number> Number force(Number n) const { return Number(constant) * n; }
	template <class Number> Number stiffness(Number) const { return Number(constant); }
	template <class Number> Number energy(Number n) const { return Number(0.5 * constant) * n * n; }
	double overlapOf(double energy) const { return std::sqrt(2 * energy / constant); }
};

/// What two bodies in contact share.
struct PairProperties {
	double mass = 0; ///< m (Eq. 43) [kg]
	double friction = 0; ///< Coulomb coefficient [-]
	double shearRatio = 1; ///< K_s / K_n: 1/(2(1+nu)) for timber (Eq. 40), 1 for snow [-]
	double overlapLimit = 0; ///< the force stays constant beyond it: the cores touch [m]
};

/// What the springs of a contact point remember between steps. Forces act on B.
template <class Number> struct Springs {
	Number excess = 0.; ///< overlap that was there at birth and carries no force, see bornOverlap() [m]
	Number overlap = 0.; ///< counted overlap n = overlap - excess, at most the limit [m]
	Number stiffness = 0.; ///< K_n [N/m]
	Number normal = 0.; ///< elastic normal force e_n [N]
	Number energy = 0.; ///< stored by the normal spring; beyond the limit, where the force is constant, it grows linearly [J]
	Vec3Of<Number> shear = Vec3Of<Number>::Constant(Number(0.)); ///< elastic tangential force e_s [N]
	Vec3Of<Number> slide = Vec3Of<Number>::Constant(Number(0.)); ///< tangential displacement of B against A in the last step [m]
	Vec3Of<Number> shearBefore = Vec3Of<Number>::Constant(Number(0.)); ///< e_s before that displacement [N]
	Number shearEnergyBefore = 0.; ///< [J]
};

/// What a contact point remembers between steps.
struct PointState : Springs<double>, PointResponse {
	FeatureId id;
	Vec3 dashpot = Vec3::Zero(); ///< what the force of the last step had besides the elastic one, on B [N]
	double closing = 0; ///< closing displacement of the step that follows, by its velocities [m]
	double arrival = 0; ///< closing displacement that brought a new point, until its first step is booked; 0: it is none, or others paid for it [m]
};

/// Motion of B against A at a contact point.
template <class Number> struct PointMotion {
	Vec3Of<Number> velocity; ///< [m/s]
	Vec3 spin; ///< mean angular velocity of the two bodies: the contact turns with it [rad/s]
};

/// Overlap that an approach within a step explains at a point: its way, but no more than its kinetic energy can press there. A stiff
/// contact stops a fast light member before the step has ended.
/// mass: equivalent [kg], speed: of closing, >= 0 [m/s], h: step [s]; returns [m].
template <class Law> double approachOverlap(const Law& law, double mass, double speed, double h) { return std::min(speed * h, law.overlapOf(mass / 2 * speed * speed)); }

/// Overlap with which a new point may start: what its approach in the last step explains, or what the energy that the pair
/// lost with other points in that step can pay for (a vertex that slides over a border hands its load to the crossing
/// edges). The patterns that the paper ignores (vertex on edge) let a vertex come deep before a face answers; answering at
/// once with the full force would create energy.
/// overlap [m] > 0, approach: approachOverlap() [m], energy [J] >= 0; returns [m].
template <class Law> double bornOverlap(const Law& law, double overlap, double approach, double energy) { return std::min(overlap, std::max(approach, law.overlapOf(std::max(0., energy)))); }

/// Energy that a tangential spring stores with a force. [J]
template <class Number> Number shearEnergy(const Vec3Of<Number>& force, Number stiffness)
{
	return chosen(stiffness > Number(0.), [&] { return Number(force.squaredNorm() / (Number(2.) * stiffness)); }, [] { return Number(0.); });
}
template <class Number> Number shearEnergy(const Springs<Number>& s, const PairProperties& p) { return shearEnergy<Number>(s.shear, Number(p.shearRatio) * s.stiffness); }

/// Turns a tangential force with the contact: with the mean spin of the bodies, then into the plane normal to n.
/// Its length stays.
template <class Number> [[gnu::always_inline]] inline Vec3Of<Number> turned(const Vec3Of<Number>& shear, const Vec3& turn, const Vec3Of<Number>& normal)
{
	const Number length = shear.squaredNorm();
	Vec3Of<Number> t = shear + wide<Number>(turn).cross(shear);
	t -= t.dot(normal) * normal;
	const Number left = t.squaredNorm(), none = 0.;
	return t * chosen(left > none, [&] { return root(Number(length / left)); }, [&] { return none; });
}

/// Force of a point that comes or goes within a step: its overlap n [m] is below its displacement d in a step [m]. Before
/// or after it there was none, and the trapezoid sum of the work over the two steps, F(n) d + F(n + d) d / 2, must be the
/// energy at n + d; with the force of n itself, impacts that last few steps lose energy. Exact for a linear law. [N]
template <class Law, class Number> Number grazingForce(const Law& law, Number n, Number d)
{
	return most(Number(0.), Number(law.energy(Number(n + d)) / d - law.force(Number(n + d)) / Number(2.)));
}

/// The same for the books, once it is known how far a new point goes on: the force at n whose work over the step that brought the
/// point, d, and the next one, d', is the energy that the spring has then, F' (d + d') / 2 + F(n + d') d' / 2 = U(n + d'). Dashpots stop
/// a light fast member where grazingForce() has it fly on; what the force of the step had besides F' is theirs. With F ~ n^e,
/// e (e + 1) = K n^2 / U. A point on its way out that parts in the step after that has only the grazing force then.
/// At n: energy U [J], stiffness K [N/m], overlap n [m]; arrival d >= n, next d' [m]; returns [N].
inline double arrivalForce(double energy, double stiffness, double overlap, double arrival, double next)
{
	const double left = overlap + next;
	if (left <= 0 || energy == 0) return 0; // it parts again within the step; or hardly touches
	const double power = (std::sqrt(1 + 4 * stiffness * overlap * overlap / energy) - 1) / 2, force = stiffness * overlap / power, share = left / overlap;
	if (left < -next) return 2 * std::max(0., energy + force * next / 2) / (arrival + next);
	return (2 * energy * std::pow(share, power + 1) - force * std::pow(share, power) * next) / (arrival + next);
}

/// Normal force: the closed form (Eq. 37), or its increment form (Eq. 38), which sums K_n times the change of overlap.
enum class NormalForm { Closed, Increment };

/// Elastic forces of one point for its new normal, overlap and displacement (Eqs. 15, 16, 19, 20).
/// The tangential spring keeps its force while n grows and loses force with K_s while n shrinks, so it never creates
/// energy. Sliding is decided where the total normal force is known (contact_solver.hpp).
/// in: law, pair, point, motion, dt [s]; in-out: state (a new one has only its excess).
template <class Law, class Point, class Number>
void elasticStep(const Law& law, const PairProperties& pair, const Point& point, const PointMotion<Number>& motion, double dt, NormalForm form, Springs<Number>& state)
{
	const Number h = dt, none = 0., limit = pair.overlapLimit, closing = -motion.velocity.dot(point.normal) * h;
	state.excess = least(state.excess, point.overlap);
	const Number before = state.overlap, stiffnessBefore = state.stiffness, whole = point.overlap - state.excess;
	state.overlap = least(whole, limit);
	state.stiffness = law.stiffness(state.overlap);
	if (form == NormalForm::Closed) {
		state.normal = law.force(state.overlap);
		const Number way = most(closing, Number(-closing));
		const auto grazes = both(none < state.overlap, state.overlap < least(way, limit));
		state.normal = chosen(grazes, [&] { return grazingForce(law, state.overlap, way); }, [&] { return state.normal; });
	} else
		state.normal = most(none, Number(state.normal + state.stiffness * (state.overlap - before)));
	state.energy = law.energy(state.overlap) + (whole - state.overlap) * state.normal;

	const Number shearStiffness = Number(pair.shearRatio) * state.stiffness;
	state.shear = turned<Number>(state.shear, motion.spin * dt, point.normal);
	state.shearBefore = state.shear;
	state.shearEnergyBefore = shearEnergy<Number>(state.shear, Number(pair.shearRatio) * stiffnessBefore);
	state.shear *= chosen(state.stiffness < stiffnessBefore, [&] { return Number(state.stiffness / stiffnessBefore); }, [] { return Number(1.); });
	state.slide = (motion.velocity + Number(closing / h) * point.normal) * h;
	state.shear -= shearStiffness * state.slide;
}

} // namespace timber
