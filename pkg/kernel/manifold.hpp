// SPDX-License-Identifier: GPL-2.0-or-later
/// Contact points between two rounded convex polyhedra (paper, section 2.2, Fig. 3). The manifold of a pair is the set
/// of its contact points.
///
/// Each point connects a feature of core A with a feature of core B. Its overlap is r_A + r_B - distance of the
/// features.
/// Vertex and face: in contact while the vertex projects onto the face. Two edges: in contact while they cross inside
/// both.
/// A face resting on a face thus has a point per supported vertex and per crossing of border edges.
/// With vertex-edge contacts some point is always at the shortest distance of the cores.
/// Deep contact (the cores overlap): only points with a normal near the axis of least overlap count. If there are none,
/// or with vertex-edge contacts none as deep as the cores, a point in the overlap region is added, so that the pair is
/// always pushed apart.
/// Flush members have vertices exactly above the border of a face: `ContactKinds::flushSupports` decides these contacts.
#pragma once
#include "polyhedron.hpp"
#include <cassert>
#include <cmath>
#include <cstdint>
#include <vector>

namespace timber {

/// Kinds of the features of A and B in contact. Points of a manifold are in this order.
enum class FeatureKind : std::uint8_t {
	VertexFace,
	FaceVertex,
	EdgeEdge,
	VertexEdge,
	EdgeVertex,
	VertexVertex,
	CoreCore
};

/// Identifies a contact point while the same two features are in contact; the history of a point is stored under its
/// id.
struct FeatureId {
	std::uint32_t bits = ~0u; ///< kind (4 bits), index of A (14), index of B (14); default: no features
	FeatureId() = default;
	FeatureId(FeatureKind kind, int a, int b)
	        : bits(std::uint32_t(kind) << 28 | std::uint32_t(a) << 14 | std::uint32_t(b))
	{
		assert(a >= 0 && a <= indexMask && b >= 0 && b <= indexMask);
	}
	FeatureKind kind() const { return FeatureKind(bits >> 28); }
	int a() const { return int(bits >> 14) & indexMask; }
	int b() const { return int(bits) & indexMask; }
	bool operator==(FeatureId o) const { return bits == o.bits; }
	bool operator<(FeatureId o) const { return bits < o.bits; }
	static constexpr int indexMask = 0x3fff;
};

struct ContactPoint {
	FeatureId id;
	/// Point of the last update that this one continues with other features, see succession.hpp; default: none.
	FeatureId predecessor;
	Vec3 position; ///< middle of the overlap, world frame [m]
	Vec3 normal; ///< unit, from A to B, world frame
	double overlap; ///< > 0 [m]
};

/// Optional kinds of contact.
struct ContactKinds {
	bool vertexEdge = false; ///< also vertex-edge and vertex-vertex contacts, which the paper ignores
	bool flushSupports = true; ///< a vertex exactly above the border of a face is supported by the face
	bool operator==(const ContactKinds& o) const
	{
		return vertexEdge == o.vertexEdge && flushSupports == o.flushSupports;
	}
};

/// Candidate features of a pair and the relative motion for which they are complete, as the skin of a Verlet list.
/// The sum of two terms must not exceed `margin`: the displacement of B at `centre`, where the bodies are close, and
/// the rotation of B times `regionRadius`. A slender member rocking on its end thus keeps its candidates although its
/// far end moves a lot.
/// The cache never changes a result: an empty one gives the same manifold. It is reset if the bodies or the kinds
/// change.
struct CandidateCache {
	unsigned long serialA = 0, serialB = 0; ///< of the bodies
	ContactKinds kinds;
	std::vector<FeatureId> candidates;
	Mat3 rotation = Mat3::Identity(); ///< of B in the frame of A, at the search
	Vec3 centre = Vec3::Zero(), centreB = Vec3::Zero(); ///< the same point at the search, frames of A and B [m]
	double regionRadius = 0; ///< of the region of contact about the centre [m]
	double skin = 0; ///< requested by the search [m]
	double margin = -1; ///< motion up to which the candidates are complete, >= skin; < 0: no search yet [m]
	int updates = 0; ///< since the search, without those that ended at the separating axis
	double lastMotion = 0; ///< motion() at the last test for rest [m]
	bool coresMayOverlap = false; ///< within the margin
	Vec3 axis = Vec3::Zero(); ///< last axis found of the largest gap between the cores, unit, frame of A
	double supportA = 0; ///< largest coordinate of core A along the axis [m]
	// Only used within an update; members for their memory
	std::vector<ContactPoint> before; ///< points of the last update
	std::vector<FeatureId> vertexContacts;

	CandidateCache() = default;
	CandidateCache(const RoundedPolyhedron& a, const RoundedPolyhedron& b, const ContactKinds& p)
	        : serialA(a.serial)
	        , serialB(b.serial)
	        , kinds(p)
	{
	}
	bool matches(const RoundedPolyhedron& a, const RoundedPolyhedron& b, const ContactKinds& p) const
	{
		return serialA == a.serial && serialB == b.serial && kinds == p;
	}
	bool isSearched() const { return margin >= 0; }
	/// Relative motion since the search, to be compared with the margin. [m]
	double motion(const Mat3& newRotation, const Vec3& newTranslation) const
	{
		const double angle = std::sqrt(0.5 * (newRotation - rotation).squaredNorm()); // displacement per radius
		return (newRotation * centreB + newTranslation - centre).norm() + angle * regionRadius;
	}
};

/// Finds the contact points with overlap > 0, sorted by id. The vertices of the bodies are in their body frames; poses
/// are finite.
/// points (in-out): those of the last update; non-empty means the pair was in contact.
/// Returns a safe displacement: how far the bodies can move relative to each other before there can be a point; 0:
/// unknown. [m]
double updateManifold(const RoundedPolyhedron& a, const RoundedPolyhedron& b, const Pose& poseA, const Pose& poseB,
        const ContactKinds& kinds, CandidateCache& cache, std::vector<ContactPoint>& points);

} // namespace timber
