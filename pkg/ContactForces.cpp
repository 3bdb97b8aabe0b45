// SPDX-License-Identifier: GPL-2.0-or-later
#include <ContactForces.hpp>

namespace yade {

YADE_PLUGIN((ContactForces));

/// Steps for which a point's response is kept. A member that turns at 10 rad/s has turned by 0.03 rad by then; longer gains nothing.
constexpr int responseSteps = 32;

void ContactForces::sortPairs()
{
	pairs.clear();
	for (const shared_ptr<Interaction>& I : seen)
		pairs.push_back({ I.get(), nullptr, nullptr });
	const auto ids = [](const Pair& p) { return std::minmax(p.interaction->getId1(), p.interaction->getId2()); };
	std::sort(pairs.begin(), pairs.end(), [&](const Pair& p, const Pair& q) { return ids(p) < ids(q); });
}

void ContactForces::collectPairs()
{
	static const int ours    = ManifoldGeom::getClassIndexStatic();
	size_t           count   = 0;
	bool             changed = false;
	for (const shared_ptr<Interaction>& I : *scene->interactions) {
		if (!I->isReal() || I->geom->getClassIndex() != ours) continue;
		const ManifoldPhys& phys = *static_cast<ManifoldPhys*>(I->phys.get());
		if (phys.states.empty() && phys.lostEnergy == 0) continue;
		if (count == seen.size()) seen.push_back(nullptr);
		if (seen[count] != I) {
			seen[count] = I;
			changed     = true;
		}
		++count;
	}
	changed = changed || count != pairs.size();
	seen.resize(count);
	if (changed) sortPairs();
	for (Pair& p : pairs) {
		p.geom = static_cast<ManifoldGeom*>(p.interaction->geom.get());
		p.phys = static_cast<ManifoldPhys*>(p.interaction->phys.get());
	}
}

void ContactForces::collectBodies()
{
	const size_t count = scene->bodies->size();
	bodies.resize(count);
	force.assign(count, Vector3r::Zero());
	torque.assign(count, Vector3r::Zero());
	scene->forces.sync();
	for (const shared_ptr<Body>& b : *scene->bodies) {
		if (!b) continue;
		const State&         s   = *b->state;
		timber::DashpotBody& own = bodies[b->getId()];
		own.velocity = own.newVelocity = s.vel;
		own.spin = own.newSpin = s.angVel;
		own.inverseMass        = 0;
		own.inverseInertia.setZero();
		if (s.blockedDOFs == State::DOF_ALL) continue;
		const Matrix3r axes = s.ori.toRotationMatrix();
		own.inverseMass     = 1 / s.mass;
		own.inverseInertia  = axes * s.inertia.cwiseInverse().asDiagonal() * axes.transpose();
		own.newVelocity += scene->dt * own.inverseMass * scene->forces.getForce(b->getId());
		own.newSpin += scene->dt * own.inverseInertia * scene->forces.getTorque(b->getId());
	}
}

void ContactForces::collectPoints()
{
	size_t count = 0;
	for (const Pair& pair : pairs) {
		const int      id1 = pair.interaction->getId1(), id2 = pair.interaction->getId2();
		const Vector3r x1 = Body::byId(id1, scene)->state->pos, x2 = Body::byId(id2, scene)->state->pos;
		const Real     rootShear = math::sqrt(pair.phys->shearRatio);
		const bool     refresh   = (scene->iter + id1 + id2) % responseSteps == 0; // not all pairs in the same step, and the same ones after a load
		if (points.size() < count + pair.phys->states.size()) points.resize(count + pair.phys->states.size());
		for (size_t k = 0; k < pair.phys->states.size(); ++k) {
			const timber::ContactPoint& at = pair.geom->contactPoints[k];
			const timber::PointState&   s  = pair.phys->states[k];
			timber::DashpotPoint&       p  = points[count++];
			p.bodyA         = id1;
			p.bodyB         = id2;
			p.armA          = at.position - x1;
			p.armB          = at.position - x2;
			p.normal        = at.normal;
			p.elasticNormal = s.normal;
			p.elasticShear  = s.shear;
			p.normalDamping = 2 * pair.phys->dampingRatio * math::sqrt(pair.phys->mass * s.stiffness);
			p.shearDamping  = p.normalDamping * rootShear;
			p.friction      = pair.phys->friction;
			p.impulse       = scene->dt * (s.normal * at.normal + s.shear + s.dashpot);
			p.response      = refresh ? timber::PointResponse() : s.response;
		}
	}
	points.resize(count);
}

void ContactForces::bookEnergy(const timber::DashpotPoint& p, timber::PointState& s, const ManifoldPhys& phys)
{
	const timber::DashpotBody &a = bodies[p.bodyA], &b = bodies[p.bodyB];
	const Vector3r             mean    = (p.before + timber::relativeVelocity(p, a.newVelocity, a.newSpin, b.newVelocity, b.newSpin)) / 2;
	const Real                 normal  = s.dashpot.dot(p.normal);
	const Real                 energy  = timber::shearEnergy(s, phys.properties());
	dashpotNormal -= scene->dt * normal * mean.dot(p.normal);
	dashpotShear -= scene->dt * (s.dashpot - normal * p.normal).dot(mean);
	friction -= s.slide.dot(s.shearBefore + s.shear) / 2 + energy - s.shearEnergyBefore;
	elasticShear += energy;
}

void ContactForces::storePoints()
{
	size_t k = 0;
	for (const Pair& pair : pairs) {
		for (size_t i = 0; i < pair.phys->states.size(); ++i, ++k) {
			timber::PointState&         s = pair.phys->states[i];
			timber::DashpotPoint&       p = points[k];
			const Vector3r              f = p.impulse / scene->dt;
			s.shear   = timber::limitedShear(s.shear, p.friction, f.dot(p.normal));
			s.dashpot = f - s.normal * p.normal - s.shear;
			s.response     = p.response;
			p.elasticShear = s.shear;
			force[p.bodyA] -= f;
			torque[p.bodyA] -= p.armA.cross(f);
			force[p.bodyB] += f;
			torque[p.bodyB] += p.armB.cross(f);
			if (!trackEnergy) continue;
			bookEnergy(p, s, *pair.phys);
			elasticNormal += s.energy;
		}
		lost += pair.phys->lostEnergy;
	}
}

void ContactForces::applyForces()
{
	for (size_t id = 0; id < bodies.size(); ++id) {
		if (bodies[id].inverseMass == 0) continue;
		scene->forces.addForce(id, force[id]);
		scene->forces.addTorque(id, torque[id]);
	}
}

Real ContactForces::elasticPower() const
{
	Real power = 0;
	for (const timber::DashpotPoint& p : points) {
		const shared_ptr<Body>&a = Body::byId(p.bodyA, scene), &b = Body::byId(p.bodyB, scene);
		if (!a || !b) continue; // taken out since the step
		power -= (p.elasticNormal * p.normal + p.elasticShear).dot(timber::relativeVelocity(p, a->state->vel, a->state->angVel, b->state->vel, b->state->angVel));
	}
	return power;
}

void ContactForces::action()
{
	elasticNormal = elasticShear = 0;
	collectPairs();
	collectBodies();
	collectPoints();
	sweepsDone += solver.solve(bodies, points, scene->dt, sweeps, tolerance);
	storePoints();
	applyForces();
}

Real ContactForces::largestEigenvalue(const boost::python::list& extra)
{
	scene = Omega::instance().getScene().get(); // not that of before a load
	collectPairs();
	collectBodies();
	std::vector<timber::StiffPoint> stiff;
	for (const Pair& pair : pairs) {
		const int id1 = pair.interaction->getId1(), id2 = pair.interaction->getId2();
		for (size_t k = 0; k < pair.phys->states.size(); ++k) {
			const timber::ContactPoint& at = pair.geom->contactPoints[k];
			const Real                  kn = pair.phys->states[k].stiffness;
			stiff.push_back({ id1, id2, at.position - Body::byId(id1, scene)->state->pos, at.position - Body::byId(id2, scene)->state->pos, at.normal, kn, pair.phys->shearRatio * kn });
		}
	}
	for (int k = 0; k < boost::python::len(extra); ++k) {
		const boost::python::tuple t   = boost::python::extract<boost::python::tuple>(extra[k]);
		const int                  id1 = boost::python::extract<int>(t[0]), id2 = boost::python::extract<int>(t[1]);
		const Vector3r             x = boost::python::extract<Vector3r>(t[2]);
		const Real                 stiffness = boost::python::extract<Real>(t[3]);
		stiff.push_back({ id1, id2, x - Body::byId(id1, scene)->state->pos, x - Body::byId(id2, scene)->state->pos, Vector3r::UnitZ(), stiffness, stiffness });
	}
	return timber::largestEigenvalue(bodies, stiff);
}

} // namespace yade
