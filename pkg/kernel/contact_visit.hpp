// SPDX-License-Identifier: GPL-2.0-or-later
/// One Gauss-Seidel visit of a contact point: equations (2) to (7) of docs/theory.md, section 5, and (8) of
/// contact_solver.hpp.
#pragma once
#include "constants.hpp"
#include "contact_point.hpp"
#include <cmath>

namespace timber {

// Functions that few visits need are not inlined: the registers are those of the usual visit.

/// Normal impulse that returns the energy A_n: p_A of (5). base: b [m/s].
[[gnu::noinline]] inline double energyImpulse(const PointStep& c, double base)
{
	return largestShare(c.before[0] + base, c.response(), c.energy);
}

/// Normal impulse with which an impact ends: p_w of (6), at least what stops the approach. base: b [m/s].
[[gnu::noinline]] inline double reboundImpulse(const PointStep& c, double base)
{
	const double soft = (c.rebound - base + reboundSoftness * (c.rebound - c.velocity[0])) / (1 + reboundSoftness);
	return std::max({ 0., soft, -base }) / c.response();
}

/// Normal spring that hardens, F(n) = F_1(n) + c n^q with a linear F_1, and its dashpot, over a closing displacement d
/// > 0. [m]
struct Hardening {
	/// c (n_0 + d)^q - c n_0^q (1 + q d / n_0): by which the force exceeds its linear extrapolation [N]
	double force;
	double slope; ///< its derivative by d [N/m]
	double damping; ///< C(n_0 + middle) - C_n [N s/m]
	double dampingSlope; ///< its derivative by middle [N s/m2]

	/// middle: displacement for the dashpot, <= d [m]
	Hardening(const PointStep& c, double d, double middle)
	{
		const double q = c.exponent, over = 1 / c.overlap, growth = d * over, stretch = 1 + growth,
		             rise = q == 1.5 ? std::sqrt(stretch) : power(stretch, q - 1);
		force = c.hardening * (stretch * rise - 1 - q * growth);
		slope = c.hardening * q * over * (rise - 1);
		damping = dampingSlope = 0;
		if (middle == 0) return;
		// C ~ K^1/2 ~ n^((q-1)/2)
		const double share = 1 + middle * over,
		             root = q == 1.5 ? std::sqrt(std::sqrt(share)) : power(share, (q - 1) / 2);
		damping = c.damping * (root - 1);
		dampingSlope = c.damping * (q - 1) / 2 * over * root / share;
	}
};

/// What a closing displacement d > 0 adds in (7), without (1 - a M_n).
struct HardeningImpulse {
	double value, slope; ///< [N s]; its derivative by d [N s/m]
};
inline HardeningImpulse hardeningImpulse(const PointStep& c, double d)
{
	const double h = c.step, a = c.response(), closing = -h * std::min(0., c.before[0]),
	             K = c.exponent * c.hardening / c.overlap;
	const bool exceeds = d > closing; // what the velocity before the step does not explain
	const Hardening spring(c, d, exceeds ? (d - closing) / 2 : 0);
	const double y = a * h * h * (K + spring.force / d), beta = y / (4 * y + 2);
	return { beta * h * spring.force + spring.damping * d,
		beta * h * spring.slope + spring.damping + (exceeds ? spring.dampingSlope * d / 2 : 0) };
}

/// Normal impulse of a point whose spring hardens within the step: (7). linear: p by (2) [N s]; closing: the
/// displacement d for it, > 0 [m].
/// In the unknown d, (7) is d + h a (1 - a M_n) more(d) = closing, whose left side increases: Newton's method within
/// bounds.
[[gnu::noinline]] inline double hardenedImpulse(const PointStep& c, double linear, double closing)
{
	const double h = c.step, a = c.response(), factor = h * a * (1 - a * c.mass[0]);
	double low = 0, high = std::min(closing, c.overlapLeft), d = high;
	for (int k = 0; k < hardeningSteps; ++k) {
		const HardeningImpulse more = hardeningImpulse(c, d);
		// The force is constant at the end
		if (k == 0 && closing - factor * more.value > c.overlapLeft)
			return linear + (factor / (h * a)) * more.value;
		const double excess = d + factor * more.value - closing,
		             newton = d - excess / (1 + factor * more.slope), last = d;
		(excess > 0 ? high : low) = d;
		const bool isInside = newton >= low && newton <= high;
		d = isInside ? newton : (low + high) / 2;
		// The error is less than the square of the last change, over d
		if (isInside && (d - last) * (d - last) <= hardeningTolerance * d * d) break;
	}
	return linear + (closing - d) / (h * a);
}

/// Normal impulse (3): the least of what springs and dashpots give, (2) or (7), of what the energy (5), the impact (6)
/// and the strength admit. un: u_n [m/s];
/// linear: p_n by (2) [N s]. As a function of the velocity b without the point's impulse it is continuous and does not
/// increase.
[[gnu::always_inline]] inline double normalImpulse(PointStep& c, double un, double linear)
{
	const double a = c.response(), base = un - a * c.impulse[0];
	const double closing = -c.step * (base + a * linear) - hardeningShare * c.overlap;
	double p = std::max(0., c.hardening > 0 && closing > 0 ? hardenedImpulse(c, linear, closing) : linear);
	if (a > 0 && p * (c.before[0] + base + a * p) > 2 * c.energy) p = std::min(p, energyImpulse(c, base)); // (5)
	c.bounded = false;
	if (c.rebound < noRebound) { // (6)
		const double bound = reboundImpulse(c, base);
		if (bound < p) p = bound, c.bounded = true;
	}
	return std::min(p, c.strength);
}

/// Rule (5) for the tangential impulse p of a point, in the axes of its tangents.
struct ShearAccount {
	Vec2 velocity; ///< v + b [m/s]
	Mat2 response; ///< S: velocity change by a unit impulse [1/kg]
	double account; ///< A_s [J]

	/// By how much p returns more than the account, times two. [J]
	double excess(const Vec2& p) const { return p.dot(velocity + response * p) - 2 * account; }
	/// p, shortened if it returns more. [N s]
	Vec2 shortened(const Vec2& p) const
	{
		const double linear = p.dot(velocity), square = p.dot(response * p);
		return linear + square > 2 * account ? Vec2(p * largestShare(linear, square, account)) : p;
	}
	/// The impulse closest to p, which returns too much, that does not: p(l) = (1 + 2 l S)^-1 (p - l (v + b)), whose
	/// excess falls with l and is convex. Newton's method does not pass the root.
	Vec2 closestTo(const Vec2& p) const
	{
		Vec2 q = p;
		double l = 0;
		for (int k = 0; k < projectionSteps; ++k) {
			const Mat2 matrix = Mat2::Identity() + 2 * l * response;
			const auto solved = [&](const Vec2& x) {
				return Vec2(Vec2(matrix(1, 1) * x[0] - matrix(0, 1) * x[1],
				                    matrix(0, 0) * x[1] - matrix(0, 1) * x[0])
				        / matrix.determinant());
			};
			q = solved(p - l * velocity);
			const double more = excess(q);
			if (more <= projectionTolerance * q.dot(response * q)) break;
			const Vec2 slope = velocity + 2 * (response * q);
			l += more / slope.dot(solved(slope));
		}
		return shortened(q);
	}
};

/// S p in the places of the tangents: their velocity change by a tangential impulse. [m/s]
[[gnu::always_inline]] inline PointStep::Quad shearChange(const PointStep& c, const PointStep::Quad& p)
{
	const PointStep::Quad& a = c.shearResponse;
	return __builtin_shufflevector(a, a, 3, 0, 1, 3) * p[1] + a * p[2];
}

/// p, whose tangential part returns more than the account, with the closest one that does not. velocity: v + b [m/s];
/// limit: of friction [N s].
[[gnu::noinline]] inline PointStep::Quad withinAccount(
        const PointStep& c, PointStep::Quad p, PointStep::Quad velocity, double limit)
{
	const PointStep::Quad& a = c.shearResponse;
	ShearAccount limits { Vec2(velocity[1], velocity[2]), Mat2(), c.shearEnergy };
	limits.response << a[0], a[1], a[1], a[2];
	const Vec2 shear = clipped(limits.closestTo(Vec2(p[1], p[2])), limit);
	p[1] = shear[0];
	p[2] = shear[1];
	return p;
}

/// Tangential impulse within the limits (4) of friction, mu normal, and (5) of energy, in the places of the tangents. p:
/// by (2); before: impulse before the visit; u: velocity with that impulse and the new normal one [m/s].
[[gnu::always_inline]] inline PointStep::Quad limitedShear(
        const PointStep& c, PointStep::Quad p, double normal, const PointStep::Quad& before, const PointStep::Quad& u)
{
	const double limit = c.friction * normal;
	const PointStep::Quad velocity = c.before + u - shearChange(c, before), squares = p * p;
	const double square = squares[1] + squares[2];
	if (square > limit * limit) p *= limit / std::sqrt(square);
	const PointStep::Quad work = p * (velocity + shearChange(c, p));
	// No impulse moves two fixed bodies. Both limits are convex and contain 0: shortening keeps (5)
	const bool returnsTooMuch = work[1] + work[2] > 2 * c.shearEnergy && c.shearResponse[0] > 0;
	return returnsTooMuch ? withinAccount(c, p, velocity, limit) : p;
}

/// One visit. velocity: change of the pair's weighted velocities, in-out. Returns the squared change of the impulse.
[[gnu::always_inline]] inline double visitPoint(PointStep& c, PairVector& velocity)
{
	// (8), (2)
	PointStep::Quad u = c.velocity + velocity.dots(c.rows), p = c.factor * c.impulse + c.bias - c.mass * u;
	const double pn = normalImpulse(c, u[0], p[0]), normalChange = pn - c.impulse[0];
	// No shear without a normal impulse
	if (pn == 0 && c.impulse[0] == 0 && c.impulse[1] == 0 && c.impulse[2] == 0) return 0;
	velocity.add(c.rows[0], normalChange); // before the tangents: the processor need not wait for them
	const PointStep::Quad slip = normalChange * c.column; // caused by the change of the normal impulse
	p = limitedShear(c, p - c.mass * slip, pn, c.impulse, u + slip); // (4)
	const PointStep::Quad change = p - c.impulse, squares = change * change;
	for (int i = 1; i < 3; ++i)
		velocity.add(c.rows[i], change[i]);
	c.impulse = p;
	c.impulse[0] = pn;
	return normalChange * normalChange + squares[1] + squares[2];
}

} // namespace timber
