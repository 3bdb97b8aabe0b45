// SPDX-License-Identifier: GPL-2.0-or-later
/// One spring of a breakable joint (paper, sections 2.4 and 3.2), anchored in both bodies.
/// Signs: the normal runs from body A to body B; the force is that on A, B gets the opposite.
#pragma once
#include "types.hpp"

namespace timber {

struct JointStiffness {
	double normal, shear; ///< K_pn, K_ps [N/m]
};

struct SpringForce {
	Vec3 force; ///< on A, world [N]
	double normal; ///< along the joint's normal, > 0 in tension [N]
	double energy; ///< stored [J]
};

/// Total form of Eqs. 25, 26, 29, 30 (the sum of the increments, without their drift).
/// stretch: anchor of B minus anchor of A, world [m]. With equal stiffnesses the normal does not matter.
inline SpringForce springForce(const JointStiffness& k, const Vec3& stretch, const Vec3& normal)
{
	const double along = stretch.dot(normal), extra = k.normal - k.shear;
	if (extra == 0) return { k.shear * stretch, k.normal * along, 0.5 * (k.shear * stretch.squaredNorm()) };
	return { k.shear * stretch + extra * along * normal, k.normal * along, 0.5 * (k.shear * stretch.squaredNorm() + extra * along * along) };
}

/// What broke a spring: the larger of its two components, and the sign of the normal one.
enum class BreakCause { Tension, Compression, Shear };
inline BreakCause breakCause(const SpringForce& f)
{
	if (f.force.squaredNorm() > 2 * f.normal * f.normal) return BreakCause::Shear;
	return f.normal > 0 ? BreakCause::Tension : BreakCause::Compression;
}

} // namespace timber
