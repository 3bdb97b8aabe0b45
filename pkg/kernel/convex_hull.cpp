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

// Convex hull of n points, n <= 4 maxVertices:
//   1. For each pair of points: skip the pair if no supporting plane can contain it (maySupport). This leaves about the
//     edges.
//   2. For each third point: the plane through the three points is supporting if no point is outside by more than the
//     tolerance. The points
//      within the tolerance of the plane are the corners of a face.
//   3. Sets of corners contained in another set are caused by rounding and are dropped.
//   4. Sort the corners of each face; find the edges from pairs of faces; check that the surface is closed.
// Step 1 is O(n^2) for most inputs and changes no result. Faces are ordered by the indices of their corners.
namespace {

	/// The faces do not form a closed surface: some are neither planar within the tolerance nor clearly bent.
	struct OpenSurface : PolyhedronError {
		using PolyhedronError::PolyhedronError;
	};

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

	using Vec2 = Eigen::Vector2d;

	double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

	/// Whether the triangle contains the origin at more than `distance` from each side; it must contain the origin.
	bool enclosesOrigin(const Vec2& a, const Vec2& b, const Vec2& c, double distance)
	{
		const auto isFar = [distance](const Vec2& p, const Vec2& q) {
			return std::abs(cross(p, q)) > distance * (p - q).norm();
		};
		return isFar(a, b) && isFar(b, c) && isFar(c, a);
	}

	/// Whether a plane through points a and b can be supporting. All points are projected along the line ab, which
	/// becomes the origin. Their directions from there form a cone; once a triangle of projected points encloses
	/// the origin, each plane has points on both sides.
	bool maySupport(const std::vector<Vec3>& points, int a, int b, double tolerance)
	{
		const Vec3 line = (points[b] - points[a]).normalized(), e1 = line.unitOrthogonal(), e2 = line.cross(e1);
		Vec2 right = Vec2::Zero(), left = right; // of the cone, counter-clockwise from right to left
		for (const Vec3& point : points) {
			const Vec3 x = point - points[a];
			const Vec2 w(e1.dot(x), e2.dot(x));
			// Too near the line to exclude a plane
			if (w.squaredNorm() <= 64 * tolerance * tolerance) continue;
			const double beyondRight = -cross(right, w), beyondLeft = -cross(w, left);
			if (right.isZero(0)) right = left = w;
			else if (beyondRight > 0 && beyondLeft > 0) {
				if (enclosesOrigin(right, left, w, 2 * tolerance)) return false;
			} else if (beyondRight > 0) right = w;
			else if (beyondLeft > 0) left = w;
		}
		return true;
	}

	using Corners = std::vector<int>; ///< of a face, by index

	/// Sets of the corners of faces (step 2).
	class SupportingSets {
	public:
		std::vector<Corners> sets;

		SupportingSets(const std::vector<Vec3>& points, double tolerance)
		        : points(points)
		        , tolerance(tolerance)
		{
		}
		/// Adds the corners of the planes through three points, one for each sign of the normal.
		void addPlanes(int a, int b, int c)
		{
			const Vec3 &origin = points[a], ab = points[b] - origin, ac = points[c] - origin;
			Vec3 normal = ab.cross(ac);
			const bool isExcluded = isOutside(lastAbove, origin, normal),
			           isReverseExcluded = isOutside(lastBelow, origin, -normal);
			if (isExcluded && isReverseExcluded) return;
			const double longest = std::max({ ab.norm(), ac.norm(), (points[c] - points[b]).norm() });
			if (normal.norm() <= 2 * tolerance * longest) return; // collinear points span no plane
			normal.normalize();
			if (!isExcluded) addIfSupporting(origin, normal, lastAbove);
			if (!isReverseExcluded) addIfSupporting(origin, -normal, lastBelow);
		}

	private:
		const std::vector<Vec3>& points;
		const double tolerance;
		/// The last points found outside a plane: they are likely outside the next one.
		int lastAbove = 0, lastBelow = 0;

		/// Whether a point is outside the plane by more than twice the tolerance, so that rounding does not
		/// matter.
		bool isOutside(int k, const Vec3& origin, const Vec3& unscaledNormal) const
		{
			const double height = unscaledNormal.dot(points[k] - origin);
			return height > 0 && height * height > 4 * tolerance * tolerance * unscaledNormal.squaredNorm();
		}
		void addIfSupporting(const Vec3& origin, const Vec3& normal, int& outside)
		{
			Corners in;
			for (size_t k = 0; k < points.size(); ++k) {
				const double height = normal.dot(points[k] - origin);
				if (height > tolerance) {
					outside = int(k);
					return;
				}
				if (height >= -tolerance) in.push_back(int(k));
			}
			if (std::find(sets.begin(), sets.end(), in) == sets.end()) sets.push_back(in);
		}
	};

	std::vector<Corners> withoutSubsets(const std::vector<Corners>& sets)
	{
		const auto isSubset = [&](const Corners& small) {
			return std::any_of(sets.begin(), sets.end(), [&](const Corners& large) {
				return large.size() > small.size()
				        && std::includes(large.begin(), large.end(), small.begin(), small.end());
			});
		};
		std::vector<Corners> maximal;
		for (const Corners& s : sets)
			if (!isSubset(s)) maximal.push_back(s);
		return maximal;
	}

	/// Steps 1 to 3.
	std::vector<Corners> supportingSets(const std::vector<Vec3>& points, double tolerance)
	{
		const int count = int(points.size());
		SupportingSets found(points, tolerance);
		for (int a = 0; a < count; ++a)
			for (int b = a + 1; b < count; ++b) {
				if (!maySupport(points, a, b, tolerance)) continue;
				for (int c = b + 1; c < count; ++c)
					found.addPlanes(a, b, c);
			}
		return withoutSubsets(found.sets);
	}

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

	/// Face from its unordered corners.
	Face orderedFace(const std::vector<Vec3>& points, std::vector<int> corners, const Vec3& inside)
	{
		const Vec3 centre = meanOf(points, corners);
		const Vec3 u = (points[corners[0]] - centre).normalized();
		Vec3 direction = Vec3::Zero();
		for (size_t k = 1; k < corners.size(); ++k) {
			const Vec3 c = u.cross(points[corners[k]] - centre);
			if (c.norm() > direction.norm()) direction = c;
		}
		if (direction.dot(centre - inside) < 0) direction = -direction;
		const Vec3 v = direction.normalized().cross(u);
		std::sort(corners.begin(), corners.end(), [&](int k, int l) {
			const Vec3 a = points[k] - centre, b = points[l] - centre;
			return std::atan2(a.dot(v), a.dot(u)) < std::atan2(b.dot(v), b.dot(u));
		});
		return faceOf(points, std::move(corners), centre);
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
				throw OpenSurface("the faces do not close around the edge between vertices "
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

	void checkCorners(const std::vector<Vec3>& points, const std::vector<Corners>& faces)
	{
		std::vector<int> degree(points.size(), 0);
		for (const Corners& corners : faces)
			for (int k : corners)
				++degree[k];
		for (size_t k = 0; k < points.size(); ++k)
			if (degree[k] < 3) throw noCorner(points, k);
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
	std::vector<Face> joinedFaces(
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
		std::vector<Face> faces;
		for (Patch& patch : patches)
			faces.push_back(std::move(patch.face));
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

Polyhedron convexHull(const std::vector<Vec3>& points, double tolerance)
{
	assert(points.size() >= 4 && points.size() <= 4 * maxVertices);
	assert(tolerance > 0);
	Vec3 inside = Vec3::Zero();
	for (const Vec3& p : points)
		inside += p / double(points.size());
	const std::vector<Corners> sets = supportingSets(points, tolerance);
	if (sets.empty()
	        || std::any_of(sets.begin(), sets.end(), [&](const Corners& s) { return s.size() == points.size(); }))
		throw PolyhedronError(coplanar);
	std::vector<Face> faces;
	for (const Corners& corners : sets)
		faces.push_back(orderedFace(points, corners, inside));
	checkCorners(points, sets);
	return closedBody(points, std::move(faces));
}

Polyhedron closedBody(std::vector<Vec3> vertices, std::vector<Face> faces)
{
	Polyhedron body { std::move(vertices), std::move(faces), {} };
	for (Face& face : body.faces)
		setSidePlanes(face, body.vertices);
	body.edges = edgesOf(body.vertices, body.faces);
	if (body.vertices.size() + body.faces.size() != body.edges.size() + 2)
		throw OpenSurface("faces, edges and vertices do not form one closed surface (Euler's formula)");
	return body;
}

/// Faces are as planar as leaves each point the corner of three.
Polyhedron triangulatedHull(const std::vector<Vec3>& points)
{
	const double tolerance = planarShare * sizeOf(points);
	const std::vector<Triangle> triangles = hullTriangles(points);
	if (triangles.empty()) throw PolyhedronError(coplanar);
	checkHeights(points, tolerance);
	for (double share = 1; share > 1e-4; share /= 10)
		if (std::vector<Face> faces = joinedFaces(points, triangles, share * tolerance);
		        leastDegree(points.size(), faces) > 2)
			return closedBody(points, std::move(faces));
	return closedBody(points, joinedFaces(points, triangles, 0));
}

void checkPoints(const std::vector<Vec3>& points)
{
	for (size_t k = 0; k < points.size(); ++k)
		if (!points[k].allFinite())
			throw PolyhedronError("vertex " + std::to_string(k) + " is not finite: " + toText(points[k]));
	const double size = sizeOf(points);
	checkSize(size);
	checkDistinct(points, planarShare * size);
}

Polyhedron closedConvexHull(const std::vector<Vec3>& points)
{
	checkPoints(points);
	const double size = sizeOf(points);
	for (double share = planarShare; share < warpShare; share *= 10)
		try {
			return convexHull(points, share * size);
		} catch (const OpenSurface&) { // nearly planar faces: increase the tolerance
		}
	return convexHull(points, warpShare * size);
}

} // namespace timber
