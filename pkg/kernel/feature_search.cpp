// SPDX-License-Identifier: GPL-2.0-or-later
#include "feature_search.hpp"
#include "geometry.hpp"
#include <limits>

namespace timber {
namespace {

	/// Feature pairs that can touch before the cache no longer holds. Its centre, region and margin are given.
	class Search {
	public:
		std::vector<Vec3> places; ///< of the candidates, frame of A
		bool coresMayMeet = false;

		/// gap: of the cores along cache.axis [m]
		Search(const Pair& p, const CandidateCache& c, double g, std::vector<FeatureId>& o)
		        : pair(p)
		        , cache(c)
		        , out(o)
		        , turn(c.skin / c.region)
		        , gap(g)
		{
			out.clear();
			verticesA.reserve(p.a.core.vertices.size());
			for (const Vec3& v : p.a.core.vertices)
				verticesA.push_back({ p.toB<double>(v), motionAt<double>(v) });
			verticesB.reserve(p.b.core.vertices.size());
			for (const Vec3& v : p.b.core.vertices) {
				const Vec3 x = p.toA<double>(v);
				verticesB.push_back({ x, motionAt<double>(x) });
			}
		}
		void faces()
		{
			const Polyhedron &a = pair.a.core, &b = pair.b.core;
			for (size_t v = 0; v < a.vertices.size(); ++v)
				for (size_t f = 0; f < b.faces.size(); ++f)
					vertexFace({ FeatureKind::VertexFace, int(v), int(f) }, verticesA[v], b.faces[f], pair.b.coreHalfThickness, a.vertices[v]);
			for (size_t f = 0; f < a.faces.size(); ++f)
				for (size_t v = 0; v < b.vertices.size(); ++v)
					vertexFace({ FeatureKind::FaceVertex, int(f), int(v) }, verticesB[v], a.faces[f], pair.a.coreHalfThickness, verticesB[v].place);
		}
		void othersThanFaces()
		{
			const Polyhedron &a = pair.a.core, &b = pair.b.core;
			edgesB.reserve(groupsOf(b.edges.size()));
			for (size_t first = 0; first < b.edges.size(); first += laneCount)
				edgesB.push_back(placed(first));
			for (size_t ea = 0; ea < a.edges.size(); ++ea) {
				const Lanes nearest = nearestAlongAxis(a.edges[ea]), reach = reachOf(a.edges[ea]);
				for (const Edges& group : edgesB)
					if (const auto on = nearest + group.behind <= reach; any(on)) edgesMeet(int(ea), group, on);
			}
			if (pair.patterns.vertexEdge) ignoredPatterns();
		}

	private:
		const Pair& pair;
		const CandidateCache& cache;
		std::vector<FeatureId>& out;
		const double turn; ///< largest turn while the cache holds [rad]
		const double gap; ///< of the cores along cache.axis [m]
		struct Vertex {
			Vec3 place; ///< in the other's frame
			double motion; ///< motionAt() there [m]
		};
		std::vector<Vertex> verticesA, verticesB;
		/// laneCount edges of B, frame of A.
		struct Edges {
			size_t first; ///< their place among the edges of B
			Vec3s tail, along, outward;
			Lanes length;
			Lanes behind; ///< how far the edge lies behind what of B is nearest to A along the axis; infinite in lanes to spare [m]
		};
		std::vector<Edges> edgesB;

		/// Bound of the relative motion near x (frame of A) while the cache holds. [m]
		template <class Number> Number motionAt(const Vec3Of<Number>& x) const
		{
			const Number away = Vec3Of<Number>(x - broadcast<Number>(cache.centre)).norm() / Number(cache.region);
			return Number(cache.skin) * max(Number(1.), away);
		}

		Edges placed(size_t first) const
		{
			const std::vector<Edge>& edges = pair.b.core.edges;
			const size_t count = edges.size() - first;
			const Group<Lanes, const Edge> group(&edges[first], count);
			const auto tails = Group<Lanes, const Vec3>(count, [&](size_t i) { return &verticesB[edges[first + i].tail].place; }).vectors();
			Edges all { first, tails, broadcast<Lanes>(pair.rotation) * group.get(&Edge::along), broadcast<Lanes>(pair.rotation) * group.get(&Edge::outward), group.get(&Edge::length),
				std::numeric_limits<double>::infinity() };
			for (size_t i = 0; i < laneCount && i < count; ++i)
				setLane(all.behind, i, std::min(behindB(edges[first + i].tail), behindB(edges[first + i].head)));
			return all;
		}
		double behindB(int vertex) const { return verticesB[vertex].place.dot(cache.axis) - (cache.farA + gap); }
		/// Distance along the axis from the edge to what of B is nearest. [m]
		double nearestAlongAxis(const Edge& ea) const
		{
			const std::vector<Vec3>& v = pair.a.core.vertices;
			return cache.farA + gap - std::max(v[ea.tail].dot(cache.axis), v[ea.head].dot(cache.axis));
		}
		/// Distance within which an edge of B may meet this one while the cache holds; (1 + turn) as for nearly parallel edges. [m]
		double reachOf(const Edge& ea) const { return std::max(pair.touch(), pair.depthLimit()) * (1 + turn) + std::max(verticesA[ea.tail].motion, verticesA[ea.head].motion); }

		void add(FeatureId id, const Vec3& place, bool coresMeet)
		{
			out.push_back(id);
			places.push_back(place);
			coresMayMeet = coresMayMeet || coresMeet;
		}

		void vertexFace(FeatureId id, const Vertex& x, const Face& face, double depth, const Vec3& place)
		{
			const double h = height<double>(face.plane, x.place);
			if (h <= pair.touch() + x.motion && h >= -depth - x.motion && isOverFace<double>(face, x.place, flushTolerance + x.motion)) add(id, place, h <= x.motion);
		}

		/// An edge of A against edges of B, of which those that are `on` are near enough along the axis.
		void edgesMeet(int edgeA, const Edges& b, Lanes::Mask on)
		{
			const Edge& ea = pair.a.core.edges[edgeA];
			const Vec3s tail = broadcast<Lanes>(pair.a.core.vertices[ea.tail]), along = broadcast<Lanes>(ea.along);
			const Lanes lengthA = ea.length;
			const Crossing<Lanes> c = crossing<Lanes>(tail, along, b.tail, b.along);
			const auto parallel = c.sine < Lanes(steadySine);
			const Vec3s place = tail + c.alongA * along;
			const Lanes motion = motionAt<Lanes>(place), range = Lanes(std::max(pair.touch(), pair.depthLimit())) + motion;
			const Lanes slack = Lanes(3.) * (motion + range * Lanes(turn)) / c.sine;
			const auto inside = [&](Lanes at, Lanes length) { return logicalAnd(at >= -slack, at <= length + slack); };
			const Lanes height = c.across.dot(Vec3s(b.tail - tail)), distance = max(height, -height);
			const auto mayFace = c.across.dot(broadcast<Lanes>(ea.outward)) * c.across.dot(b.outward) <= Lanes(3 * turn) / c.sine;
			const auto meet = logicalAnd(logicalAnd(inside(c.alongA, lengthA), inside(c.alongB, b.length)), logicalAnd(distance <= range, mayFace));
			for (size_t i = 0; i < laneCount; ++i) {
				if (!lane(on, i)) continue;
				const int edgeB = int(b.first + i);
				const FeatureId id(FeatureKind::EdgeEdge, edgeA, edgeB);
				if (lane(parallel, i)) nearlyParallel(id, ea, pair.b.core.edges[edgeB], lane(c.sine, i));
				else if (lane(meet, i)) add(id, lane(place, i), lane(distance, i) <= lane(motion, i));
			}
		}
		void nearlyParallel(FeatureId id, const Edge& ea, const Edge& eb, double sine)
		{
			if (sine + turn < parallelSine) return;
			const Vec3 &tailA = pair.a.core.vertices[ea.tail], &headA = pair.a.core.vertices[ea.head];
			const Vertex &tailB = verticesB[eb.tail], &headB = verticesB[eb.head];
			const double motion = std::min(std::max(verticesA[ea.tail].motion, verticesA[ea.head].motion), std::max(tailB.motion, headB.motion));
			const double range = std::max(pair.touch(), pair.depthLimit()) * (1 + turn) + motion;
			const double distance = segmentDistance(tailA, headA - tailA, tailB.place, headB.place - tailB.place);
			const Vec3 place = ea.length < eb.length ? Vec3((tailA + headA) / 2) : Vec3((tailB.place + headB.place) / 2);
			if (distance <= range) add(id, place, distance <= motion);
		}

		void ignoredPatterns()
		{
			const Polyhedron &a = pair.a.core, &b = pair.b.core;
			for (size_t v = 0; v < a.vertices.size(); ++v)
				for (size_t e = 0; e < b.edges.size(); ++e)
					vertexEdge({ FeatureKind::VertexEdge, int(v), int(e) }, verticesA[v].place, b, b.edges[e], a.vertices[v]);
			for (size_t e = 0; e < a.edges.size(); ++e)
				for (size_t v = 0; v < b.vertices.size(); ++v)
					vertexEdge({ FeatureKind::EdgeVertex, int(e), int(v) }, verticesB[v].place, a, a.edges[e], verticesB[v].place);
			for (size_t v = 0; v < a.vertices.size(); ++v)
				for (size_t w = 0; w < verticesB.size(); ++w)
					within({ FeatureKind::VertexVertex, int(v), int(w) }, (verticesB[w].place - a.vertices[v]).norm(), a.vertices[v]);
		}
		void vertexEdge(FeatureId id, const Vec3& x, const Polyhedron& body, const Edge& edge, const Vec3& place)
		{
			const Vec3 way = x - body.vertices[edge.tail];
			within(id, (way - std::clamp(way.dot(edge.along), 0., edge.length) * edge.along).norm(), place);
		}
		void within(FeatureId id, double distance, const Vec3& place)
		{
			const double motion = motionAt<double>(place);
			if (distance <= pair.touch() + motion + flushTolerance) add(id, place, distance <= motion);
		}
	};

	/// Motion is judged at the smaller body: what happens beyond its reach does not matter.
	void centreOnSmallerBody(const Pair& pair, CandidateCache& cache)
	{
		cache.centre = pair.b.reach <= pair.a.reach ? pair.translation : Vec3(Vec3::Zero());
		cache.region = std::max(leastRegion * cache.skin, std::min(pair.a.reach, pair.b.reach) + pair.touch() + 2 * cache.skin);
	}

	/// Motion is judged where the features meet.
	void centreOn(const std::vector<Vec3>& places, double touch, CandidateCache& cache)
	{
		cache.centre.setZero();
		for (const Vec3& x : places)
			cache.centre += x / double(places.size());
		cache.region = leastRegion * cache.skin;
		for (const Vec3& x : places)
			cache.region = std::max(cache.region, (x - cache.centre).norm() + touch);
	}

} // namespace

/// A pair far apart needs no candidates until its gap has shrunk to the touching distance plus the skin, which also
/// covers what a flush support reaches beyond a border.
void searchCandidates(const Pair& pair, double skin, CandidateCache& cache)
{
	cache.skin = skin;
	cache.uses = 0;
	cache.motionThen = 0;
	const double gap = coreGap(pair.a.core, pair.b.core, pair.rotation, pair.translation, cache.axis, skin);
	cache.farA = extent(pair.a.core, cache.axis).second;
	cache.candidates.clear();
	cache.rotation = pair.rotation;
	cache.margin = std::max(skin, gap - pair.touch() - skin);
	cache.coresMayMeet = gap <= skin;
	centreOnSmallerBody(pair, cache);
	if (gap < pair.touch() + 2 * skin) {
		Search rough(pair, cache, gap, cache.candidates); // finds where the features meet; faces alone tell it, if any do
		rough.faces();
		if (rough.places.empty()) rough.othersThanFaces();
		if (!rough.places.empty()) {
			centreOn(rough.places, pair.touch(), cache);
			Search whole(pair, cache, gap, cache.candidates);
			whole.faces();
			whole.othersThanFaces();
			cache.coresMayMeet = whole.coresMayMeet || cache.coresMayMeet;
		}
	}
	cache.centreB = pair.toB<double>(cache.centre);
}

} // namespace timber
