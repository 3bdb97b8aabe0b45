// SPDX-License-Identifier: GPL-2.0-or-later
#include "core_distance.hpp"
#include "geometry.hpp"
#include "separating_axis.hpp"
#include <cmath>
#include <limits>

namespace timber {
namespace {

	/// Least distance of points from the faces onto which they project; infinite without any. [m]
	double distanceFromFaces(const Polyhedron& body, const std::vector<Vec3>& points)
	{
		double least = std::numeric_limits<double>::infinity();
		for (const Face& face : body.faces)
			for (const Vec3& x : points) {
				const double distance = signedDistance<double>(face.plane, x);
				if (distance >= 0 && distance < least && projectsOntoFace<double>(face, x, 0.))
					least = distance;
			}
		return least;
	}

	std::vector<Vec3> moved(const std::vector<Vec3>& points, const Mat3& rotation, const Vec3& translation)
	{
		std::vector<Vec3> result;
		result.reserve(points.size());
		for (const Vec3& x : points)
			result.push_back(rotation * x + translation);
		return result;
	}

} // namespace

/// The closest points are a vertex and a point of a face, or points of two edges.
double coreDistance(const Polyhedron& a, const Polyhedron& b, const Mat3& rotation, const Vec3& translation)
{
	const std::vector<Vec3> verticesB = moved(b.vertices, rotation, translation);
	double least = std::min(distanceFromFaces(a, verticesB),
	        distanceFromFaces(b, moved(a.vertices, rotation.transpose(), -(rotation.transpose() * translation))));
	for (const Edge& ea : a.edges)
		for (const Edge& eb : b.edges) {
			const Vec3 &tailA = a.vertices[ea.tail], &tailB = verticesB[eb.tail];
			least = std::min(least,
			        segmentDistance(tailA, a.vertices[ea.head] - tailA, tailB, verticesB[eb.head] - tailB));
		}
	return least;
}

double bodyOverlap(const RoundedPolyhedron& a, const RoundedPolyhedron& b, const Pose& poseA, const Pose& poseB)
{
	const Mat3 rotationA = poseA.orientation.toRotationMatrix(),
	           rotation = rotationA.transpose() * poseB.orientation.toRotationMatrix();
	const Vec3 translation = rotationA.transpose() * (poseB.position - poseA.position);
	const double touch = a.radius + b.radius;
	Vec3 axis;
	double gap = coreGap(
	        a.core, b.core, rotation, translation, axis, -std::numeric_limits<double>::infinity()); // of faces
	if (gap >= touch) return touch - gap;
	if (gap < 0) gap = coreGap(a.core, b.core, rotation, translation, axis, 0);
	return touch - (gap < 0 ? gap : coreDistance(a.core, b.core, rotation, translation));
}

} // namespace timber
