// SPDX-License-Identifier: GPL-2.0-or-later
#include "manifold.hpp"
#include "feature_search.hpp"
#include "geometry.hpp"
#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace timber {
namespace {

	/// What two features make of each other, in the frame of A.
	template <class Number> struct FeatureContact {
		Vec3Of<Number> onA; ///< point on core A
		Vec3Of<Number> normal; ///< unit, from A to B
		Number distance; ///< of the cores along the normal, negative when they overlap [m]
	};

	/// Contact points of a pair, as they are found.
	class Points {
		const Pair& pair;
		const Mat3& turnA;
		const Vec3& originA;
		std::vector<ContactPoint>& all;

		/// Vertices on each other, or over each other's borders, are one contact although several features name it.
		/// Crossings are never repeated: they keep their distance from vertices (crossingEdges).
		bool isRepeated(const ContactPoint& next) const
		{
			const FeatureKind meeting = next.id.kind();
			if (meeting == FeatureKind::VertexFace || meeting == FeatureKind::EdgeEdge) return false;
			const bool onEdge = meeting == FeatureKind::VertexEdge || meeting == FeatureKind::EdgeVertex;
			return std::any_of(all.begin(), all.end(), [&](const ContactPoint& p) {
				if (onEdge ? p.id.kind() == FeatureKind::EdgeEdge : p.id.kind() != FeatureKind::VertexFace) return false;
				return (p.position - next.position).squaredNorm() < 4 * flushTolerance * flushTolerance && p.normal.dot(next.normal) > 0.9;
			});
		}

	public:
		Points(const Pair& p, const Mat3& turn, const Vec3& origin, std::vector<ContactPoint>& points)
		        : pair(p)
		        , turnA(turn)
		        , originA(origin)
		        , all(points)
		{
		}
		/// Takes over, of the pairs of features named from `first` on, those that are `on`: in the middle of the overlap, in the world.
		template <class Number, class Condition> void add(const FeatureId* first, size_t count, Condition on, const FeatureContact<Number>& meet)
		{
			const Number overlap = Number(pair.touch()) - meet.distance;
			const Vec3Of<Number> middle = meet.onA + (Number(pair.a.radius) - overlap / Number(2.)) * meet.normal;
			const Vec3Of<Number> place = broadcast<Number>(originA) + broadcast<Number>(turnA) * middle, normal = broadcast<Number>(turnA) * meet.normal;
			for (size_t i = 0; i < count; ++i) {
				if (!lane(on, i)) continue;
				const ContactPoint next { first[i], lane(place, i), lane(normal, i), lane(overlap, i) };
				if (!isRepeated(next)) all.push_back(next);
			}
		}
	};

	/// Vertices x against a face, both in the face's frame. Cores apart: the foot must lie in the face, or over its border
	/// but nearer to the border than to the face (else the face behind the border answers, too). Cores overlapping: only
	/// the face that looks along the axis of least overlap answers, so that all points push the pair apart.
	template <class Number> auto verticesOnFace(const Pair& pair, const RoundedPolyhedron& body, int facing, int face, const Vec3Of<Number>& x, Number& distance)
	{
		const Face& f = body.core.faces[face];
		const Number border = pair.borderLimit(), none = 0.;
		distance = height(f.plane, x);
		auto on = logicalAnd(distance < Number(pair.touch()), distance > Number(-(pair.deep() ? body.coreHalfThickness : flushTolerance)));
		if (!any(on)) return on;
		on = logicalAnd(on, isOverFace(f, x, pair.deep() ? border : min(border, distance)));
		if (!pair.deep()) return on;
		return face == facing ? logicalAnd(on, logicalOr(distance >= none, isInside(body.core, face, x, border))) : none < none;
	}

	/// Up to laneCount vertices of one body against the same face of the other.
	template <class Number> auto verticesMeetFace(const Pair& pair, const FeatureId* first, size_t count, FeatureContact<Number>& meet)
	{
		using Vec = Vec3Of<Number>;
		const bool ofB = first->kind() == FeatureKind::VertexFace;
		const RoundedPolyhedron &body = ofB ? pair.b : pair.a, &other = ofB ? pair.a : pair.b;
		const int face = ofB ? first->b() : first->a();
		const Vec own = Group<Number, const Vec3>(count, [&](size_t i) { return &other.core.vertices[ofB ? first[i].a() : first[i].b()]; }).vectors();
		const Vec inA = ofB ? own : pair.toA<Number>(own);
		const auto on = verticesOnFace<Number>(pair, body, ofB ? pair.facingB : pair.facingA, face, ofB ? pair.toB<Number>(own) : inA, meet.distance);
		if (!any(on)) return on;
		const Vec3& outward = body.core.faces[face].plane.normal;
		meet.normal = broadcast<Number>(ofB ? Vec3(-(pair.rotation * outward)) : outward);
		meet.onA = ofB ? inA : Vec(inA - meet.distance * meet.normal);
		return on;
	}

	/// Up to laneCount edges of A, each against one of B. The crossing must lie inside both edges, farther from their ends than the border
	/// rule reaches.
	template <class Number> auto crossingEdges(const Pair& pair, const FeatureId* first, size_t count, FeatureContact<Number>& meet)
	{
		using Vec = Vec3Of<Number>;
		const Polyhedron &coreA = pair.a.core, &coreB = pair.b.core;
		const Number none = 0.;
		const auto edgeA = [&](size_t i) { return &coreA.edges[first[i].a()]; };
		const auto edgeB = [&](size_t i) { return &coreB.edges[first[i].b()]; };
		const Group<Number, const Edge> a(count, edgeA), b(count, edgeB);
		const Vec tailA = Group<Number, const Vec3>(count, [&](size_t i) { return &coreA.vertices[edgeA(i)->tail]; }).vectors();
		const Vec tailB = pair.toA<Number>(Group<Number, const Vec3>(count, [&](size_t i) { return &coreB.vertices[edgeB(i)->tail]; }).vectors());
		const Vec alongA = a.get(&Edge::along), alongB = broadcast<Number>(pair.rotation) * b.get(&Edge::along);
		const Crossing<Number> c = crossing<Number>(tailA, alongA, tailB, alongB);
		auto on = c.sine >= Number(parallelSine);
		if (!any(on)) return on;
		const Number end = Number(flushTolerance) / c.sine;
		on = logicalAnd(on, logicalAnd(logicalAnd(c.alongA > end, c.alongA < a.get(&Edge::length) - end), logicalAnd(c.alongB > end, c.alongB < b.get(&Edge::length) - end)));
		if (!any(on)) return on;
		meet.normal = select(c.across.dot(a.get(&Edge::outward)) < none, Vec(-c.across), c.across);
		on = logicalAnd(on, meet.normal.dot(Vec(broadcast<Number>(pair.rotation) * b.get(&Edge::outward))) < none); // else B's edge is on the far side of B
		meet.onA = tailA + c.alongA * alongA;
		meet.distance = meet.normal.dot(Vec(tailB + c.alongB * alongB - meet.onA));
		return logicalAnd(on, logicalAnd(meet.distance < Number(pair.touch()), meet.distance > Number(-(pair.deep() ? pair.depthLimit() : flushTolerance))));
	}

	/// A vertex is the nearest part of its body in direction `towards` (unit) if no edge from it leads that way.
	bool isExtreme(const Polyhedron& body, int vertex, const Vec3& towards, double slope)
	{
		for (const Edge& e : body.edges) {
			if (e.tail != vertex && e.head != vertex) continue;
			const double rise = e.along.dot(towards);
			if ((e.tail == vertex ? rise : -rise) > slope) return false;
		}
		return true;
	}

	/// Vertex x of `from` against an edge of `body`; `from`'s frame is turned by `turn` into the edge's frame.
	bool vertexOnEdge(const Pair& pair, const Polyhedron& from, const Mat3& turn, int vertex, const Polyhedron& body, const Edge& edge, const Vec3& x, Vec3& foot)
	{
		const Vec3& tail = body.vertices[edge.tail];
		const double along = (x - tail).dot(edge.along);
		if (along < -flushTolerance || along > edge.length + flushTolerance) return false;
		for (const int f : { edge.left, edge.right })
			if (isOverFace<double>(body.faces[f], x, pair.borderLimit())) return false; // the face answers
		foot = tail + along * edge.along;
		const Vec3 towards = foot - x;
		const double distance = towards.norm();
		if (distance >= pair.touch() || distance <= 0 || towards.dot(edge.outward) >= 0) return false;
		return isExtreme(from, vertex, turn.transpose() * towards / distance, flushTolerance / pair.touch());
	}

	/// From a point on core A to one on core B.
	bool meetBetween(const Vec3& onA, const Vec3& onB, FeatureContact<double>& meet)
	{
		const Vec3 way = onB - onA;
		meet.onA = onA;
		meet.distance = way.norm();
		meet.normal = way / meet.distance;
		return true;
	}

	bool vertexMeetsEdge(const Pair& pair, int vertex, int edge, FeatureContact<double>& meet)
	{
		const Vec3& x = pair.a.core.vertices[vertex];
		Vec3 foot;
		if (!vertexOnEdge(pair, pair.a.core, pair.rotation.transpose(), vertex, pair.b.core, pair.b.core.edges[edge], pair.toB<double>(x), foot)) return false;
		return meetBetween(x, pair.toA<double>(foot), meet);
	}

	bool edgeMeetsVertex(const Pair& pair, int edge, int vertex, FeatureContact<double>& meet)
	{
		const Vec3 x = pair.toA<double>(pair.b.core.vertices[vertex]);
		Vec3 foot;
		return vertexOnEdge(pair, pair.b.core, pair.rotation, vertex, pair.a.core, pair.a.core.edges[edge], x, foot) && meetBetween(foot, x, meet);
	}

	bool verticesMeet(const Pair& pair, int vertexA, int vertexB, FeatureContact<double>& meet)
	{
		const Vec3 &onA = pair.a.core.vertices[vertexA], onB = pair.toA<double>(pair.b.core.vertices[vertexB]);
		const Vec3 way = onB - onA;
		const double distance = way.norm();
		if (distance >= pair.touch() || distance <= flushTolerance) return false;
		const double beyond = -flushTolerance / distance; // strictly beyond the ends of all edges: they do not answer
		return isExtreme(pair.a.core, vertexA, way / distance, beyond) && isExtreme(pair.b.core, vertexB, pair.rotation.transpose() * -way / distance, beyond) && meetBetween(onA, onB, meet);
	}

	/// The patterns that the paper ignores.
	bool othersMeet(const Pair& pair, FeatureId id, FeatureContact<double>& meet)
	{
		switch (id.kind()) {
			case FeatureKind::VertexEdge: return vertexMeetsEdge(pair, id.a(), id.b(), meet);
			case FeatureKind::EdgeVertex: return edgeMeetsVertex(pair, id.a(), id.b(), meet);
			case FeatureKind::VertexVertex: return verticesMeet(pair, id.a(), id.b(), meet);
			default: return false;
		}
	}

	/// How many candidates from `first` on can be worked on together, as far as there are lanes: vertices against one face, or crossing edges.
	size_t countAlike(const FeatureId* first, const FeatureId* end)
	{
		const auto isAlike = [first](FeatureId id) {
			if (id.kind() != first->kind()) return false;
			switch (id.kind()) {
				case FeatureKind::VertexFace: return id.b() == first->b();
				case FeatureKind::FaceVertex: return id.a() == first->a();
				default: return id.kind() == FeatureKind::EdgeEdge;
			}
		};
		return size_t(std::find_if_not(first + 1, first + std::min<std::ptrdiff_t>(end - first, laneCount), isAlike) - first);
	}

	/// Points of `count` candidates that are alike.
	template <class Number> void meetAlike(const Pair& pair, const FeatureId* first, size_t count, Points& points)
	{
		FeatureContact<Number> meet;
		const auto take = [&](auto on) {
			if (!any(on)) return;
			if (pair.deep()) on = logicalAnd(on, meet.normal.dot(broadcast<Number>(pair.axis)) >= Number(outwardCosine));
			points.add(first, count, on, meet);
		};
		const FeatureKind meeting = first->kind();
		if (meeting == FeatureKind::EdgeEdge) take(crossingEdges(pair, first, count, meet));
		else if (meeting == FeatureKind::VertexFace || meeting == FeatureKind::FaceVertex) take(verticesMeetFace(pair, first, count, meet));
		else if constexpr (std::is_same_v<Number, double>) take(othersMeet(pair, *first, meet));
	}

	/// Middle of what two bodies have in common along a direction, from the origin of A. [m]
	double commonMiddle(const Pair& pair, const Vec3& direction)
	{
		const auto [leastA, mostA] = extent(pair.a.core, direction);
		const auto [leastB, mostB] = extent(pair.b.core, pair.rotation.transpose() * direction);
		const double shift = pair.translation.dot(direction);
		return (std::max(leastA, leastB + shift) + std::min(mostA, mostB + shift)) / 2;
	}

	/// Cores overlap and no pair of features answers (two plates through each other): one point in their common part,
	/// along the axis of least overlap.
	FeatureContact<double> meetCores(const Pair& pair)
	{
		const Vec3 half = pair.gap / 2 * pair.axis;
		Vec3 middle = commonMiddle(pair, pair.axis) * pair.axis;
		for (const Vec3& across : { Vec3(pair.axis.unitOrthogonal()), Vec3(pair.rotation * (pair.rotation.transpose() * pair.axis).unitOrthogonal()) })
			for (const Vec3& direction : { across, Vec3(pair.axis.cross(across)) }) // the mean over both bodies' frames: swapping them changes nothing
				middle += 0.5 * commonMiddle(pair, direction) * direction;
		return { middle - half, pair.axis, pair.gap };
	}

	/// Gap of the cores on the axis that the cache knows: if it is there, they are apart. Any axis may say so. [m]
	double gapAlongKnownAxis(const Pair& pair, const CandidateCache& cache)
	{
		if (!cache.searched()) return -std::numeric_limits<double>::infinity();
		return extent(pair.b.core, pair.rotation.transpose() * cache.axis).first + pair.translation.dot(cache.axis) - cache.farA;
	}

	/// What of the cores' gap is left to the bodies before points may exist. A flush support reaches beyond a border, at a
	/// corner by sqrt(2) times its tolerance. [m]
	double freeWay(const Pair& pair, double gap) { return std::max(0., gap - pair.touch() - 2 * flushTolerance); }

	/// The pair has no points: looks, now and then, for a face whose normal shows how far it is apart. Returns its freeWay(). [m]
	double seekAxis(const Pair& pair, CandidateCache& cache)
	{
		if (cache.uses % axisUses != axisUses / 2) return 0;
		Vec3 axis;
		const double gap = coreGap(pair.a.core, pair.b.core, pair.rotation, pair.translation, axis, -std::numeric_limits<double>::infinity());
		const double way = freeWay(pair, gap);
		if (way > 0) {
			cache.axis = axis;
			cache.farA = extent(pair.a.core, axis).second;
		}
		return way;
	}

	/// Candidates for the pair's placement: fewer where it is about as far from that of the search as quietSteps uses ago.
	void refresh(CandidateCache& cache, const Pair& pair)
	{
		const double motion = cache.searched() ? cache.motion(pair.rotation, pair.translation) : 0;
		if (!cache.searched() || !(motion <= cache.margin)) return searchCandidates(pair, candidateSkin, cache);
		if (++cache.uses % quietSteps != 0) return;
		const bool still = std::abs(motion - cache.motionThen) < quietSkin / 2;
		cache.motionThen = motion;
		if (still && cache.skin > quietSkin && !cache.candidates.empty()) searchCandidates(pair, quietSkin, cache);
	}

	void lookForOverlap(Pair& pair)
	{
		pair.gap = coreGap(pair.a.core, pair.b.core, pair.rotation, pair.translation, pair.axis, 0);
		if (!pair.deep()) return;
		pair.facingA = faceLooking(pair.a.core, pair.axis);
		pair.facingB = faceLooking(pair.b.core, pair.rotation.transpose() * -pair.axis);
	}

} // namespace

double updateManifold(const RoundedPolyhedron& a, const RoundedPolyhedron& b, const Pose& poseA, const Pose& poseB, const Patterns& patterns,
        CandidateCache& cache, std::vector<ContactPoint>& points)
{
	if (!cache.fits(a, b, patterns)) cache = CandidateCache(a, b, patterns);
	const bool touched = !points.empty();
	points.clear();
	const Mat3 turnA = poseA.orientation.toRotationMatrix();
	Pair pair { a, b, turnA.transpose() * poseB.orientation.toRotationMatrix(), turnA.transpose() * (poseB.position - poseA.position), patterns };
	if (const double way = touched ? 0 : freeWay(pair, gapAlongKnownAxis(pair, cache)); way > 0) return way; // what has touched will most likely touch
	refresh(cache, pair);
	if (cache.coresMayMeet && gapAlongKnownAxis(pair, cache) < flushTolerance) lookForOverlap(pair); // apart by far more than rounding: not deep

	Points found(pair, turnA, poseA.position, points);
	const FeatureId* const end = cache.candidates.data() + cache.candidates.size();
	for (const FeatureId* next = cache.candidates.data(); next != end;) {
		const size_t count = countAlike(next, end);
		count == 1 ? meetAlike<double>(pair, next, count, found) : meetAlike<Lanes>(pair, next, count, found);
		next += count;
	}
	const FeatureId cores { FeatureKind::CoreCore, 0, 0 };
	if (points.empty() && pair.deep()) found.add(&cores, 1, true, meetCores(pair));
	return points.empty() ? seekAxis(pair, cache) : 0;
}

} // namespace timber
