// SPDX-License-Identifier: GPL-2.0-or-later
/// Positions and velocities of rigid bodies and of points on them, in the world frame.
#pragma once
#include "simd.hpp"

namespace timber {

struct BodyKinematics {
	const Vec3 &position, &velocity, &spin; ///< of the centre of mass [m, m/s]; angular velocity [rad/s]
};

/// Velocity of B relative to A at a point. arms: from the centres of mass to the point [m]; v, w: velocity and angular
/// velocity of each body [m/s, rad/s]. Returns [m/s].
template <class Number>
[[gnu::always_inline]] inline Vec3Of<Number> relativeVelocity(const Vec3Of<Number>& armA, const Vec3Of<Number>& armB,
        const Vec3& vA, const Vec3& wA, const Vec3& vB, const Vec3& wB)
{
	return broadcast<Number>(vB) + broadcast<Number>(wB).cross(armB) - broadcast<Number>(vA)
	        - broadcast<Number>(wA).cross(armA);
}

/// Motion of B relative to A at a contact point.
template <class Number> struct RelativeMotion {
	Vec3Of<Number> velocity; ///< [m/s]
	Vec3 spin; ///< mean angular velocity of the two bodies, with which the contact rotates [rad/s]
};

} // namespace timber
