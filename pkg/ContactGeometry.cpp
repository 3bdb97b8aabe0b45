// SPDX-License-Identifier: GPL-2.0-or-later
#include <ContactGeometry.hpp>
#include <bodies.hpp>

namespace yade {

YADE_PLUGIN((ManifoldGeom)(Ig2_RoundedPolyhedron_RoundedPolyhedron_ManifoldGeom));

boost::python::list ManifoldGeom::pyPoints() const
{
	boost::python::list points;
	for (const timber::ContactPoint& p : contactPoints)
		points.append(boost::python::make_tuple(
		        Vector3r(p.position), Vector3r(p.normal), Real(p.overlap), p.id.bits));
	return points;
}

bool Ig2_RoundedPolyhedron_RoundedPolyhedron_ManifoldGeom::go(const shared_ptr<Shape>& shape1,
        const shared_ptr<Shape>& shape2, const State& state1, const State& state2, const Vector3r&, const bool&,
        const shared_ptr<Interaction>& I)
{
	if (!isFree(state1) && !isFree(state2) && !I->geom) return false;
	if (!I->geom) I->geom = shared_ptr<IGeom>(new ManifoldGeom);
	ManifoldGeom& geom = *static_cast<ManifoldGeom*>(I->geom.get());
	const timber::RoundedPolyhedron &a = *static_cast<RoundedPolyhedron*>(shape1.get())->geometry,
	                                &b = *static_cast<RoundedPolyhedron*>(shape2.get())->geometry;
	const timber::Pose poseA { state1.pos, state1.ori }, poseB { state2.pos, state2.ori };
	geom.safeDisplacement = timber::updateManifold(
	        a, b, poseA, poseB, { vertexEdge, flushSupports }, geom.cache, geom.contactPoints);
	return true;
}

} // namespace yade
