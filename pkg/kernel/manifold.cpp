// SPDX-License-Identifier: GPL-2.0-or-later
#include "manifold.hpp"
#include "constants.hpp"
#include "geometry.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

namespace timber {
namespace {

	/// One pair at one instant, all in the frame of A: x_A = rotation x_B + translation.
	struct Pair {
		const RoundedPolyhedron& a;
		const RoundedPolyhedron& b;
		Mat3 rotation;
		Vec3 translation;
		Patterns patterns;
		double gap = 0; ///< of the cores; < 0: they overlap (deep contact). Not looked up while they are surely apart. [m]
		Vec3 axis = Vec3::Zero(); ///< where the gap is found, unit, from A to B; only in deep contact
		int facingA = -1, facingB = -1; ///< the faces that look along the axis; only in deep contact

		bool deep() const { return gap < 0; }
		double touch() const { return a.radius + b.radius; }
		double depthLimit() const { return std::min(a.coreHalfThickness, b.coreHalfThickness); }
		Vec3 toB(const Vec3& x) const { return rotation.transpose() * (x - translation); }
		Vec3 toA(const Vec3& x) const { return rotation * x + translation; }
		/// Foot beyond a border by less than this still belongs to the face. [m]
		double borderLimit() const { return patterns.flushSupports ? flushTolerance : -flushTolerance; }
	};

	/// What two features make of each other: distance of the cores along the normal, in one frame.
	struct Meet {
		Vec3 pointA, pointB; ///< on the cores
		Vec3 normal; ///< unit, from A to B
		double distance; ///< of the cores along the normal, negative when they overlap [m]
	};

	/// Vertex x against a face, both in the face's frame. Cores apart: the foot must lie in the face, or over its border
	/// but nearer to the border than to the face (else the face behind the border answers, too). Cores overlapping: only
	/// the face that looks along the axis of least overlap answers, so that all points push the pair apart.
	bool vertexOnFace(const Pair& pair, const RoundedPolyhedron& body, int facing, int face, const Vec3& x, double& distance)
	{
		const Face& f = body.core.faces[face];
		distance = height(f, x);
		if (distance >= pair.touch() || distance <= -(pair.deep() ? body.coreHalfThickness : flushTolerance)) return false;
		if (!isOverFace(body.core, f, x, pair.deep() ? pair.borderLimit() : std::min(pair.borderLimit(), distance))) return false;
		return !pair.deep() || (face == facing && (distance >= 0 || isInside(body.core, face, x, pair.borderLimit())));
	}

	bool meetVertexFace(const Pair& pair, int vertex, int face, Meet& meet)
	{
		const Vec3& x = pair.a.core.vertices[vertex];
		const Face& f = pair.b.core.faces[face];
		if (!vertexOnFace(pair, pair.b, pair.facingB, face, pair.toB(x), meet.distance)) return false;
		meet.normal = -(pair.rotation * f.plane.normal);
		meet.pointA = x;
		meet.pointB = x + meet.distance * meet.normal;
		return true;
	}

	bool meetFaceVertex(const Pair& pair, int face, int vertex, Meet& meet)
	{
		const Vec3 x = pair.toA(pair.b.core.vertices[vertex]);
		const Face& f = pair.a.core.faces[face];
		if (!vertexOnFace(pair, pair.a, pair.facingA, face, x, meet.distance)) return false;
		meet.normal = f.plane.normal;
		meet.pointB = x;
		meet.pointA = x - meet.distance * meet.normal;
		return true;
	}

	/// Two lines: sine of their angle, parameters of the closest points along the unit directions.
	struct Crossing {
		double sine, alongA, alongB;
		Vec3 across; ///< unit, perpendicular to both
	};
	Crossing cross(const Vec3& originA, const Vec3& alongA, const Vec3& originB, const Vec3& alongB)
	{
		Crossing c;
		const Vec3 n = alongA.cross(alongB);
		c.sine = n.norm();
		if (c.sine < parallelSine) return c;
		c.across = n / c.sine;
		const Vec3 w = originB - originA;
		const double square = c.sine * c.sine;
		c.alongA = w.cross(alongB).dot(n) / square;
		c.alongB = w.cross(alongA).dot(n) / square;
		return c;
	}

	/// The crossing must lie inside both edges, farther from their ends than the border rule reaches.
	bool meetEdgeEdge(const Pair& pair, int edgeA, int edgeB, Meet& meet)
	{
		const Edge &ea = pair.a.core.edges[edgeA], &eb = pair.b.core.edges[edgeB];
		const Vec3& tailA = pair.a.core.vertices[ea.tail];
		const Vec3 tailB = pair.toA(pair.b.core.vertices[eb.tail]);
		const Vec3 spanA = pair.a.core.vertices[ea.head] - tailA;
		const Vec3 spanB = pair.rotation * (pair.b.core.vertices[eb.head] - pair.b.core.vertices[eb.tail]);
		const double lengthA = spanA.norm(), lengthB = spanB.norm();
		Crossing c = cross(tailA, spanA / lengthA, tailB, spanB / lengthB);
		if (c.sine < parallelSine) return false;
		const double end = flushTolerance / c.sine;
		if (c.alongA <= end || c.alongA >= lengthA - end || c.alongB <= end || c.alongB >= lengthB - end) return false;
		if (c.across.dot(ea.outward) < 0) c.across = -c.across;
		if (c.across.dot(pair.rotation * eb.outward) >= 0) return false; // B's edge is on the far side of B
		meet.pointA = tailA + c.alongA / lengthA * spanA;
		meet.pointB = tailB + c.alongB / lengthB * spanB;
		meet.normal = c.across;
		meet.distance = c.across.dot(meet.pointB - meet.pointA);
		return meet.distance < pair.touch() && meet.distance > -(pair.deep() ? pair.depthLimit() : flushTolerance);
	}

	/// A vertex is the nearest part of its body in direction `towards` (unit) if no edge from it leads that way.
	bool isExtreme(const Polyhedron& body, int vertex, const Vec3& towards, double slope)
	{
		for (const Edge& e : body.edges) {
			if (e.tail != vertex && e.head != vertex) continue;
			const Vec3 along = body.vertices[e.tail == vertex ? e.head : e.tail] - body.vertices[vertex];
			if (along.dot(towards) > slope * along.norm()) return false;
		}
		return true;
	}

	/// Vertex x of `from` against an edge of `body`; `from`'s frame is turned by `turn` into the edge's frame.
	bool vertexOnEdge(const Pair& pair, const Polyhedron& from, const Mat3& turn, int vertex, const Polyhedron& body, const Edge& edge, const Vec3& x, Vec3& foot)
	{
		const Vec3& tail = body.vertices[edge.tail];
		const Vec3 span = body.vertices[edge.head] - tail;
		const double length = span.norm(), along = (x - tail).dot(span) / length;
		if (along < -flushTolerance || along > length + flushTolerance) return false;
		for (const int f : { edge.left, edge.right })
			if (isOverFace(body, body.faces[f], x, pair.borderLimit())) return false; // the face answers
		foot = tail + along / length * span;
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
		if (!vertexOnEdge(pair, pair.a.core, pair.rotation.transpose(), vertex, pair.b.core, pair.b.core.edges[edge], pair.toB(x), foot)) return false;
		meet.pointA = x;
		meet.pointB = pair.toA(foot);
		return finish(meet);
	}

	bool meetEdgeVertex(const Pair& pair, int edge, int vertex, Meet& meet)
	{
		meet.pointB = pair.toA(pair.b.core.vertices[vertex]);
		return vertexOnEdge(pair, pair.b.core, pair.rotation, vertex, pair.a.core, pair.a.core.edges[edge], meet.pointB, meet.pointA) && finish(meet);
	}

	bool meetVertexVertex(const Pair& pair, int vertexA, int vertexB, Meet& meet)
	{
		meet.pointA = pair.a.core.vertices[vertexA];
		meet.pointB = pair.toA(pair.b.core.vertices[vertexB]);
		const Vec3 way = meet.pointB - meet.pointA;
		const double distance = way.norm();
		if (distance >= pair.touch() || distance <= flushTolerance) return false;
		const double beyond = -flushTolerance / distance; // strictly beyond the ends of all edges: they do not answer
		return isExtreme(pair.a.core, vertexA, way / distance, beyond) && isExtreme(pair.b.core, vertexB, pair.rotation.transpose() * -way / distance, beyond) && finish(meet);
	}

	bool meetFeatures(const Pair& pair, FeatureId id, Meet& meet)
	{
		switch (id.meeting()) {
			case Meeting::VertexFace: return meetVertexFace(pair, id.a(), id.b(), meet);
			case Meeting::FaceVertex: return meetFaceVertex(pair, id.a(), id.b(), meet);
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

	ContactPoint worldPoint(const Pair& pair, const Pose& poseA, FeatureId id, const Meet& meet)
	{
		const double overlap = pair.touch() - meet.distance;
		const Vec3 middle = meet.pointA + (pair.a.radius - overlap / 2) * meet.normal;
		return { id, poseA.position + poseA.orientation * middle, poseA.orientation * meet.normal, overlap };
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

	/// Feature pairs that can touch before the pair has moved by the skin.
	class CandidateSearch {
	public:
		CandidateSearch(const Pair& p, std::vector<FeatureId>& o)
		        : pair(p)
		        , out(o)
		        , range(p.touch() + candidateSkin)
		{
			for (const Vec3& v : p.a.core.vertices)
				verticesA.push_back(p.toB(v));
			for (const Vec3& v : p.b.core.vertices)
				verticesB.push_back(p.toA(v));
		}
		void run()
		{
			facesAgainst(Meeting::VertexFace, verticesA, pair.b);
			facesAgainst(Meeting::FaceVertex, verticesB, pair.a);
			edges();
			if (!pair.patterns.vertexEdge) return;
			edgesAgainst(Meeting::VertexEdge, verticesA, pair.b.core);
			edgesAgainst(Meeting::EdgeVertex, verticesB, pair.a.core);
			vertices();
		}

	private:
		const Pair& pair;
		std::vector<FeatureId>& out;
		double range;
		std::vector<Vec3> verticesA, verticesB; ///< each in the other's frame

		void facesAgainst(Meeting meeting, const std::vector<Vec3>& points, const RoundedPolyhedron& body)
		{
			const bool vertexFirst = meeting == Meeting::VertexFace;
			const int outer = int(vertexFirst ? points.size() : body.core.faces.size()), inner = int(vertexFirst ? body.core.faces.size() : points.size());
			for (int a = 0; a < outer; ++a)
				for (int b = 0; b < inner; ++b) {
					const Face& face = body.core.faces[vertexFirst ? b : a];
					const Vec3& x = points[vertexFirst ? a : b];
					const double h = height(face, x);
					if (h > range || h < -(body.coreHalfThickness + candidateSkin)) continue;
					if (isOverFace(body.core, face, x, flushTolerance + candidateSkin)) out.push_back({ meeting, a, b });
				}
		}
		void edges()
		{
			const double near = std::max(range, pair.depthLimit() + candidateSkin);
			for (size_t a = 0; a < pair.a.core.edges.size(); ++a)
				for (size_t b = 0; b < pair.b.core.edges.size(); ++b) {
					const Edge &ea = pair.a.core.edges[a], &eb = pair.b.core.edges[b];
					const Vec3& tailA = pair.a.core.vertices[ea.tail];
					const Vec3& tailB = verticesB[eb.tail];
					const Vec3 spanA = pair.a.core.vertices[ea.head] - tailA, spanB = verticesB[eb.head] - tailB;
					if (segmentDistance(tailA, spanA, tailB, spanB) <= near && mayCross(ea, tailA, spanA, eb, tailB, spanB)) out.push_back({ Meeting::EdgeEdge, int(a), int(b) });
				}
		}
		/// Two near edges can only come to cross within the skin if they are not too parallel, cross near both spans and look
		/// towards each other. Half of the near pairs of flush members are none of it. Ill-conditioned crossings are kept.
		bool mayCross(const Edge& ea, const Vec3& tailA, const Vec3& spanA, const Edge& eb, const Vec3& tailB, const Vec3& spanB) const
		{
			const double lengthA = spanA.norm(), lengthB = spanB.norm(), turn = candidateSkin / std::min(pair.a.reach, pair.b.reach);
			const Crossing c = cross(tailA, spanA / lengthA, tailB, spanB / lengthB);
			if (c.sine < parallelSine) return c.sine + turn >= parallelSine;
			if (c.sine < 0.1) return true;
			const double slack = 3 * (candidateSkin + pair.touch() * turn) / c.sine;
			if (c.alongA < -slack || c.alongA > lengthA + slack || c.alongB < -slack || c.alongB > lengthB + slack) return false;
			return c.across.dot(ea.outward) * c.across.dot(pair.rotation * eb.outward) <= 3 * turn / c.sine;
		}
		void edgesAgainst(Meeting meeting, const std::vector<Vec3>& points, const Polyhedron& body)
		{
			const bool vertexFirst = meeting == Meeting::VertexEdge;
			const int outer = int(vertexFirst ? points.size() : body.edges.size()), inner = int(vertexFirst ? body.edges.size() : points.size());
			for (int a = 0; a < outer; ++a)
				for (int b = 0; b < inner; ++b) {
					const Edge& e = body.edges[vertexFirst ? b : a];
					const Vec3& tail = body.vertices[e.tail];
					if (segmentDistance(tail, body.vertices[e.head] - tail, points[vertexFirst ? a : b], Vec3(1e-12, 0, 0)) <= range) out.push_back({ meeting, a, b });
				}
		}
		void vertices()
		{
			for (size_t a = 0; a < pair.a.core.vertices.size(); ++a)
				for (size_t b = 0; b < verticesB.size(); ++b)
					if ((verticesB[b] - pair.a.core.vertices[a]).norm() <= range) out.push_back({ Meeting::VertexVertex, int(a), int(b) });
		}
	};

	/// Upper bound of how far any point within the search range of the smaller body has moved with it, in the frame of
	/// the larger body: vertices of the larger one are seen from the smaller one, too. [m]
	double relativeMotion(const Pair& pair, const Quat& rotation, const CandidateCache& cache)
	{
		const double turned = 2 * (cache.rotation.conjugate() * rotation).vec().norm(), range = pair.touch() + 2 * candidateSkin;
		if (pair.b.reach <= pair.a.reach) return (pair.translation - cache.translation).norm() + turned * (pair.b.reach + range);
		const Vec3 now = pair.rotation.transpose() * pair.translation, then = cache.rotation.conjugate() * cache.translation;
		return (now - then).norm() + turned * (pair.a.reach + range);
	}

	/// A pair far apart needs no candidates until its gap has shrunk to the touching distance plus the skin, which also
	/// covers what a flush support reaches beyond a border.
	void search(const Pair& pair, const Quat& rotation, CandidateCache& cache)
	{
		cache.candidates.clear();
		cache.translation = pair.translation;
		cache.rotation = rotation;
		Vec3 axis;
		const double gap = coreGap(pair.a.core, pair.b.core, pair.rotation, pair.translation, axis);
		cache.coresMayMeet = gap <= candidateSkin;
		cache.margin = std::max(candidateSkin, gap - pair.touch() - candidateSkin);
		if (gap < pair.touch() + 2 * candidateSkin) CandidateSearch(pair, cache.candidates).run();
	}

	void lookForOverlap(Pair& pair)
	{
		pair.gap = coreGap(pair.a.core, pair.b.core, pair.rotation, pair.translation, pair.axis);
		if (!pair.deep()) return;
		pair.facingA = faceLooking(pair.a.core, pair.axis);
		pair.facingB = faceLooking(pair.b.core, pair.rotation.transpose() * -pair.axis);
	}

} // namespace

void updateManifold(const RoundedPolyhedron& a, const RoundedPolyhedron& b, const Pose& poseA, const Pose& poseB, const Patterns& patterns,
        CandidateCache& cache, std::vector<ContactPoint>& points)
{
	points.clear();
	const Quat rotation = poseA.orientation.conjugate() * poseB.orientation;
	Pair pair { a, b, rotation.toRotationMatrix(), poseA.orientation.conjugate() * (poseB.position - poseA.position), patterns };
	if (cache.margin < 0 || relativeMotion(pair, rotation, cache) > cache.margin) search(pair, rotation, cache);
	if (cache.coresMayMeet) lookForOverlap(pair);

	Meet meet;
	for (const FeatureId id : cache.candidates) {
		if (!meetFeatures(pair, id, meet)) continue;
		if (pair.deep() && meet.normal.dot(pair.axis) < outwardCosine) continue;
		const ContactPoint point = worldPoint(pair, poseA, id, meet);
		if (!isRepeated(points, point)) points.push_back(point);
	}
	if (points.empty() && pair.deep()) points.push_back(worldPoint(pair, poseA, { Meeting::CoreCore, 0, 0 }, meetCores(pair)));
}

} // namespace timber
