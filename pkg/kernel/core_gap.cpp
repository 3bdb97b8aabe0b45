// SPDX-License-Identifier: GPL-2.0-or-later
#include "manifold.hpp"
#include <limits>

namespace timber {

double coreGap(const Polyhedron& a, const Polyhedron& b, const Mat3& rotation, const Vec3& translation, Vec3& axis)
{
	std::vector<Vec3> placed;
	for (const Vec3& v : b.vertices)
		placed.push_back(rotation * v + translation);
	double best = -std::numeric_limits<double>::infinity();
	const auto tryAxis = [&](const Vec3& direction) {
		double farA = -std::numeric_limits<double>::infinity(), nearB = -farA;
		for (const Vec3& v : a.vertices)
			farA = std::max(farA, v.dot(direction));
		for (const Vec3& v : placed)
			nearB = std::min(nearB, v.dot(direction));
		if (nearB - farA > best) {
			best = nearB - farA;
			axis = direction;
		}
	};
	for (const Face& face : a.faces)
		tryAxis(face.plane.normal);
	for (const Face& face : b.faces)
		tryAxis(-(rotation * face.plane.normal));
	for (const Edge& ea : a.edges)
		for (const Edge& eb : b.edges) {
			const Vec3 spanA = a.vertices[ea.head] - a.vertices[ea.tail], spanB = placed[eb.head] - placed[eb.tail];
			const Vec3 n = spanA.cross(spanB);
			const double length = n.norm();
			if (length <= 1e-9 * spanA.norm() * spanB.norm()) continue; // any direction may be tried, but not none
			tryAxis(n / length);
			tryAxis(-n / length);
		}
	return best;
}

} // namespace timber
