// SPDX-License-Identifier: GPL-2.0-or-later
/// Which pairs of features of two separated or overlapping cores are in contact, and where.
///
/// A vertex has at most one contact: with the feature of the other body that is closest to it, a face, an edge or a
/// vertex. Edges are in contact where they cross inside both. Next to an end the contact of its vertex takes the
/// place of the crossing, if there is one. So some contact is always at the shortest distance of the cores.
#pragma once
#include "geometry.hpp"
#include "shape_pair.hpp"
#include <bitset>
#include <cassert>

namespace timber {

/// Contact of two features, frame of A.
template <class Number> struct FeatureContact {
	Vec3Of<Number> pointA; ///< on core A [m]
	Vec3Of<Number> normal; ///< unit, from A to B
	Number distance; ///< of the cores along the normal, < 0 where they overlap [m]
};

/// Contacts of the vertices of both bodies that have been found in an update.
class VertexContacts {
public:
	/// storage: cleared and used as long as this exists.
	explicit VertexContacts(std::vector<FeatureId>& storage)
	        : list(storage)
	{
		list.clear();
	}
	void add(FeatureId id)
	{
		list.push_back(id);
		const FeatureKind kind = id.kind();
		const bool ofBoth = kind == FeatureKind::VertexVertex;
		if (ofBoth || kind == FeatureKind::VertexFace || kind == FeatureKind::VertexEdge)
			inA.set(size_t(id.a()));
		if (ofBoth || kind == FeatureKind::FaceVertex || kind == FeatureKind::EdgeVertex)
			inB.set(size_t(id.b()));
	}
	bool ofA(int vertex) const { return inA[size_t(vertex)]; }
	bool ofB(int vertex) const { return inB[size_t(vertex)]; }
	/// Whether a vertex of A is in contact with an edge of B, a face beside it or one of its ends.
	bool joinsA(int vertex, int edge, const Edge& e) const
	{
		return ofA(vertex) && std::any_of(list.begin(), list.end(), [&](FeatureId id) {
			if (id.a() != vertex) return false;
			switch (id.kind()) {
				case FeatureKind::VertexFace: return id.b() == e.left || id.b() == e.right;
				case FeatureKind::VertexEdge: return id.b() == edge;
				case FeatureKind::VertexVertex: return id.b() == e.tail || id.b() == e.head;
				default: return false;
			}
		});
	}
	/// The same for a vertex of B and an edge of A.
	bool joinsB(int vertex, int edge, const Edge& e) const
	{
		return ofB(vertex) && std::any_of(list.begin(), list.end(), [&](FeatureId id) {
			if (id.b() != vertex) return false;
			switch (id.kind()) {
				case FeatureKind::FaceVertex: return id.a() == e.left || id.a() == e.right;
				case FeatureKind::EdgeVertex: return id.a() == edge;
				case FeatureKind::VertexVertex: return id.a() == e.tail || id.a() == e.head;
				default: return false;
			}
		});
	}

private:
	std::vector<FeatureId>& list;
	std::bitset<4 * maxVertices> inA, inB; ///< by vertex
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
	        -(pair.isDeep() ? body.coreHalfThickness : pair.flushLimit())));
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
auto vertexFaceContact(const ShapePair& pair, const FeatureId* first, size_t count, FeatureContact<Number>& contact)
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
	const auto valid = isVertexOnFace<Number>(pair, body, isFaceOfB ? pair.supportFaceB : pair.supportFaceA, face,
	        isFaceOfB ? pair.toB<Number>(vertices) : inA, contact.distance);
	if (!any(valid)) return valid;
	const Vec3& outward = body.core.faces[face].plane.normal;
	contact.normal = broadcast<Number>(isFaceOfB ? Vec3(-(pair.rotation * outward)) : outward);
	contact.pointA = isFaceOfB ? inA : Vec(inA - contact.distance * contact.normal);
	return valid;
}

/// Whether a vertex x is above a face beside an edge, within the flush limit, in the edge's frame.
inline bool isAboveFaceOf(const ShapePair& pair, const Polyhedron& body, const Edge& edge, const Vec3& x)
{
	const auto isAbove = [&](int face) {
		const Face& f = body.faces[face];
		return projectsOntoFace<double>(
		        f, x, std::min(pair.sideTolerance(), signedDistance<double>(f.plane, x)));
	};
	return isAbove(edge.left) || isAbove(edge.right);
}

/// Whether the contact of a vertex takes the place of the crossing of two edges. along: of the crossing; zone: from
/// the ends [m]. Without vertex-edge contacts it is that with a face, which at an overlap of zero rounding decides.
inline bool isReplacedByVertex(
        const ShapePair& pair, FeatureId id, double alongA, double alongB, double zone, const VertexContacts& vertices)
{
	const Polyhedron &coreA = pair.a.core, &coreB = pair.b.core;
	const Edge &a = coreA.edges[id.a()], &b = coreB.edges[id.b()];
	const auto joinsA = [&](int v) {
		return pair.kinds.vertexEdge ? vertices.joinsA(v, id.b(), b)
		                             : isAboveFaceOf(pair, coreB, b, pair.toB<double>(coreA.vertices[v]));
	};
	const auto joinsB = [&](int v) {
		return pair.kinds.vertexEdge ? vertices.joinsB(v, id.a(), a)
		                             : isAboveFaceOf(pair, coreA, a, pair.toA<double>(coreB.vertices[v]));
	};
	return (alongA <= zone && joinsA(a.tail)) || (alongA >= a.length - zone && joinsA(a.head))
	        || (alongB <= zone && joinsB(b.tail)) || (alongB >= b.length - zone && joinsB(b.head));
}

/// Up to laneCount edges of A, each against an edge of B. The crossing must be inside both edges. Closer to an end than
/// the flush limit across the other edge, a contact of the end's vertex is preferred; without contacts of vertices
/// above borders there is no contact there. Returns which of the edges are in contact.
template <class Number>
auto edgeEdgeContact(const ShapePair& pair, const FeatureId* first, size_t count, const VertexContacts& vertices,
        FeatureContact<Number>& contact)
{
	using Vec = Vec3Of<Number>;
	const Polyhedron &coreA = pair.a.core, &coreB = pair.b.core;
	const Number zero = 0.;
	const auto edgeA = [&](size_t i) { return &coreA.edges[first[i].a()]; };
	const auto edgeB = [&](size_t i) { return &coreB.edges[first[i].b()]; };
	const Group<Number, const Edge> a(count, edgeA), b(count, edgeB);
	const Vec tailA
	        = Group<Number, const Vec3>(count, [&](size_t i) { return &coreA.vertices[edgeA(i)->tail]; }).vectors();
	const Vec tailB = pair.toA<Number>(
	        Group<Number, const Vec3>(count, [&](size_t i) { return &coreB.vertices[edgeB(i)->tail]; }).vectors());
	const Vec directionA = a.get(&Edge::direction),
	          directionB = broadcast<Number>(pair.rotation) * b.get(&Edge::direction);
	const Crossing<Number> c = crossing<Number>(tailA, directionA, tailB, directionB);
	auto valid = c.sine >= Number(pair.crossingLimit());
	if (!any(valid)) return valid;
	const Number zone = Number(pair.flushLimit()) / c.sine, end = pair.hasBorderContacts() ? zero : zone,
	             lengthA = a.get(&Edge::length), lengthB = b.get(&Edge::length);
	const auto isInside = [&](Number distance) {
		return logicalAnd(logicalAnd(c.alongA > distance, c.alongA < lengthA - distance),
		        logicalAnd(c.alongB > distance, c.alongB < lengthB - distance));
	};
	valid = logicalAnd(valid, isInside(end));
	if (!any(valid)) return valid;
	contact.normal = select(c.normal.dot(a.get(&Edge::outward)) < zero, Vec(-c.normal), c.normal);
	valid = logicalAnd(
	        // Otherwise on the far side of B
	        valid, contact.normal.dot(Vec(broadcast<Number>(pair.rotation) * b.get(&Edge::outward))) < zero);
	contact.pointA = tailA + c.alongA * directionA;
	contact.distance = contact.normal.dot(Vec(tailB + c.alongB * directionB - contact.pointA));
	valid = logicalAnd(valid,
	        logicalAnd(contact.distance<Number(pair.contactDistance()), contact.distance> Number(
	                -(pair.isDeep() ? pair.depthLimit() : pair.flushLimit()))));
	const auto isCentral = isInside(zone);
	for (size_t i = 0; i < count; ++i)
		if (lane(valid, i) && !lane(isCentral, i)
		        && isReplacedByVertex(
		                pair, first[i], lane(c.alongA, i), lane(c.alongB, i), lane(zone, i), vertices))
			clearLane(valid, i);
	return valid;
}

/// Whether no edge from a vertex approaches in a direction (unit) by more than `slope` (cosine). Edges that are nearly
/// parallel to `line` (unit) form a line contact with it and may approach by their angle.
inline bool isSupportVertex(
        const Polyhedron& body, int vertex, const Vec3& direction, double slope, const Vec3& line = Vec3::Zero())
{
	assert(isUnit(direction));
	for (const Edge& e : body.edges) {
		if (e.tail != vertex && e.head != vertex) continue;
		const double rise = e.direction.dot(direction), along = e.direction.dot(line);
		const bool isLine = 1 - along * along < lineSine * lineSine;
		if ((e.tail == vertex ? rise : -rise) > (isLine ? lineSine : slope)) return false;
	}
	return true;
}

/// Whether a point x is in the wedge of an edge, beyond the borders of both its faces, in the edge's frame. limit:
/// tolerance inside them [m]
inline bool isBeyondBothFaces(const Polyhedron& body, const Edge& edge, const Vec3& x, double limit)
{
	const Vec3 fromTail = x - body.vertices[edge.tail];
	const auto beyond = [&](int face, double sign) {
		return sign * fromTail.dot(edge.direction.cross(body.faces[face].plane.normal)) >= -limit;
	};
	return beyond(edge.left, 1) && beyond(edge.right, -1);
}

/// Whether a vertex of one body is in contact with an edge of the other, in the frame of the edge's body.
/// rotation: from the frame of the vertex's body to that of the edge. x: position of the vertex [m]. foot
/// (out): closest point of the edge.
inline bool isVertexOnEdge(const ShapePair& pair, const Polyhedron& vertexBody, const Mat3& rotation, int vertex,
        const Polyhedron& edgeBody, const Edge& edge, const Vec3& x, Vec3& foot)
{
	const Vec3& tail = edgeBody.vertices[edge.tail];
	const double along = (x - tail).dot(edge.direction);
	if (along < -roundingLength || along > edge.length + roundingLength) return false;
	foot = tail + along * edge.direction;
	const Vec3 towards = foot - x;
	const double distance = towards.norm();
	if (distance >= pair.contactDistance() || distance <= 0 || towards.dot(edge.outward) >= 0) return false;
	return isBeyondBothFaces(edgeBody, edge, x, pair.wedgeTolerance())
	        && isSupportVertex(vertexBody, vertex, rotation.transpose() * towards / distance, pair.slopeTolerance(),
	                rotation.transpose() * edge.direction);
}

/// Contact of two points on the cores, which do not coincide.
inline bool pointPointContact(const Vec3& pointA, const Vec3& pointB, FeatureContact<double>& contact)
{
	const Vec3 difference = pointB - pointA;
	contact.pointA = pointA;
	contact.distance = difference.norm();
	assert(contact.distance > 0);
	contact.normal = difference / contact.distance;
	return true;
}

inline bool vertexEdgeContact(const ShapePair& pair, int vertex, int edge, FeatureContact<double>& contact)
{
	const Polyhedron &a = pair.a.core, &b = pair.b.core;
	const Vec3& x = a.vertices[vertex];
	Vec3 foot;
	if (!isVertexOnEdge(pair, a, pair.rotation.transpose(), vertex, b, b.edges[edge], pair.toB<double>(x), foot))
		return false;
	return pointPointContact(x, pair.toA<double>(foot), contact);
}

inline bool edgeVertexContact(const ShapePair& pair, int edge, int vertex, FeatureContact<double>& contact)
{
	const Polyhedron &a = pair.a.core, &b = pair.b.core;
	const Vec3 x = pair.toA<double>(b.vertices[vertex]);
	Vec3 foot;
	return isVertexOnEdge(pair, b, pair.rotation, vertex, a, a.edges[edge], x, foot)
	        && pointPointContact(foot, x, contact);
}

inline bool vertexVertexContact(const ShapePair& pair, int vertexA, int vertexB, FeatureContact<double>& contact)
{
	const Polyhedron &a = pair.a.core, &b = pair.b.core;
	const Vec3 &pointA = a.vertices[vertexA], pointB = pair.toA<double>(b.vertices[vertexB]);
	const Vec3 difference = pointB - pointA;
	const double distance = difference.norm(), slope = pair.slopeTolerance();
	if (distance >= pair.contactDistance() || distance <= 0) return false;
	return isSupportVertex(a, vertexA, difference / distance, slope)
	        && isSupportVertex(b, vertexB, pair.rotation.transpose() * -difference / distance, slope)
	        && pointPointContact(pointA, pointB, contact);
}

/// ContactKinds::vertexEdge, of vertices without a contact.
inline bool extraPatternContact(
        const ShapePair& pair, FeatureId id, const VertexContacts& vertices, FeatureContact<double>& contact)
{
	switch (id.kind()) {
		case FeatureKind::VertexEdge:
			return !vertices.ofA(id.a()) && vertexEdgeContact(pair, id.a(), id.b(), contact);
		case FeatureKind::EdgeVertex:
			return !vertices.ofB(id.b()) && edgeVertexContact(pair, id.a(), id.b(), contact);
		case FeatureKind::VertexVertex:
			return !vertices.ofA(id.a()) && !vertices.ofB(id.b())
			        && vertexVertexContact(pair, id.a(), id.b(), contact);
		default: return false;
	}
}

} // namespace timber
