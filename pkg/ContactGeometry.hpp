// SPDX-License-Identifier: GPL-2.0-or-later
/// Contact geometry: from two RoundedPolyhedron shapes to contact points.
#pragma once
#include <Shape.hpp>
#include <kernel/manifold.hpp>

namespace boost {
namespace serialization {
	template <class Archive> void serialize(Archive& ar, timber::ContactPoint& p, const unsigned int)
	{
		ar& make_nvp("id", p.id.bits) & make_nvp("position", p.position) & make_nvp("normal", p.normal)
		        & make_nvp("overlap", p.overlap);
	}
}
}

namespace yade {

/// Computed from the two poses in each step. The points are saved, so that a loaded scene shows them before its first
/// step.
class ManifoldGeom : public IGeom {
public:
	timber::CandidateCache cache;
	Real safeDisplacement = 0; ///< relative motion of the bodies before which there is no contact; 0: unknown [m]

	boost::python::list pyPoints() const;
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(ManifoldGeom, IGeom, "Contact points between two :yref:`RoundedPolyhedron`; "
		"none while their bounding boxes overlap without contact.",
		((vector<timber::ContactPoint>, contactPoints, , Attr::hidden, "Contact points, sorted by feature id. "
			"[-]")),
		createIndex();,
		.add_property("points", &ManifoldGeom::pyPoints, "List of (position [m], normal from body 1 to body 2, "
			"overlap [m], feature id) of the contact points, world frame.")
	);
	// clang-format on
	REGISTER_CLASS_INDEX(ManifoldGeom, IGeom);
};
REGISTER_SERIALIZABLE(ManifoldGeom);

class Ig2_RoundedPolyhedron_RoundedPolyhedron_ManifoldGeom : public IGeomFunctor {
public:
	bool go(const shared_ptr<Shape>&, const shared_ptr<Shape>&, const State&, const State&, const Vector3r& shift2,
	        const bool& force, const shared_ptr<Interaction>&) override;
	FUNCTOR2D(RoundedPolyhedron, RoundedPolyhedron);
	DEFINE_FUNCTOR_ORDER_2D(RoundedPolyhedron, RoundedPolyhedron);
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(Ig2_RoundedPolyhedron_RoundedPolyhedron_ManifoldGeom, IGeomFunctor,
		"Contact points between two polyhedra: vertex-face and edge-edge, as in the paper (section 2.2), and "
		"vertex-edge and vertex-vertex. The "
		"interaction exists while the bounding boxes overlap, so that the candidate features of a near pair "
		"are cached. Periodic cells are not supported.",
		((bool, vertexEdge, true, , "Also vertex-edge and vertex-vertex contacts. The paper ignores them: "
			"edges and corners sink into each other where only they meet. [-]"))
		((bool, flushSupports, true, , "A vertex exactly above the border of a face (flush members) is "
			"supported by the face. [-]"))
	);
	// clang-format on
};
REGISTER_SERIALIZABLE(Ig2_RoundedPolyhedron_RoundedPolyhedron_ManifoldGeom);

} // namespace yade
