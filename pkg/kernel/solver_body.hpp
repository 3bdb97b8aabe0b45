// SPDX-License-Identifier: GPL-2.0-or-later
/// Bodies as the solver sees them, in the world frame.
#pragma once
#include "types.hpp"

namespace timber {

struct SolverBody {
	Vec3 velocity, spin; ///< before the step [m/s, rad/s]
	Vec3 newVelocity, newSpin; ///< in: after all forces except contacts and joint dashpots; out: after these, too
	double inverseMass; ///< 0 for a fixed body [1/kg]
	Mat3 inverseInertia; ///< world axes [1/(kg m2)]
	Vec3 position = Vec3::Zero(); ///< [m]
};

/// Inverse of the equivalent mass of two bodies (Eq. 43). [1/kg]
inline double pairInverseMass(const SolverBody& a, const SolverBody& b) { return a.inverseMass + b.inverseMass; }

/// [v]: [v] x = v cross x.
inline Mat3 crossMatrix(const Vec3& v)
{
	Mat3 m;
	m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
	return m;
}

/// Inverse effective mass of a body at a point: change of the point's velocity per unit impulse, 1/m - [r] I^-1 [r]. [1/kg]
/// arm: r, from the centre of mass to the point [m].
inline Mat3 bodyResponse(const SolverBody& body, const Vec3& arm)
{
	const Mat3 s = crossMatrix(arm);
	Mat3 response = -(s * body.inverseInertia * s);
	response.diagonal().array() += body.inverseMass;
	return response;
}

} // namespace timber
