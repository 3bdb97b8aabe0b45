// SPDX-License-Identifier: GPL-2.0-or-later
#include <Shape.hpp>
#include <kernel/rotation.hpp>
#include <validation.hpp>
#include <map>
#include <mutex>

namespace yade {

YADE_PLUGIN((RoundedPolyhedron)(Bo1_RoundedPolyhedron_Aabb));

namespace {
	/// Radius and coordinates. Coordinates that are not finite are refused first: NaN has no order in a map.
	std::vector<Real> keyOf(const vector<Vector3r>& vertices, Real radius)
	{
		std::vector<Real> numbers { radius };
		for (const Vector3r& v : vertices) {
			if (!v.allFinite()) timber::Polyhedron::fromVertices(vertices); // throws with the vertex
			numbers.insert(numbers.end(), v.data(), v.data() + 3);
		}
		return numbers;
	}

	/// Geometries by radius and vertices. Unused ones are removed when the map has grown.
	class SharedGeometries {
		using Geometry = const timber::RoundedPolyhedron;
		std::mutex guard;
		std::map<std::vector<Real>, boost::weak_ptr<Geometry>> geometries;
		size_t sizeLimit = 1000; ///< at which unused ones are removed

		void removeUnused()
		{
			if (geometries.size() < sizeLimit) return;
			for (auto k = geometries.begin(); k != geometries.end();)
				k = k->second.expired() ? geometries.erase(k) : std::next(k);
			sizeLimit = 2 * geometries.size() + 1000;
		}

	public:
		shared_ptr<Geometry> findOrMake(const vector<Vector3r>& vertices, Real radius)
		{
			const std::lock_guard<std::mutex> lock(guard);
			removeUnused();
			const std::vector<Real> key = keyOf(vertices, radius);
			const auto place = geometries.find(key);
			shared_ptr<Geometry> shared = place == geometries.end() ? nullptr : place->second.lock();
			if (shared) return shared;
			shared = boost::make_shared<Geometry>(timber::RoundedPolyhedron::fromSharp(
			        timber::Polyhedron::fromVertices(vertices), radius));
			geometries[key] = shared;
			geometries[keyOf(vertices, shared->radius)] = shared; // the attribute's value from now on
			return shared;
		}
	};
	SharedGeometries sharedGeometries;
}

void RoundedPolyhedron::validate() const
{
	require(radius >= 0 && std::isfinite(radius), "RoundedPolyhedron.radius", radius,
	        ">= 0 (0 takes 10 % of the shortest edge)");
}

void RoundedPolyhedron::postLoad(RoundedPolyhedron&)
{
	validate();
	if (vertices.empty()) return; // default-constructed
	const auto shared = sharedGeometries.findOrMake(vertices, radius);
	volume = timber::massProperties(shared->sharp).volume;
	radius = shared->radius;
	geometry = shared;
}

boost::python::tuple RoundedPolyhedron::massProperties() const
{
	if (vertices.empty()) throw std::runtime_error("RoundedPolyhedron.massProperties: the shape has no vertices");
	const timber::MassProperties p = timber::massProperties(geometry->sharp);
	return boost::python::make_tuple(Real(p.volume), Vector3r(p.centroid), Matrix3r(p.inertia),
	        Quaternionr(timber::principalAxes(p.inertia)));
}

boost::python::list RoundedPolyhedron::faces() const
{
	boost::python::list cornerLists;
	for (const timber::Face& face : geometry->sharp.faces) {
		boost::python::list corners;
		for (const int k : face.corners)
			corners.append(k);
		cornerLists.append(corners);
	}
	return cornerLists;
}

constexpr int fastBodySteps = 32; ///< for which the box of a fast body is sufficient
constexpr Real maxMarginRatio = 20; ///< of the margin of a fast body to that of a slow one

Real boxMargin(const Body& b, Real margin, Real dt)
{
	const RoundedPolyhedron* shape = roundedShape(b);
	if (!shape) return 0;
	const State& s = *b.state;
	// In one step
	const Real displacement = dt
	        * (s.vel.norm() + timber::rotationSpeed(s.ori.conjugate() * s.angVel, shape->geometry->halfExtents));
	return math::max(margin, math::min(maxMarginRatio * margin, fastBodySteps * displacement));
}

void Bo1_RoundedPolyhedron_Aabb::validate() const { requirePositive("Bo1_RoundedPolyhedron_Aabb.margin", margin); }

void Bo1_RoundedPolyhedron_Aabb::go(
        const shared_ptr<Shape>& shape, shared_ptr<Bound>& bound, const Se3r& se3, const Body* b)
{
	const timber::RoundedPolyhedron& body = *static_cast<RoundedPolyhedron*>(shape.get())->geometry;
	if (!bound) bound = shared_ptr<Bound>(new Aabb);
	const Matrix3r rotation = se3.orientation.toRotationMatrix();
	Vector3r low = Vector3r::Constant(std::numeric_limits<Real>::infinity()), high = -low;
	for (const Vector3r& v : body.core.vertices) {
		const Vector3r x = rotation * v;
		low = low.cwiseMin(x);
		high = high.cwiseMax(x);
	}
	const Vector3r grow = Vector3r::Constant(body.radius + (b ? boxMargin(*b, margin, scene->dt) : margin));
	bound->min = se3.position + low - grow;
	bound->max = se3.position + high + grow;
}

} // namespace yade
