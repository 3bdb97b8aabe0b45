// SPDX-License-Identifier: GPL-2.0-or-later
#include "manifold.hpp"
#include "candidates.hpp"
#include "geometry.hpp"
#include <algorithm>
#include <cmath>

namespace timber {
namespace {

	/// What two features make of each other: distance of the cores along the normal, in one frame.
	struct Meet {
		Vec3 pointA, pointB; ///< on the cores
		Vec3 normal; ///< unit, from A to B
		double distance; ///< of the cores along the normal, negative when they overlap [m]
	};

	/// Vertices x against a face, both in the face's frame. Cores apart: the foot must lie in the face, or over its border
	/// but nearer to the border than to the face (else the face behind the border answers, too). Cores overlapping: only
	/// the face that looks along the axis of least overlap answers, so that all points push the pair apart.
	template <class Number> auto verticesOnFace(const Pair& pair, const RoundedPolyhedron& body, int facing, int face, const Vec3Of<Number>& x, Number& distance)
	{
		const Face& f = body.core.faces[face];
		const Number border = pair.borderLimit(), none = 0.;
		distance = height(f.plane, x);
		auto on = both(distance < Number(pair.touch()), distance > Number(-(pair.deep() ? body.coreHalfThickness : flushTolerance)));
		if (!any(on)) return on;
		on = both(on, isOverFace(f, x, pair.deep() ? border : least(border, distance)));
		if (!pair.deep()) return on;
		return face == facing ? both(on, either(distance >= none, isInside(body.core, face, x, border))) : none < none;
	}

	/// The crossing must lie inside both edges, farther from their ends than the border rule reaches.
	bool meetEdgeEdge(const Pair& pair, int edgeA, int edgeB, Meet& meet)
	{
		const Edge &ea = pair.a.core.edges[edgeA], &eb = pair.b.core.edges[edgeB];
		const Vec3& tailA = pair.a.core.vertices[ea.tail];
		const Vec3 tailB = pair.toA<double>(pair.b.core.vertices[eb.tail]), alongB = pair.rotation * eb.along;
		Crossing c = crossing(tailA, ea.along, tailB, alongB);
		if (c.sine < parallelSine) return false;
		const double end = flushTolerance / c.sine;
		if (c.alongA <= end || c.alongA >= ea.length - end || c.alongB <= end || c.alongB >= eb.length - end) return false;
		if (c.across.dot(ea.outward) < 0) c.across = -c.across;
		if (c.across.dot(pair.rotation * eb.outward) >= 0) return false; // B's edge is on the far side of B
		meet.pointA = tailA + c.alongA * ea.along;
		meet.pointB = tailB + c.alongB * alongB;
		meet.normal = c.across;
		meet.distance = c.across.dot(meet.pointB - meet.pointA);
		return meet.distance < pair.touch() && meet.distance > -(pair.deep() ? pair.depthLimit() : flushTolerance);
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

	bool finish(Meet& meet)
	{
		const Vec3 way = meet.pointB - meet.pointA;
		meet.distance = way.norm();
		meet.normal = way / meet.distance;
		return true;
	}

	bool meetVertexEdge(const Pair& pair, int vertex, int edge, Meet& meet)
	{
		const Vec3& x = pair.a.core.vertices[vertex];
		Vec3 foot;
		if (!vertexOnEdge(pair, pair.a.core, pair.rotation.transpose(), vertex, pair.b.core, pair.b.core.edges[edge], pair.toB<double>(x), foot)) return false;
		meet.pointA = x;
		meet.pointB = pair.toA<double>(foot);
		return finish(meet);
	}

	bool meetEdgeVertex(const Pair& pair, int edge, int vertex, Meet& meet)
	{
		meet.pointB = pair.toA<double>(pair.b.core.vertices[vertex]);
		return vertexOnEdge(pair, pair.b.core, pair.rotation, vertex, pair.a.core, pair.a.core.edges[edge], meet.pointB, meet.pointA) && finish(meet);
	}

	bool meetVertexVertex(const Pair& pair, int vertexA, int vertexB, Meet& meet)
	{
		meet.pointA = pair.a.core.vertices[vertexA];
		meet.pointB = pair.toA<double>(pair.b.core.vertices[vertexB]);
		const Vec3 way = meet.pointB - meet.pointA;
		const double distance = way.norm();
		if (distance >= pair.touch() || distance <= flushTolerance) return false;
		const double beyond = -flushTolerance / distance; // strictly beyond the ends of all edges: they do not answer
		return isExtreme(pair.a.core, vertexA, way / distance, beyond) && isExtreme(pair.b.core, vertexB, pair.rotation.transpose() * -way / distance, beyond) && finish(meet);
	}

	bool meetFeatures(const Pair& pair, FeatureId id, Meet& meet)
	{
		switch (id.meeting()) {
			case Meeting::EdgeEdge: return meetEdgeEdge(pair, id.a(), id.b(), meet);
			case Meeting::VertexEdge: return meetVertexEdge(pair, id.a(), id.b(), meet);
			case Meeting::EdgeVertex: return meetEdgeVertex(pair, id.a(), id.b(), meet);
			case Meeting::VertexVertex: return meetVertexVertex(pair, id.a(), id.b(), meet);
			default: return false;
		}
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
	Meet meetCores(const Pair& pair)
	{
		const Vec3 half = pair.gap / 2 * pair.axis;
		Vec3 middle = commonMiddle(pair, pair.axis) * pair.axis;
		for (const Vec3& across : { Vec3(pair.axis.unitOrthogonal()), Vec3(pair.rotation * (pair.rotation.transpose() * pair.axis).unitOrthogonal()) })
			for (const Vec3& direction : { across, Vec3(pair.axis.cross(across)) }) // the mean over both bodies' frames: swapping them changes nothing
				middle += 0.5 * commonMiddle(pair, direction) * direction;
		return { middle - half, middle + half, pair.axis, pair.gap };
	}

	/// Middle of the overlap in the world, from the point on core A.
	template <class Number> Vec3Of<Number> placeOf(const Pair& pair, const Mat3& turnA, const Vec3& originA, const Vec3Of<Number>& onA, const Vec3Of<Number>& normal, Number overlap)
	{
		const Vec3Of<Number> middle = onA + (Number(pair.a.radius) - overlap / Number(2.)) * normal;
		return wide<Number>(originA) + wide<Number>(turnA) * middle;
	}

	ContactPoint worldPoint(const Pair& pair, const Mat3& turnA, const Vec3& originA, FeatureId id, const Meet& meet)
	{
		const double overlap = pair.touch() - meet.distance;
		return { id, placeOf<double>(pair, turnA, originA, meet.pointA, meet.normal, overlap), turnA * meet.normal, overlap };
	}

	/// Vertices on each other, or over each other's borders, are one contact although several features name it.
	/// Crossings are never repeated: they keep their distance from vertices (meetEdgeEdge).
	bool isRepeated(const std::vector<ContactPoint>& points, const ContactPoint& next)
	{
		const Meeting meeting = next.id.meeting();
		if (meeting == Meeting::VertexFace || meeting == Meeting::EdgeEdge) return false;
		const bool onEdge = meeting == Meeting::VertexEdge || meeting == Meeting::EdgeVertex;
		return std::any_of(points.begin(), points.end(), [&](const ContactPoint& p) {
			if (onEdge ? p.id.meeting() == Meeting::EdgeEdge : p.id.meeting() != Meeting::VertexFace) return false;
			return (p.position - next.position).squaredNorm() < 4 * flushTolerance * flushTolerance && p.normal.dot(next.normal) > 0.9;
		});
	}

	void add(std::vector<ContactPoint>& points, const ContactPoint& next)
	{
		if (!isRepeated(points, next)) points.push_back(next);
	}

	/// The face of a candidate of a vertex and a face, if it is one.
	int faceOf(FeatureId id) { return id.meeting() == Meeting::VertexFace ? id.b() : id.meeting() == Meeting::FaceVertex ? id.a() : -1; }

	/// How many candidates from `first` on are vertices of one body against the same face of the other, as far as there are lanes.
	size_t countOnFace(const FeatureId* first, const FeatureId* end)
	{
		const auto other = [&](FeatureId id) { return id.meeting() != first->meeting() || faceOf(id) != faceOf(*first); };
		return size_t(std::find_if(first, std::min(end, first + laneCount), other) - first);
	}

	/// Contacts of up to laneCount vertices of one body with the same face of the other.
	template <class Number> void meetFace(const Pair& pair, const Mat3& turnA, const Vec3& originA, const FeatureId* first, size_t count, std::vector<ContactPoint>& points)
	{
		const bool ofB = first->meeting() == Meeting::VertexFace;
		const RoundedPolyhedron &body = ofB ? pair.b : pair.a, &other = ofB ? pair.a : pair.b;
		const int face = faceOf(*first);
		const Vec3& outward = body.core.faces[face].plane.normal;
		const Vec3 normal = ofB ? Vec3(-(pair.rotation * outward)) : outward;
		if (pair.deep() && normal.dot(pair.axis) < outwardCosine) return;

		using Vec = Vec3Of<Number>;
		const Vec own = Group<Number, const Vec3>(count, [&](size_t i) { return &other.core.vertices[ofB ? first[i].a() : first[i].b()]; }).vectors();
		const Vec inA = ofB ? own : pair.toA<Number>(own);
		Number distance;
		const auto on = verticesOnFace<Number>(pair, body, ofB ? pair.facingB : pair.facingA, face, ofB ? pair.toB<Number>(own) : inA, distance);
		if (!any(on)) return;
		const Vec across = wide<Number>(normal), onA = ofB ? inA : Vec(inA - distance * across);
		const Number overlap = Number(pair.touch()) - distance;
		const Vec place = placeOf<Number>(pair, turnA, originA, onA, across, overlap);
		const Vec3 worldNormal = turnA * normal;
		for (size_t i = 0; i < count; ++i)
			if (lane(on, i)) add(points, { first[i], lane(place, i), worldNormal, lane(overlap, i) });
	}

	/// Gap between the bodies on the axis on which the cores were apart at the last search: if it is there, the pair does not
	/// touch, the usual case of one that has parted a little. Any axis may say so. A flush support reaches beyond a border, at a
	/// corner by sqrt(2) times its tolerance. [m]
	double knownGap(const Pair& pair, const CandidateCache& cache)
	{
		if (!cache.searched()) return 0;
		const double nearB = extent(pair.b.core, pair.rotation.transpose() * cache.axis).first + pair.translation.dot(cache.axis);
		return std::max(0., nearB - cache.farA - pair.touch() - 2 * flushTolerance);
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
	const bool touched = !points.empty();
	points.clear();
	const Mat3 turnA = poseA.orientation.toRotationMatrix();
	Pair pair { a, b, turnA.transpose() * poseB.orientation.toRotationMatrix(), turnA.transpose() * (poseB.position - poseA.position), patterns };
	if (const double gap = touched ? 0 : knownGap(pair, cache); gap > 0) return gap; // what has touched will most likely touch
	if (!cache.holds(pair.rotation, pair.translation)) searchCandidates(pair, cache);
	if (cache.coresMayMeet) lookForOverlap(pair);

	Meet meet;
	const FeatureId* const end = cache.candidates.data() + cache.candidates.size();
	for (const FeatureId* next = cache.candidates.data(); next != end;) {
		if (faceOf(*next) >= 0) {
			const size_t count = countOnFace(next, end);
			count == 1 ? meetFace<double>(pair, turnA, poseA.position, next, count, points) : meetFace<Lanes>(pair, turnA, poseA.position, next, count, points);
			next += count;
			continue;
		}
		const FeatureId id = *next++;
		if (!meetFeatures(pair, id, meet)) continue;
		if (pair.deep() && meet.normal.dot(pair.axis) < outwardCosine) continue;
		add(points, worldPoint(pair, turnA, poseA.position, id, meet));
	}
	if (points.empty() && pair.deep()) points.push_back(worldPoint(pair, turnA, poseA.position, { Meeting::CoreCore, 0, 0 }, meetCores(pair)));
	return 0;
}

} // namespace timber
