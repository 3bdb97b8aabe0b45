// SPDX-License-Identifier: GPL-2.0-or-later
#include "manifold.hpp"
#include "feature_search.hpp"
#include "geometry.hpp"
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
//   4. Test the candidates: vertices against one face, or edge against edge, in SIMD batches; other patterns one by
//     one.
//   5. Deep contact without a point: add one point in the overlap region, along the axis of least overlap.
//   6. No points at all: look for a separating axis for step 1 of the next update.
// All geometry is in the frame of A until a point is stored.
namespace {

	/// Contact of two features, frame of A.
	template <class Number> struct FeatureContact {
		Vec3Of<Number> pointA; ///< on core A [m]
		Vec3Of<Number> normal; ///< unit, from A to B
		Number distance; ///< of the cores along the normal, < 0 where they overlap [m]
	};

	/// Collects the contact points of a pair, in world coordinates.
	class PointCollector {
		const ShapePair& pair;
		const Mat3& rotationA;
		const Vec3& positionA;
		std::vector<ContactPoint>& points;

		/// Coincident vertices, and vertices above each other's borders, are found as several pairs of features
		/// but are one contact.
		/// Crossings of edges keep a distance from vertices (edgeEdgeContact) and are never duplicates.
		bool isDuplicate(const ContactPoint& next) const
		{
			const FeatureKind kind = next.id.kind();
			if (kind == FeatureKind::VertexFace || kind == FeatureKind::EdgeEdge) return false;
			const bool isVertexEdge = kind == FeatureKind::VertexEdge || kind == FeatureKind::EdgeVertex;
			return std::any_of(points.begin(), points.end(), [&](const ContactPoint& p) {
				if (isVertexEdge ? p.id.kind() == FeatureKind::EdgeEdge
				                 : p.id.kind() != FeatureKind::VertexFace)
					return false;
				return (p.position - next.position).squaredNorm() < 4 * flushTolerance * flushTolerance
				        && p.normal.dot(next.normal) > 0.9;
			});
		}

	public:
		PointCollector(
		        const ShapePair& p, const Mat3& rotation, const Vec3& position, std::vector<ContactPoint>& out)
		        : pair(p)
		        , rotationA(rotation)
		        , positionA(position)
		        , points(out)
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
				const ContactPoint next { first[i], lane(position, i), lane(normal, i),
					lane(overlap, i) };
				if (!isDuplicate(next)) points.push_back(next);
			}
		}
	};

	/// Whether vertices x are in contact with a face of a body, in the body's frame.
	/// Separated cores: the vertex projects onto the face, or beyond a side but closer to the side than to the
	/// face. Otherwise the adjacent face would give a second point. Overlapping cores: only the support face along
	/// the axis of least overlap counts.
	template <class Number>
	auto isVertexOnFace(const ShapePair& pair, const RoundedPolyhedron& body, int supportFace, int face,
	        const Vec3Of<Number>& x, Number& distance)
	{
		const Face& f = body.core.faces[face];
		const Number side = pair.sideTolerance(), zero = 0.;
		distance = signedDistance(f.plane, x);
		auto valid = logicalAnd(distance<Number(pair.contactDistance()), distance> Number(
		        -(pair.isDeep() ? body.coreHalfThickness : flushTolerance)));
		if (!any(valid)) return valid;
		valid = logicalAnd(valid, projectsOntoFace(f, x, pair.isDeep() ? side : min(side, distance)));
		if (!pair.isDeep()) return valid;
		return face == supportFace
		        ? logicalAnd(valid, logicalOr(distance >= zero, isInsideOtherFaces(body.core, face, x, side)))
		        : zero < zero;
	}

	/// Up to laneCount vertices of one body against the same face of the other. Returns which of them are in
	/// contact.
	template <class Number>
	auto vertexFaceContact(
	        const ShapePair& pair, const FeatureId* first, size_t count, FeatureContact<Number>& contact)
	{
		using Vec = Vec3Of<Number>;
		const bool isFaceOfB = first->kind() == FeatureKind::VertexFace;
		const RoundedPolyhedron &body = isFaceOfB ? pair.b : pair.a, &other = isFaceOfB ? pair.a : pair.b;
		const int face = isFaceOfB ? first->b() : first->a();
		assert(size_t(face) < body.core.faces.size());
		const Vec vertices = Group<Number, const Vec3>(count, [&](size_t i) {
			return &other.core.vertices[isFaceOfB ? first[i].a() : first[i].b()];
		}).vectors();
		const Vec inA = isFaceOfB ? vertices : pair.toA<Number>(vertices);
		const auto valid = isVertexOnFace<Number>(pair, body, isFaceOfB ? pair.supportFaceB : pair.supportFaceA,
		        face, isFaceOfB ? pair.toB<Number>(vertices) : inA, contact.distance);
		if (!any(valid)) return valid;
		const Vec3& outward = body.core.faces[face].plane.normal;
		contact.normal = broadcast<Number>(isFaceOfB ? Vec3(-(pair.rotation * outward)) : outward);
		contact.pointA = isFaceOfB ? inA : Vec(inA - contact.distance * contact.normal);
		return valid;
	}

	/// Up to laneCount edges of A, each against an edge of B. The crossing must be inside both edges, farther from
	/// their ends than the flush tolerance, where the vertices are in contact instead. Returns which of them are in
	/// contact.
	template <class Number>
	auto edgeEdgeContact(
	        const ShapePair& pair, const FeatureId* first, size_t count, FeatureContact<Number>& contact)
	{
		using Vec = Vec3Of<Number>;
		const Polyhedron &coreA = pair.a.core, &coreB = pair.b.core;
		const Number zero = 0.;
		const auto edgeA = [&](size_t i) { return &coreA.edges[first[i].a()]; };
		const auto edgeB = [&](size_t i) { return &coreB.edges[first[i].b()]; };
		const Group<Number, const Edge> a(count, edgeA), b(count, edgeB);
		const Vec tailA = Group<Number, const Vec3>(count, [&](size_t i) {
			return &coreA.vertices[edgeA(i)->tail];
		}).vectors();
		const Vec tailB = pair.toA<Number>(Group<Number, const Vec3>(count, [&](size_t i) {
			return &coreB.vertices[edgeB(i)->tail];
		}).vectors());
		const Vec directionA = a.get(&Edge::direction),
		          directionB = broadcast<Number>(pair.rotation) * b.get(&Edge::direction);
		const Crossing<Number> c = crossing<Number>(tailA, directionA, tailB, directionB);
		auto valid = c.sine >= Number(parallelSine);
		if (!any(valid)) return valid;
		const Number end = Number(flushTolerance) / c.sine;
		valid = logicalAnd(valid,
		        logicalAnd(logicalAnd(c.alongA > end, c.alongA < a.get(&Edge::length) - end),
		                logicalAnd(c.alongB > end, c.alongB < b.get(&Edge::length) - end)));
		if (!any(valid)) return valid;
		contact.normal = select(c.normal.dot(a.get(&Edge::outward)) < zero, Vec(-c.normal), c.normal);
		valid = logicalAnd(
		        // Otherwise on the far side of B
		        valid,
		        contact.normal.dot(Vec(broadcast<Number>(pair.rotation) * b.get(&Edge::outward))) < zero);
		contact.pointA = tailA + c.alongA * directionA;
		contact.distance = contact.normal.dot(Vec(tailB + c.alongB * directionB - contact.pointA));
		return logicalAnd(valid,
		        logicalAnd(contact.distance<Number(pair.contactDistance()), contact.distance> Number(
		                -(pair.isDeep() ? pair.depthLimit() : flushTolerance))));
	}

	/// Whether a vertex is the support point of its body along a direction (unit): no edge from it rises by more
	/// than `slope` (cosine).
	bool isSupportVertex(const Polyhedron& body, int vertex, const Vec3& direction, double slope)
	{
		assert(isUnit(direction));
		for (const Edge& e : body.edges) {
			if (e.tail != vertex && e.head != vertex) continue;
			const double rise = e.direction.dot(direction);
			if ((e.tail == vertex ? rise : -rise) > slope) return false;
		}
		return true;
	}

	/// Whether a vertex of one body is in contact with an edge of the other, in the frame of the edge's body.
	/// rotation: from the frame of the vertex's body to that of the edge. x: position of the vertex [m]. foot
	/// (out): closest point of the edge.
	bool isVertexOnEdge(const ShapePair& pair, const Polyhedron& vertexBody, const Mat3& rotation, int vertex,
	        const Polyhedron& edgeBody, const Edge& edge, const Vec3& x, Vec3& foot)
	{
		const Vec3& tail = edgeBody.vertices[edge.tail];
		const double along = (x - tail).dot(edge.direction);
		if (along < -flushTolerance || along > edge.length + flushTolerance) return false;
		for (const int f : { edge.left, edge.right })
			// Vertex-face contact
			if (projectsOntoFace<double>(edgeBody.faces[f], x, pair.sideTolerance())) return false;
		foot = tail + along * edge.direction;
		const Vec3 towards = foot - x;
		const double distance = towards.norm();
		if (distance >= pair.contactDistance() || distance <= 0 || towards.dot(edge.outward) >= 0) return false;
		return isSupportVertex(vertexBody, vertex, rotation.transpose() * towards / distance,
		        flushTolerance / pair.contactDistance());
	}

	/// Contact of two points on the cores, which do not coincide.
	bool pointPointContact(const Vec3& pointA, const Vec3& pointB, FeatureContact<double>& contact)
	{
		const Vec3 difference = pointB - pointA;
		contact.pointA = pointA;
		contact.distance = difference.norm();
		assert(contact.distance > 0);
		contact.normal = difference / contact.distance;
		return true;
	}

	bool vertexEdgeContact(const ShapePair& pair, int vertex, int edge, FeatureContact<double>& contact)
	{
		const Polyhedron &a = pair.a.core, &b = pair.b.core;
		const Vec3& x = a.vertices[vertex];
		Vec3 foot;
		if (!isVertexOnEdge(
		            pair, a, pair.rotation.transpose(), vertex, b, b.edges[edge], pair.toB<double>(x), foot))
			return false;
		return pointPointContact(x, pair.toA<double>(foot), contact);
	}

	bool edgeVertexContact(const ShapePair& pair, int edge, int vertex, FeatureContact<double>& contact)
	{
		const Polyhedron &a = pair.a.core, &b = pair.b.core;
		const Vec3 x = pair.toA<double>(b.vertices[vertex]);
		Vec3 foot;
		return isVertexOnEdge(pair, b, pair.rotation, vertex, a, a.edges[edge], x, foot)
		        && pointPointContact(foot, x, contact);
	}

	bool vertexVertexContact(const ShapePair& pair, int vertexA, int vertexB, FeatureContact<double>& contact)
	{
		const Polyhedron &a = pair.a.core, &b = pair.b.core;
		const Vec3 &pointA = a.vertices[vertexA], pointB = pair.toA<double>(b.vertices[vertexB]);
		const Vec3 difference = pointB - pointA;
		const double distance = difference.norm();
		if (distance >= pair.contactDistance() || distance <= flushTolerance) return false;
		// Strictly beyond the ends of all edges: no vertex-edge contact
		const double slope = -flushTolerance / distance;
		return isSupportVertex(a, vertexA, difference / distance, slope)
		        && isSupportVertex(b, vertexB, pair.rotation.transpose() * -difference / distance, slope)
		        && pointPointContact(pointA, pointB, contact);
	}

	/// Patterns::vertexEdge.
	bool extraPatternContact(const ShapePair& pair, FeatureId id, FeatureContact<double>& contact)
	{
		switch (id.kind()) {
			case FeatureKind::VertexEdge: return vertexEdgeContact(pair, id.a(), id.b(), contact);
			case FeatureKind::EdgeVertex: return edgeVertexContact(pair, id.a(), id.b(), contact);
			case FeatureKind::VertexVertex: return vertexVertexContact(pair, id.a(), id.b(), contact);
			default: return false;
		}
	}

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
				default: return id.kind() == FeatureKind::EdgeEdge;
			}
		};
		return size_t(
		        std::find_if_not(first + 1, first + std::min<std::ptrdiff_t>(end - first, laneCount), isSimilar)
		        - first);
	}

	/// Tests a batch of candidates and adds their contact points.
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
		if (kind == FeatureKind::EdgeEdge) add(edgeEdgeContact(pair, first, count, contact));
		else if (kind == FeatureKind::VertexFace || kind == FeatureKind::FaceVertex)
			add(vertexFaceContact(pair, first, count, contact));
		else if constexpr (std::is_same_v<Number, double>) add(extraPatternContact(pair, *first, contact));
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
		assert(pair.isDeep() && isUnit(pair.axis));
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

	/// Step 6, in one of axisInterval updates: tests the face normals. Returns the safe displacement. [m]
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

	/// Step 4.
	void testCandidates(const ShapePair& pair, const std::vector<FeatureId>& candidates, PointCollector& points)
	{
		const FeatureId* const end = candidates.data() + candidates.size();
		for (const FeatureId* next = candidates.data(); next != end;) {
			const size_t count = batchSize(next, end);
			count == 1 ? addBatch<double>(pair, next, count, points)
			           : addBatch<Lanes>(pair, next, count, points);
			next += count;
		}
	}

} // namespace

double updateManifold(const RoundedPolyhedron& a, const RoundedPolyhedron& b, const Pose& poseA, const Pose& poseB,
        const Patterns& patterns, CandidateCache& cache, std::vector<ContactPoint>& points)
{
	assert(isAdmissible(poseA) && isAdmissible(poseB));
	assert(a.radius > 0 && b.radius > 0);
	if (!cache.matches(a, b, patterns)) cache = CandidateCache(a, b, patterns);
	const bool wasInContact = !points.empty();
	points.clear();
	const Mat3 rotationA = poseA.orientation.toRotationMatrix();
	ShapePair pair { a, b, rotationA.transpose() * poseB.orientation.toRotationMatrix(),
		rotationA.transpose() * (poseB.position - poseA.position), patterns };

	if (!wasInContact) // 1.
		if (const double displacement = safeDisplacement(pair, gapAlongCachedAxis(pair, cache));
		        displacement > 0)
			return displacement;
	updateCandidates(cache, pair); // 2.
	// 3. A larger gap is not due to rounding
	if (cache.coresMayOverlap && gapAlongCachedAxis(pair, cache) < flushTolerance) findLeastOverlap(pair);
	PointCollector collector(pair, rotationA, poseA.position, points);
	testCandidates(pair, cache.candidates, collector); // 4.
	const FeatureId cores { FeatureKind::CoreCore, 0, 0 };
	if (points.empty() && pair.isDeep()) collector.add(&cores, 1, true, coreCoreContact(pair)); // 5.
	assert(std::is_sorted(points.begin(), points.end(),
	        [](const ContactPoint& p, const ContactPoint& q) { return p.id < q.id; }));
	return points.empty() ? findSeparatingFace(pair, cache) : 0; // 6.
}

} // namespace timber
