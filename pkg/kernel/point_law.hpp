// SPDX-License-Identifier: GPL-2.0-or-later
/// Impulse of a contact point as a function of the velocity u' after the step: the fixed points of its visits
/// (contact_visit.hpp), for Newton's method (contact_newton.cpp). Symbols: contact_solver.hpp.
/// At a fixed point p = f p + B - M u', so that (2) is p = (B - M u') / (1 - f), and the limits (5), (6) are
///     p (v + v' + eps a p) / 2 <= A                                                              (1)
///     p_w = max((w + s (w - u_n0) - v') / (a s), -v' / (eps a))                                  (2)
/// With the softness eps = 0, (1) lets p jump at v' = -v where A = 0, and (2) at v' = 0; eps > 0 makes them continuous
/// there, and the point returns less than A.
#pragma once
#include "contact_visit.hpp"

namespace timber {

/// p_n. It does not increase with v'. after: v' [m/s]; softness: eps [-]; returns [N s].
inline double normalImpulseAt(PointStep& c, double after, double softness)
{
	const double a = c.response(), closing = -c.step * after - hardeningShare * c.overlap;
	double p = (c.bias[0] - c.mass[0] * after) / (1 - c.factor[0]);
	if (c.hardening > 0 && closing > 0) p += hardeningImpulse(c, std::min(closing, c.overlapLeft)).value;
	p = std::max(0., p);
	const double sum = c.before[0] + after, soft = softness * a;
	if (p * (sum + soft * p) > 2 * c.energy) p = std::min(p, largestShare(sum, soft, c.energy));
	c.bounded = false;
	if (c.rebound < noRebound) {
		const double bound = std::max({ 0., -after / soft,
		        (c.rebound + reboundSoftness * (c.rebound - c.velocity[0]) - after) / (a * reboundSoftness) });
		if (bound < p) p = bound, c.bounded = true;
	}
	return std::min(p, c.strength);
}

/// p_s: (4), shortened to mu p_n and to what (5) admits. after: u_s' [m/s]; normal: p_n [N s].
/// (Visits take the impulse closest to (4): shortened ones may alternate between two values in the sweeps.)
inline Vec2 shearImpulseAt(const PointStep& c, const Vec2& after, double normal, double softness)
{
	const Vec2 before(c.before[1], c.before[2]), bias(c.bias[1], c.bias[2]);
	const Vec2 p = clipped(Vec2((bias - c.mass[1] * after) / (1 - c.factor[1])), c.friction * normal);
	ShearAccount account { before + after, Mat2(), c.shearEnergy };
	account.response << c.shearResponse[0], c.shearResponse[1], c.shearResponse[1], c.shearResponse[2];
	account.response *= softness;
	return account.shortened(p);
}

/// p for the velocity u'.
inline Vec3 impulseAt(PointStep& c, const Vec3& after, double softness)
{
	Vec3 p = Vec3::Zero();
	p[0] = normalImpulseAt(c, after[0], softness);
	if (p[0] > 0) p.tail<2>() = shearImpulseAt(c, after.tail<2>(), p[0], softness);
	return p;
}

/// -dp/du' by differences. impulse: p at u'. [kg]
inline Mat3 impulseSlope(PointStep c, const Vec3& after, const Vec3& impulse, double softness)
{
	const double a = std::max({ c.response(), c.shearResponse[0], c.shearResponse[2] });
	const double speed = after.norm() + std::abs(c.before[0]) + std::abs(c.before[1]) + std::abs(c.before[2]),
	             du = slopeShare * (speed + a * impulse.norm());
	Mat3 slope = Mat3::Zero();
	for (int i = 0; i < 3 && du > 0; ++i) {
		Vec3 moved = after;
		moved[i] += du;
		slope.col(i) = (impulse - impulseAt(c, moved, softness)) / du;
	}
	return slope;
}

} // namespace timber
