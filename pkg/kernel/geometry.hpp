// SPDX-License-Identifier: GPL-2.0-or-later
/// Small questions about points, segments and one convex polyhedron, all in the polyhedron's frame.
#pragma once
#include "simd.hpp"
#include "polyhedron.hpp"
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace timber {

template <class Number> Number height(const HalfSpace& plane, const Vec3Of<Number>& x) { return broadcast<Number>(plane.normal).dot(x) - Number(plane.offset); }

/// The foot of x lies in the face or beyond its border by at most `limit` (negative: inside it by as much) [m]. At a
/// corner the distance along the bisector counts, too, over sqrt(2): nothing new at a right corner, but a foot beyond a
/// sharp tip stays near it.
template <class Number> auto isOverFace(const Face& face, const Vec3Of<Number>& x, Number limit)
{
	const Number none = 0.;
	auto over = none <= none, beyond = none < none;
	for (const HalfSpace& border : face.borders) {
		const Number distance = height(border, x);
		over = logicalAnd(over, distance <= limit);
		if (!any(over)) return over;
		beyond = logicalOr(beyond, distance > none);
	}
	if (!any(logicalAnd(over, beyond))) return over;
	for (const HalfSpace& tip : face.tips)
		over = logicalAnd(over, logicalOr(beyond == (none < none), height(tip, x) <= Number(M_SQRT2) * limit));
	return over;
}

/// x lies in all half-spaces but that of the given face, which is not asked; `limit` may reach beyond them or stay inside. [m]
template <class Number> auto isInside(const Polyhedron& body, int face, const Vec3Of<Number>& x, Number limit)
{
	const Number none = 0.;
	auto inside = none <= none;
	for (int f = 0; f < int(body.faces.size()); ++f)
		if (f != face) inside = logicalAnd(inside, height(body.faces[f].plane, x) <= limit);
	return inside;
}

/// The face that looks most along a direction.
inline int faceLooking(const Polyhedron& body, const Vec3& direction)
{
	const auto looksLess = [&](const Face& f, const Face& g) { return f.plane.normal.dot(direction) < g.plane.normal.dot(direction); };
	return int(std::max_element(body.faces.begin(), body.faces.end(), looksLess) - body.faces.begin());
}

/// Least and greatest coordinate along a direction. [m]
inline std::pair<double, double> extent(const Polyhedron& body, const Vec3& direction)
{
	double least = std::numeric_limits<double>::infinity(), most = -least;
	for (const Vec3& v : body.vertices) {
		least = std::min(least, v.dot(direction));
		most = std::max(most, v.dot(direction));
	}
	return { least, most };
}

/// Shortest distance of two segments, each from its tail along its span. [m]
inline double segmentDistance(const Vec3& tailA, const Vec3& spanA, const Vec3& tailB, const Vec3& spanB)
{
	const Vec3 w = tailA - tailB;
	const double aa = spanA.squaredNorm(), bb = spanB.squaredNorm(), ab = spanA.dot(spanB), aw = spanA.dot(w), bw = spanB.dot(w);
	const double det = aa * bb - ab * ab;
	double s = det > 1e-12 * aa * bb ? std::clamp((ab * bw - bb * aw) / det, 0., 1.) : 0.;
	const double t = std::clamp((ab * s + bw) / bb, 0., 1.);
	s = std::clamp((ab * t - aw) / aa, 0., 1.);
	return (w + s * spanA - t * spanB).norm();
}

} // namespace timber
