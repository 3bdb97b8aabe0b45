// SPDX-License-Identifier: GPL-2.0-or-later
/// Contact points between two rounded convex polyhedra (paper, section 2.2, Fig. 3).
///
/// Every point joins a feature of core A to a feature of core B and has the overlap r_A + r_B - distance.
/// A vertex counts against a face while its foot lies in the core face; two edges count while they cross inside both.
/// A face on a face thus gets a point per supported vertex and per crossing pair of border edges.
/// Once the cores overlap (deep contact), only points that push along the axis of least overlap count, or one point in the
/// common part if there is none: the pair is always pushed apart.
/// Vertices over a border (the normal case in a house, where members are flush) are decided by `Patterns::flushSupports`.
#pragma once
#include "polyhedron.hpp"
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace timber {

/// Which features of A and B meet. The order is the order of points in a manifold.
enum class FeatureKind : std::uint8_t { VertexFace, FaceVertex, EdgeEdge, VertexEdge, EdgeVertex, VertexVertex, CoreCore };

/// Name of a contact point that lasts as long as the same two features meet: history follows it.
struct FeatureId {
	std::uint32_t bits = ~0u; ///< no features yet
	FeatureId() = default;
	FeatureId(FeatureKind m, int a, int b)
	        : bits(std::uint32_t(m) << 28 | std::uint32_t(a) << 14 | std::uint32_t(b))
	{
	}
	FeatureKind kind() const { return FeatureKind(bits >> 28); }
	int a() const { return int(bits >> 14 & 0x3fff); }
	int b() const { return int(bits & 0x3fff); }
	bool operator==(FeatureId o) const { return bits == o.bits; }
	bool operator<(FeatureId o) const { return bits < o.bits; }
};

struct ContactPoint {
	FeatureId id;
	Vec3 position; ///< middle of the overlap, world [m]
	Vec3 normal; ///< unit, from A to B, world
	double overlap; ///< > 0 [m]
};

/// How the contact patterns of the paper are read.
struct Patterns {
	bool vertexEdge = false; ///< also vertex-edge and vertex-vertex, which the paper ignores
	bool flushSupports = true; ///< a vertex exactly over the border of a face is supported by it
	bool operator==(const Patterns& o) const { return vertexEdge == o.vertexEdge && flushSupports == o.flushSupports; }
};

/// Candidate feature pairs of two bodies and the relative motion that keeps them complete: the body B may move by `margin`
/// at `centre`, where the bodies are near each other, and turn by `margin` over `region`, together no more than one of them.
/// A slender member that rocks on its end thus keeps its candidates although its far end moves a lot.
/// Holds no result: an empty cache gives the same manifold. One of other bodies or patterns counts as empty.
struct CandidateCache {
	unsigned long serialA = 0, serialB = 0; ///< of the bodies
	Patterns patterns;
	std::vector<FeatureId> candidates;
	Mat3 rotation = Mat3::Identity(); ///< of B in the frame of A, at the search
	Vec3 centre = Vec3::Zero(), centreB = Vec3::Zero(); ///< in the frames of A and B [m]
	double region = 0; ///< [m]
	double skin = 0; ///< least margin asked for [m]
	double margin = -1; ///< [m]; < 0: never searched
	int uses = 0; ///< since the search, but for those that ended at the known gap
	double motionThen = 0; ///< motion() at the last look whether the pair keeps still [m]
	bool coresMayMeet = false; ///< cores may overlap within the margin
	Vec3 axis = Vec3::Zero(); ///< unit, frame of A: where the cores were farthest apart, at the search or when they were last looked at for it
	double farA = 0; ///< how far A reaches along it [m]

	CandidateCache() = default;
	CandidateCache(const RoundedPolyhedron& a, const RoundedPolyhedron& b, const Patterns& p)
	        : serialA(a.serial)
	        , serialB(b.serial)
	        , patterns(p)
	{
	}
	bool fits(const RoundedPolyhedron& a, const RoundedPolyhedron& b, const Patterns& p) const { return serialA == a.serial && serialB == b.serial && patterns == p; }
	bool searched() const { return margin >= 0; }
	/// Since the search. [m]
	double motion(const Mat3& nowRotation, const Vec3& nowTranslation) const
	{
		const double turned = std::sqrt(0.5 * (nowRotation - rotation).squaredNorm()); // way per radius
		return (nowRotation * centreB + nowTranslation - centre).norm() + turned * region;
	}
};

/// Largest gap between the cores over all separating axes: <= distance when apart, minus the penetration depth when
/// they overlap. `axis` (unit, from A to B, frame of A) is where it is found. The crossings of edges are not tried once the
/// gap exceeds `enough`. [m]
double coreGap(const Polyhedron& a, const Polyhedron& b, const Mat3& rotation, const Vec3& translation, Vec3& axis,
        double enough = std::numeric_limits<double>::infinity());

/// Contact points with overlap > 0, sorted by id. Both bodies' vertices are in their body frames. Returns by how much the bodies
/// may surely move against each other before there are any; 0: not known. [m]
double updateManifold(const RoundedPolyhedron& a, const RoundedPolyhedron& b, const Pose& poseA, const Pose& poseB, const Patterns& patterns,
        CandidateCache& cache, std::vector<ContactPoint>& points);

} // namespace timber
