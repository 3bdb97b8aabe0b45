// SPDX-License-Identifier: GPL-2.0-or-later
/// Independent distance of two convex point sets: the point of least norm of their Minkowski difference, by the active
/// set method of P. Wolfe (1976), Math. Programming 11, 128-149. It knows vertices only, no faces or edges.
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>
#include <kernel/types.hpp>
#include <limits>
#include <vector>

namespace timber::shapes {

class LeastNorm {
public:
	/// Distance of the hulls of two sets of points, 0 where they overlap. [m]
	static double distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b)
	{
		double least = std::numeric_limits<double>::infinity();
		for (size_t start = 0; start < a.size() * b.size(); ++start) {
			LeastNorm program(a, b);
			const Vec3 x = program.solve(b[start % b.size()] - a[start / b.size()]);
			least = std::min(least, x.norm());
			if (program.isOptimal(x)) break; // else rounding ended it: from another start
		}
		return least;
	}

private:
	const std::vector<Vec3>&a, &b;
	std::vector<Vec3> corral; ///< affinely independent points of the difference
	std::vector<double> weights; ///< of the corral, >= 0, with the sum 1

	LeastNorm(const std::vector<Vec3>& x, const std::vector<Vec3>& y)
	        : a(x)
	        , b(y)
	{
	}
	/// Point b - a of the difference with the least product with x.
	Vec3 support(const Vec3& x) const
	{
		const auto isLess = [&x](const Vec3& p, const Vec3& q) { return p.dot(x) < q.dot(x); };
		return *std::min_element(b.begin(), b.end(), isLess) - *std::max_element(a.begin(), a.end(), isLess);
	}
	Vec3 point() const
	{
		Vec3 x = Vec3::Zero();
		for (size_t k = 0; k < corral.size(); ++k)
			x += weights[k] * corral[k];
		return x;
	}
	/// Solves the first `size` equations m w = right by elimination with pivoting.
	static std::vector<double> solved(double (&m)[5][6], int size)
	{
		for (int k = 0; k < size; ++k) {
			int pivot = k;
			for (int i = k + 1; i < size; ++i)
				if (std::abs(m[i][k]) > std::abs(m[pivot][k])) pivot = i;
			std::swap(m[k], m[pivot]);
			for (int i = 0; i < size; ++i)
				for (int j = size; i != k && m[k][k] != 0 && j >= k; --j)
					m[i][j] -= m[i][k] / m[k][k] * m[k][j];
		}
		std::vector<double> w;
		for (int k = 0; k < size; ++k)
			w.push_back(m[k][k] != 0 ? m[k][size] / m[k][k] : 0);
		return w;
	}
	/// Weights of the point of least norm in the affine hull of the corral, of at most four points.
	std::vector<double> affineWeights() const
	{
		const int n = int(corral.size());
		double m[5][6] = {};
		for (int k = 0; k < n; ++k) {
			for (int l = 0; l < n; ++l)
				m[k][l] = corral[size_t(k)].dot(corral[size_t(l)]);
			m[k][n] = m[n][k] = 1;
		}
		m[n][n + 1] = 1;
		std::vector<double> w = solved(m, n + 1);
		w.pop_back();
		return w;
	}
	void remove(size_t k)
	{
		corral.erase(corral.begin() + long(k));
		weights.erase(weights.begin() + long(k));
	}
	/// Minor cycles: towards the affine minimum, dropping points whose weight would become negative.
	void reduce()
	{
		while (true) {
			const std::vector<double> target = affineWeights();
			double step = 1;
			size_t first = target.size();
			for (size_t k = 0; k < target.size(); ++k)
				if (target[k] <= -1e-12 && weights[k] / (weights[k] - target[k]) <= step) {
					step = weights[k] / (weights[k] - target[k]);
					first = k;
				}
			for (size_t k = 0; k < target.size(); ++k)
				weights[k] += step * (target[k] - weights[k]);
			if (first == target.size()) return;
			remove(first);
		}
	}
	/// Whether no point of the difference is closer to the origin by more than rounding.
	bool isOptimal(const Vec3& x) const
	{
		const double length = x.norm();
		return length <= 1e-12 || length - x.dot(support(x)) / length <= 1e-11 * (1 + b[0].norm());
	}
	/// From a point of the difference.
	Vec3 solve(const Vec3& start)
	{
		corral = { start };
		weights = { 1 };
		for (int step = 0; step < 1000; ++step) {
			const Vec3 x = point(), next = support(x);
			const double scale = std::max(1., corral[0].squaredNorm());
			if (x.squaredNorm() <= 1e-24 || x.dot(next) >= x.squaredNorm() - 1e-15 * scale) return x;
			for (const Vec3& p : corral)
				if (p == next) return x;
			if (corral.size() == 4) return x; // rounding: the origin is inside
			corral.push_back(next);
			weights.push_back(0);
			reduce();
		}
		return point();
	}
};

} // namespace timber::shapes
