// SPDX-License-Identifier: GPL-2.0-or-later
#include "candidates.hpp"
#include "geometry.hpp"

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
			for (const Vec3& v : p.a.core.vertices)
				verticesA.push_back({ p.toB<double>(v), motionAt(v) });
			for (const Vec3& v : p.b.core.vertices) {
				const Vec3 x = p.toA<double>(v);
				verticesB.push_back({ x, motionAt(x) });
			}
			for (const Edge& e : p.b.core.edges)
				edgesB.push_back({ p.rotation * e.along, p.rotation * e.outward, std::min(behindB(e.tail), behindB(e.head)) });
		}
		void faces()
		{
			const Polyhedron &a = pair.a.core, &b = pair.b.core;
			for (size_t v = 0; v < a.vertices.size(); ++v)
				for (size_t f = 0; f < b.faces.size(); ++f)
					vertexFace({ Meeting::VertexFace, int(v), int(f) }, verticesA[v], b.faces[f], pair.b.coreHalfThickness, a.vertices[v]);
			for (size_t f = 0; f < a.faces.size(); ++f)
				for (size_t v = 0; v < b.vertices.size(); ++v)
					vertexFace({ Meeting::FaceVertex, int(f), int(v) }, verticesB[v], a.faces[f], pair.a.coreHalfThickness, verticesB[v].place);
		}
		void othersThanFaces()
		{
			const Polyhedron &a = pair.a.core, &b = pair.b.core;
			for (size_t ea = 0; ea < a.edges.size(); ++ea) {
				const double nearest = nearestAlongAxis(a.edges[ea]), reach = reachOf(a.edges[ea]);
				for (size_t eb = 0; eb < b.edges.size(); ++eb)
					if (nearest + edgesB[eb].behind <= reach) edgeEdge({ Meeting::EdgeEdge, int(ea), int(eb) }, a.edges[ea], b.edges[eb], edgesB[eb]);
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
		struct Turned {
			Vec3 along, outward; ///< frame of A
			double behind; ///< how far the edge lies behind what of B is nearest to A along the axis [m]
		};
		std::vector<Turned> edgesB;

		/// Bound of the relative motion near x (frame of A) while the cache holds. [m]
		double motionAt(const Vec3& x) const { return cache.skin * std::max(1., (x - cache.centre).norm() / cache.region); }

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

		void edgeEdge(FeatureId id, const Edge& ea, const Edge& eb, const Turned& turnedB)
		{
			const Vec3 &tailA = pair.a.core.vertices[ea.tail], &tailB = verticesB[eb.tail].place;
			const Crossing<double> c = crossing<double>(tailA, ea.along, tailB, turnedB.along);
			if (c.sine < steadySine) return nearlyParallel(id, ea, eb, c.sine);
			const Vec3 place = tailA + c.alongA * ea.along;
			const double motion = motionAt(place), range = std::max(pair.touch(), pair.depthLimit()) + motion;
			const double slack = 3 * (motion + range * turn) / c.sine;
			if (c.alongA < -slack || c.alongA > ea.length + slack || c.alongB < -slack || c.alongB > eb.length + slack) return;
			const double distance = std::abs(c.across.dot(tailB - tailA));
			const bool mayFace = c.across.dot(ea.outward) * c.across.dot(turnedB.outward) <= 3 * turn / c.sine;
			if (distance <= range && mayFace) add(id, place, distance <= motion);
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
					vertexEdge({ Meeting::VertexEdge, int(v), int(e) }, verticesA[v].place, b, b.edges[e], a.vertices[v]);
			for (size_t e = 0; e < a.edges.size(); ++e)
				for (size_t v = 0; v < b.vertices.size(); ++v)
					vertexEdge({ Meeting::EdgeVertex, int(e), int(v) }, verticesB[v].place, a, a.edges[e], verticesB[v].place);
			for (size_t v = 0; v < a.vertices.size(); ++v)
				for (size_t w = 0; w < verticesB.size(); ++w)
					within({ Meeting::VertexVertex, int(v), int(w) }, (verticesB[w].place - a.vertices[v]).norm(), a.vertices[v]);
		}
		void vertexEdge(FeatureId id, const Vec3& x, const Polyhedron& body, const Edge& edge, const Vec3& place)
		{
			const Vec3 way = x - body.vertices[edge.tail];
			within(id, (way - std::clamp(way.dot(edge.along), 0., edge.length) * edge.along).norm(), place);
		}
		void within(FeatureId id, double distance, const Vec3& place)
		{
			const double motion = motionAt(place);
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
