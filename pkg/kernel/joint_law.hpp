// SPDX-License-Identifier: GPL-2.0-or-later
/// One spring of a breakable joint (paper, sections 2.4 and 3.2), anchored in both bodies.
/// Signs: the normal runs from body A to body B; the force is that on A, B gets the opposite.
#pragma once
#include "simd.hpp"
#include <vector>

namespace timber {

struct JointStiffness {
	double normal, shear; ///< K_pn, K_ps [N/m]
};

template <class Number> struct SpringForce {
	Vec3Of<Number> force; ///< on A, world [N]
	Number normal; ///< along the joint's normal, > 0 in tension [N]
	Number energy; ///< stored [J]
};

/// Total form of Eqs. 25, 26, 29, 30 (the sum of the increments, without their drift).
/// stretch: anchor of B minus anchor of A, world [m]. With equal stiffnesses the normal does not matter.
template <class Number> SpringForce<Number> springForce(const JointStiffness& k, const Vec3Of<Number>& stretch, const Vec3& normal)
{
	const Vec3Of<Number> n = wide<Number>(normal), shear = Number(k.shear) * stretch;
	const Number along = stretch.dot(n), square = Number(k.shear) * stretch.squaredNorm(), extra = k.normal - k.shear, half = 0.5;
	if (k.normal == k.shear) return { shear, Number(k.normal) * along, half * square };
	return { shear + extra * along * n, Number(k.normal) * along, half * (square + extra * along * along) };
}

/// Where a joint's two bodies are: matrices from their frames to the world, and from the centre of A to that of B [m].
struct JointPlacement {
	const Mat3 &axesA, &axesB;
	Vec3 apart;
};

/// What all springs of a joint do that are left; forces on A, torques about the bodies' own centres.
struct JointPull {
	Vec3 force = Vec3::Zero(), torqueA = Vec3::Zero(), torqueB = Vec3::Zero(); ///< [N, N m]
	double energy = 0; ///< [J]
	double largest = 0; ///< square of the largest spring force [N2]
	double sum = 0; ///< of the sizes of the spring forces [N]
};

/// Stretches a joint's springs to the bodies' placement. anchors: in the bodies' frames; normal: in that of A; stretches, forces (on A): in the
/// world, zero for broken springs.
JointPull pullSprings(const JointStiffness& k, const JointPlacement& place, const Vec3& normal, const std::vector<Vec3>& anchorsA, const std::vector<Vec3>& anchorsB,
        const std::vector<int>& broken, std::vector<Vec3>& stretches, std::vector<Vec3>& forces);

/// What broke a spring: the larger of its two components, and the sign of the normal one.
enum class BreakCause { Tension, Compression, Shear };
inline BreakCause breakCause(const SpringForce<double>& f)
{
	if (f.force.squaredNorm() > 2 * f.normal * f.normal) return BreakCause::Shear;
	return f.normal > 0 ? BreakCause::Tension : BreakCause::Compression;
}

} // namespace timber
