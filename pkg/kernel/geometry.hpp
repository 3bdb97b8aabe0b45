// SPDX-License-Identifier: GPL-2.0-or-later
/// Geometric queries for one convex polyhedron, in its frame, and for segments.
#pragma once
#include "polyhedron.hpp"
#include "preconditions.hpp"
#include "simd.hpp"
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace timber {

/// Distance of a point from a plane, > 0 outside. [m]
template <class Number> Number signedDistance(const HalfSpace& plane, const Vec3Of<Number>& x)
{
	return broadcast<Number>(plane.normal).dot(x) - Number(plane.offset);
}

/// Whether the projection of x onto the face's plane lies in the face. limit: tolerance beyond its sides (negative:
/// inside them) [m].
/// Beyond a side, the distance from the bevel planes is limited to sqrt(2) times as much. This changes nothing at a
/// right angle, and keeps the projection near an acute corner.
template <class Number> auto projectsOntoFace(const Face& face, const Vec3Of<Number>& x, Number limit)
{
	const Number zero = 0.;
	auto inside = zero <= zero, beyond = zero < zero;
	for (const HalfSpace& side : face.sidePlanes) {
		const Number distance = signedDistance(side, x);
		inside = logicalAnd(inside, distance <= limit);
		if (!any(inside)) return inside;
		beyond = logicalOr(beyond, distance > zero);
	}
	if (!any(logicalAnd(inside, beyond))) return inside;
	for (const HalfSpace& bevel : face.bevelPlanes)
		inside = logicalAnd(inside,
		        logicalOr(beyond == (zero < zero), signedDistance(bevel, x) <= Number(M_SQRT2) * limit));
	return inside;
}

/// Whether x lies inside all faces' planes except that of `excludedFace`. limit: tolerance outside the planes
/// (negative: inside them) [m].
template <class Number>
auto isInsideOtherFaces(const Polyhedron& body, int excludedFace, const Vec3Of<Number>& x, Number limit)
{
	assert(excludedFace >= 0 && excludedFace < int(body.faces.size()));
	const Number zero = 0.;
	auto inside = zero <= zero;
	for (int f = 0; f < int(body.faces.size()); ++f)
		if (f != excludedFace) inside = logicalAnd(inside, signedDistance(body.faces[f].plane, x) <= limit);
	return inside;
}

/// The face whose normal is closest to a direction.
inline int supportFace(const Polyhedron& body, const Vec3& direction)
{
	assert(isUnit(direction));
	const auto isLess = [&](const Face& f, const Face& g) {
		return f.plane.normal.dot(direction) < g.plane.normal.dot(direction);
	};
	return int(std::max_element(body.faces.begin(), body.faces.end(), isLess) - body.faces.begin());
}

struct Interval {
	double min, max; ///< [m]
};

/// Projection of a polyhedron onto an axis through the origin.
inline Interval projectionInterval(const Polyhedron& body, const Vec3& axis)
{
	Interval interval { std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity() };
	for (const Vec3& v : body.vertices) {
		interval.min = std::min(interval.min, v.dot(axis));
		interval.max = std::max(interval.max, v.dot(axis));
	}
	return interval;
}

/// Shortest distance of two segments, each from its tail along its span. [m]
inline double segmentDistance(const Vec3& tailA, const Vec3& spanA, const Vec3& tailB, const Vec3& spanB)
{
	assert(spanA.squaredNorm() > 0 && spanB.squaredNorm() > 0);
	const Vec3 w = tailA - tailB;
	const double aa = spanA.squaredNorm(), bb = spanB.squaredNorm(), ab = spanA.dot(spanB), aw = spanA.dot(w),
	             bw = spanB.dot(w);
	const double det = aa * bb - ab * ab;
	double s = det > 1e-12 * aa * bb ? std::clamp((ab * bw - bb * aw) / det, 0., 1.) : 0.;
	const double t = std::clamp((ab * s + bw) / bb, 0., 1.);
	s = std::clamp((ab * t - aw) / aa, 0., 1.);
	return (w + s * spanA - t * spanB).norm();
}

} // namespace timber
