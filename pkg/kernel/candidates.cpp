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

		Search(const Pair& p, const CandidateCache& c, std::vector<FeatureId>& o)
		        : pair(p)
		        , cache(c)
		        , out(o)
		        , turn(candidateSkin / c.region)
		{
			for (const Vec3& v : p.a.core.vertices)
				verticesA.push_back(p.toB(v));
			for (const Vec3& v : p.b.core.vertices)
				verticesB.push_back(p.toA(v));
			faces();
			edges();
			if (p.patterns.vertexEdge) ignoredPatterns();
		}

	private:
		const Pair& pair;
		const CandidateCache& cache;
		std::vector<FeatureId>& out;
		const double turn; ///< largest turn while the cache holds [rad]
		std::vector<Vec3> verticesA, verticesB; ///< each in the other's frame

		/// Bound of the relative motion near x (frame of A) while the cache holds. [m]
		double motionAt(const Vec3& x) const { return candidateSkin * std::max(1., (x - cache.centre).norm() / cache.region); }

		void add(FeatureId id, const Vec3& place, bool coresMeet)
		{
			out.push_back(id);
			places.push_back(place);
			coresMayMeet = coresMayMeet || coresMeet;
		}

		void faces()
		{
			const Polyhedron &a = pair.a.core, &b = pair.b.core;
			for (size_t v = 0; v < a.vertices.size(); ++v)
				for (size_t f = 0; f < b.faces.size(); ++f)
					vertexFace({ Meeting::VertexFace, int(v), int(f) }, verticesA[v], b.faces[f], pair.b.coreHalfThickness, a.vertices[v]);
			for (size_t f = 0; f < a.faces.size(); ++f)
				for (size_t v = 0; v < b.vertices.size(); ++v)
					vertexFace({ Meeting::FaceVertex, int(f), int(v) }, verticesB[v], a.faces[f], pair.a.coreHalfThickness, verticesB[v]);
		}
		void vertexFace(FeatureId id, const Vec3& x, const Face& face, double depth, const Vec3& place)
		{
			const double motion = motionAt(place), h = height(face.plane, x);
			if (h <= pair.touch() + motion && h >= -depth - motion && isOverFace(face, x, flushTolerance + motion)) add(id, place, h <= motion);
		}

		void edges()
		{
			const Polyhedron &a = pair.a.core, &b = pair.b.core;
			for (size_t ea = 0; ea < a.edges.size(); ++ea)
				for (size_t eb = 0; eb < b.edges.size(); ++eb)
					edgeEdge({ Meeting::EdgeEdge, int(ea), int(eb) }, a.edges[ea], b.edges[eb]);
		}
		void edgeEdge(FeatureId id, const Edge& ea, const Edge& eb)
		{
			const Vec3 &tailA = pair.a.core.vertices[ea.tail], &tailB = verticesB[eb.tail];
			const Vec3 alongB = pair.rotation * eb.along;
			const Crossing c = crossing(tailA, ea.along, tailB, alongB);
			if (c.sine < steadySine) return nearlyParallel(id, ea, tailA, eb, tailB, alongB, c.sine);
			const Vec3 place = tailA + c.alongA * ea.along;
			const double motion = motionAt(place), range = std::max(pair.touch(), pair.depthLimit()) + motion;
			const double slack = 3 * (motion + range * turn) / c.sine;
			if (c.alongA < -slack || c.alongA > ea.length + slack || c.alongB < -slack || c.alongB > eb.length + slack) return;
			const double distance = std::abs(c.across.dot(tailB - tailA));
			const bool mayFace = c.across.dot(ea.outward) * c.across.dot(pair.rotation * eb.outward) <= 3 * turn / c.sine;
			if (distance <= range && mayFace) add(id, place, distance <= motion);
		}
		void nearlyParallel(FeatureId id, const Edge& ea, const Vec3& tailA, const Edge& eb, const Vec3& tailB, const Vec3& alongB, double sine)
		{
			if (sine + turn < parallelSine) return;
			const Vec3 spanA = ea.length * ea.along, spanB = eb.length * alongB;
			const double motion = std::min(std::max(motionAt(tailA), motionAt(tailA + spanA)), std::max(motionAt(tailB), motionAt(tailB + spanB)));
			const double range = std::max(pair.touch(), pair.depthLimit()) * (1 + turn) + motion, distance = segmentDistance(tailA, spanA, tailB, spanB);
			const Vec3 place = ea.length < eb.length ? Vec3(tailA + spanA / 2) : Vec3(tailB + spanB / 2);
			if (distance <= range) add(id, place, distance <= motion);
		}

		void ignoredPatterns()
		{
			const Polyhedron &a = pair.a.core, &b = pair.b.core;
			for (size_t v = 0; v < a.vertices.size(); ++v)
				for (size_t e = 0; e < b.edges.size(); ++e)
					vertexEdge({ Meeting::VertexEdge, int(v), int(e) }, verticesA[v], b, b.edges[e], a.vertices[v]);
			for (size_t e = 0; e < a.edges.size(); ++e)
				for (size_t v = 0; v < b.vertices.size(); ++v)
					vertexEdge({ Meeting::EdgeVertex, int(e), int(v) }, verticesB[v], a, a.edges[e], verticesB[v]);
			for (size_t v = 0; v < a.vertices.size(); ++v)
				for (size_t w = 0; w < verticesB.size(); ++w)
					within({ Meeting::VertexVertex, int(v), int(w) }, (verticesB[w] - a.vertices[v]).norm(), a.vertices[v]);
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
		cache.region = std::max(leastRegion * candidateSkin, std::min(pair.a.reach, pair.b.reach) + pair.touch() + 2 * candidateSkin);
	}

	/// Motion is judged where the features meet.
	void centreOn(const std::vector<Vec3>& places, double touch, CandidateCache& cache)
	{
		cache.centre.setZero();
		for (const Vec3& x : places)
			cache.centre += x / double(places.size());
		cache.region = leastRegion * candidateSkin;
		for (const Vec3& x : places)
			cache.region = std::max(cache.region, (x - cache.centre).norm() + touch);
	}

} // namespace

/// A pair far apart needs no candidates until its gap has shrunk to the touching distance plus the skin, which also
/// covers what a flush support reaches beyond a border.
void searchCandidates(const Pair& pair, CandidateCache& cache)
{
	const double gap = coreGap(pair.a.core, pair.b.core, pair.rotation, pair.translation, cache.axis, candidateSkin);
	cache.farA = extent(pair.a.core, cache.axis).second;
	cache.candidates.clear();
	cache.rotation = pair.rotation;
	cache.margin = std::max(candidateSkin, gap - pair.touch() - candidateSkin);
	cache.coresMayMeet = gap <= candidateSkin;
	centreOnSmallerBody(pair, cache);
	if (gap < pair.touch() + 2 * candidateSkin) {
		const std::vector<Vec3> places = Search(pair, cache, cache.candidates).places;
		if (!places.empty()) {
			centreOn(places, pair.touch(), cache);
			cache.candidates.clear();
			cache.coresMayMeet = Search(pair, cache, cache.candidates).coresMayMeet || cache.coresMayMeet;
		}
	}
	cache.centreB = pair.toB(cache.centre);
}

} // namespace timber
