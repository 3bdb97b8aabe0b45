// SPDX-License-Identifier: GPL-2.0-or-later
#include "separating_axis.hpp"
#include "preconditions.hpp"
#include <algorithm>
#include <cassert>

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
		/// Tests both signs of an axis.
		void testBothSigns(const Vec3& direction)
		{
			double minA = std::numeric_limits<double>::infinity(), maxA = -minA, minB = minA, maxB = maxA;
			for (const Vec3& v : a) {
				const double x = v.dot(direction);
				minA = std::min(minA, x);
				maxA = std::max(maxA, x);
			}
			for (const Vec3& v : b) {
				const double x = v.dot(direction);
				minB = std::min(minB, x);
				maxB = std::max(maxB, x);
			}
			update(minB - maxA, direction);
			update(minA - maxB, -direction);
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

} // namespace

double coreGap(const Polyhedron& a, const Polyhedron& b, const Mat3& rotation, const Vec3& translation, Vec3& axis,
        double sufficientGap)
{
	assert(a.faces.size() >= 4 && b.faces.size() >= 4);
	assert(isRotation(rotation) && isFinite(translation));
	std::vector<Vec3> verticesB; // frame of A
	verticesB.reserve(b.vertices.size());
	for (const Vec3& v : b.vertices)
		verticesB.push_back(rotation * v + translation);
	LargestGap largest(a.vertices, verticesB);
	for (const Face& face : a.faces)
		largest.testAxis(face.plane.normal);
	for (const Face& face : b.faces)
		largest.testAxis(-(rotation * face.plane.normal));
	for (const Edge& ea : a.edges)
		for (const Edge& eb : b.edges) {
			if (largest.gap > sufficientGap) break;
			const Vec3 n = ea.direction.cross(rotation * eb.direction);
			const double sine = n.norm();
			if (sine > 1e-9) largest.testBothSigns(n / sine); // parallel edges have no cross product
		}
	axis = largest.axis;
	return largest.gap;
}

} // namespace timber
