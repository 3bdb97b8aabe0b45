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

	/// Empty if the faces do not close.
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
			if (back == faceLeftOf.end()) return {};
			if (ends.first < ends.second)
				edges.push_back(
				        edgeBetween(points, faces, ends.first, ends.second, left, back->second));
		}
		return edges;
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

	/// First point within the tolerance of the hull of the others; the number of points if there is none.
	size_t firstNoCorner(const std::vector<Vec3>& points, double tolerance)
	{
		for (size_t k = 0; k < points.size() && points.size() > 4; ++k) {
			std::vector<Vec3> others = points;
			others.erase(others.begin() + long(k));
			const std::vector<Triangle> hull = hullTriangles(others);
			if (!hull.empty() && heightAbove(others, hull, points[k]) <= tolerance) return k;
		}
		return points.size();
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

	/// Corners of faces, of triangles with neighbours in one plane joined.
	std::vector<Corners> joinedOutlines(
	        const std::vector<Vec3>& points, const std::vector<Triangle>& triangles, double tolerance)
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
		std::vector<Corners> outlines;
		for (Patch& patch : patches)
			outlines.push_back(std::move(patch.face.corners));
		return outlines;
	}

	/// Faces in the order of their sorted corners.
	std::vector<Face> orderedFaces(const std::vector<Vec3>& points, const std::vector<Corners>& outlines)
	{
		Vec3 inside = Vec3::Zero();
		for (const Vec3& p : points)
			inside += p / double(points.size());
		std::map<Corners, Face> ordered;
		for (const Corners& outline : outlines) {
			Corners sorted = outline;
			std::sort(sorted.begin(), sorted.end());
			ordered[sorted] = faceOf(points, outline, sorted, inside);
		}
		std::vector<Face> faces;
		for (auto& item : ordered)
			faces.push_back(std::move(item.second));
		return faces;
	}

	/// Number of faces at the corner with the fewest.
	int leastDegree(size_t count, const std::vector<Corners>& outlines)
	{
		std::vector<int> degree(count, 0);
		for (const Corners& outline : outlines)
			for (int k : outline)
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
Hull tryConvexHull(const std::vector<Vec3>& points, double tolerance)
{
	assert(points.size() >= 4 && points.size() <= maxVertices);
	assert(tolerance > 0);
	const std::vector<Triangle> triangles = hullTriangles(points);
	const auto within = [&](double limit) { return joinedOutlines(points, triangles, limit); };
	std::vector<Corners> outlines = within(tolerance);
	if (outlines.size() < 4) return { HullOutcome::Coplanar };
	if (leastDegree(points.size(), outlines) < 3) {
		const size_t k = firstNoCorner(points, tolerance);
		if (k < points.size()) return { HullOutcome::NoCorner, {}, k };
	}
	for (double share = 0.1; share > 1e-4 && leastDegree(points.size(), outlines) < 3; share /= 10)
		outlines = within(share * tolerance);
	if (leastDegree(points.size(), outlines) < 3) outlines = within(0);
	return closedBody(points, outlines);
}

Hull closedBody(const std::vector<Vec3>& vertices, const std::vector<Corners>& outlines)
{
	Polyhedron body { vertices, orderedFaces(vertices, outlines), {} };
	for (Face& face : body.faces) {
		if (!face.plane.normal.allFinite()) return { HullOutcome::Open };
		setSidePlanes(face, body.vertices);
	}
	body.edges = edgesOf(body.vertices, body.faces);
	// Euler's formula
	if (body.vertices.size() + body.faces.size() != body.edges.size() + 2) return { HullOutcome::Open };
	return { HullOutcome::Sound, std::move(body) };
}

Polyhedron convexHull(const std::vector<Vec3>& points)
{
	for (size_t k = 0; k < points.size(); ++k)
		if (!points[k].allFinite())
			throw PolyhedronError("vertex " + std::to_string(k) + " is not finite: " + toText(points[k]));
	const double size = sizeOf(points);
	checkSize(size);
	checkDistinct(points, planarShare * size);
	Hull hull = tryConvexHull(points, planarShare * size);
	if (hull.outcome == HullOutcome::Coplanar)
		throw PolyhedronError("the vertices lie in one plane: a polyhedron needs a volume");
	if (hull.outcome == HullOutcome::NoCorner)
		throw PolyhedronError("vertex " + std::to_string(hull.point) + " " + toText(points[hull.point])
		        + " is no corner of the convex hull: the element is not convex or the vertex is superfluous");
	if (hull.outcome != HullOutcome::Sound)
		throw PolyhedronError("faces, edges and vertices do not form one closed surface (Euler's formula)");
	return std::move(hull.body);
}

} // namespace timber
