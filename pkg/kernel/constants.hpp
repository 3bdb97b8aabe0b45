// SPDX-License-Identifier: GPL-2.0-or-later
/// Every tolerance of the kernel: what it means, its unit, and what changing it does.
#pragma once

namespace timber {

/// Rounding radius as a share of the shortest edge (paper, section 2.2). [-]
constexpr double radiusShare = 0.10;

/// Admissible largest extent of a polyhedron. [m] Products of three lengths, squared, must neither overflow nor vanish; no
/// element of a house comes near either end.
constexpr double smallestSize = 1e-6, largestSize = 1e6;

/// Points closer to a plane than this share of the polyhedron's size lie in it. [-]
/// Larger: single-precision vertices still make planar faces; smaller: nearly flat corners are kept as corners.
constexpr double planarShare = 1e-6;

/// Where faces are neither plane to planarShare nor clearly bent (vertices typed to the millimetre), they are made plane
/// with a tolerance of up to this share of the polyhedron's size. [-]
/// Larger: more warped input is accepted, its core less true to it; smaller: it is refused.
constexpr double warpShare = 1e-3;

/// Two places closer than this are the same place: a vertex over a face's border, a crossing at an edge's end,
/// two vertices on each other. [m] Below any construction tolerance and far above rounding noise, so that a flush
/// contact is decided by rule and not by the last bit. It sets how far a member slides before the rule lets go.
constexpr double flushTolerance = 1e-4;

/// Edges whose directions differ by less (sine of the angle) are parallel and have no crossing point. [-]
/// Larger drops real crossings; smaller lets the crossing point of nearly parallel edges jump along them.
constexpr double parallelSine = 5e-3;

/// Candidate features are kept for a pair until it has moved by this length. [m]
/// Larger: rarer searches, more candidates evaluated in each step. Results do not depend on it.
constexpr double candidateSkin = 4e-3;

/// The same for a pair that has hardly moved in quietSteps steps: little but what meets is evaluated. [m] A search spares its cost within
/// some 20 steps, or 40 with that which follows when the pair moves on.
constexpr double quietSkin = candidateSkin / 20;
constexpr int quietSteps = 100;
static_assert(quietSkin * quietSkin > 2 * flushTolerance * flushTolerance, "a skin covers what a flush support reaches beyond a corner");

/// How often a pair that is near but has no points is asked whether an axis shows it to be apart: once in so many uses. Asking costs
/// some five uses, and many such pairs are not apart (only patterns that are left out meet). Results do not depend on it. [-]
constexpr int axisUses = 24;

/// Crossings of edges with a smaller angle (sine) run along the edges when the pair moves; as candidates they are judged by distance alone. [-]
/// Larger: more candidates; smaller: crossings shift by more than the first order that the search allows for. Results do not depend on it.
constexpr double steadySine = 0.2;

/// Least size of the place at which a pair's motion is judged, in skins: it keeps the turn that is allowed small (0.04 rad). [-]
/// Larger: searches after smaller turns. Results do not depend on it.
constexpr double leastRegion = 25;

/// Overlapping cores: points whose normal makes a larger angle with the axis of least overlap do not count. [-]
/// Larger: fewer points, one along the axis in their stead; 0: points across the axis, decided by rounding.
constexpr double outwardCosine = 0.5;

/// Convergence threshold of the first sweep of a step, as a share of the tolerance of the later sweeps. [-]
/// 1: the error of the warm start does not decay, and stiff loaded members (braces under snow, the foot of a stack, at steps of 2.5e-4 s)
/// jitter; 1e-4: the jitter is smaller by that factor (1e-8 of a stack's weight); 0: a second sweep even where all is at rest.
constexpr double firstSweepShare = 1e-8;

/// Steps for which the response (inverse effective mass) of a contact point is reused. [-]
/// A member that rotates at 10 rad/s has rotated by 0.03 rad by then; more steps save nothing.
constexpr int responseSteps = 32;

} // namespace timber
