// SPDX-License-Identifier: GPL-2.0-or-later
#include "manifold.hpp"
#include "core_distance.hpp"
#include "feature_contact.hpp"
#include "feature_search.hpp"
#include "geometry.hpp"
#include "succession.hpp"
#include "separating_axis.hpp"
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <type_traits>

namespace timber {

// Update of a manifold:
//   1. Early out: the pair had no points, and the cached separating axis shows a gap. Return the gap as safe
//     displacement.
//   2. Search the candidate features again if the pair has moved beyond the margin of the last search
//     (feature_search.cpp).
//   3. If the cores may overlap, find the axis of least overlap (separating_axis.cpp).
//   4. Test the candidates: vertices against one face, or edge against edge, in SIMD batches; other kinds one by
//     one. Edges come last, since contacts of vertices replace crossings (feature_contact.hpp).
//   5. Deep contact without a point as deep as the cores: add one point in the overlap region, along the axis of least
//     overlap.
//   6. Link new points to those of the last update that they continue (succession.hpp).
//   7. No points at all: look for a separating axis for step 1 of the next update.
// All geometry is in the frame of A until a point is stored.
namespace {

	/// Collects the contact points of a pair, in world coordinates.
	class PointCollector {
		const ShapePair& pair;
		const Mat3& rotationA;
		const Vec3& positionA;
		std::vector<ContactPoint>& points;

		/// Coincident vertices, and vertices above each other's borders, are found as several pairs of features
		/// but are one contact. With vertex-edge contacts only a point that is not deeper is left out.
		bool isDuplicate(const ContactPoint& next) const
		{
			const FeatureKind kind = next.id.kind();
			if (kind == FeatureKind::VertexFace || kind == FeatureKind::EdgeEdge) return false;
			const double limit = 2 * pair.flushLimit();
			return std::any_of(points.begin(), points.end(), [&](const ContactPoint& p) {
				if (kind == FeatureKind::FaceVertex ? p.id.kind() != FeatureKind::VertexFace
				                                    : p.id.kind() == FeatureKind::EdgeEdge)
					return false;
				return (p.position - next.position).squaredNorm() < limit * limit
				        && p.normal.dot(next.normal) > 0.9
				        && (!pair.kinds.vertexEdge
				                || next.overlap <= p.overlap + duplicateShare * limit);
			});
		}

	public:
		VertexContacts vertices;

		/// scratch: storage of `vertices`
		PointCollector(const ShapePair& p, const Mat3& rotation, const Vec3& position,
		        std::vector<FeatureId>& scratch, std::vector<ContactPoint>& out)
		        : pair(p)
		        , rotationA(rotation)
		        , positionA(position)
		        , points(out)
		        , vertices(scratch)
		{
		}
		/// Adds the `valid` ones of a batch of contacts. first: their ids.
		template <class Number, class Condition>
		void add(const FeatureId* first, size_t count, Condition valid, const FeatureContact<Number>& contact)
		{
			const Number overlap = Number(pair.contactDistance()) - contact.distance;
			const Vec3Of<Number> middle
			        = contact.pointA + (Number(pair.a.radius) - overlap / Number(2.)) * contact.normal;
			const Vec3Of<Number> position
			        = broadcast<Number>(positionA) + broadcast<Number>(rotationA) * middle,
			        normal = broadcast<Number>(rotationA) * contact.normal;
			for (size_t i = 0; i < count; ++i) {
				if (!lane(valid, i)) continue;
				vertices.add(first[i]);
				const ContactPoint next { first[i], {}, lane(position, i), lane(normal, i),
					lane(overlap, i) };
				if (!isDuplicate(next)) points.push_back(next);
			}
		}
	};

	/// Number of candidates from `first` on that form a SIMD batch: vertices against one face, or edge against
	/// edge.
	size_t batchSize(const FeatureId* first, const FeatureId* end)
	{
		assert(first < end);
		const auto isSimilar = [first](FeatureId id) {
			if (id.kind() != first->kind()) return false;
			switch (id.kind()) {
				case FeatureKind::VertexFace: return id.b() == first->b();
				case FeatureKind::FaceVertex: return id.a() == first->a();
				default: return true;
			}
		};
		return size_t(
		        std::find_if_not(first + 1, first + std::min<std::ptrdiff_t>(end - first, laneCount), isSimilar)
		        - first);
	}

	/// Tests a batch of candidates, of vertices and faces or of edges, and adds their contact points.
	template <class Number>
	void addBatch(const ShapePair& pair, const FeatureId* first, size_t count, PointCollector& points)
	{
		FeatureContact<Number> contact;
		const auto add = [&](auto valid) {
			if (!any(valid)) return;
			if (pair.isDeep())
				valid = logicalAnd(valid,
				        contact.normal.dot(broadcast<Number>(pair.axis)) >= Number(deepNormalCosine));
			points.add(first, count, valid, contact);
		};
		const FeatureKind kind = first->kind();
		if (kind == FeatureKind::EdgeEdge) add(edgeEdgeContact(pair, first, count, points.vertices, contact));
		else add(vertexFaceContact(pair, first, count, contact));
	}

	/// Centre of the common part of the projections of both cores onto a direction, from the origin of A. [m]
	double overlapCentre(const ShapePair& pair, const Vec3& direction)
	{
		const Interval a = projectionInterval(pair.a.core, direction),
		               b = projectionInterval(pair.b.core, pair.rotation.transpose() * direction);
		const double shift = pair.translation.dot(direction);
		return (std::max(a.min, b.min + shift) + std::min(a.max, b.max + shift)) / 2;
	}

	/// One point in the overlap region of the cores, along the axis of least overlap: for overlapping cores without
	/// a pair of features in contact, such as two plates through each other.
	FeatureContact<double> coreCoreContact(const ShapePair& pair)
	{
		assert(isUnit(pair.axis));
		const Vec3 half = pair.gap / 2 * pair.axis;
		Vec3 middle = overlapCentre(pair, pair.axis) * pair.axis;
		for (const Vec3& across : { Vec3(pair.axis.unitOrthogonal()),
		             Vec3(pair.rotation * (pair.rotation.transpose() * pair.axis).unitOrthogonal()) })
			// Mean over both bodies' frames: symmetric in A and B
			for (const Vec3& direction : { across, Vec3(pair.axis.cross(across)) })
				middle += 0.5 * overlapCentre(pair, direction) * direction;
		return { middle - half, pair.axis, pair.gap };
	}

	/// Gap between the cores along the cached axis: a lower bound of their distance. [m]
	double gapAlongCachedAxis(const ShapePair& pair, const CandidateCache& cache)
	{
		if (!cache.isSearched()) return -std::numeric_limits<double>::infinity();
		return projectionInterval(pair.b.core, pair.rotation.transpose() * cache.axis).min
		        + pair.translation.dot(cache.axis) - cache.supportA;
	}

	/// Relative displacement without a contact point, given a gap between the cores. A flush support extends beyond
	/// the border of a face, at a corner by sqrt(2) times its tolerance. [m]
	double safeDisplacement(const ShapePair& pair, double gap)
	{
		return std::max(0., gap - pair.contactDistance() - 2 * flushTolerance);
	}

	/// Step 7, in one of axisInterval updates: tests the face normals. Returns the safe displacement. [m]
	double findSeparatingFace(const ShapePair& pair, CandidateCache& cache)
	{
		if (cache.updates % axisInterval != axisInterval / 2) return 0;
		Vec3 axis;
		const double gap = coreGap(pair.a.core, pair.b.core, pair.rotation, pair.translation, axis,
		        -std::numeric_limits<double>::infinity());
		const double displacement = safeDisplacement(pair, gap);
		if (displacement > 0) {
			cache.axis = axis;
			cache.supportA = projectionInterval(pair.a.core, axis).max;
		}
		return displacement;
	}

	/// Step 2. A pair at rest is searched with the smaller skin.
	void updateCandidates(CandidateCache& cache, const ShapePair& pair)
	{
		const double motion = cache.isSearched() ? cache.motion(pair.rotation, pair.translation) : 0;
		if (!cache.isSearched() || !(motion <= cache.margin))
			return searchCandidates(pair, candidateSkin, cache);
		if (++cache.updates % restInterval != 0) return;
		const bool isAtRest = std::abs(motion - cache.lastMotion) < restSkin / 2;
		cache.lastMotion = motion;
		if (isAtRest && cache.skin > restSkin && !cache.candidates.empty())
			searchCandidates(pair, restSkin, cache);
	}

	/// Step 3.
	void findLeastOverlap(ShapePair& pair)
	{
		pair.gap = coreGap(pair.a.core, pair.b.core, pair.rotation, pair.translation, pair.axis, 0);
		if (!pair.isDeep()) return;
		pair.supportFaceA = supportFace(pair.a.core, pair.axis);
		pair.supportFaceB = supportFace(pair.b.core, pair.rotation.transpose() * -pair.axis);
	}

	/// Step 4, of candidates from `next` to `end`.
	void testCandidates(const ShapePair& pair, const FeatureId* next, const FeatureId* end, PointCollector& points)
	{
		while (next != end) {
			const size_t count = batchSize(next, end);
			count == 1 ? addBatch<double>(pair, next, count, points)
			           : addBatch<Lanes>(pair, next, count, points);
			next += count;
		}
	}

	/// Step 4, of candidates of extra kinds from `next` to `end`.
	void testExtraPatterns(
	        const ShapePair& pair, const FeatureId* next, const FeatureId* end, PointCollector& points)
	{
		FeatureContact<double> contact;
		for (; next != end; ++next)
			if (extraPatternContact(pair, *next, points.vertices, contact)
			        && (!pair.isDeep() || contact.normal.dot(pair.axis) >= deepNormalCosine))
				points.add(next, 1, true, contact);
	}

	/// Step 4. The points are sorted by id.
	void testCandidates(const ShapePair& pair, const std::vector<FeatureId>& candidates, PointCollector& collector,
	        std::vector<ContactPoint>& points)
	{
		const auto firstOf = [&](FeatureKind kind) {
			return std::lower_bound(
			        candidates.data(), candidates.data() + candidates.size(), FeatureId(kind, 0, 0));
		};
		const FeatureId *const first = candidates.data(), *const end = first + candidates.size(),
		                       *const edges = firstOf(FeatureKind::EdgeEdge),
		                       *const extras = firstOf(FeatureKind::VertexEdge);
		testCandidates(pair, first, edges, collector);
		const auto onFaces = std::ptrdiff_t(points.size());
		testExtraPatterns(pair, extras, end, collector);
		const auto ofVertices = std::ptrdiff_t(points.size());
		testCandidates(pair, edges, extras, collector);
		std::rotate(points.begin() + onFaces, points.begin() + ofVertices, points.end());
	}

	/// Step 5. Whether the points leave out an overlap of the cores. With vertex-edge contacts some point is as
	/// deep as the cores, but for those that are deeper than half a body, or touch exactly.
	bool lacksDepth(const ShapePair& pair, const std::vector<ContactPoint>& points)
	{
		if (!pair.kinds.vertexEdge) return pair.isDeep() && points.empty();
		if (points.empty() && pair.gap >= 0)
			return pair.gap < pair.flushLimit()
			        && coreDistance(pair.a.core, pair.b.core, pair.rotation, pair.translation)
			        < pair.flushLimit();
		return pair.isDeep() && std::none_of(points.begin(), points.end(), [&](const ContactPoint& p) {
			return p.overlap >= pair.contactDistance() - pair.gap - pair.flushLimit();
		});
	}

} // namespace

double updateManifold(const RoundedPolyhedron& a, const RoundedPolyhedron& b, const Pose& poseA, const Pose& poseB,
        const ContactKinds& kinds, CandidateCache& cache, std::vector<ContactPoint>& points)
{
	assert(isAdmissible(poseA) && isAdmissible(poseB));
	assert(a.radius > 0 && b.radius > 0);
	if (!cache.matches(a, b, kinds)) cache = CandidateCache(a, b, kinds);
	std::vector<ContactPoint>& before = cache.before;
	before.swap(points);
	const bool wasInContact = !before.empty();
	points.clear();
	const Mat3 rotationA = poseA.orientation.toRotationMatrix();
	ShapePair pair { a, b, rotationA.transpose() * poseB.orientation.toRotationMatrix(),
		rotationA.transpose() * (poseB.position - poseA.position), kinds };

	if (!wasInContact) // 1.
		if (const double displacement = safeDisplacement(pair, gapAlongCachedAxis(pair, cache));
		        displacement > 0)
			return displacement;
	updateCandidates(cache, pair); // 2.
	// 3. A larger gap is not due to rounding
	if (cache.coresMayOverlap && gapAlongCachedAxis(pair, cache) < flushTolerance) findLeastOverlap(pair);
	PointCollector collector(pair, rotationA, poseA.position, cache.vertexContacts, points);
	testCandidates(pair, cache.candidates, collector, points); // 4.
	const FeatureId cores { FeatureKind::CoreCore, 0, 0 };
	if (lacksDepth(pair, points)) collector.add(&cores, 1, true, coreCoreContact(pair)); // 5.
	if (kinds.vertexEdge) linkPredecessors(a.core, b.core, before, points); // 6.
	assert(std::is_sorted(points.begin(), points.end(),
	        [](const ContactPoint& p, const ContactPoint& q) { return p.id < q.id; }));
	return points.empty() ? findSeparatingFace(pair, cache) : 0; // 7.
}

} // namespace timber
