// SPDX-License-Identifier: GPL-2.0-or-later
#include "separating_axis.hpp"
#include "constants.hpp"
#include "preconditions.hpp"
#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>

namespace timber {
namespace {

	/// Largest gap so far and its axis, frame of A.
	class LargestGap {
	public:
		double gap = -std::numeric_limits<double>::infinity(); ///< [m]
		Vec3 axis = Vec3::Zero(); ///< unit, from A to B

		/// Vertices of both cores in the frame of A.
		LargestGap(const std::vector<Vec3>& a, const std::vector<Vec3>& b)
		        : a(a)
		        , b(b)
		{
		}
		/// Tests an axis from A to B.
		void testAxis(const Vec3& direction)
		{
			double maxA = -std::numeric_limits<double>::infinity(), minB = -maxA;
			for (const Vec3& v : a)
				maxA = std::max(maxA, v.dot(direction));
			for (const Vec3& v : b)
				minB = std::min(minB, v.dot(direction));
			update(minB - maxA, direction);
		}

		/// Tests an axis from A to B on which these vertices of an edge of A and of B may be the supports.
		void testEdges(const Vec3& direction, const Vec3& vertexA, const Vec3& vertexB)
		{
			if (direction.dot(vertexB - vertexA) > gap) testAxis(direction);
		}

	private:
		const std::vector<Vec3>&a, &b;

		void update(double separation, const Vec3& direction)
		{
			if (separation <= gap) return;
			gap = separation;
			axis = direction;
		}
	};

	/// Components of the normals of an edge's two faces along an edge of the other body. [-] On the sphere of
	/// directions the normals of all supports of an edge form the arc between those of its faces.
	struct Arc {
		double left, right;
		bool straddles() const
		{
			return std::min(left, right) < arcTolerance && std::max(left, right) > -arcTolerance;
		}
	};
	Arc arcOf(const Edge& edge, const std::vector<Vec3>& normals, const Vec3& direction)
	{
		return { normals[edge.left].dot(direction), normals[edge.right].dot(direction) };
	}
	/// Whether an edge of A and one of B may form a face of the Minkowski difference: the arc of A crosses the
	/// reflected one of B. Only the axes of its faces can be those of the largest gap of overlapping cores (Gregorius
	/// 2013, Game Developers Conference).
	bool mayFormFace(const Arc& a, const Arc& b)
	{
		return a.straddles() && b.straddles() && a.right * b.left < arcTolerance;
	}

} // namespace

double coreGap(const Polyhedron& a, const Polyhedron& b, const Mat3& rotation, const Vec3& translation, Vec3& axis,
        double sufficientGap)
{
	assert(a.faces.size() >= 4 && b.faces.size() >= 4);
	assert(isRotation(rotation) && isFinite(translation));
	// All in the frame of A
	const auto listOf = [](const auto& parts, auto vectorOf) {
		std::vector<Vec3> list;
		list.reserve(parts.size());
		std::transform(parts.begin(), parts.end(), std::back_inserter(list), vectorOf);
		return list;
	};
	const auto normalsA = listOf(a.faces, [](const Face& f) { return f.plane.normal; });
	const auto normalsB = listOf(b.faces, [&](const Face& f) { return Vec3(rotation * f.plane.normal); });
	const auto verticesB = listOf(b.vertices, [&](const Vec3& v) { return Vec3(rotation * v + translation); });
	const auto directionsB = listOf(b.edges, [&](const Edge& e) { return Vec3(rotation * e.direction); });
	LargestGap largest(a.vertices, verticesB);
	for (const Vec3& normal : normalsA)
		largest.testAxis(normal);
	for (const Vec3& normal : normalsB)
		largest.testAxis(-normal);
	for (const Edge& ea : a.edges)
		for (size_t k = 0; k < b.edges.size(); ++k) {
			if (largest.gap > sufficientGap) break;
			const Edge& eb = b.edges[k];
			if (!mayFormFace(arcOf(ea, normalsA, directionsB[k]), arcOf(eb, normalsB, ea.direction)))
				continue;
			const Vec3 n = ea.direction.cross(directionsB[k]);
			const double length = n.dot(ea.outward) < 0 ? -n.norm() : n.norm();
			if (std::abs(length) < 1e-9) continue; // parallel edges
			largest.testEdges(n / length, a.vertices[ea.tail], verticesB[eb.tail]);
		}
	axis = largest.axis;
	return largest.gap;
}

} // namespace timber
