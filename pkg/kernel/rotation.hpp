// SPDX-License-Identifier: GPL-2.0-or-later
/// Torque-free rotation of a rigid body.
#pragma once
#include "types.hpp"
#include <cmath>
#include <utility>

namespace timber {

/// Sine and cosine; by their series, exact to rounding, where they are short.
inline std::pair<double, double> sineCosine(double x)
{
	if (std::abs(x) > 0.02) return { std::sin(x), std::cos(x) };
	const double y = x * x;
	return { x * (1 - y / 6 * (1 - y / 20 * (1 - y / 42))), 1 - y / 2 * (1 - y / 12 * (1 - y / 30 * (1 - y / 56))) };
}

/// Turns the orientation about its own principal axis by `angle` [rad].
template <int axis> void turnAbout(Quat& orientation, Vec3& bodyMomentum, double angle)
{
	constexpr int j = (axis + 1) % 3, k = (axis + 2) % 3;
	const auto [halfS, halfC] = sineCosine(angle / 2);
	const double c = halfC * halfC - halfS * halfS, s = 2 * halfS * halfC;
	const double mj = bodyMomentum[j], mk = bodyMomentum[k];
	bodyMomentum[j] = c * mj + s * mk;
	bodyMomentum[k] = c * mk - s * mj;
	auto& q = orientation.coeffs(); // x, y, z, w; from the right by (halfC, halfS along the axis)
	const double qw = q[3], qi = q[axis], qj = q[j], qk = q[k];
	q[3] = qw * halfC - qi * halfS;
	q[axis] = qi * halfC + qw * halfS;
	q[j] = qj * halfC + qk * halfS;
	q[k] = qk * halfC - qj * halfS;
}

/// One step of free rotation, the symmetric composition R1(h/2) R2(h/2) R3(h) R2(h/2) R1(h/2) of exact rotations
/// (Dullweber, Leimkuhler, McLachlan 1997, J. Chem. Phys. 107, 5840, section III). Second order; |L| and L are kept.
/// orientation: body to world, in-out. momentum L: world [kg m2/s]. inertia: principal [kg m2]. Returns the angular
/// velocity after the step, world [rad/s].
inline Vec3 freeRotation(Quat& orientation, const Vec3& momentum, const Vec3& inertia, double h)
{
	const Vec3 inverse = inertia.cwiseInverse();
	Vec3 body = orientation.conjugate() * momentum;
	turnAbout<0>(orientation, body, h / 2 * body[0] * inverse[0]);
	turnAbout<1>(orientation, body, h / 2 * body[1] * inverse[1]);
	turnAbout<2>(orientation, body, h * body[2] * inverse[2]);
	turnAbout<1>(orientation, body, h / 2 * body[1] * inverse[1]);
	turnAbout<0>(orientation, body, h / 2 * body[0] * inverse[0]);
	orientation.normalize();
	return orientation * body.cwiseProduct(inverse).eval();
}

/// Bound of |w x x| over the points x of a body: of their speeds when it spins with w [m/s]. A slender member that spins about its
/// axis is slow.
/// spin: in the body's frame; span: largest |x| along each axis [m].
inline double turningSpeed(const Vec3& spin, const Vec3& span)
{
	const Vec3 w = spin.cwiseAbs();
	return Vec3(w.y() * span.z() + w.z() * span.y(), w.z() * span.x() + w.x() * span.z(), w.x() * span.y() + w.y() * span.x()).norm();
}

/// Bound of the way that points of a body go when it turns: a point at x goes |(R - I) x| = 2 |q x x|, q the vector part of the
/// rotation's quaternion.
/// turn: of the body, in its own frame; span: largest |x| along each axis [m]. Returns [m].
inline double turnedWay(const Quat& turn, const Vec3& span) { return 2 * turningSpeed(turn.vec(), span); }

} // namespace timber
