// SPDX-License-Identifier: GPL-2.0-or-later
/// Two rounded polyhedra at one instant, as the manifold and the search for its candidates see them.
#pragma once
#include "constants.hpp"
#include "simd.hpp"
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
	template <class Number> Vec3Of<Number> toB(const Vec3Of<Number>& x) const { return broadcast<Number>(rotation).transpose() * (x - broadcast<Number>(translation)); }
	template <class Number> Vec3Of<Number> toA(const Vec3Of<Number>& x) const { return broadcast<Number>(rotation) * x + broadcast<Number>(translation); }
	/// Foot beyond a border by less than this still belongs to the face. [m]
	double borderLimit() const { return patterns.flushSupports ? flushTolerance : -flushTolerance; }
};

/// Two lines: sine of their angle, parameters of the closest points along the unit directions.
template <class Number> struct Crossing {
	Number sine; ///< where it is below parallelSine the rest is of no use
	Number alongA, alongB; ///< [m]
	Vec3Of<Number> across; ///< unit, perpendicular to both
};

template <class Number> Crossing<Number> crossing(const Vec3Of<Number>& originA, const Vec3Of<Number>& alongA, const Vec3Of<Number>& originB, const Vec3Of<Number>& alongB)
{
	Crossing<Number> c;
	const Vec3Of<Number> n = alongA.cross(alongB);
	const Number square = n.squaredNorm();
	c.sine = sqrt(square);
	c.across = n / c.sine;
	const Vec3Of<Number> w = originB - originA;
	c.alongA = w.cross(alongB).dot(n) / square;
	c.alongB = w.cross(alongA).dot(n) / square;
	return c;
}

} // namespace timber
