// SPDX-License-Identifier: GPL-2.0-or-later
/// Convex polyhedra and their rounded form (paper, section 2.2, Fig. 2).
#pragma once
#include "types.hpp"
#include <stdexcept>
#include <string>
#include <vector>

namespace timber {

/// The input is not an admissible convex polyhedron. The message names the vertex or plane and the reason.
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
	std::vector<HalfSpace> sidePlanes; ///< through corners k and k+1; normal in the face, outwards
	/// Through corner k; normal: bisector of the normals of its two side planes.
	std::vector<HalfSpace> bevelPlanes;
};

struct Edge {
	int tail, head; ///< vertex indices
	int left, right; ///< faces: tail->head runs counter-clockwise in `left`
	Vec3 outward; ///< unit bisector of the two face normals
	Vec3 direction; ///< unit, from tail to head
	double length; ///< [m]
};

/// A convex polyhedron, in the frame of its vertices.
struct Polyhedron {
	std::vector<Vec3> vertices;
	std::vector<Face> faces;
	std::vector<Edge> edges;

	/// Polyhedron with these corners [m]; each point must be a corner of the convex hull.
	/// Points within planarShare of a plane form one face.
	/// Throws PolyhedronError for: fewer than 4 or more than maxVertices points; coordinates that are not finite;
	/// an extent outside smallestSize ... largestSize; coincident points; coplanar points; a point that is not a
	/// corner.
	static Polyhedron fromVertices(const std::vector<Vec3>& points);

	double shortestEdge() const; ///< [m]
	double thickness() const; ///< smallest width over all face normals [m]
};

/// Mass properties for unit density.
struct MassProperties {
	double volume; ///< [m3]
	Vec3 centroid; ///< [m]
	Mat3 inertia; ///< about the centroid, axes of the vertices' frame [m5]
};
MassProperties massProperties(const Polyhedron& body);

/// Rotation whose columns are the principal axes, right-handed. Among equivalent choices the one closest to the given
/// axes (identity for an axis-aligned box and for a cube). inertia: symmetric.
Mat3 principalAxes(const Mat3& inertia);

/// Minkowski sum of an inner core and a ball. The outer faces coincide with those of the sharp polyhedron; vertices
/// become 1/8 spheres and edges 1/4 cylinders.
struct RoundedPolyhedron {
	Polyhedron sharp; ///< the element with sharp edges
	Polyhedron core; ///< faces of `sharp` moved inwards by `radius`
	double radius = 0; ///< rounding radius [m]
	Vec3 halfExtents = Vec3::Zero(); ///< largest absolute coordinate of the core vertices along each axis [m]
	double boundingRadius = 0; ///< largest distance of a core vertex from the origin [m]
	unsigned long serial = 0; ///< unique number of this geometry; identifies it in a CandidateCache
	double coreHalfThickness = 0; ///< maximum penetration into the core at which a face or edge gives a contact [m]

	/// radius <= 0: 10 % of the shortest edge (radiusShare). Warped faces of `sharp` may become planar (warpShare).
	/// Throws PolyhedronError if no core remains.
	static RoundedPolyhedron fromSharp(Polyhedron sharp, double radius = 0);
};

} // namespace timber
