// SPDX-License-Identifier: GPL-2.0-or-later
/// Which features of a pair can touch soon.
#pragma once
#include "pair.hpp"

namespace timber {

/// Fills the cache anew for the pair's present placement.
void searchCandidates(const Pair& pair, CandidateCache& cache);

} // namespace timber
