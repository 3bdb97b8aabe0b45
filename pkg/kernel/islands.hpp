// SPDX-License-Identifier: GPL-2.0-or-later
/// Bodies that no chain of contacts joins (two houses on the ground) are islands: each is solved by itself, so that they do
/// not influence each other, not even by rounding, threads may share the work, and a street costs what its houses cost.
#pragma once
#include <cstddef>
#include <utility>
#include <vector>

namespace timber {

/// Two bodies in contact, ~body of a fixed one: it joins nothing.
using Link = std::pair<int, int>;
/// A pair that does not touch: both ends the same free body, which no pair has.
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

	/// Islands of these pairs in the order of their first ones; all bodies are < `bodies`.
	void find(size_t bodies, const std::vector<Link>& pairs);
	size_t count() const { return starts.empty() ? 0 : starts.size() - 1; }
	Island operator[](size_t k) const { return { order.data() + starts[k], order.data() + starts[k + 1] }; }

private:
	std::vector<Link> links; ///< for which the islands were found
	std::vector<int> order; ///< pairs by island
	std::vector<size_t> starts; ///< in `order`, and its end
	std::vector<int> parent, islandOf; ///< of each body, while islands are sought

	int root(int body);
	int bodyOf(const Link&);
};

} // namespace timber
