// SPDX-License-Identifier: GPL-2.0-or-later
#include <ContactForces.hpp>

namespace yade {

YADE_PLUGIN((ContactForces));

void ContactForces::collectPairs()
{
	pairs.clear();
	for (const shared_ptr<Interaction>& I : *scene->interactions) {
		if (!I->isReal()) continue;
		ManifoldPhys* phys = dynamic_cast<ManifoldPhys*>(I->phys.get());
		if (phys && (!phys->states.empty() || phys->lostEnergy != 0)) pairs.push_back({ I.get(), static_cast<ManifoldGeom*>(I->geom.get()), phys });
	}
	const auto ids = [](const Pair& p) { return std::minmax(p.interaction->getId1(), p.interaction->getId2()); };
	std::sort(pairs.begin(), pairs.end(), [&](const Pair& p, const Pair& q) { return ids(p) < ids(q); });
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
	points.clear();
	for (const Pair& pair : pairs) {
		const int      id1 = pair.interaction->getId1(), id2 = pair.interaction->getId2();
		const Vector3r x1 = Body::byId(id1, scene)->state->pos, x2 = Body::byId(id2, scene)->state->pos;
		for (size_t k = 0; k < pair.phys->states.size(); ++k) {
			const timber::ContactPoint& at = pair.geom->points[k];
			const timber::PointState&   s  = pair.phys->states[k];
			timber::DashpotPoint        p {};
			p.bodyA          = id1;
			p.bodyB          = id2;
			p.armA           = at.position - x1;
			p.armB           = at.position - x2;
			p.normal         = at.normal;
			p.elasticNormal  = s.normal;
			p.elasticShear   = s.shear;
			p.normalDamping  = 2 * pair.phys->dampingRatio * math::sqrt(pair.phys->mass * s.stiffness);
			p.shearDamping   = p.normalDamping * math::sqrt(pair.phys->shearRatio);
			p.friction       = pair.phys->friction;
			p.impulse        = scene->dt * (s.normal * at.normal + s.shear + s.dashpot);
			points.push_back(p);
		}
	}
}

void ContactForces::bookEnergy(const timber::DashpotPoint& p, timber::PointState& s, const ManifoldPhys& phys)
{
	const timber::DashpotBody &a = bodies[p.bodyA], &b = bodies[p.bodyB];
	const Vector3r             mean    = (p.before + timber::relativeVelocity(p, a.newVelocity, a.newSpin, b.newVelocity, b.newSpin)) / 2;
	const Real                 normal  = s.dashpot.dot(p.normal);
	const Real                 energy  = timber::shearEnergy(s, phys.properties());
	dashpotNormalPending -= scene->dt * normal * mean.dot(p.normal);
	dashpotShearPending -= scene->dt * (s.dashpot - normal * p.normal).dot(mean);
	friction -= s.slide.dot(s.shearBefore + s.shear) / 2 + energy - s.shearEnergyBefore;
	elasticShearNow += energy;
}

void ContactForces::storePoints()
{
	size_t k = 0;
	for (const Pair& pair : pairs) {
		for (size_t i = 0; i < pair.phys->states.size(); ++i, ++k) {
			timber::PointState&         s = pair.phys->states[i];
			const timber::DashpotPoint& p = points[k];
			const Vector3r              f = p.impulse / scene->dt;
			s.shear   = timber::limitedShear(s.shear, p.friction, f.dot(p.normal));
			s.dashpot = f - s.normal * p.normal - s.shear;
			force[p.bodyA] -= f;
			torque[p.bodyA] -= p.armA.cross(f);
			force[p.bodyB] += f;
			torque[p.bodyB] += p.armB.cross(f);
			if (!trackEnergy) continue;
			bookEnergy(p, s, *pair.phys);
			elasticNormalNow += pair.phys->normalEnergy(s, pair.geom->points[i].overlap);
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

void ContactForces::action()
{
	dashpotNormal += dashpotNormalPending;
	dashpotShear += dashpotShearPending;
	dashpotNormalPending = dashpotShearPending = 0;
	elasticNormalLast = elasticNormalNow;
	elasticShearLast  = elasticShearNow;
	elasticNormalNow = elasticShearNow = 0;
	collectPairs();
	collectBodies();
	collectPoints();
	timber::solveDashpots(bodies, points, scene->dt, sweeps);
	storePoints();
	applyForces();
}

} // namespace yade
