// SPDX-License-Identifier: GPL-2.0-or-later
/// Convex polyhedra and their rounded form (paper, section 2.2, Fig. 2).
#pragma once
#include "types.hpp"
#include <stdexcept>
#include <string>
#include <vector>

namespace timber {

/// Input that is no convex polyhedron; the message says which vertex or plane is wrong and why.
struct PolyhedronError : std::invalid_argument {
	using std::invalid_argument::invalid_argument;
};

/// Points x with normal.x <= offset [m]; normal is a unit vector and points outwards.
struct HalfSpace {
	Vec3 normal;
	double offset;
};

struct Face {
	HalfSpace plane;
	std::vector<int> corners; ///< vertex indices, counter-clockwise seen from outside
	std::vector<HalfSpace> borders; ///< from corner k to k+1; normals in the plane of the face
	std::vector<HalfSpace> tips; ///< through corner k, across the bisector of its two borders
};

struct Edge {
	int tail, head; ///< vertex indices
	int left, right; ///< faces: tail->head runs counter-clockwise in `left`
	Vec3 outward; ///< unit bisector of the two face normals
	Vec3 along; ///< unit, from tail to head
	double length; ///< [m]
};

/// A convex polyhedron in whatever frame its vertices are given in.
struct Polyhedron {
	std::vector<Vec3> vertices;
	std::vector<Face> faces;
	std::vector<Edge> edges;

	/// Polyhedron whose corners are exactly these points [m].
	/// Points nearly in a plane make one face (planarShare; up to warpShare where the faces would not close otherwise).
	/// Throws PolyhedronError: fewer than 4 points, NaN, an extent outside smallestSize ... largestSize, two equal, all in a
	/// plane, one that is no corner of the hull.
	static Polyhedron fromVertices(const std::vector<Vec3>& points);
	/// Bounded intersection of half-spaces; redundant ones are dropped. Throws PolyhedronError if empty, flat or unbounded.
	static Polyhedron fromHalfSpaces(const std::vector<HalfSpace>& planes);

	double shortestEdge() const; ///< [m]
	double thickness() const; ///< smallest width over all face normals [m]
};

/// For unit density: multiply mass and inertia by the density.
struct MassProperties {
	double volume; ///< [m3]
	Vec3 centroid; ///< [m]
	Mat3 inertia; ///< about the centroid, axes of the vertices' frame [m5]
};
MassProperties massProperties(const Polyhedron& body);

/// Rotation whose columns are the principal axes, right-handed, as close to the given axes as the inertia allows
/// (identity for an axis-aligned box, also for a cube).
Mat3 principalAxes(const Mat3& inertia);

/// An inner core plus a ball: the outer faces stay where the sharp polyhedron has them, its vertices become 1/8
/// spheres and its edges 1/4 cylinders of that radius.
struct RoundedPolyhedron {
	Polyhedron sharp; ///< the element as drawn
	Polyhedron core; ///< faces of `sharp` moved inwards by `radius`
	double radius = 0; ///< [m]
	Vec3 span = Vec3::Zero(); ///< largest distance of a core vertex from the frame's origin along each axis [m]
	double reach = 0; ///< distance of the farthest core vertex from the frame's origin [m]
	unsigned long serial = 0; ///< another one for each that was made from vertices: what was kept for a body is known by it
	double coreHalfThickness = 0; ///< deepest overlap beyond the cores' contact that a face or edge answers to [m]

	/// radius <= 0 takes the paper's 10 % of the shortest edge. Warped faces may become plane in `sharp` (warpShare).
	/// Throws PolyhedronError if the core vanishes.
	static RoundedPolyhedron fromSharp(Polyhedron sharp, double radius = 0);
};

} // namespace timber
