// SPDX-License-Identifier: GPL-2.0-or-later
#include <Shape.hpp>
#include <kernel/rotation.hpp>
#include <map>
#include <mutex>

namespace yade {

YADE_PLUGIN((RoundedPolyhedron)(Bo1_RoundedPolyhedron_Aabb));

namespace {
	/// The numbers that make a geometry. NaN among them, which no map can order, is refused first.
	std::vector<Real> key(const vector<Vector3r>& vertices, Real radius)
	{
		std::vector<Real> numbers { radius };
		for (const Vector3r& v : vertices) {
			if (!v.allFinite()) timber::Polyhedron::fromVertices(vertices); // says which
			numbers.insert(numbers.end(), v.data(), v.data() + 3);
		}
		return numbers;
	}

	/// Geometries by what makes them; those that no element has any more are dropped now and then.
	class SharedGeometries {
		using Geometry = const timber::RoundedPolyhedron;
		std::mutex                                           guard;
		std::map<std::vector<Real>, boost::weak_ptr<Geometry>> known;
		size_t                                               crowded = 1000;

		void tidy()
		{
			if (known.size() < crowded) return;
			for (auto k = known.begin(); k != known.end();)
				k = k->second.expired() ? known.erase(k) : std::next(k);
			crowded = 2 * known.size() + 1000;
		}

	public:
		shared_ptr<Geometry> find(const vector<Vector3r>& vertices, Real radius)
		{
			const std::lock_guard<std::mutex> lock(guard);
			tidy();
			const std::vector<Real> name = key(vertices, radius);
			const auto              place = known.find(name);
			shared_ptr<Geometry>    found = place == known.end() ? nullptr : place->second.lock();
			if (found) return found;
			found       = boost::make_shared<Geometry>(timber::RoundedPolyhedron::fromSharp(timber::Polyhedron::fromVertices(vertices), radius));
			known[name] = found; // what is refused does not come here
			return found;
		}
	};
	SharedGeometries geometries;
}

void RoundedPolyhedron::postLoad(RoundedPolyhedron&)
{
	if (vertices.empty()) return; // default-constructed
	if (!(radius >= 0)) throw std::invalid_argument("RoundedPolyhedron.radius = " + std::to_string(radius) + ": it must be >= 0 (0 takes 10 % of the shortest edge)");
	geometry = geometries.find(vertices, radius);
	radius   = geometry->radius;
	volume   = timber::massProperties(geometry->sharp).volume;
}

boost::python::tuple RoundedPolyhedron::massProperties() const
{
	if (vertices.empty()) throw std::runtime_error("RoundedPolyhedron.massProperties: it has no vertices");
	const timber::MassProperties p = timber::massProperties(geometry->sharp);
	return boost::python::make_tuple(Real(p.volume), Vector3r(p.centroid), Matrix3r(p.inertia), Quaternionr(timber::principalAxes(p.inertia)));
}

boost::python::list RoundedPolyhedron::faces() const
{
	boost::python::list all;
	for (const timber::Face& face : geometry->sharp.faces) {
		boost::python::list corners;
		for (const int k : face.corners)
			corners.append(k);
		all.append(corners);
	}
	return all;
}

/// Steps that a fast body's box lasts, and how many times wider than a slow one's its margin gets for that.
constexpr int  boxSteps  = 32;
constexpr Real boxWidest = 20;

Real boxMargin(const Body& b, Real margin, Real dt)
{
	const auto shape = dynamic_cast<const RoundedPolyhedron*>(b.shape.get());
	if (!shape) return 0;
	const State& s   = *b.state;
	const Real   way = dt * (s.vel.norm() + timber::rotationSpeed(s.ori.conjugate() * s.angVel, shape->geometry->span));
	return math::max(margin, math::min(boxWidest * margin, boxSteps * way));
}

void Bo1_RoundedPolyhedron_Aabb::go(const shared_ptr<Shape>& shape, shared_ptr<Bound>& bound, const Se3r& se3, const Body* b)
{
	const timber::RoundedPolyhedron& body = *static_cast<RoundedPolyhedron*>(shape.get())->geometry;
	if (!bound) bound = shared_ptr<Bound>(new Aabb);
	const Matrix3r turn = se3.orientation.toRotationMatrix();
	Vector3r       low  = Vector3r::Constant(std::numeric_limits<Real>::infinity()), high = -low;
	for (const Vector3r& v : body.core.vertices) {
		const Vector3r x = turn * v;
		low              = low.cwiseMin(x);
		high             = high.cwiseMax(x);
	}
	const Vector3r grow = Vector3r::Constant(body.radius + (b ? boxMargin(*b, margin, scene->dt) : margin));
	bound->min          = se3.position + low - grow;
	bound->max          = se3.position + high + grow;
}

} // namespace yade
