// SPDX-License-Identifier: GPL-2.0-or-later
/// Candidate features: those of a pair that can come into contact within a margin of motion.
#pragma once
#include "shape_pair.hpp"

namespace timber {

/// Fills the cache for the pair's present pose. skin: minimum motion for which the candidates must be complete, > 0
/// [m].
void searchCandidates(const ShapePair& pair, double skin, CandidateCache& cache);

} // namespace timber
