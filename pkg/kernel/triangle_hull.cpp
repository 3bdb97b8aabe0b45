// SPDX-License-Identifier: GPL-2.0-or-later
#include "triangle_hull.hpp"
#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <utility>

namespace timber {

// Incremental hull: a point outside replaces the triangles that it sees by those between it and their outline. Points
// in special position are moved by a random share of their distance from the origin, far above the rounding of `long
// double` and below that of `double`. Should rounding yet make the visible triangles no disc, the hull is started again
// with other displacements.
namespace {

	constexpr long double displacement = 1e-15L; ///< of a point, as a share of its distance from the origin
	constexpr int attempts = 30;

	std::vector<LongVec3> displaced(const std::vector<LongVec3>& points, std::mt19937& random)
	{
		const auto share
		        = [&] { return displacement * (2 * (long double)(random()) / std::mt19937::max() - 1); };
		std::vector<LongVec3> moved;
		for (const LongVec3& p : points) {
			const long double x = share(), y = share(), z = share();
			moved.push_back(p + p.norm() * LongVec3(x, y, z));
		}
		return moved;
	}

	/// Six times the volume of a tetrahedron, > 0 if the point sees the triangle's outer side.
	long double volumeAbove(const std::vector<LongVec3>& points, const Triangle& t, int point)
	{
		const LongVec3 &origin = points[t[0]], a = points[t[1]] - origin, b = points[t[2]] - origin;
		return a.cross(b).dot(points[point] - origin);
	}

	template <class Measure> int farthest(size_t count, Measure measure)
	{
		int best = 0;
		for (size_t k = 1; k < count; ++k)
			if (measure(int(k)) > measure(best)) best = int(k);
		return best;
	}

	/// A large tetrahedron of the points; empty if they are coplanar.
	std::vector<Triangle> firstTetrahedron(const std::vector<LongVec3>& x)
	{
		const size_t n = x.size();
		const int a = farthest(n, [&](int k) { return x[k].norm(); }),
		          b = farthest(n, [&](int k) { return (x[k] - x[a]).norm(); });
		const LongVec3 line = x[b] - x[a];
		const int c = farthest(n, [&](int k) { return line.cross(x[k] - x[a]).norm(); });
		const int d = farthest(n, [&](int k) { return std::abs(volumeAbove(x, { a, b, c }, k)); });
		const long double volume = volumeAbove(x, { a, b, c }, d), length = line.norm();
		if (!(std::abs(volume) > 100 * displacement * length * length * length)) return {};
		const int left = volume < 0 ? b : c, right = volume < 0 ? c : b;
		return { { a, left, right }, { a, d, left }, { left, d, right }, { right, d, a } };
	}

	/// Extends the hull; false if the visible triangles are no disc.
	bool addPoint(const std::vector<LongVec3>& points, int point, std::vector<Triangle>& hull)
	{
		const auto visible = std::stable_partition(hull.begin(), hull.end(),
		        [&](const Triangle& t) { return !(volumeAbove(points, t, point) > 0); });
		if (visible == hull.end()) return true; // inside
		const std::vector<int> outline = outlineOf({ visible, hull.end() });
		if (outline.empty()) return false;
		hull.erase(visible, hull.end());
		for (size_t k = 0; k < outline.size(); ++k)
			hull.push_back({ outline[k], outline[(k + 1) % outline.size()], point });
		return true;
	}

} // namespace

std::vector<int> outlineOf(const std::vector<Triangle>& triangles)
{
	std::set<std::pair<int, int>> edges;
	for (const Triangle& t : triangles)
		for (int k = 0; k < 3; ++k)
			edges.insert({ t[k], t[(k + 1) % 3] });
	std::map<int, int> next;
	for (const auto& [tail, head] : edges)
		if (!edges.count({ head, tail }) && !next.emplace(tail, head).second) return {};
	if (next.empty()) return {};
	std::vector<int> outline { next.begin()->first };
	while (outline.size() <= next.size()) {
		const auto step = next.find(outline.back());
		if (step == next.end()) return {};
		if (step->second == outline.front()) break;
		outline.push_back(step->second);
	}
	return outline.size() == next.size() ? outline : std::vector<int> {};
}

std::vector<Triangle> hullTriangles(const std::vector<LongVec3>& points)
{
	std::mt19937 random(1);
	for (int attempt = 0; attempt < attempts; ++attempt) {
		const std::vector<LongVec3> moved = displaced(points, random);
		std::vector<Triangle> hull = firstTetrahedron(moved);
		if (hull.empty()) return {};
		bool isClosed = true;
		for (size_t k = 0; isClosed && k < points.size(); ++k) {
			const bool isCorner = std::any_of(hull.begin(), hull.end(),
			        [&](const Triangle& t) { return t[0] == int(k) || t[1] == int(k) || t[2] == int(k); });
			isClosed = isCorner || addPoint(moved, int(k), hull);
		}
		if (isClosed) return hull;
	}
	return {};
}

std::vector<Triangle> hullTriangles(const std::vector<Vec3>& points)
{
	LongVec3 middle = LongVec3::Zero();
	for (const Vec3& p : points)
		middle += p.cast<long double>() / points.size();
	std::vector<LongVec3> about;
	for (const Vec3& p : points)
		about.push_back(p.cast<long double>() - middle);
	return hullTriangles(about);
}

} // namespace timber
