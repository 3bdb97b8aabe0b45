// SPDX-License-Identifier: GPL-2.0-or-later
/// Two rounded polyhedra in one relative pose: input of the contact manifold and of the feature search.
#pragma once
#include "constants.hpp"
#include "manifold.hpp"
#include "simd.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

namespace timber {

/// All in the frame of A: x_A = rotation x_B + translation.
struct ShapePair {
	const RoundedPolyhedron& a;
	const RoundedPolyhedron& b;
	Mat3 rotation;
	Vec3 translation;
	ContactKinds kinds;
	/// Between the cores along the axis; < 0: they overlap (deep contact); infinite if they are known to be separated
	/// [m]
	double gap = std::numeric_limits<double>::infinity();
	Vec3 axis = Vec3::Zero(); ///< of least overlap, unit, from A to B; of cores that may overlap
	/// Faces of A towards B and of B towards A along the axis; only in deep contact.
	int supportFaceA = -1, supportFaceB = -1;

	bool isDeep() const { return gap < 0; }
	/// Distance of the cores at which the rounded surfaces touch. [m]
	double contactDistance() const { return a.radius + b.radius; }
	double depthLimit() const { return std::min(a.coreHalfThickness, b.coreHalfThickness); } ///< [m]
	/// A projection beyond a side of a face by less than this still belongs to the face. [m]
	double sideTolerance() const { return kinds.flushSupports ? flushLimit() : -flushLimit(); }
	/// The flush tolerance, for small bodies a share of their contact distance. [m]
	double flushLimit() const { return std::min(flushTolerance, flushShare * contactDistance()); }
	/// Whether vertices exactly above borders of faces have contacts.
	bool hasBorderContacts() const { return kinds.flushSupports || kinds.vertexEdge; }
	/// A vertex inside the border of a face by less than this is in the wedge of the border's edge. [m] Faces support
	/// vertices inside their border by the flush limit if flushSupports is off.
	double wedgeTolerance() const { return kinds.flushSupports ? roundingLength : 2 * flushLimit(); }
	/// Slope by which the edges of a vertex in contact may approach the other body. [-] The crossing of such an edge is
	/// within the flush limit from the vertex.
	double slopeTolerance() const { return flushLimit() / contactDistance(); }
	/// Edges with a smaller sine of their angle have no crossing point. [-] With vertex-edge contacts the ends of nearly
	/// parallel edges carry what the crossing does not.
	double crossingLimit() const { return kinds.vertexEdge ? smallestSine : parallelSine; }
	template <class Number> Vec3Of<Number> toB(const Vec3Of<Number>& x) const
	{
		return broadcast<Number>(rotation).transpose() * (x - broadcast<Number>(translation));
	}
	template <class Number> Vec3Of<Number> toA(const Vec3Of<Number>& x) const
	{
		return broadcast<Number>(rotation) * x + broadcast<Number>(translation);
	}
};

/// Closest points of two lines.
template <class Number> struct Crossing {
	Number sine; ///< of the angle between the lines; the other members are meaningless below parallelSine
	Number alongA, alongB; ///< parameters of the closest points [m]
	Vec3Of<Number> normal; ///< unit, perpendicular to both
};

/// Directions are unit vectors.
template <class Number>
Crossing<Number> crossing(const Vec3Of<Number>& originA, const Vec3Of<Number>& directionA,
        const Vec3Of<Number>& originB, const Vec3Of<Number>& directionB)
{
	Crossing<Number> c;
	const Vec3Of<Number> n = directionA.cross(directionB);
	const Number square = n.squaredNorm();
	c.sine = sqrt(square);
	c.normal = n / c.sine;
	const Vec3Of<Number> w = originB - originA;
	c.alongA = w.cross(directionB).dot(n) / square;
	c.alongB = w.cross(directionA).dot(n) / square;
	return c;
}

} // namespace timber
