// SPDX-License-Identifier: GPL-2.0-or-later
#include "convex_hull.hpp"
#include "constants.hpp"
#include "triangle_hull.hpp"
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>
#include <utility>

namespace timber {

// The hull's triangles (triangle_hull.hpp) close at any placement of the points. Neighbours in one plane within the
// tolerance are joined to faces. Faces are ordered by the indices of their corners.
namespace {

	void checkSize(double extent)
	{
		// 0: checkDistinct has the better message
		if (extent == 0 || (smallestSize <= extent && extent <= largestSize)) return;
		std::ostringstream what;
		what << "the vertices extend over " << extent << " m: a polyhedron has " << smallestSize << " to "
		     << largestSize << " m";
		throw PolyhedronError(what.str());
	}

	void checkDistinct(const std::vector<Vec3>& points, double tolerance)
	{
		for (size_t k = 0; k < points.size(); ++k)
			for (size_t l = k + 1; l < points.size(); ++l)
				if ((points[k] - points[l]).norm() <= tolerance)
					throw PolyhedronError("vertices " + std::to_string(k) + " and "
					        + std::to_string(l) + " are the same point " + toText(points[k]));
	}

	using Corners = std::vector<int>; ///< of a face, by index

	void setSidePlanes(Face& face, const std::vector<Vec3>& points)
	{
		const size_t count = face.corners.size();
		const auto through = [](const Vec3& normal, const Vec3& x) {
			return HalfSpace { normal, normal.dot(x) };
		};
		for (size_t k = 0; k < count; ++k) {
			const Vec3 &corner = points[face.corners[k]], &next = points[face.corners[(k + 1) % count]];
			face.sidePlanes.push_back(
			        through((next - corner).cross(face.plane.normal).normalized(), corner));
		}
		for (size_t k = 0; k < count; ++k)
			face.bevelPlanes.push_back(
			        through((face.sidePlanes[k].normal + face.sidePlanes[(k + count - 1) % count].normal)
			                        .normalized(),
			                points[face.corners[k]]));
	}

	Vec3 meanOf(const std::vector<Vec3>& points, const Corners& corners)
	{
		Vec3 centre = Vec3::Zero();
		for (int k : corners)
			centre += points[k];
		return centre / double(corners.size());
	}

	/// Face from its corners, counter-clockwise seen from outside, and their mean: Newell normal.
	Face faceOf(const std::vector<Vec3>& points, Corners corners, const Vec3& centre)
	{
		Vec3 newell = Vec3::Zero();
		for (size_t k = 0; k < corners.size(); ++k)
			newell += (points[corners[k]] - centre)
			                  .cross(points[corners[(k + 1) % corners.size()]] - centre);
		Face face;
		face.plane.normal = newell.normalized();
		face.plane.offset = face.plane.normal.dot(centre);
		face.corners = std::move(corners);
		return face;
	}

	/// Face from its outline and its sorted corners. Of the angles about the centre, from the first corner, the least
	/// one comes first.
	Face faceOf(const std::vector<Vec3>& points, Corners outline, const Corners& sorted, const Vec3& inside)
	{
		const Vec3 centre = meanOf(points, sorted);
		const Vec3 u = (points[sorted[0]] - centre).normalized();
		Vec3 direction = Vec3::Zero();
		for (size_t k = 1; k < sorted.size(); ++k) {
			const Vec3 c = u.cross(points[sorted[k]] - centre);
			if (c.norm() > direction.norm()) direction = c;
		}
		if (direction.dot(centre - inside) < 0) direction = -direction;
		const Vec3 v = direction.normalized().cross(u);
		const auto angle = [&](int k) {
			const Vec3 x = points[k] - centre;
			const double along = x.dot(u), across = x.dot(v);
			return std::copysign(1 - along / (std::abs(along) + std::abs(across)), across);
		};
		std::rotate(outline.begin(),
		        std::min_element(
		                outline.begin(), outline.end(), [&](int k, int l) { return angle(k) < angle(l); }),
		        outline.end());
		return faceOf(points, std::move(outline), centre);
	}

	Edge edgeBetween(const std::vector<Vec3>& points, const std::vector<Face>& faces, int tail, int head, int left,
	        int right)
	{
		const Vec3 span = points[head] - points[tail];
		return { tail, head, left, right, (faces[left].plane.normal + faces[right].plane.normal).normalized(),
			span.normalized(), span.norm() };
	}

	std::vector<Edge> edgesOf(const std::vector<Vec3>& points, const std::vector<Face>& faces)
	{
		std::map<std::pair<int, int>, int> faceLeftOf;
		for (size_t f = 0; f < faces.size(); ++f)
			for (size_t k = 0; k < faces[f].corners.size(); ++k)
				faceLeftOf[{ faces[f].corners[k], faces[f].corners[(k + 1) % faces[f].corners.size()] }]
				        = int(f);
		std::vector<Edge> edges;
		for (const auto& [ends, left] : faceLeftOf) {
			const auto back = faceLeftOf.find({ ends.second, ends.first });
			if (back == faceLeftOf.end())
				throw PolyhedronError("the faces do not close around the edge between vertices "
				        + std::to_string(ends.first) + " and " + std::to_string(ends.second));
			if (ends.first < ends.second)
				edges.push_back(
				        edgeBetween(points, faces, ends.first, ends.second, left, back->second));
		}
		return edges;
	}

	const char* const coplanar = "the vertices lie in one plane: a polyhedron needs a volume";

	PolyhedronError noCorner(const std::vector<Vec3>& points, size_t k)
	{
		return PolyhedronError("vertex " + std::to_string(k) + " " + toText(points[k])
		        + " is no corner of the convex hull: the element is not convex or the vertex is superfluous");
	}

	/// Largest distance of a point from the planes of triangles, > 0 outside; those without a plane are left out.
	/// [m]
	double heightAbove(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles, const Vec3& x)
	{
		double height = -std::numeric_limits<double>::infinity();
		for (const Triangle& t : triangles) {
			const Vec3 &a = points[t[0]], ab = points[t[1]] - a, ac = points[t[2]] - a,
			           normal = ab.cross(ac);
			const bool isLine = normal.norm() <= 1e-9 * std::max(ab.squaredNorm(), ac.squaredNorm());
			if (!isLine) height = std::max(height, normal.normalized().dot(x - a));
		}
		return height;
	}

	/// Refuses points that are within the tolerance of the hull of the others.
	void checkHeights(const std::vector<Vec3>& points, double tolerance)
	{
		for (size_t k = 0; k < points.size(); ++k) {
			std::vector<Vec3> others = points;
			others.erase(others.begin() + long(k));
			if (others.size() < 4) continue;
			const std::vector<Triangle> hull = hullTriangles(others);
			if (!hull.empty() && heightAbove(others, hull, points[k]) <= tolerance)
				throw noCorner(points, k);
		}
	}

	bool isPlanar(const std::vector<Vec3>& points, const Face& face, double tolerance)
	{
		return std::all_of(face.corners.begin(), face.corners.end(), [&](int k) {
			return std::abs(face.plane.normal.dot(points[k]) - face.plane.offset) <= tolerance;
		});
	}

	/// A face and its triangles.
	struct Patch {
		std::vector<Triangle> triangles;
		Face face;
	};

	/// Joins two patches that are neighbours in one plane within the tolerance.
	bool join(const std::vector<Vec3>& points, Patch& patch, const Patch& other, double tolerance)
	{
		const auto liesIn = [&](const Face& f, const HalfSpace& plane) {
			return isPlanar(points, { plane, f.corners, {}, {} }, 4 * tolerance);
		};
		if (!liesIn(other.face, patch.face.plane) && !liesIn(patch.face, other.face.plane)) return false;
		std::vector<Triangle> triangles = patch.triangles;
		triangles.insert(triangles.end(), other.triangles.begin(), other.triangles.end());
		const Corners outline = outlineOf(triangles);
		if (outline.empty()) return false;
		Face face = faceOf(points, outline, meanOf(points, outline));
		if (!isPlanar(points, face, tolerance)) return false;
		patch = { std::move(triangles), std::move(face) };
		return true;
	}

	/// Faces of triangles, with neighbours in one plane joined.
	std::vector<Face> joinedFaces(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles,
	        const Vec3& inside, double tolerance)
	{
		std::vector<Patch> patches;
		for (const Triangle& t : triangles)
			patches.push_back({ { t },
			        faceOf(points, { t.begin(), t.end() }, meanOf(points, { t.begin(), t.end() })) });
		for (size_t k = 0; k < patches.size(); ++k)
			for (size_t l = k + 1; l < patches.size();)
				if (join(points, patches[k], patches[l], tolerance)) {
					patches.erase(patches.begin() + long(l));
					l = k + 1;
				} else ++l;
		std::map<Corners, Face> ordered;
		for (const Patch& patch : patches) {
			Corners sorted = patch.face.corners;
			std::sort(sorted.begin(), sorted.end());
			ordered[sorted] = faceOf(points, patch.face.corners, sorted, inside);
		}
		std::vector<Face> faces;
		for (auto& item : ordered)
			faces.push_back(std::move(item.second));
		return faces;
	}

	/// Number of faces at the corner with the fewest.
	int leastDegree(size_t count, const std::vector<Face>& faces)
	{
		std::vector<int> degree(count, 0);
		for (const Face& face : faces)
			for (int k : face.corners)
				++degree[k];
		return *std::min_element(degree.begin(), degree.end());
	}

} // namespace

std::string toText(const Vec3& v)
{
	std::ostringstream s;
	s << "(" << v.x() << ", " << v.y() << ", " << v.z() << ")";
	return s.str();
}

double sizeOf(const std::vector<Vec3>& points)
{
	Vec3 low = points.front(), high = points.front();
	for (const Vec3& p : points) {
		low = low.cwiseMin(p);
		high = high.cwiseMax(p);
	}
	return (high - low).maxCoeff();
}

/// Faces are as planar as leaves each point the corner of three.
Polyhedron convexHull(const std::vector<Vec3>& points, double tolerance)
{
	assert(points.size() >= 4 && points.size() <= 4 * maxVertices);
	assert(tolerance > 0);
	Vec3 inside = Vec3::Zero();
	for (const Vec3& p : points)
		inside += p / double(points.size());
	const std::vector<Triangle> triangles = hullTriangles(points);
	const auto facesWithin = [&](double limit) { return joinedFaces(points, triangles, inside, limit); };
	std::vector<Face> faces = facesWithin(tolerance);
	if (faces.size() < 4) throw PolyhedronError(coplanar);
	if (leastDegree(points.size(), faces) < 3) checkHeights(points, tolerance);
	for (double share = 0.1; share > 1e-4 && leastDegree(points.size(), faces) < 3; share /= 10)
		faces = facesWithin(share * tolerance);
	if (leastDegree(points.size(), faces) < 3) faces = facesWithin(0);
	return closedBody(points, std::move(faces));
}

Polyhedron closedBody(std::vector<Vec3> vertices, std::vector<Face> faces)
{
	Polyhedron body { std::move(vertices), std::move(faces), {} };
	for (Face& face : body.faces)
		setSidePlanes(face, body.vertices);
	body.edges = edgesOf(body.vertices, body.faces);
	if (body.vertices.size() + body.faces.size() != body.edges.size() + 2)
		throw PolyhedronError("faces, edges and vertices do not form one closed surface (Euler's formula)");
	return body;
}

Polyhedron convexHull(const std::vector<Vec3>& points)
{
	for (size_t k = 0; k < points.size(); ++k)
		if (!points[k].allFinite())
			throw PolyhedronError("vertex " + std::to_string(k) + " is not finite: " + toText(points[k]));
	const double size = sizeOf(points);
	checkSize(size);
	checkDistinct(points, planarShare * size);
	return convexHull(points, planarShare * size);
}

} // namespace timber
