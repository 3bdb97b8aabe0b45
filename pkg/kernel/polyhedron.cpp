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

	/// The planes of the faces, moved inwards.
	std::vector<HalfSpace> innerPlanes(const Polyhedron& sharp, double radius)
	{
		std::vector<HalfSpace> planes;
		for (const Face& face : sharp.faces) {
			const double length = face.plane.normal.norm(); // 1 but for rounding
			planes.push_back({ face.plane.normal / length, (face.plane.offset - radius) / length });
		}
		return planes;
	}

	PolyhedronError noCore(double radius, const Sphere& largest)
	{
		std::ostringstream what;
		what << "rounding radius " << radius
		     << " m leaves no core: it must be below the radius of the inscribed sphere, " << largest.radius
		     << " m";
		return PolyhedronError(what.str());
	}

	Sphere inscribedSphere(const Polyhedron& sharp, double size)
	{
		return inscribedSphere(innerPlanes(sharp, 0), sharp.vertices.front(), size);
	}

} // namespace

Polyhedron Polyhedron::fromVertices(const std::vector<Vec3>& points)
{
	if (points.size() < 4)
		throw PolyhedronError("a polyhedron has at least 4 vertices, got " + std::to_string(points.size()));
	if (points.size() > maxVertices)
		throw PolyhedronError("a polyhedron has at most " + std::to_string(maxVertices) + " vertices, got "
		        + std::to_string(points.size())
		        + ": the time of a contact grows with the square of their number");
	return convexHull(points);
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

namespace {

	/// A polyhedron and its core, with two distinct corners at each edge of the core, as far as possible.
	struct Core {
		Polyhedron sharp, core;
	};

	/// Slightly warped faces split into triangles, and the cores of these have clusters of corners. The planarity
	/// tolerance is therefore increased while two corners of the core are too close to be two contacts.
	Core coreOf(Polyhedron sharp, double radius)
	{
		const double size = sizeOf(sharp.vertices), tolerance = planarShare * size;
		const Sphere largest = inscribedSphere(sharp, size);
		if (radius >= largest.radius - tolerance) throw noCore(radius, largest);
		Core best;
		for (double share = planarShare; share < 2 * warpShare; share *= 10) {
			Hull planar = share > planarShare ? tryConvexHull(sharp.vertices, share * size)
			                                  : Hull { HullOutcome::Sound, sharp };
			if (planar.outcome != HullOutcome::Sound) continue;
			const Sphere within = inscribedSphere(planar.body, size);
			if (radius >= within.radius - tolerance) continue;
			Hull core = intersectionAround(within.centre, innerPlanes(planar.body, radius), 4 * tolerance);
			if (core.outcome != HullOutcome::Sound) continue;
			const bool isDistinct = core.body.shortestEdge() > 2 * flushTolerance;
			if (isDistinct || best.core.vertices.empty())
				best = { std::move(planar.body), std::move(core.body) };
			if (isDistinct) break;
		}
		if (best.core.vertices.empty()) throw PolyhedronError("the faces of the core do not close");
		return best;
	}

}

RoundedPolyhedron RoundedPolyhedron::fromSharp(Polyhedron sharp, double radius)
{
	assert(std::isfinite(radius));
	static std::atomic<unsigned long> count { 0 };
	RoundedPolyhedron body;
	body.serial = ++count;
	body.radius = radius > 0 ? radius : radiusShare * sharp.shortestEdge();
	Core parts = coreOf(std::move(sharp), body.radius);
	body.sharp = std::move(parts.sharp);
	body.core = std::move(parts.core);
	for (const Vec3& v : body.core.vertices) {
		body.halfExtents = body.halfExtents.cwiseMax(v.cwiseAbs());
		body.boundingRadius = std::max(body.boundingRadius, v.norm());
	}
	body.coreHalfThickness = body.core.thickness() / 2;
	return body;
}

} // namespace timber
