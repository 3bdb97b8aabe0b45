// SPDX-License-Identifier: GPL-2.0-or-later
/// Which features of a pair can touch soon.
#pragma once
#include "shape_pair.hpp"

namespace timber {

/// Fills the cache anew for the pair's present placement. skin: motion for which it shall hold [m].
void searchCandidates(const Pair& pair, double skin, CandidateCache& cache);

} // namespace timber
