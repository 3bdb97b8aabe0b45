// SPDX-License-Identifier: GPL-2.0-or-later
/// Contact geometry: from two RoundedPolyhedron shapes to contact points.
#pragma once
#include <Shape.hpp>
#include <kernel/manifold.hpp>

namespace boost {
namespace serialization {
	template <class Archive> void serialize(Archive& ar, timber::ContactPoint& p, const unsigned int)
	{
		ar & make_nvp("id", p.id.bits) & make_nvp("position", p.position) & make_nvp("normal", p.normal) & make_nvp("overlap", p.overlap);
	}
}
}

namespace yade {

/// Made anew from the two placements in each step; the points are saved so that a loaded scene can be asked for them.
class ManifoldGeom : public IGeom {
public:
	timber::CandidateCache cache;
	Real                   gap = 0; ///< by which the bodies may surely move against each other before they touch; 0: not known [m]

	boost::python::list pyPoints() const;
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(ManifoldGeom, IGeom, "Contact points between two :yref:`RoundedPolyhedron`; none while they are only near each other.",
		((vector<timber::ContactPoint>, contactPoints, , Attr::hidden, "Contact points, sorted by feature id. [-]")),
		createIndex();,
		.add_property("points", &ManifoldGeom::pyPoints, "List of (position [m], normal from body 1 to body 2, overlap [m], feature id) of the points that touch, world frame.")
	);
	// clang-format on
	REGISTER_CLASS_INDEX(ManifoldGeom, IGeom);
};
REGISTER_SERIALIZABLE(ManifoldGeom);

class Ig2_RoundedPolyhedron_RoundedPolyhedron_ManifoldGeom : public IGeomFunctor {
public:
	bool go(const shared_ptr<Shape>&, const shared_ptr<Shape>&, const State&, const State&, const Vector3r& shift2, const bool& force, const shared_ptr<Interaction>&) override;
	FUNCTOR2D(RoundedPolyhedron, RoundedPolyhedron);
	DEFINE_FUNCTOR_ORDER_2D(RoundedPolyhedron, RoundedPolyhedron);
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(Ig2_RoundedPolyhedron_RoundedPolyhedron_ManifoldGeom, IGeomFunctor,
		"Contact points between two polyhedra: vertex on face and edge across edge, as the paper keeps (section 2.2). The interaction stays while the bounding boxes overlap, so that the candidate features of a near pair are kept.",
		((bool, vertexEdge, false, , "Whether vertex-edge and vertex-vertex contacts exist too, which the paper ignores. [-]"))
		((bool, flushSupports, true, , "Whether a vertex exactly over the border of a face (flush members) is supported by it. [-]"))
	);
	// clang-format on
};
REGISTER_SERIALIZABLE(Ig2_RoundedPolyhedron_RoundedPolyhedron_ManifoldGeom);

} // namespace yade
