// SPDX-License-Identifier: GPL-2.0-or-later
#include "manifold.hpp"
#include <algorithm>
#include <limits>

namespace timber {
namespace {

	/// The largest gap so far and the direction (from A to B) where it is. All in the frame of A.
	class Widest {
	public:
		double gap = -std::numeric_limits<double>::infinity(); ///< [m]
		Vec3 axis = Vec3::Zero();

		Widest(const std::vector<Vec3>& a, const std::vector<Vec3>& b)
		        : a(a)
		        , b(b)
		{
		}
		/// B beyond A along the direction.
		void along(const Vec3& direction)
		{
			double farA = -std::numeric_limits<double>::infinity(), nearB = -farA;
			for (const Vec3& v : a)
				farA = std::max(farA, v.dot(direction));
			for (const Vec3& v : b)
				nearB = std::min(nearB, v.dot(direction));
			take(nearB - farA, direction);
		}
		void alongBothWays(const Vec3& direction)
		{
			double leastA = std::numeric_limits<double>::infinity(), mostA = -leastA, leastB = leastA, mostB = mostA;
			for (const Vec3& v : a) {
				const double x = v.dot(direction);
				leastA = std::min(leastA, x);
				mostA = std::max(mostA, x);
			}
			for (const Vec3& v : b) {
				const double x = v.dot(direction);
				leastB = std::min(leastB, x);
				mostB = std::max(mostB, x);
			}
			take(leastB - mostA, direction);
			take(leastA - mostB, -direction);
		}

	private:
		const std::vector<Vec3>&a, &b;

		void take(double found, const Vec3& direction)
		{
			if (found <= gap) return;
			gap = found;
			axis = direction;
		}
	};

} // namespace

double coreGap(const Polyhedron& a, const Polyhedron& b, const Mat3& rotation, const Vec3& translation, Vec3& axis, double enough)
{
	std::vector<Vec3> placed;
	placed.reserve(b.vertices.size());
	for (const Vec3& v : b.vertices)
		placed.push_back(rotation * v + translation);
	Widest widest(a.vertices, placed);
	for (const Face& face : a.faces)
		widest.along(face.plane.normal);
	for (const Face& face : b.faces)
		widest.along(-(rotation * face.plane.normal));
	for (const Edge& ea : a.edges)
		for (const Edge& eb : b.edges) {
			if (widest.gap > enough) break;
			const Vec3 n = ea.along.cross(rotation * eb.along);
			const double sine = n.norm();
			if (sine > 1e-9) widest.alongBothWays(n / sine); // any direction may be tried, but not none
		}
	axis = widest.axis;
	return widest.gap;
}

} // namespace timber
