// SPDX-License-Identifier: GPL-2.0-or-later
/// Elastic part of the contact laws at one contact point (paper, sections 2.3 and 3.1). Dashpots: dashpots.hpp.
/// Signs: the normal runs from body A to body B; forces are those on B, A gets the opposite; a normal force is >= 0
/// and pushes the bodies apart.
#pragma once
#include "constants.hpp"
#include "dashpots.hpp"
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
	double force(double n) const { return 4. / 3 * modulus * std::sqrt(radius * n) * n; } ///< [N] (Eq. 37)
	double stiffness(double n) const { return 2 * modulus * std::sqrt(radius * n); } ///< [N/m] (Eq. 39)
	double energy(double n) const { return 0.4 * force(n) * n; } ///< [J]
	double overlapOf(double energy) const { return std::pow(15 * energy / (8 * modulus * std::sqrt(radius)), 0.4); } ///< inverse of energy() [m]
};

/// Snow: constant stiffness, proportional to the snow's mass (Table 1).
struct LinearLaw {
	double constant; ///< [N/m]
	double force(double n) const { return constant * n; }
	double stiffness(double) const { return constant; }
	double energy(double n) const { return 0.5 * constant * n * n; }
	double overlapOf(double energy) const { return std::sqrt(2 * energy / constant); }
};

/// What two bodies in contact share.
struct PairProperties {
	double mass = 0; ///< m (Eq. 43) [kg]
	double friction = 0; ///< Coulomb coefficient [-]
	double shearRatio = 1; ///< K_s / K_n: 1/(2(1+nu)) for timber (Eq. 40), 1 for snow [-]
	double overlapLimit = 0; ///< the force stays constant beyond it: the cores touch [m]
};

/// What a contact point remembers between steps. Forces act on B.
struct PointState {
	FeatureId id;
	double excess = 0; ///< overlap that was there at birth and carries no force, see bornOverlap() [m]
	double overlap = 0; ///< counted overlap n = overlap - excess, at most the limit [m]
	double stiffness = 0; ///< K_n [N/m]
	double normal = 0; ///< elastic normal force e_n [N]
	double energy = 0; ///< stored by the normal spring; beyond the limit, where the force is constant, it grows linearly [J]
	Vec3 shear = Vec3::Zero(); ///< elastic tangential force e_s [N]
	Vec3 dashpot = Vec3::Zero(); ///< dashpot force of the last step [N]
	PointResponse response; ///< kept for some steps
	double closing = 0; ///< closing displacement of the last step [m]
	Vec3 slide = Vec3::Zero(); ///< tangential displacement of B against A in the last step [m]
	Vec3 shearBefore = Vec3::Zero(); ///< e_s before that displacement [N]
	double shearEnergyBefore = 0; ///< [J]
};

/// Motion of B against A at a contact point.
struct PointMotion {
	Vec3 velocity; ///< [m/s]
	Vec3 spin; ///< mean angular velocity of the two bodies: the contact turns with it [rad/s]
};

/// Overlap with which a new point may start: what its approach in the last step explains, or what the energy that the pair
/// lost with other points in that step can pay for (a vertex that slides over a border hands its load to the crossing
/// edges). The patterns that the paper ignores (vertex on edge) let a vertex come deep before a face answers; answering at
/// once with the full force would create energy.
/// overlap [m] > 0, approach: closing displacement [m], energy [J] >= 0; returns [m].
template <class Law> double bornOverlap(const Law& law, double overlap, double approach, double energy) { return std::min(overlap, std::max(approach, law.overlapOf(std::max(0., energy)))); }

/// Stored energy of the tangential spring. [J]
inline double shearEnergy(const PointState& s, const PairProperties& p)
{
	const double stiffness = p.shearRatio * s.stiffness;
	return stiffness > 0 ? s.shear.squaredNorm() / (2 * stiffness) : 0;
}

/// Turns a tangential force with the contact: with the mean spin of the bodies, then into the plane normal to n.
/// Its length stays.
inline Vec3 turned(const Vec3& shear, const Vec3& turn, const Vec3& normal)
{
	const double length = shear.squaredNorm();
	if (length == 0) return shear;
	Vec3 t = shear + turn.cross(shear);
	t -= t.dot(normal) * normal;
	const double left = t.squaredNorm();
	return left > 0 ? Vec3(t * std::sqrt(length / left)) : Vec3(Vec3::Zero());
}

/// Force of a point that comes or goes within a step: its overlap n [m] is below its displacement d in a step [m]. Before
/// or after it there was none, and the trapezoid sum of the work over the two steps, F(n) d + F(n + d) d / 2, must be the
/// energy at n + d; with the force of n itself, impacts that last few steps lose energy. Exact for a linear law. [N]
template <class Law> double grazingForce(const Law& law, double n, double d) { return std::max(0., law.energy(n + d) / d - law.force(n + d) / 2); }

/// Normal force: the closed form (Eq. 37), or its increment form (Eq. 38), which sums K_n times the change of overlap.
enum class NormalForm { Closed, Increment };

/// Elastic forces of one point for its new overlap and displacement (Eqs. 15, 16, 19, 20).
/// The tangential spring keeps its force while n grows and loses force with K_s while n shrinks, so it never creates
/// energy. Sliding is decided where the total normal force is known (dashpots.hpp).
/// in: law, pair, point, motion, dt [s]; in-out: state (a new one has only its id and excess).
template <class Law>
void elasticStep(const Law& law, const PairProperties& pair, const ContactPoint& point, const PointMotion& motion, double dt, NormalForm form, PointState& state)
{
	state.closing = -motion.velocity.dot(point.normal) * dt;
	state.excess = std::min(state.excess, point.overlap);
	const double before = state.overlap, stiffnessBefore = state.stiffness;
	state.overlap = std::min(point.overlap - state.excess, pair.overlapLimit);
	state.stiffness = law.stiffness(state.overlap);
	state.normal = form == NormalForm::Closed ? law.force(state.overlap) : std::max(0., state.normal + state.stiffness * (state.overlap - before));

	const double way = std::abs(state.closing);
	const bool grazes = 0 < state.overlap && state.overlap < std::min(way, pair.overlapLimit);
	if (form == NormalForm::Closed && grazes) state.normal = grazingForce(law, state.overlap, way);
	state.energy = law.energy(state.overlap) + (point.overlap - state.excess - state.overlap) * state.normal;

	state.shear = turned(state.shear, motion.spin * dt, point.normal);
	state.shearBefore = state.shear;
	state.shearEnergyBefore = stiffnessBefore > 0 ? state.shear.squaredNorm() / (2 * pair.shearRatio * stiffnessBefore) : 0;
	if (state.stiffness < stiffnessBefore) state.shear *= state.stiffness / stiffnessBefore;
	state.slide = (motion.velocity + state.closing / dt * point.normal) * dt;
	state.shear -= pair.shearRatio * state.stiffness * state.slide;
}

} // namespace timber
