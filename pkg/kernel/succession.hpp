// SPDX-License-Identifier: GPL-2.0-or-later
/// Continuity of contact points whose features change: a vertex that slides over a border becomes a crossing of edges, a
/// corner that rolls over an edge becomes a vertex on it. The point is the same, and so are its springs.
#pragma once
#include "manifold.hpp"

namespace timber {

/// Sets the predecessor of each point that is new: the closest of the points before that have disappeared, whose
/// features touch the new ones on both bodies and whose normal is similar. Each has at most one successor.
/// before: points of the last update, sorted by id; points (in-out): sorted by id.
void linkPredecessors(const Polyhedron& a, const Polyhedron& b, const std::vector<ContactPoint>& before,
        std::vector<ContactPoint>& points);

} // namespace timber
