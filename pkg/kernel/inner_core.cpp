// SPDX-License-Identifier: GPL-2.0-or-later
#include "inner_core.hpp"
#include "triangle_hull.hpp"
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>

namespace timber {
namespace {

	constexpr int maxSteps = 1000; ///< of the search for the inscribed sphere; some twenty suffice

	/// Of the radius of the inscribed sphere, as a share of the size.
	constexpr long double sphereRounding = 1e-15L;

	using LongVec4 = Eigen::Matrix<long double, 4, 1>;
	using LongMat4 = Eigen::Matrix<long double, 4, 4>;

	/// A sphere inside has row . (centre, radius) <= offset.
	struct TouchingPlane {
		LongVec4 row;
		long double offset;
	};
	TouchingPlane touchingPlane(const Vec3& normal, double offset)
	{
		return { LongVec4(normal.x(), normal.y(), normal.z(), 1), offset };
	}

	/// The plane of the basis whose weight is the first to become zero as that of the new plane grows; of several
	/// the one with the largest share, for accuracy. -1: none.
	int leavingPlane(const LongVec4& weights, const LongVec4& shares)
	{
		constexpr long double rounding = 1e-15L;
		int leaving = -1;
		for (int k = 0; k < 4; ++k) {
			if (shares[k] <= rounding) continue;
			const long double later
			        = leaving < 0 ? -1 : weights[k] / shares[k] - weights[leaving] / shares[leaving];
			if (later < -rounding || (later <= rounding && shares[k] > shares[leaving])) leaving = k;
		}
		return leaving;
	}

	/// Joins elements in groups; each group has a representative.
	class Groups {
	public:
		explicit Groups(size_t count)
		        : parent(count)
		{
			std::iota(parent.begin(), parent.end(), 0);
		}
		int of(int k) const { return parent[k] == k ? k : of(parent[k]); }
		void join(int k, int l) { parent[of(k)] = of(l); }

	private:
		std::vector<int> parent;
	};

	/// Common point of three planes.
	LongVec3 commonPoint(const std::vector<HalfSpace>& planes, const Triangle& t)
	{
		const LongVec3 a = planes[t[0]].normal.cast<long double>(), b = planes[t[1]].normal.cast<long double>(),
		               c = planes[t[2]].normal.cast<long double>();
		const LongVec3 bc = b.cross(c);
		return (planes[t[0]].offset * bc + planes[t[1]].offset * c.cross(a) + planes[t[2]].offset * a.cross(b))
		        / a.dot(bc);
	}

	/// The triangles around each point, counter-clockwise seen from outside.
	std::vector<std::vector<int>> trianglesAround(const std::vector<Triangle>& triangles, size_t pointCount)
	{
		// Of a point: from an edge to the triangle left of it and its next edge
		std::vector<std::map<int, std::pair<int, int>>> turns(pointCount);
		for (size_t t = 0; t < triangles.size(); ++t)
			for (int k = 0; k < 3; ++k)
				turns[triangles[t][k]][triangles[t][(k + 1) % 3]]
				        = { int(t), triangles[t][(k + 2) % 3] };
		std::vector<std::vector<int>> around(pointCount);
		for (size_t p = 0; p < pointCount; ++p) {
			if (turns[p].empty()) continue;
			const int first = turns[p].begin()->first;
			int edge = first;
			do {
				const auto& [triangle, next] = turns[p].at(edge);
				around[p].push_back(triangle);
				edge = next;
			} while (edge != first);
		}
		return around;
	}

	/// Removes repeated neighbours from cycles of corners; cycles of less than three corners become empty.
	void tidy(std::vector<int>& cycle)
	{
		cycle.erase(std::unique(cycle.begin(), cycle.end()), cycle.end());
		while (cycle.size() > 1 && cycle.front() == cycle.back())
			cycle.pop_back();
		if (cycle.size() < 3) cycle.clear();
	}

	/// Removes corners of less than three faces, and faces of less than three corners, until there are none. Both
	/// lie on an edge of two other faces.
	void removeIncomplete(std::vector<std::vector<int>>& cycles, size_t cornerCount)
	{
		bool isComplete = false;
		while (!isComplete) {
			isComplete = true;
			std::vector<int> degree(cornerCount, 0);
			for (const auto& cycle : cycles)
				for (const int k : cycle)
					++degree[k];
			for (auto& cycle : cycles) {
				const auto rest = std::remove_if(
				        cycle.begin(), cycle.end(), [&](int k) { return degree[k] < 3; });
				if (rest == cycle.end()) continue;
				isComplete = false;
				cycle.erase(rest, cycle.end());
				tidy(cycle);
			}
		}
	}

	/// Common point of the first three planes of a group, in their order, that have one inside the others; else
	/// `otherwise`, about the centre. The first of several points that rounding tells apart does not depend on the
	/// centre.
	struct Corner {
		std::array<int, 3> planes;
		Vec3 position; ///< [m]
	};
	Corner cornerOf(const std::vector<int>& group, const std::vector<HalfSpace>& planes, const Vec3& otherwise)
	{
		const auto isInside = [&](const Vec3& x) {
			return std::all_of(group.begin(), group.end(), [&](int k) {
				const HalfSpace& h = planes[k];
				return h.normal.dot(x) - h.offset <= 1e-9 * (std::abs(h.offset) + x.norm());
			});
		};
		for (size_t a = 0; a < group.size(); ++a)
			for (size_t b = a + 1; b < group.size(); ++b)
				for (size_t c = b + 1; c < group.size(); ++c) {
					const HalfSpace &p = planes[group[a]], &q = planes[group[b]],
					                &r = planes[group[c]];
					Mat3 normals;
					normals << p.normal.transpose(), q.normal.transpose(), r.normal.transpose();
					if (std::abs(normals.determinant()) < 1e-9) continue;
					const Vec3 x = normals.inverse() * Vec3(p.offset, q.offset, r.offset);
					if (isInside(x)) return { { group[a], group[b], group[c] }, x };
				}
		return { { group[0], group[1], group[2] }, otherwise };
	}

	/// Corners of the primal body by group of triangles, in the order of their planes.
	Hull bodyOf(const std::vector<LongVec3>& points, std::vector<std::vector<int>> cycles,
	        const std::vector<HalfSpace>& planes, const Vec3& centre)
	{
		std::map<int, std::vector<int>> planesAt;
		for (size_t f = 0; f < cycles.size(); ++f)
			for (const int k : cycles[f])
				planesAt[k].push_back(int(f));
		std::vector<std::pair<Corner, int>> corners;
		for (const auto& [k, group] : planesAt)
			corners.push_back({ cornerOf(group, planes, centre + points[k].cast<double>()), k });
		std::sort(corners.begin(), corners.end(), [](const auto& p, const auto& q) {
			return std::tie(p.first.planes, p.second) < std::tie(q.first.planes, q.second);
		});
		std::vector<Vec3> vertices;
		std::map<int, int> number;
		for (const auto& [corner, k] : corners) {
			number[k] = int(vertices.size());
			vertices.push_back(corner.position);
		}
		for (auto& cycle : cycles)
			for (int& k : cycle)
				k = number[k];
		cycles.erase(
		        std::remove_if(cycles.begin(), cycles.end(), [](const auto& cycle) { return cycle.empty(); }),
		        cycles.end());
		if (cycles.size() < 4) return { HullOutcome::NoVolume };
		return closedBody(vertices, cycles);
	}

} // namespace

/// The dual simplex method: of four planes, the sphere that touches them; the plane that cuts it most replaces one of
/// them. It starts at a large tetrahedron. Nearly parallel planes may end it early or make it repeat itself: the best
/// centre counts.
Sphere inscribedSphere(const std::vector<HalfSpace>& planes, const Vec3& middle, double size)
{
	assert(size > 0);
	std::vector<TouchingPlane> touching; // lengths in units of the size about the middle
	for (const Vec3& n : { Vec3(1, 1, 1), Vec3(1, -1, -1), Vec3(-1, 1, -1), Vec3(-1, -1, 1) })
		touching.push_back(touchingPlane(n.normalized(), 10));
	for (const HalfSpace& h : planes)
		touching.push_back(touchingPlane(h.normal, (h.offset - h.normal.dot(middle)) / size));
	std::array<size_t, 4> basis { 0, 1, 2, 3 };
	Sphere best { middle, -std::numeric_limits<double>::infinity() };
	for (int step = 0; step < maxSteps; ++step) {
		LongMat4 rows;
		LongVec4 offsets;
		for (int k = 0; k < 4; ++k) {
			rows.row(k) = touching[basis[k]].row;
			offsets[k] = touching[basis[k]].offset;
		}
		const Eigen::FullPivLU<LongMat4> solver(rows), transposed(rows.transpose());
		const LongVec4 sphere = solver.solve(offsets);
		const auto excess = [&](const TouchingPlane& p) { return p.row.dot(sphere) - p.offset; };
		const auto cutting = std::max_element(touching.begin(), touching.end(),
		        [&](const TouchingPlane& p, const TouchingPlane& q) { return excess(p) < excess(q); });
		const double radius = size * double(sphere[3] - excess(*cutting)); // inside all planes
		if (radius > best.radius) best = { middle + size * sphere.head<3>().cast<double>(), radius };
		if (excess(*cutting) <= sphereRounding) break;
		const int leaving
		        = leavingPlane(transposed.solve(LongVec4(0, 0, 0, 1)), transposed.solve(cutting->row));
		if (leaving < 0) break;
		basis[leaving] = size_t(cutting - touching.begin());
	}
	return best;
}

Hull intersectionAround(const Vec3& centre, const std::vector<HalfSpace>& planes, double tolerance)
{
	std::vector<HalfSpace> about; // the centre
	std::vector<LongVec3> duals;
	for (const HalfSpace& h : planes) {
		about.push_back({ h.normal, h.offset - h.normal.dot(centre) });
		assert(about.back().offset > 0);
		duals.push_back(h.normal.cast<long double>() / (long double)(about.back().offset));
	}
	const std::vector<Triangle> triangles = hullTriangles(duals);
	std::vector<LongVec3> corners;
	for (const Triangle& t : triangles)
		corners.push_back(commonPoint(about, t));
	std::vector<std::vector<int>> cycles = trianglesAround(triangles, planes.size());
	Groups groups(corners.size());
	for (const auto& cycle : cycles)
		for (size_t k = 0; k < cycle.size(); ++k) {
			const int here = cycle[k], next = cycle[(k + 1) % cycle.size()];
			if ((corners[here] - corners[next]).norm() <= tolerance) groups.join(here, next);
		}
	for (auto& cycle : cycles) {
		for (int& k : cycle)
			k = groups.of(k);
		tidy(cycle);
	}
	removeIncomplete(cycles, corners.size());
	return bodyOf(corners, std::move(cycles), planes, centre);
}

} // namespace timber
