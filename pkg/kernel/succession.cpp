// SPDX-License-Identifier: GPL-2.0-or-later
#include "succession.hpp"
#include "constants.hpp"
#include <algorithm>
#include <limits>

namespace timber {
namespace {

	using Points = std::vector<ContactPoint>;

	enum class Feature { Vertex, Edge, Face, None };
	Feature featureOfA(FeatureKind kind)
	{
		switch (kind) {
			case FeatureKind::VertexFace:
			case FeatureKind::VertexEdge:
			case FeatureKind::VertexVertex: return Feature::Vertex;
			case FeatureKind::EdgeEdge:
			case FeatureKind::EdgeVertex: return Feature::Edge;
			case FeatureKind::FaceVertex: return Feature::Face;
			default: return Feature::None;
		}
	}
	Feature featureOfB(FeatureKind kind)
	{
		switch (kind) {
			case FeatureKind::FaceVertex:
			case FeatureKind::EdgeVertex:
			case FeatureKind::VertexVertex: return Feature::Vertex;
			case FeatureKind::EdgeEdge:
			case FeatureKind::VertexEdge: return Feature::Edge;
			case FeatureKind::VertexFace: return Feature::Face;
			default: return Feature::None;
		}
	}

	/// Calls work for each vertex of a feature; ends with true when it returns true.
	template <class Work> bool anyVertex(const Polyhedron& body, Feature feature, int index, Work work)
	{
		switch (feature) {
			case Feature::Vertex: return work(index);
			case Feature::Edge: return work(body.edges[index].tail) || work(body.edges[index].head);
			case Feature::Face:
				return std::any_of(
				        body.faces[index].corners.begin(), body.faces[index].corners.end(), work);
			default: return false;
		}
	}

	/// Whether two features of a body have a common vertex.
	bool doTouch(const Polyhedron& body, Feature f, int indexF, Feature g, int indexG)
	{
		return anyVertex(body, f, indexF,
		        [&](int v) { return anyVertex(body, g, indexG, [v](int w) { return v == w; }); });
	}

	bool doTouch(const Polyhedron& a, const Polyhedron& b, FeatureId p, FeatureId q)
	{
		return doTouch(a, featureOfA(p.kind()), p.a(), featureOfA(q.kind()), q.a())
		        && doTouch(b, featureOfB(p.kind()), p.b(), featureOfB(q.kind()), q.b());
	}

	bool contains(const Points& points, FeatureId id)
	{
		const auto at = std::lower_bound(
		        points.begin(), points.end(), id, [](const ContactPoint& p, FeatureId i) { return p.id < i; });
		return at != points.end() && at->id == id;
	}

	bool isTaken(const Points& points, FeatureId id)
	{
		return std::any_of(
		        points.begin(), points.end(), [id](const ContactPoint& p) { return p.predecessor == id; });
	}

} // namespace

void linkPredecessors(const Polyhedron& a, const Polyhedron& b, const Points& before, Points& points)
{
	const bool same = std::equal(before.begin(), before.end(), points.begin(), points.end(),
	        [](const ContactPoint& p, const ContactPoint& q) { return p.id == q.id; });
	if (same || before.empty()) return;
	for (ContactPoint& next : points) {
		if (contains(before, next.id)) continue;
		double least = std::numeric_limits<double>::infinity();
		FeatureId closest;
		for (const ContactPoint& old : before) {
			const double distance = (old.position - next.position).squaredNorm();
			if (distance >= least || old.normal.dot(next.normal) < successionCosine
			        || contains(points, old.id) || isTaken(points, old.id)
			        || !doTouch(a, b, old.id, next.id))
				continue;
			least = distance;
			closest = old.id;
		}
		next.predecessor = closest;
	}
}

} // namespace timber
