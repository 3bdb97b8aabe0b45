// SPDX-License-Identifier: GPL-2.0-or-later
#include "feature_search.hpp"
#include "geometry.hpp"
#include "separating_axis.hpp"
#include <cassert>
#include <limits>

namespace timber {

// Search of the candidates:
//   1. Find the axis of the largest gap between the cores. A pair far apart has no candidates; its margin is what
//     remains of the gap.
//   2. Rough search for close features, with the motion bounded about the smaller body. Other kinds of
//     contact are searched only where no vertex is close to a face.
//   3. Centre the region of contact on these positions. The bound of the motion is smallest there.
//   4. Final search with this region: all pairs of features that can come into contact within the margin.
namespace {

	/// One search, for a cache with given centre, regionRadius and margin. Candidates are found in the order of
	/// their ids.
	class FeatureSearch {
	public:
		std::vector<Vec3> positions; ///< of the candidates, frame of A [m]
		bool coresMayOverlap = false;

		/// gap: between the cores along cache.axis [m]
		FeatureSearch(const ShapePair& p, const CandidateCache& c, double g, std::vector<FeatureId>& out)
		        : pair(p)
		        , cache(c)
		        , candidates(out)
		        , maxRotation(c.skin / c.regionRadius)
		        , gap(g)
		{
			assert(c.skin > 0 && c.regionRadius > 0 && isUnit(c.axis));
			candidates.clear();
			verticesA.reserve(p.a.core.vertices.size());
			for (const Vec3& v : p.a.core.vertices)
				verticesA.push_back({ p.toB<double>(v), motionBound<double>(v) });
			verticesB.reserve(p.b.core.vertices.size());
			for (const Vec3& v : p.b.core.vertices) {
				const Vec3 x = p.toA<double>(v);
				verticesB.push_back({ x, motionBound<double>(x) });
			}
		}
		void searchVertexFace()
		{
			const Polyhedron &a = pair.a.core, &b = pair.b.core;
			for (size_t v = 0; v < a.vertices.size(); ++v)
				for (size_t f = 0; f < b.faces.size(); ++f)
					testVertexFace({ FeatureKind::VertexFace, int(v), int(f) }, verticesA[v],
					        b.faces[f], pair.b.coreHalfThickness, a.vertices[v]);
			for (size_t f = 0; f < a.faces.size(); ++f)
				for (size_t v = 0; v < b.vertices.size(); ++v)
					testVertexFace({ FeatureKind::FaceVertex, int(f), int(v) }, verticesB[v],
					        a.faces[f], pair.a.coreHalfThickness, verticesB[v].position);
		}
		/// Edge-edge, and the extra kinds if they are on.
		void searchOtherKinds()
		{
			const Polyhedron &a = pair.a.core, &b = pair.b.core;
			edgesB.reserve(groupsOf(b.edges.size()));
			for (size_t first = 0; first < b.edges.size(); first += laneCount)
				edgesB.push_back(edgeBatch(first));
			for (size_t ea = 0; ea < a.edges.size(); ++ea) {
				const Lanes distance = distanceToB(a.edges[ea]), range = edgeRange(a.edges[ea]);
				for (const EdgeBatch& batch : edgesB)
					if (const auto inRange = distance + batch.depth <= range; any(inRange))
						testEdges(int(ea), batch, inRange);
			}
			if (pair.kinds.vertexEdge) searchExtraKinds();
		}

	private:
		const ShapePair& pair;
		const CandidateCache& cache;
		std::vector<FeatureId>& candidates;
		const double maxRotation; ///< within the margin [rad]
		const double gap; ///< between the cores along cache.axis [m]
		struct Vertex {
			Vec3 position; ///< in the frame of the other body [m]
			double motion; ///< motionBound() there [m]
		};
		std::vector<Vertex> verticesA, verticesB;
		/// laneCount edges of B, frame of A.
		struct EdgeBatch {
			size_t first; ///< index of the first
			Vec3s tail, direction, outward;
			Lanes length; ///< [m]
			/// Distance along the axis behind the vertex of B closest to A; infinite in unused lanes [m]
			Lanes depth;
		};
		std::vector<EdgeBatch> edgesB;

		/// Bound of the relative motion of a point (frame of A) within the margin. [m]
		template <class Number> Number motionBound(const Vec3Of<Number>& x) const
		{
			const Number distance = Vec3Of<Number>(x - broadcast<Number>(cache.centre)).norm()
			        / Number(cache.regionRadius);
			return Number(cache.skin) * max(Number(1.), distance);
		}

		EdgeBatch edgeBatch(size_t first) const
		{
			const std::vector<Edge>& edges = pair.b.core.edges;
			const size_t count = edges.size() - first;
			const Group<Lanes, const Edge> group(&edges[first], count);
			const auto tails = Group<Lanes, const Vec3>(count, [&](size_t i) {
				return &verticesB[edges[first + i].tail].position;
			}).vectors();
			EdgeBatch batch { first, tails, broadcast<Lanes>(pair.rotation) * group.get(&Edge::direction),
				broadcast<Lanes>(pair.rotation) * group.get(&Edge::outward), group.get(&Edge::length),
				std::numeric_limits<double>::infinity() };
			for (size_t i = 0; i < laneCount && i < count; ++i)
				setLane(batch.depth, i,
				        std::min(depthInB(edges[first + i].tail), depthInB(edges[first + i].head)));
			return batch;
		}
		double depthInB(int vertex) const
		{
			return verticesB[vertex].position.dot(cache.axis) - (cache.supportA + gap);
		}
		/// Distance along the axis between an edge of A and the vertex of B closest to A. [m]
		double distanceToB(const Edge& ea) const
		{
			const std::vector<Vec3>& v = pair.a.core.vertices;
			return cache.supportA + gap - std::max(v[ea.tail].dot(cache.axis), v[ea.head].dot(cache.axis));
		}
		/// Largest distance or depth of crossing edges in contact. [m]
		double reach() const { return std::max(pair.contactDistance(), pair.depthLimit()); }
		/// Distance within which an edge of B can be in contact with an edge of A within the margin, for nearly
		/// parallel edges. [m]
		double edgeRange(const Edge& ea) const
		{
			return reach() * (1 + maxRotation)
			        + std::max(verticesA[ea.tail].motion, verticesA[ea.head].motion);
		}

		/// position: of the candidate, frame of A [m]
		void add(FeatureId id, const Vec3& position, bool mayOverlap)
		{
			candidates.push_back(id);
			positions.push_back(position);
			coresMayOverlap = coresMayOverlap || mayOverlap;
		}

		void testVertexFace(FeatureId id, const Vertex& x, const Face& face, double depth, const Vec3& position)
		{
			const double distance = signedDistance<double>(face.plane, x.position);
			if (distance <= pair.contactDistance() + x.motion && distance >= -depth - x.motion
			        && projectsOntoFace<double>(face, x.position, flushTolerance + x.motion))
				add(id, position, distance <= x.motion);
		}

		/// An edge of A against the edges of a batch that are in range along the axis.
		void testEdges(int edgeA, const EdgeBatch& b, Lanes::Mask inRange)
		{
			const Edge& ea = pair.a.core.edges[edgeA];
			const Vec3s tail = broadcast<Lanes>(pair.a.core.vertices[ea.tail]),
			            direction = broadcast<Lanes>(ea.direction);
			const Lanes lengthA = ea.length;
			const Crossing<Lanes> c = crossing<Lanes>(tail, direction, b.tail, b.direction);
			const auto nearlyParallel = c.sine < Lanes(crossingSine);
			const Vec3s position = tail + c.alongA * direction;
			const Lanes motion = motionBound<Lanes>(position), range = Lanes(reach()) + motion;
			// Shift of the crossing along the edges
			const Lanes slack = Lanes(3.) * (motion + range * Lanes(maxRotation)) / c.sine;
			const auto inside = [&](Lanes at, Lanes length) {
				return logicalAnd(at >= -slack, at <= length + slack);
			};
			const Lanes height = c.normal.dot(Vec3s(b.tail - tail)), distance = max(height, -height);
			const auto mayFace = c.normal.dot(broadcast<Lanes>(ea.outward)) * c.normal.dot(b.outward)
			        <= Lanes(3 * maxRotation) / c.sine;
			const auto mayCross
			        = logicalAnd(logicalAnd(inside(c.alongA, lengthA), inside(c.alongB, b.length)),
			                logicalAnd(distance <= range, mayFace));
			for (size_t i = 0; i < laneCount; ++i) {
				if (!lane(inRange, i)) continue;
				const int edgeB = int(b.first + i);
				const FeatureId id(FeatureKind::EdgeEdge, edgeA, edgeB);
				if (lane(nearlyParallel, i))
					testParallelEdges(id, ea, pair.b.core.edges[edgeB], lane(c.sine, i));
				else if (lane(mayCross, i))
					add(id, lane(position, i), lane(distance, i) <= lane(motion, i));
			}
		}
		/// Nearly parallel edges: the distance of the segments decides.
		void testParallelEdges(FeatureId id, const Edge& ea, const Edge& eb, double sine)
		{
			if (sine + maxRotation < pair.crossingLimit()) return;
			const Vec3 &tailA = pair.a.core.vertices[ea.tail], &headA = pair.a.core.vertices[ea.head];
			const Vertex &tailB = verticesB[eb.tail], &headB = verticesB[eb.head];
			const double motion = std::min(std::max(verticesA[ea.tail].motion, verticesA[ea.head].motion),
			        std::max(tailB.motion, headB.motion));
			const double range = reach() * (1 + maxRotation) + motion;
			const double distance = segmentDistance(
			        tailA, headA - tailA, tailB.position, headB.position - tailB.position);
			const Vec3 position = ea.length < eb.length ? Vec3((tailA + headA) / 2)
			                                            : Vec3((tailB.position + headB.position) / 2);
			if (distance <= range) add(id, position, distance <= motion);
		}

		/// ContactKinds::vertexEdge.
		void searchExtraKinds()
		{
			const Polyhedron &a = pair.a.core, &b = pair.b.core;
			for (size_t v = 0; v < a.vertices.size(); ++v)
				for (size_t e = 0; e < b.edges.size(); ++e)
					testVertexEdge({ FeatureKind::VertexEdge, int(v), int(e) },
					        verticesA[v].position, b, b.edges[e], a.vertices[v]);
			for (size_t e = 0; e < a.edges.size(); ++e)
				for (size_t v = 0; v < b.vertices.size(); ++v)
					testVertexEdge({ FeatureKind::EdgeVertex, int(e), int(v) },
					        verticesB[v].position, a, a.edges[e], verticesB[v].position);
			for (size_t v = 0; v < a.vertices.size(); ++v)
				for (size_t w = 0; w < verticesB.size(); ++w)
					testDistance({ FeatureKind::VertexVertex, int(v), int(w) },
					        (verticesB[w].position - a.vertices[v]).norm(), a.vertices[v]);
		}
		/// x: vertex in the frame of the edge's body [m]
		void testVertexEdge(
		        FeatureId id, const Vec3& x, const Polyhedron& body, const Edge& edge, const Vec3& position)
		{
			const Vec3 fromTail = x - body.vertices[edge.tail];
			testDistance(id,
			        (fromTail - std::clamp(fromTail.dot(edge.direction), 0., edge.length) * edge.direction)
			                .norm(),
			        position);
		}
		void testDistance(FeatureId id, double distance, const Vec3& position)
		{
			const double motion = motionBound<double>(position);
			if (distance <= pair.contactDistance() + motion + flushTolerance)
				add(id, position, distance <= motion);
		}
	};

	/// For step 2: the region is that of the smaller body; contact beyond its bounding sphere is impossible.
	void centreOnSmallerBody(const ShapePair& pair, CandidateCache& cache)
	{
		cache.centre = pair.b.boundingRadius <= pair.a.boundingRadius ? pair.translation : Vec3(Vec3::Zero());
		cache.regionRadius = std::max(minRegionSkins * cache.skin,
		        std::min(pair.a.boundingRadius, pair.b.boundingRadius) + pair.contactDistance()
		                + 2 * cache.skin);
	}

	/// Step 3.
	void centreOn(const std::vector<Vec3>& positions, double contactDistance, CandidateCache& cache)
	{
		assert(!positions.empty());
		cache.centre.setZero();
		for (const Vec3& x : positions)
			cache.centre += x / double(positions.size());
		cache.regionRadius = minRegionSkins * cache.skin;
		for (const Vec3& x : positions)
			cache.regionRadius = std::max(cache.regionRadius, (x - cache.centre).norm() + contactDistance);
	}

} // namespace

void searchCandidates(const ShapePair& pair, double skin, CandidateCache& cache)
{
	assert(skin > 0);
	cache.skin = skin;
	cache.updates = 0;
	cache.lastMotion = 0;
	const double gap = coreGap(pair.a.core, pair.b.core, pair.rotation, pair.translation, cache.axis, skin); // 1.
	cache.supportA = projectionInterval(pair.a.core, cache.axis).max;
	cache.candidates.clear();
	cache.rotation = pair.rotation;
	// The skin covers the reach of a flush support beyond a border
	cache.margin = std::max(skin, gap - pair.contactDistance() - skin);
	cache.coresMayOverlap = gap <= skin;
	centreOnSmallerBody(pair, cache);
	if (gap < pair.contactDistance() + 2 * skin) {
		FeatureSearch rough(pair, cache, gap, cache.candidates); // 2.
		rough.searchVertexFace();
		if (rough.positions.empty()) rough.searchOtherKinds();
		if (!rough.positions.empty()) {
			centreOn(rough.positions, pair.contactDistance(), cache); // 3.
			FeatureSearch search(pair, cache, gap, cache.candidates); // 4.
			search.searchVertexFace();
			search.searchOtherKinds();
			cache.coresMayOverlap = search.coresMayOverlap || cache.coresMayOverlap;
		}
	}
	cache.centreB = pair.toB<double>(cache.centre);
}

} // namespace timber
