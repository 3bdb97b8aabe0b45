// SPDX-License-Identifier: GPL-2.0-or-later
#include "islands.hpp"
#include <algorithm>
#include <cassert>
#include <numeric>

namespace timber {

int Islands::root(int body)
{
	while (parent[body] != body)
		body = parent[body] = parent[parent[body]];
	return body;
}

/// The body that identifies the island of a pair.
int Islands::representative(const Link& link)
{
	return link.first >= 0 ? root(link.first) : link.second >= 0 ? root(link.second) : ~link.second;
}

void Islands::find(size_t bodies, const std::vector<Link>& pairs)
{
	[[maybe_unused]] const auto isValid = [bodies](int body) { return size_t(body >= 0 ? body : ~body) < bodies; };
	assert(std::all_of(pairs.begin(), pairs.end(), [&](const Link& link) {
		return link == noLink || (link.first != link.second && isValid(link.first) && isValid(link.second));
	}));
	if (bodies == parent.size() && pairs == links) return;
	links = pairs;
	parent.resize(bodies);
	std::iota(parent.begin(), parent.end(), 0);
	for (const Link& link : links)
		if (link != noLink && link.first >= 0 && link.second >= 0) parent[root(link.second)] = root(link.first);
	islandOf.assign(bodies, -1);
	starts.assign(1, 0);
	for (const Link& link : links) {
		if (link == noLink) continue;
		int& island = islandOf[representative(link)];
		if (island < 0) {
			island = int(starts.size()) - 1;
			starts.push_back(0);
		}
		++starts[island + 1];
	}
	std::partial_sum(starts.begin(), starts.end(), starts.begin());
	order.resize(starts.back());
	std::vector<size_t> next = starts;
	for (size_t k = 0; k < links.size(); ++k)
		if (links[k] != noLink) order[next[islandOf[representative(links[k])]]++] = int(k);
}

} // namespace timber
