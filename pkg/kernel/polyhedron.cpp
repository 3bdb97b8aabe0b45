// SPDX-License-Identifier: GPL-2.0-or-later
#include "polyhedron.hpp"
#include "constants.hpp"
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <atomic>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>

namespace timber {
namespace {

	/// Corners sorted into faces do not make a closed surface: some are neither plane nor clearly bent.
	struct OpenSurface : PolyhedronError {
		using PolyhedronError::PolyhedronError;
	};

	std::string text(const Vec3& v)
	{
		std::ostringstream s;
		s << "(" << v.x() << ", " << v.y() << ", " << v.z() << ")";
		return s.str();
	}

	double size(const std::vector<Vec3>& points)
	{
		Vec3 low = points.front(), high = points.front();
		for (const Vec3& p : points) {
			low = low.cwiseMin(p);
			high = high.cwiseMax(p);
		}
		return (high - low).maxCoeff();
	}

	void refuseBadSize(double extent)
	{
		if (extent == 0 || (smallestSize <= extent && extent <= largestSize)) return; // 0: refuseBadPoints says more
		std::ostringstream what;
		what << "the vertices extend over " << extent << " m: a polyhedron has " << smallestSize << " to " << largestSize << " m";
		throw PolyhedronError(what.str());
	}

	void refuseBadPoints(const std::vector<Vec3>& points, double tolerance)
	{
		for (size_t k = 0; k < points.size(); ++k)
			for (size_t l = k + 1; l < points.size(); ++l)
				if ((points[k] - points[l]).norm() <= tolerance)
					throw PolyhedronError("vertices " + std::to_string(k) + " and " + std::to_string(l) + " are the same point " + text(points[k]));
	}

	/// Corners of all supporting planes: for each triple of points the plane through it is supporting if no point lies
	/// outside; the points in it are a face's corners. Sets within a larger set come from rounding and are dropped.
	std::vector<std::vector<int>> supportingSets(const std::vector<Vec3>& points, double tolerance)
	{
		const int count = int(points.size());
		std::vector<std::vector<int>> sets;
		const auto add = [&](const Vec3& origin, const Vec3& normal) {
			std::vector<int> in;
			for (int k = 0; k < count; ++k) {
				const double height = normal.dot(points[k] - origin);
				if (height > tolerance) return;
				if (height >= -tolerance) in.push_back(k);
			}
			if (std::find(sets.begin(), sets.end(), in) == sets.end()) sets.push_back(in);
		};
		for (int a = 0; a < count; ++a)
			for (int b = a + 1; b < count; ++b)
				for (int c = b + 1; c < count; ++c) {
					Vec3 normal = (points[b] - points[a]).cross(points[c] - points[a]);
					const double longest = std::max({ (points[b] - points[a]).norm(), (points[c] - points[a]).norm(), (points[c] - points[b]).norm() });
					if (normal.norm() <= 2 * tolerance * longest) continue; // three points in a line span no plane
					normal.normalize();
					add(points[a], normal);
					add(points[a], -normal);
				}
		const auto contained = [&](const std::vector<int>& small) {
			return std::any_of(sets.begin(), sets.end(), [&](const std::vector<int>& large) {
				return large.size() > small.size() && std::includes(large.begin(), large.end(), small.begin(), small.end());
			});
		};
		std::vector<std::vector<int>> maximal;
		for (const auto& s : sets)
			if (!contained(s)) maximal.push_back(s);
		return maximal;
	}

	void setBorders(Face& face, const std::vector<Vec3>& points)
	{
		const size_t count = face.corners.size();
		const auto through = [](const Vec3& normal, const Vec3& x) { return HalfSpace { normal, normal.dot(x) }; };
		for (size_t k = 0; k < count; ++k) {
			const Vec3 &corner = points[face.corners[k]], &next = points[face.corners[(k + 1) % count]];
			face.borders.push_back(through((next - corner).cross(face.plane.normal).normalized(), corner));
		}
		for (size_t k = 0; k < count; ++k)
			face.tips.push_back(through((face.borders[k].normal + face.borders[(k + count - 1) % count].normal).normalized(), points[face.corners[k]]));
	}

	/// Face from its unordered corners: Newell normal, corners counter-clockwise seen from outside.
	Face orderedFace(const std::vector<Vec3>& points, std::vector<int> corners, const Vec3& inside)
	{
		Vec3 centre = Vec3::Zero();
		for (int k : corners)
			centre += points[k];
		centre /= double(corners.size());
		const Vec3 u = (points[corners[0]] - centre).normalized();
		Vec3 rough = Vec3::Zero();
		for (size_t k = 1; k < corners.size(); ++k) {
			const Vec3 c = u.cross(points[corners[k]] - centre);
			if (c.norm() > rough.norm()) rough = c;
		}
		if (rough.dot(centre - inside) < 0) rough = -rough;
		const Vec3 v = rough.normalized().cross(u);
		std::sort(corners.begin(), corners.end(), [&](int k, int l) {
			const Vec3 a = points[k] - centre, b = points[l] - centre;
			return std::atan2(a.dot(v), a.dot(u)) < std::atan2(b.dot(v), b.dot(u));
		});
		Vec3 newell = Vec3::Zero();
		for (size_t k = 0; k < corners.size(); ++k)
			newell += (points[corners[k]] - centre).cross(points[corners[(k + 1) % corners.size()]] - centre);
		Face face;
		face.plane.normal = newell.normalized();
		face.plane.offset = face.plane.normal.dot(centre);
		face.corners = std::move(corners);
		setBorders(face, points);
		return face;
	}

	Edge edgeBetween(const std::vector<Vec3>& points, const std::vector<Face>& faces, int tail, int head, int left, int right)
	{
		const Vec3 span = points[head] - points[tail];
		return { tail, head, left, right, (faces[left].plane.normal + faces[right].plane.normal).normalized(), span.normalized(), span.norm() };
	}

	std::vector<Edge> edgesOf(const std::vector<Vec3>& points, const std::vector<Face>& faces)
	{
		std::map<std::pair<int, int>, int> faceLeftOf;
		for (size_t f = 0; f < faces.size(); ++f)
			for (size_t k = 0; k < faces[f].corners.size(); ++k)
				faceLeftOf[{ faces[f].corners[k], faces[f].corners[(k + 1) % faces[f].corners.size()] }] = int(f);
		std::vector<Edge> edges;
		for (const auto& [ends, left] : faceLeftOf) {
			const auto back = faceLeftOf.find({ ends.second, ends.first });
			if (back == faceLeftOf.end()) throw OpenSurface("faces do not close around the edge between vertices " + std::to_string(ends.first) + " and " + std::to_string(ends.second));
			if (ends.first < ends.second)
				edges.push_back(edgeBetween(points, faces, ends.first, ends.second, left, back->second));
		}
		return edges;
	}

	/// Corner points of an intersection of half-spaces: points of three planes that no other plane cuts off.
	std::vector<Vec3> cornerPoints(const std::vector<HalfSpace>& planes)
	{
		std::vector<Vec3> corners;
		double scale = 0;
		const auto inside = [&](const Vec3& p) {
			return std::all_of(planes.begin(), planes.end(), [&](const HalfSpace& h) { return h.normal.dot(p) - h.offset <= 1e-9 * (std::abs(h.offset) + p.norm()); });
		};
		for (size_t a = 0; a < planes.size(); ++a)
			for (size_t b = a + 1; b < planes.size(); ++b)
				for (size_t c = b + 1; c < planes.size(); ++c) {
					Mat3 normals;
					normals << planes[a].normal.transpose(), planes[b].normal.transpose(), planes[c].normal.transpose();
					if (std::abs(normals.determinant()) < 1e-9) continue;
					const Vec3 p = normals.inverse() * Vec3(planes[a].offset, planes[b].offset, planes[c].offset);
					if (!inside(p)) continue;
					corners.push_back(p);
					scale = std::max(scale, (p - corners.front()).norm());
				}
		std::vector<Vec3> distinct;
		for (const Vec3& p : corners)
			if (std::none_of(distinct.begin(), distinct.end(), [&](const Vec3& q) { return (p - q).norm() <= 4 * planarShare * scale; })) distinct.push_back(p);
		return distinct;
	}

	/// Points farther from a plane than `share` of the body's size are not in it; see Polyhedron::fromVertices.
	Polyhedron hullOf(const std::vector<Vec3>& points, double share)
	{
		Vec3 inside = Vec3::Zero();
		for (const Vec3& p : points)
			inside += p / double(points.size());
		Polyhedron body;
		body.vertices = points;
		const auto sets = supportingSets(points, share * size(points));
		if (sets.empty() || std::any_of(sets.begin(), sets.end(), [&](const auto& s) { return s.size() == points.size(); }))
			throw PolyhedronError("the vertices lie in one plane: a polyhedron needs a volume");
		std::vector<int> degree(points.size(), 0);
		for (const auto& corners : sets) {
			body.faces.push_back(orderedFace(points, corners, inside));
			for (int k : corners)
				++degree[k];
		}
		for (size_t k = 0; k < points.size(); ++k)
			if (degree[k] < 3) throw PolyhedronError("vertex " + std::to_string(k) + " " + text(points[k]) + " is no corner of the convex hull: the element is not convex or the vertex is superfluous");
		body.edges = edgesOf(body.vertices, body.faces);
		if (body.vertices.size() + body.faces.size() != body.edges.size() + 2) throw OpenSurface("faces, edges and vertices do not close to one surface (Euler's formula)");
		return body;
	}

	Polyhedron coreOf(const Polyhedron& sharp, double radius)
	{
		std::vector<HalfSpace> planes;
		for (const Face& face : sharp.faces)
			planes.push_back({ face.plane.normal, face.plane.offset - radius });
		return Polyhedron::fromHalfSpaces(planes);
	}

} // namespace

Polyhedron Polyhedron::fromVertices(const std::vector<Vec3>& points)
{
	for (size_t k = 0; k < points.size(); ++k)
		if (!points[k].allFinite()) throw PolyhedronError("vertex " + std::to_string(k) + " is not finite: " + text(points[k]));
	if (points.size() < 4) throw PolyhedronError("a polyhedron has at least 4 vertices, got " + std::to_string(points.size()));
	refuseBadSize(size(points));
	refuseBadPoints(points, planarShare * size(points));
	for (double share = planarShare; share < warpShare; share *= 10)
		try {
			return hullOf(points, share);
		} catch (const OpenSurface&) { // nearly plane faces: be more tolerant
		}
	return hullOf(points, warpShare);
}

Polyhedron Polyhedron::fromHalfSpaces(const std::vector<HalfSpace>& planes)
{
	std::vector<HalfSpace> units;
	for (size_t k = 0; k < planes.size(); ++k) {
		const double length = planes[k].normal.norm();
		if (!std::isfinite(length) || !std::isfinite(planes[k].offset) || length == 0) throw PolyhedronError("half-space " + std::to_string(k) + " has no finite unit normal and offset");
		units.push_back({ planes[k].normal / length, planes[k].offset / length });
	}
	const std::vector<Vec3> corners = cornerPoints(units);
	if (corners.size() < 4) throw PolyhedronError("the half-spaces enclose no volume");
	Polyhedron body = fromVertices(corners);
	for (const Face& face : body.faces) { // an unbounded intersection has a hull whose closing face is none of the planes
		const bool given = std::any_of(units.begin(), units.end(), [&](const HalfSpace& h) { return h.normal.dot(face.plane.normal) > 1 - 1e-6; });
		if (!given) throw PolyhedronError("the half-spaces do not bound a volume in the direction " + text(face.plane.normal));
	}
	return body;
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

/// Sum over tetrahedra (reference point, face triangle); second moments as in Tonon (2004), J. Math. Stat. 1, 8-11.
MassProperties massProperties(const Polyhedron& body)
{
	const Vec3 origin = body.vertices.front();
	double volume = 0;
	Vec3 first = Vec3::Zero();
	Mat3 second = Mat3::Zero();
	for (const Face& face : body.faces)
		for (size_t k = 1; k + 1 < face.corners.size(); ++k) {
			const Vec3 a = body.vertices[face.corners[0]] - origin, b = body.vertices[face.corners[k]] - origin, c = body.vertices[face.corners[k + 1]] - origin;
			const double part = a.dot(b.cross(c)) / 6;
			const Vec3 sum = a + b + c;
			volume += part;
			first += part / 4 * sum;
			second += part / 20 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
		}
	const Vec3 centre = first / volume;
	const Mat3 central = second - volume * centre * centre.transpose();
	return { volume, origin + centre, central.trace() * Mat3::Identity() - central };
}

/// The best order and signs of the eigenvectors are right-handed by themselves: the traces of the six orders add up to
/// 2 sum |q_ij| >= 6, so the best is above 1, and a left-handed orthogonal matrix has a trace of at most 1.
Mat3 principalAxes(const Mat3& inertia)
{
	const double offDiagonal = std::max({ std::abs(inertia(0, 1)), std::abs(inertia(0, 2)), std::abs(inertia(1, 2)) });
	if (offDiagonal <= 1e-12 * inertia.trace()) return Mat3::Identity();
	const Mat3 found = Eigen::SelfAdjointEigenSolver<Mat3>(inertia).eigenvectors();
	constexpr std::array<std::array<int, 3>, 6> orders { { { 0, 1, 2 }, { 0, 2, 1 }, { 1, 0, 2 }, { 1, 2, 0 }, { 2, 0, 1 }, { 2, 1, 0 } } };
	Mat3 best = found;
	double alignment = -1;
	for (const auto& order : orders) {
		Mat3 axes;
		for (int k = 0; k < 3; ++k)
			axes.col(k) = found.col(order[k]) * (found(k, order[k]) < 0 ? -1. : 1.);
		if (axes.trace() > alignment) {
			alignment = axes.trace();
			best = axes;
		}
	}
	return best;
}

/// Slightly warped faces split into triangles whose cores meet in clusters of corners, or do not close: then the faces
/// are made plane with growing tolerance, as long as two core corners are too close to be two contacts.
RoundedPolyhedron RoundedPolyhedron::fromSharp(Polyhedron sharp, double radius)
{
	static std::atomic<unsigned long> made { 0 };
	RoundedPolyhedron body;
	body.serial = ++made;
	body.radius = radius > 0 ? radius : radiusShare * sharp.shortestEdge();
	std::string reason;
	bool clear = false;
	for (double share = planarShare; !clear && share < 2 * warpShare; share *= 10)
		try {
			Polyhedron planed = share > planarShare ? hullOf(sharp.vertices, share) : sharp, core = coreOf(planed, body.radius);
			clear = core.shortestEdge() > 2 * flushTolerance;
			if (!clear && !body.core.vertices.empty()) continue;
			body.sharp = std::move(planed);
			body.core = std::move(core);
		} catch (const PolyhedronError& error) {
			if (reason.empty()) reason = error.what();
		}
	if (body.core.vertices.empty())
		throw PolyhedronError("rounding radius " + std::to_string(body.radius) + " m leaves no core (" + reason + "): it must be below the radius of the inscribed sphere, at most " + std::to_string(sharp.thickness() / 2) + " m");
	for (const Vec3& v : body.core.vertices) {
		body.span = body.span.cwiseMax(v.cwiseAbs());
		body.reach = std::max(body.reach, v.norm());
	}
	body.coreHalfThickness = body.core.thickness() / 2;
	return body;
}

} // namespace timber
