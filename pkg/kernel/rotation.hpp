// SPDX-License-Identifier: GPL-2.0-or-later
/// Torque-free rotation of rigid bodies.
#pragma once
#include "portable_math.hpp"
#include "preconditions.hpp"
#include <cassert>
#include <cmath>
#include <utility>

namespace timber {

inline Lanes sine(Lanes x)
{
	return eachLane(x, [](double one) { return sine(one); });
}
inline Lanes cosine(Lanes x)
{
	return eachLane(x, [](double one) { return cosine(one); });
}

/// Sine and cosine; for small arguments by power series, exact to rounding.
template <class Number> std::pair<Number, Number> sineCosine(Number x)
{
	const Number one = 1., y = x * x;
	const auto isLong = logicalOr(x > Number(0.02), x < Number(-0.02));
	const auto over = [y](double divisor) { return Number(y / Number(divisor)); };
	const auto shortSine = [&] { return Number(x * (one - over(6) * (one - over(20) * (one - over(42))))); };
	const auto shortCosine
	        = [&] { return Number(one - over(2) * (one - over(12) * (one - over(30) * (one - over(56))))); };
	return { selectLazily(
		         isLong, [x] { return sine(x); }, shortSine),
		selectLazily(
		        isLong, [x] { return cosine(x); }, shortCosine) };
}

template <class Number> using QuatOf = Eigen::Quaternion<Number>;

/// Rotates the orientation about its own principal axis by `angle` [rad], and the momentum, in the body frame, by the
/// opposite angle.
template <int axis, class Number>
void rotateAboutAxis(QuatOf<Number>& orientation, Vec3Of<Number>& bodyMomentum, Number angle)
{
	constexpr int j = (axis + 1) % 3, k = (axis + 2) % 3;
	const auto [halfS, halfC] = sineCosine<Number>(angle / Number(2.));
	const Number c = halfC * halfC - halfS * halfS, s = Number(2.) * halfS * halfC;
	const Number mj = bodyMomentum[j], mk = bodyMomentum[k];
	bodyMomentum[j] = c * mj + s * mk;
	bodyMomentum[k] = c * mk - s * mj;
	auto& q = orientation.coeffs(); // x, y, z, w; multiplied from the right by (halfC, halfS along the axis)
	const Number qw = q[3], qi = q[axis], qj = q[j], qk = q[k];
	q[3] = qw * halfC - qi * halfS;
	q[axis] = qi * halfC + qw * halfS;
	q[j] = qj * halfC + qk * halfS;
	q[k] = qk * halfC - qj * halfS;
}

/// One step of free rotation, the symmetric composition R1(h/2) R2(h/2) R3(h) R2(h/2) R1(h/2) of exact rotations
/// (Dullweber, Leimkuhler, McLachlan 1997, J. Chem. Phys. 107, 5840, section III). Second order; L is conserved.
/// orientation: body to world, in-out. momentum L: world [kg m2/s]. inertia: principal [kg m2]. Returns the angular
/// velocity after the step, world [rad/s].
template <class Number>
Vec3Of<Number> freeRotation(
        QuatOf<Number>& orientation, const Vec3Of<Number>& momentum, const Vec3Of<Number>& inertia, double h)
{
	assert(std::isfinite(h) && isFinite(momentum) && isFinite(inertia)
	        && !any(logicalOr(
	                inertia[0] <= Number(0.), logicalOr(inertia[1] <= Number(0.), inertia[2] <= Number(0.)))));
	const Number whole = h, half = h / 2;
	const Vec3Of<Number> inverse = inertia.cwiseInverse();
	Vec3Of<Number> body = orientation.conjugate() * momentum;
	rotateAboutAxis<0, Number>(orientation, body, half * body[0] * inverse[0]);
	rotateAboutAxis<1, Number>(orientation, body, half * body[1] * inverse[1]);
	rotateAboutAxis<2, Number>(orientation, body, whole * body[2] * inverse[2]);
	rotateAboutAxis<1, Number>(orientation, body, half * body[1] * inverse[1]);
	rotateAboutAxis<0, Number>(orientation, body, half * body[0] * inverse[0]);
	orientation.coeffs() /= sqrt(orientation.squaredNorm());
	return orientation * body.cwiseProduct(inverse).eval();
}

/// Upper bound of |w x x| over the points x of a body: of their speed due to the spin w [m/s]. It is small for a
/// slender member that spins about its axis.
/// spin: in the body's frame; span: largest |x| along each axis [m].
inline double rotationSpeed(const Vec3& spin, const Vec3& span)
{
	const Vec3 w = spin.cwiseAbs();
	return Vec3(w.y() * span.z() + w.z() * span.y(), w.z() * span.x() + w.x() * span.z(),
	        w.x() * span.y() + w.y() * span.x())
	        .norm();
}

/// Upper bound of the displacement of a body's points due to its rotation: |(R - I) x| = 2 |q x x| at a point x, q the
/// vector part of the rotation's quaternion.
/// rotation: of the body, in its own frame; span: largest |x| along each axis [m]. Returns [m].
inline double rotationDisplacement(const Quat& rotation, const Vec3& span)
{
	return 2 * rotationSpeed(rotation.vec(), span);
}

} // namespace timber
