// SPDX-License-Identifier: GPL-2.0-or-later
/// Pairs with contacts in closed form. Each library gets the same bodies; positions account for its collision margins.
#pragma once
#include <shapes.hpp>
#include <functional>
#include <string>

namespace timber::bench {

constexpr double depth = 1e-4; ///< overlap of a touching pair [m]
constexpr double nearGap = 2e-3; ///< gap of a near pair [m]

/// Body B against body A, which is fixed. Normals run from A to B.
struct Configuration {
	std::string name;
	std::vector<Vec3> a, b; ///< corners, body frames [m]
	Vec3 boxA, boxB; ///< extents of bodies that are boxes, otherwise zero [m]
	Quat rotationA, rotationB;
	Vec3 normal; ///< closed form, unit
	Vec3 offset; ///< position of B perpendicular to the normal [m]
	double overlap; ///< closed form [m]; < 0: a gap
	int points; ///< closed form: 4 for a face with four corners, 1 for an edge or a corner
};

inline std::vector<Configuration> configurations()
{
	const Vec3 plate(1, 1, 0.2), cube(0.3, 0.3, 0.3), beam(1, 0.2, 0.2), wall(0.2, 1, 1);
	const Quat none = Quat::Identity(), edgeUp = shapes::about(Vec3::UnitX(), M_PI / 4),
	           across = shapes::about(Vec3::UnitZ(), M_PI / 2) * edgeUp;
	const Quat cornerDown = Quat::FromTwoVectors(Vec3(1, 1, 1), -Vec3::UnitZ());
	const auto brace = shapes::Brace { 0.91, 2.73, 0.09, 0.045 };
	const Vec3 centre = massProperties(Polyhedron::fromVertices(brace.vertices())).centroid;
	const auto prism = shapes::moved(brace.vertices(), none, -centre);
	const auto box = [](const Vec3& e) { return shapes::boxVertices(e); };
	const Vec3 up = Vec3::UnitZ(), east = Vec3::UnitX();
	return {
		{ "face on face", box(plate), box(cube), plate, cube, none, none, up, Vec3(0.01, 0.02, 0), depth, 4 },
		{ "edge on edge", box(beam), box(beam), beam, beam, edgeUp, across, up, Vec3::Zero(), depth, 1 },
		{ "corner on face", box(plate), box(cube), plate, cube, none, cornerDown, up, Vec3(0.01, 0.02, 0),
		        depth, 1 },
		{ "hexagonal prism on floor", box(plate), prism, plate, Vec3::Zero(), none, none, up,
		        Vec3(centre.x() - 0.02, 0, 0), depth, 4 },
		{ "hexagonal prism on wall", box(wall), prism, wall, Vec3::Zero(), none, none, east,
		        Vec3(0, 0, centre.z() - 0.1), depth, 4 },
		{ "near faces", box(plate), box(cube), plate, cube, none, none, up, Vec3(0.01, 0.02, 0), -nearGap, 0 },
	};
}

/// Support function of rotated points: largest coordinate along a direction. [m]
inline double support(const std::vector<Vec3>& points, const Quat& rotation, const Vec3& direction)
{
	double largest = -1e300;
	for (const Vec3& p : points)
		largest = std::max(largest, (rotation * p).dot(direction));
	return largest;
}

/// Position of body B for the closed-form overlap. margins: sum of the collision margins that a library adds to the
/// corners [m].
inline Vec3 positionOfB(const Configuration& c, const std::vector<Vec3>& a, const std::vector<Vec3>& b, double margins)
{
	const double distance
	        = support(a, c.rotationA, c.normal) + support(b, c.rotationB, -c.normal) + margins - c.overlap;
	return c.offset - c.offset.dot(c.normal) * c.normal + distance * c.normal;
}

/// Displacement in step k, as in a house at rest: a tenth of a micrometre. [m]
inline Vec3 vibration(int k) { return 1e-7 * Vec3(k % 7 - 3, k % 5 - 2, k % 3 - 1); }

/// Contact points found by a library, compared with the closed form.
struct Found {
	int points = 0;
	double normalError = 0; ///< largest angle between a normal and the closed form [rad]
	double depthError = 0; ///< largest error of an overlap [m]
	void add(const Configuration& c, const Vec3& normal, double overlap)
	{
		++points;
		normalError = std::max(normalError, std::atan2(normal.cross(c.normal).norm(), normal.dot(c.normal)));
		depthError = std::max(depthError, std::abs(overlap - c.overlap));
	}
};

} // namespace timber::bench
