// SPDX-License-Identifier: GPL-2.0-or-later
#include "polyhedron.hpp"
#include "constants.hpp"
#include "convex_hull.hpp"
#include "inner_core.hpp"
#include "triangle_hull.hpp"
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cmath>
#include <limits>
#include <sstream>

namespace timber {
namespace {

	/// Corners of an intersection of half-spaces: common points of three planes inside all half-spaces.
	std::vector<Vec3> cornerPoints(const std::vector<HalfSpace>& planes)
	{
		std::vector<Vec3> corners;
		double scale = 0;
		const auto inside = [&](const Vec3& p) {
			const double distance = p.norm();
			return std::all_of(planes.begin(), planes.end(), [&](const HalfSpace& h) {
				return h.normal.dot(p) - h.offset <= 1e-9 * (std::abs(h.offset) + distance);
			});
		};
		for (size_t a = 0; a < planes.size(); ++a)
			for (size_t b = a + 1; b < planes.size(); ++b)
				for (size_t c = b + 1; c < planes.size(); ++c) {
					Mat3 normals;
					normals << planes[a].normal.transpose(), planes[b].normal.transpose(),
					        planes[c].normal.transpose();
					if (std::abs(normals.determinant()) < 1e-9) continue;
					const Vec3 p = normals.inverse()
					        * Vec3(planes[a].offset, planes[b].offset, planes[c].offset);
					if (!inside(p)) continue;
					corners.push_back(p);
					scale = std::max(scale, (p - corners.front()).norm());
				}
		std::vector<Vec3> distinct;
		for (const Vec3& p : corners)
			if (std::none_of(distinct.begin(), distinct.end(),
			            [&](const Vec3& q) { return (p - q).norm() <= 4 * planarShare * scale; }))
				distinct.push_back(p);
		return distinct;
	}

	/// Intersection of half-spaces whose normals are unit vectors.
	Polyhedron intersectionOf(const std::vector<HalfSpace>& planes)
	{
		const std::vector<Vec3> corners = cornerPoints(planes);
		if (corners.size() < 4) throw PolyhedronError("the half-spaces enclose no volume");
		Polyhedron body = convexHull(corners);
		// An unbounded intersection has a closing face that is none of the planes
		for (const Face& face : body.faces) {
			const bool isPlane = std::any_of(planes.begin(), planes.end(),
			        [&](const HalfSpace& h) { return h.normal.dot(face.plane.normal) > 1 - 1e-6; });
			if (!isPlane)
				throw PolyhedronError("the half-spaces do not bound a volume in the direction "
				        + toText(face.plane.normal));
		}
		return body;
	}

	/// The planes of the faces, moved inwards.
	std::vector<HalfSpace> innerPlanes(const Polyhedron& sharp, double radius)
	{
		std::vector<HalfSpace> planes;
		for (const Face& face : sharp.faces)
			planes.push_back({ face.plane.normal, face.plane.offset - radius });
		return planes;
	}

	/// Core whose faces no tolerance tells from corners.
	Polyhedron closedCore(const Polyhedron& sharp, double radius)
	{
		const double size = sizeOf(sharp.vertices), tolerance = planarShare * size;
		const Sphere largest = inscribedSphere(innerPlanes(sharp, 0), sharp.vertices.front(), size);
		if (radius >= largest.radius - tolerance) {
			std::ostringstream what;
			what << "rounding radius " << radius
			     << " m leaves no core: it must be below the radius of the inscribed sphere, "
			     << largest.radius << " m";
			throw PolyhedronError(what.str());
		}
		return intersectionAround(largest.centre, innerPlanes(sharp, radius), 4 * tolerance);
	}

} // namespace

Polyhedron Polyhedron::fromVertices(const std::vector<Vec3>& points)
{
	if (points.size() < 4)
		throw PolyhedronError("a polyhedron has at least 4 vertices, got " + std::to_string(points.size()));
	if (points.size() > maxVertices)
		throw PolyhedronError("a polyhedron has at most " + std::to_string(maxVertices) + " vertices, got "
		        + std::to_string(points.size())
		        + ": the time of a contact grows with the third power of their number");
	return convexHull(points);
}

Polyhedron Polyhedron::fromHalfSpaces(const std::vector<HalfSpace>& planes)
{
	if (planes.size() > maxFaces)
		throw PolyhedronError(
		        "at most " + std::to_string(maxFaces) + " half-spaces, got " + std::to_string(planes.size()));
	std::vector<HalfSpace> units;
	for (size_t k = 0; k < planes.size(); ++k) {
		const double length = planes[k].normal.norm();
		if (!std::isfinite(length) || !std::isfinite(planes[k].offset) || length == 0)
			throw PolyhedronError(
			        "half-space " + std::to_string(k) + " has no finite unit normal and offset");
		units.push_back({ planes[k].normal / length, planes[k].offset / length });
	}
	return intersectionOf(units);
}

double Polyhedron::shortestEdge() const
{
	double shortest = std::numeric_limits<double>::infinity();
	for (const Edge& e : edges)
		shortest = std::min(shortest, (vertices[e.head] - vertices[e.tail]).norm());
	return shortest;
}

double Polyhedron::thickness() const
{
	double least = std::numeric_limits<double>::infinity();
	for (const Face& face : faces) {
		double low = face.plane.offset;
		for (const Vec3& v : vertices)
			low = std::min(low, face.plane.normal.dot(v));
		least = std::min(least, face.plane.offset - low);
	}
	return least;
}

namespace {

	/// Triangles of the surface; of the convex hull where corners are outside the planes of their faces.
	std::vector<Triangle> surfaceOf(const Polyhedron& body)
	{
		const double rounding = roundingShare * sizeOf(body.vertices);
		std::vector<Triangle> triangles;
		for (const Face& face : body.faces) {
			for (const int k : face.corners)
				if (std::abs(face.plane.normal.dot(body.vertices[k]) - face.plane.offset) > rounding)
					return hullTriangles(body.vertices);
			for (size_t k = 1; k + 1 < face.corners.size(); ++k)
				triangles.push_back({ face.corners[0], face.corners[k], face.corners[k + 1] });
		}
		return triangles;
	}

} // namespace

/// Sum over tetrahedra (reference point, face triangle); second moments as in Tonon (2004), J. Math. Stat. 1, 8-11.
MassProperties massProperties(const Polyhedron& body)
{
	assert(body.vertices.size() >= 4 && body.faces.size() >= 4);
	const Vec3 origin = body.vertices.front();
	double volume = 0;
	Vec3 first = Vec3::Zero();
	Mat3 second = Mat3::Zero();
	for (const Triangle& t : surfaceOf(body)) {
		const Vec3 a = body.vertices[t[0]] - origin, b = body.vertices[t[1]] - origin,
		           c = body.vertices[t[2]] - origin;
		const double part = a.dot(b.cross(c)) / 6;
		const Vec3 sum = a + b + c;
		volume += part;
		first += part / 4 * sum;
		second += part / 20
		        * (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
	}
	const Vec3 centre = first / volume;
	const Mat3 central = second - volume * centre * centre.transpose();
	return { volume, origin + centre, central.trace() * Mat3::Identity() - central };
}

/// The order and signs of the eigenvectors with the largest trace are right-handed: the traces of the six orders sum to
/// 2 sum |q_ij| >= 6, so the largest exceeds 1, and a left-handed orthogonal matrix has a trace of at most 1.
Mat3 principalAxes(const Mat3& inertia)
{
	assert(inertia.allFinite());
	const double offDiagonal
	        = std::max({ std::abs(inertia(0, 1)), std::abs(inertia(0, 2)), std::abs(inertia(1, 2)) });
	if (offDiagonal <= 1e-12 * inertia.trace()) return Mat3::Identity();
	const Mat3 vectors = Eigen::SelfAdjointEigenSolver<Mat3>(inertia).eigenvectors();
	constexpr std::array<std::array<int, 3>, 6> orders { { { 0, 1, 2 }, { 0, 2, 1 }, { 1, 0, 2 }, { 1, 2, 0 },
		{ 2, 0, 1 }, { 2, 1, 0 } } };
	Mat3 best = vectors;
	double alignment = -1;
	for (const auto& order : orders) {
		Mat3 axes;
		for (int k = 0; k < 3; ++k)
			axes.col(k) = vectors.col(order[k]) * (vectors(k, order[k]) < 0 ? -1. : 1.);
		if (axes.trace() > alignment) {
			alignment = axes.trace();
			best = axes;
		}
	}
	return best;
}

/// Slightly warped faces split into triangles. The cores of these have clusters of corners, or do not close. The
/// planarity tolerance is therefore increased while two corners of the core are too close to be two contacts.
RoundedPolyhedron RoundedPolyhedron::fromSharp(Polyhedron sharp, double radius)
{
	assert(std::isfinite(radius));
	static std::atomic<unsigned long> count { 0 };
	RoundedPolyhedron body;
	body.serial = ++count;
	body.radius = radius > 0 ? radius : radiusShare * sharp.shortestEdge();
	bool isDistinct = false; // corners of the core
	for (double share = planarShare; !isDistinct && share < 2 * warpShare; share *= 10)
		try {
			Polyhedron planar = share > planarShare
			        ? convexHull(sharp.vertices, share * sizeOf(sharp.vertices))
			        : sharp,
			           core = Polyhedron::fromHalfSpaces(innerPlanes(planar, body.radius));
			isDistinct = core.shortestEdge() > 2 * flushTolerance;
			if (!isDistinct && !body.core.vertices.empty()) continue;
			body.sharp = std::move(planar);
			body.core = std::move(core);
		} catch (const PolyhedronError&) { // the next tolerance, or closedCore()
		}
	if (body.core.vertices.empty()) {
		body.core = closedCore(sharp, body.radius);
		body.sharp = std::move(sharp);
	}
	for (const Vec3& v : body.core.vertices) {
		body.halfExtents = body.halfExtents.cwiseMax(v.cwiseAbs());
		body.boundingRadius = std::max(body.boundingRadius, v.norm());
	}
	body.coreHalfThickness = body.core.thickness() / 2;
	return body;
}

} // namespace timber
