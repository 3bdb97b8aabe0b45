// SPDX-License-Identifier: GPL-2.0-or-later
#include <ContactForces.hpp>
#include <PackedScene.hpp>

namespace yade {

namespace {
	void append(std::vector<float>& to, const Vector3r& v)
	{
		to.insert(to.end(), { float(v.x()), float(v.y()), float(v.z()) });
	}

	/// Interactions of near bodies, ordered by their ids: the order of the container depends on the run's history.
	std::vector<Interaction*> interactionsById(const Scene& scene)
	{
		std::vector<Interaction*> sorted;
		for (const shared_ptr<Interaction>& i : *scene.interactions)
			if (i->isReal()) sorted.push_back(i.get());
		std::sort(sorted.begin(), sorted.end(), [](const Interaction* a, const Interaction* b) {
			return std::make_pair(a->getId1(), a->getId2()) < std::make_pair(b->getId1(), b->getId2());
		});
		return sorted;
	}
}

boost::python::tuple packedPlacements()
{
	const BodyContainer& bodies = *Omega::instance().getScene()->bodies;
	const Real nan = std::numeric_limits<Real>::quiet_NaN();
	std::vector<float> positions, orientations;
	for (size_t id = 0; id < bodies.size(); ++id) {
		const shared_ptr<Body>& b = bodies[Body::id_t(id)];
		const Quaternionr q = b ? b->state->ori : Quaternionr(nan, nan, nan, nan);
		append(positions, b ? b->state->pos : Vector3r(nan, nan, nan));
		orientations.insert(orientations.end(), { float(q.w()), float(q.x()), float(q.y()), float(q.z()) });
	}
	return boost::python::make_tuple(bytes(positions), bytes(orientations));
}

boost::python::tuple packedJoints(const shared_ptr<JointEngine>& engine)
{
	if (!engine) throw std::invalid_argument("packed_joints: engine = None: it must be a JointEngine");
	std::vector<float> loads;
	std::vector<std::uint8_t> broken;
	for (const timber::JointEntry& j : engine->jointSet().joints) {
		loads.push_back(float(engine->jointSet().load(j)));
		broken.push_back(std::uint8_t(j.springs - j.intact));
	}
	return boost::python::make_tuple(bytes(loads), bytes(broken));
}

boost::python::tuple packedContacts()
{
	std::vector<std::int32_t> pairs;
	std::vector<float> positions, forces;
	for (const Interaction* i : interactionsById(*Omega::instance().getScene())) {
		const auto geom = dynamic_cast<const ManifoldGeom*>(i->geom.get());
		const auto phys = dynamic_cast<const ManifoldPhys*>(i->phys.get());
		if (!geom || !phys) continue;
		for (const timber::ContactPoint& point : geom->contactPoints) {
			const auto record = std::find_if(phys->records.begin(), phys->records.end(),
			        [&](const timber::PointRecord& p) { return p.id == point.id; });
			if (record == phys->records.end()) continue;
			pairs.insert(pairs.end(), { i->getId1(), i->getId2() });
			append(positions, point.position);
			append(forces, record->normalForce * point.normal + record->shearForce + record->dashpotForce);
		}
	}
	return boost::python::make_tuple(bytes(pairs), bytes(positions), bytes(forces));
}

boost::python::tuple packedSprings()
{
	const Scene& scene = *Omega::instance().getScene();
	std::vector<std::int32_t> pairs;
	std::vector<double> values;
	for (const timber::PointSpring& p : ContactForces::linearSprings(scene, ContactForces::placements(scene))) {
		pairs.insert(pairs.end(), { p.bodyA, p.bodyB });
		for (const Vector3r& v : { p.armA, p.armB, p.normal })
			values.insert(values.end(), v.data(), v.data() + 3);
		values.insert(values.end(), { p.normalStiffness, p.shearStiffness });
		values.insert(values.end(), p.force.data(), p.force.data() + 3);
	}
	return boost::python::make_tuple(bytes(pairs), bytes(values));
}

Real pyDashpotPower(const boost::python::object& velocities)
{
	const Scene& scene = *Omega::instance().getScene();
	std::vector<timber::SolverBody> bodies = ContactForces::placements(scene);
	const string values = boost::python::extract<string>(velocities);
	if (values.size() != 6 * sizeof(double) * bodies.size())
		throw std::invalid_argument("dashpot_power: velocities: six numbers for each body");
	std::vector<double> v(6 * bodies.size());
	std::memcpy(v.data(), values.data(), values.size());
	for (size_t id = 0; id < bodies.size(); ++id) {
		bodies[id].velocity = Eigen::Map<const Vector3r>(&v[6 * id]);
		bodies[id].spin = Eigen::Map<const Vector3r>(&v[6 * id + 3]);
	}
	return ContactForces::dashpotPower(scene, bodies);
}

} // namespace yade
