// SPDX-License-Identifier: GPL-2.0-or-later
/// Pairs in closed-form configurations: every library gets the same bodies, placed by its own idea of their surface.
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
	Vec3 boxA, boxB; ///< extents of the bodies that are boxes, else zero [m]
	Quat turnA, turnB;
	Vec3 normal; ///< closed form: unit
	Vec3 aside; ///< where B's frame is, but for the way along the normal [m]
	double overlap; ///< closed form [m]; < 0: a gap
	int points; ///< of a face with four corners: 4; of an edge or a corner: 1
};

inline Vec3 principalCentre(const std::vector<Vec3>& points) { return massProperties(Polyhedron::fromVertices(points)).centroid; }

inline std::vector<Configuration> configurations()
{
	const Vec3 plate(1, 1, 0.2), cube(0.3, 0.3, 0.3), beam(1, 0.2, 0.2), wall(0.2, 1, 1);
	const Quat none = Quat::Identity(), edgeUp = shapes::about(Vec3::UnitX(), M_PI / 4), across = shapes::about(Vec3::UnitZ(), M_PI / 2) * edgeUp;
	const Quat cornerDown = Quat::FromTwoVectors(Vec3(1, 1, 1), -Vec3::UnitZ());
	const auto brace = shapes::Brace { 0.91, 2.73, 0.09, 0.045 };
	const Vec3 centre = principalCentre(brace.vertices());
	const auto prism = shapes::moved(brace.vertices(), none, -centre);
	const auto box = [](const Vec3& e) { return shapes::boxVertices(e); };
	const Vec3 up = Vec3::UnitZ(), east = Vec3::UnitX();
	return {
		{ "face on face", box(plate), box(cube), plate, cube, none, none, up, Vec3(0.01, 0.02, 0), depth, 4 },
		{ "edge on edge", box(beam), box(beam), beam, beam, edgeUp, across, up, Vec3::Zero(), depth, 1 },
		{ "corner on face", box(plate), box(cube), plate, cube, none, cornerDown, up, Vec3(0.01, 0.02, 0), depth, 1 },
		{ "hexagonal prism on floor", box(plate), prism, plate, Vec3::Zero(), none, none, up, Vec3(centre.x() - 0.02, 0, 0), depth, 4 },
		{ "hexagonal prism on wall", box(wall), prism, wall, Vec3::Zero(), none, none, east, Vec3(0, 0, centre.z() - 0.1), depth, 4 },
		{ "near faces", box(plate), box(cube), plate, cube, none, none, up, Vec3(0.01, 0.02, 0), -nearGap, 0 },
	};
}

/// Greatest coordinate along a direction of points turned by `turn`. [m]
inline double support(const std::vector<Vec3>& points, const Quat& turn, const Vec3& direction)
{
	double most = -1e300;
	for (const Vec3& p : points)
		most = std::max(most, (turn * p).dot(direction));
	return most;
}

/// Where body B stands for the closed-form overlap; margins: what a library adds to the given corners all round. [m]
inline Vec3 placeOfB(const Configuration& c, const std::vector<Vec3>& a, const std::vector<Vec3>& b, double margins)
{
	const double apart = support(a, c.turnA, c.normal) + support(b, c.turnB, -c.normal) + margins - c.overlap;
	return c.aside - c.aside.dot(c.normal) * c.normal + apart * c.normal;
}

/// Motion in step k, as of a standing house: a tenth of a micrometre.
inline Vec3 trembling(int k) { return 1e-7 * Vec3(k % 7 - 3, k % 5 - 2, k % 3 - 1); }

/// What was found against the closed form.
struct Found {
	int points = 0;
	double normalError = 0; ///< largest angle between a normal and the expected one [rad]
	double depthError = 0; ///< largest difference of an overlap [m]
	void add(const Configuration& c, const Vec3& normal, double overlap)
	{
		++points;
		normalError = std::max(normalError, std::atan2(normal.cross(c.normal).norm(), normal.dot(c.normal)));
		depthError = std::max(depthError, std::abs(overlap - c.overlap));
	}
};

} // namespace timber::bench
