// SPDX-License-Identifier: GPL-2.0-or-later
/// A pair in ODE: dCollide, which has no state between steps.
#pragma once
#include "configurations.hpp"
#include <memory>
#include <ode/ode.h>

namespace timber::bench {

class OdePair {
	/// Data referenced by dCreateConvex.
	struct Convex {
		std::vector<dReal> planes, points;
		std::vector<unsigned> polygons;
	};
	Convex convexA, convexB;
	dGeomID a, b;
	dContactGeom contacts[16];
	int count = 0;
	Vec3 position; ///< of B [m]

	static dGeomID shape(const std::vector<Vec3>& points, const Vec3& box, Convex& convex)
	{
		if (box.x() > 0) return dCreateBox(nullptr, box.x(), box.y(), box.z());
		const Polyhedron body = Polyhedron::fromVertices(points);
		for (const Vec3& p : body.vertices)
			convex.points.insert(convex.points.end(), { dReal(p.x()), dReal(p.y()), dReal(p.z()) });
		for (const Face& f : body.faces) {
			const Vec3& n = f.plane.normal;
			convex.planes.insert(convex.planes.end(),
			        { dReal(n.x()), dReal(n.y()), dReal(n.z()), dReal(f.plane.offset) });
			convex.polygons.push_back(unsigned(f.corners.size()));
			convex.polygons.insert(convex.polygons.end(), f.corners.begin(), f.corners.end());
		}
		return dCreateConvex(nullptr, convex.planes.data(), unsigned(body.faces.size()), convex.points.data(),
		        unsigned(points.size()), convex.polygons.data());
	}
	static void rotate(dGeomID geom, const Quat& q)
	{
		const dQuaternion ode = { dReal(q.w()), dReal(q.x()), dReal(q.y()), dReal(q.z()) };
		dGeomSetQuaternion(geom, ode);
	}

public:
	const Configuration& configuration;

	explicit OdePair(const Configuration& c)
	        : a(shape(c.a, c.boxA, convexA))
	        , b(shape(c.b, c.boxB, convexB))
	        , position(positionOfB(c, c.a, c.b, 0))
	        , configuration(c)
	{
		rotate(a, c.rotationA);
		rotate(b, c.rotationB);
	}
	~OdePair()
	{
		dGeomDestroy(a);
		dGeomDestroy(b);
	}
	void step(int k) { stepAt(position + vibration(k)); }
	void stepAt(const Vec3& x)
	{
		dGeomSetPosition(b, x.x(), x.y(), x.z());
		count = dCollide(a, b, 16, contacts, sizeof(dContactGeom));
	}
	Found found()
	{
		stepAt(position);
		Found f;
		for (int k = 0; k < count; ++k) // ODE's normals point into the first body
			f.add(configuration, -Vec3(contacts[k].normal[0], contacts[k].normal[1], contacts[k].normal[2]),
			        contacts[k].depth);
		return f;
	}
};

} // namespace timber::bench
