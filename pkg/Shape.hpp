// SPDX-License-Identifier: GPL-2.0-or-later
/// Shape and bounding box of the elements.
#pragma once
#include <kernel/polyhedron.hpp>
#include <pch.hpp>

namespace yade {

class RoundedPolyhedron : public Shape {
public:
	/// Made from the attributes by postLoad. Equal elements share one geometry, which saves memory traffic in each
	/// step.
	shared_ptr<const timber::RoundedPolyhedron> geometry { new timber::RoundedPolyhedron };
	Real volume = 0; ///< of the sharp polyhedron [m3]

	/// Throws for an attribute outside its range.
	void validate() const;
	/// Makes the geometry. Changes nothing if it throws.
	void postLoad(RoundedPolyhedron&);
	/// (volume, centroid, inertia matrix about it for unit density, quaternion of the principal axes), frame of the
	/// vertices.
	boost::python::tuple massProperties() const;
	/// Faces as lists of vertex indices, counter-clockwise seen from outside.
	boost::python::list faces() const;

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(RoundedPolyhedron, Shape,
		"Convex polyhedron with rounded vertices and edges (paper, section 2.2): its faces moved inwards by "
		":yref:`radius<RoundedPolyhedron.radius>`, plus a ball of that radius. "
		"The vertices are in the body frame: origin in the centroid, axes along the principal axes. "
		"``yade_timber.polyhedron`` makes such a body from vertices in the world frame. "
		"Raises an error if a vertex is not a corner of the convex hull.",
		((vector<Vector3r>, vertices, , Attr::triggerPostLoad, "Corners of the sharp polyhedron, 4 to 64, body "
			"frame. [m]"))
		((Real, radius, 0, Attr::triggerPostLoad, "Rounding radius, >= 0; 0 takes 10 % of the shortest edge. "
			"[m] (paper, section 2.2)"))
		((string, name, , , "Name of the element, for reports. [-]"))
		((string, kind, , , "Kind of the element: column, beam, brace, ... [-]")),
		createIndex();,
		.def("massProperties", &RoundedPolyhedron::massProperties, "(volume [m3], centroid [m], inertia about "
			"it for unit density [m5], principal axes as Quaternion), frame of the vertices.")
		.def("faces", &RoundedPolyhedron::faces, "Faces as lists of vertex indices, counter-clockwise seen "
			"from outside. [-]")
	);
	// clang-format on
	REGISTER_CLASS_INDEX(RoundedPolyhedron, Shape);
};
REGISTER_SERIALIZABLE(RoundedPolyhedron);

/// The shape of a body; null if it is another one.
inline const RoundedPolyhedron* roundedShape(const Body& b)
{
	return dynamic_cast<const RoundedPolyhedron*>(b.shape.get());
}

/// Margin of an element's bounding box on all sides: `margin` [m], or more for a fast body, so that it stays in its box
/// for several steps.
/// 0 for other shapes, whose boxes are made elsewhere. dt: time step [s]. Returns [m].
Real boxMargin(const Body& b, Real margin, Real dt);

class Bo1_RoundedPolyhedron_Aabb : public BoundFunctor {
public:
	void validate() const;
	void postLoad(Bo1_RoundedPolyhedron_Aabb&) { validate(); }
	void go(const shared_ptr<Shape>&, shared_ptr<Bound>&, const Se3r&, const Body*) override;
	FUNCTOR1D(RoundedPolyhedron);
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(Bo1_RoundedPolyhedron_Aabb, BoundFunctor, "Axis-aligned bounding box of a "
		":yref:`RoundedPolyhedron`.",
		((Real, margin, 5e-3, Attr::triggerPostLoad, "Margin of the box on all sides, >= 0; up to twenty times "
			"as much for fast bodies. It reduces the number of runs of the collider, see "
			":yref:`CollisionTrigger`. [m]"))
	);
	// clang-format on
};
REGISTER_SERIALIZABLE(Bo1_RoundedPolyhedron_Aabb);

} // namespace yade
