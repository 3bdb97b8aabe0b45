// SPDX-License-Identifier: GPL-2.0-or-later
/// Islands: sets of free bodies connected by contacts (each house on the ground is one). The solver takes each island
/// by itself, so that islands do not influence each other, not even by rounding, and threads may share them.
#pragma once
#include <cstddef>
#include <utility>
#include <vector>

namespace timber {

/// Two bodies in contact; a fixed body is given as ~body: it connects nothing.
using Link = std::pair<int, int>;
/// A pair without contact points. No pair has the same free body twice.
constexpr Link noLink { 0, 0 };

class Islands {
public:
	/// Indices of the pairs of an island, ascending.
	struct Island {
		const int *first, *last;
		const int* begin() const { return first; }
		const int* end() const { return last; }
		size_t size() const { return size_t(last - first); }
		int operator[](size_t k) const { return first[k]; }
	};

	/// Islands of these pairs, in the order of their first pairs. Body indices are < bodies.
	void find(size_t bodies, const std::vector<Link>& pairs);
	size_t count() const { return starts.empty() ? 0 : starts.size() - 1; }
	Island operator[](size_t k) const { return { order.data() + starts[k], order.data() + starts[k + 1] }; }

private:
	std::vector<Link> links; ///< input of the last search
	std::vector<int> order; ///< indices of the pairs, island by island
	std::vector<size_t> starts; ///< of the islands in `order`, and its end
	std::vector<int> parent, islandOf; ///< of each body: parent in the disjoint-set forest, island of its root

	int root(int body);
	int representative(const Link&);
};

} // namespace timber
