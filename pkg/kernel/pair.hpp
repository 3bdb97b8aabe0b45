// SPDX-License-Identifier: GPL-2.0-or-later
/// Two rounded polyhedra at one instant, as the manifold and the search for its candidates see them.
#pragma once
#include "constants.hpp"
#include "lanes.hpp"
#include "manifold.hpp"
#include <algorithm>
#include <cmath>

namespace timber {

/// One pair at one instant, all in the frame of A: x_A = rotation x_B + translation.
struct Pair {
	const RoundedPolyhedron& a;
	const RoundedPolyhedron& b;
	Mat3 rotation;
	Vec3 translation;
	Patterns patterns;
	double gap = 0; ///< of the cores; < 0: they overlap (deep contact). Not looked up while they are surely apart. [m]
	Vec3 axis = Vec3::Zero(); ///< where the gap is found, unit, from A to B; only in deep contact
	int facingA = -1, facingB = -1; ///< the faces that look along the axis; only in deep contact

	bool deep() const { return gap < 0; }
	double touch() const { return a.radius + b.radius; }
	double depthLimit() const { return std::min(a.coreHalfThickness, b.coreHalfThickness); }
	template <class Number> Vec3Of<Number> toB(const Vec3Of<Number>& x) const { return wide<Number>(rotation).transpose() * (x - wide<Number>(translation)); }
	template <class Number> Vec3Of<Number> toA(const Vec3Of<Number>& x) const { return wide<Number>(rotation) * x + wide<Number>(translation); }
	/// Foot beyond a border by less than this still belongs to the face. [m]
	double borderLimit() const { return patterns.flushSupports ? flushTolerance : -flushTolerance; }
};

/// Two lines: sine of their angle, parameters of the closest points along the unit directions.
struct Crossing {
	double sine; ///< below parallelSine nothing else is known
	double alongA, alongB; ///< [m]
	Vec3 across; ///< unit, perpendicular to both
};

inline Crossing crossing(const Vec3& originA, const Vec3& alongA, const Vec3& originB, const Vec3& alongB)
{
	Crossing c;
	const Vec3 n = alongA.cross(alongB);
	const double square = n.squaredNorm();
	c.sine = std::sqrt(square);
	if (c.sine < parallelSine) return c;
	c.across = n / c.sine;
	const Vec3 w = originB - originA;
	c.alongA = w.cross(alongB).dot(n) / square;
	c.alongB = w.cross(alongA).dot(n) / square;
	return c;
}

} // namespace timber
