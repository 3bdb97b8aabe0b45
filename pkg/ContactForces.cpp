// SPDX-License-Identifier: GPL-2.0-or-later
#include <ContactForces.hpp>
#include <threads.hpp>

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
		if (static_cast<ManifoldPhys*>(I->phys.get())->isIdle()) continue;
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

void ContactForces::collectBody(Body::id_t id)
{
	const shared_ptr<Body>& b = (*scene->bodies)[id];
	if (!b) return;
	const State&         s   = *b->state;
	timber::DashpotBody& own = bodies[id];
	own.velocity = own.newVelocity = s.vel;
	own.spin = own.newSpin = s.angVel;
	own.inverseMass        = 0;
	own.inverseInertia.setZero();
	if (!isFree(s)) return;
	const Matrix3r axes = s.ori.toRotationMatrix();
	own.inverseMass     = 1 / s.mass;
	own.inverseInertia  = axes * s.inertia.cwiseInverse().asDiagonal() * axes.transpose();
	own.newVelocity += scene->dt * own.inverseMass * scene->forces.getForce(id);
	own.newSpin += scene->dt * own.inverseInertia * scene->forces.getTorque(id);
}

void ContactForces::collectBodies()
{
	const int count = int(scene->bodies->size());
	bodies.resize(count);
	sums.clear(count);
	scene->forces.sync();
#pragma omp parallel for schedule(static) if (count > smallLoop)
	for (int id = 0; id < count; ++id)
		collectBody(id);
}

void ContactForces::collectPoints(size_t k)
{
	const Pair&    pair = pairs[k];
	const int      id1 = pair.interaction->getId1(), id2 = pair.interaction->getId2();
	const Vector3r x1 = Body::byId(id1, scene)->state->pos, x2 = Body::byId(id2, scene)->state->pos;
	const Real     rootShear = math::sqrt(pair.phys->shearRatio);
	const bool     refresh   = (scene->iter + id1 + id2) % responseSteps == 0; // not all pairs in the same step, and the same ones after a load
	size_t         row       = solver.pair(k).first;
	for (size_t i = 0; i < pair.phys->states.size(); ++i, ++row) {
		const timber::ContactPoint& at = pair.geom->contactPoints[i];
		timber::PointState&         s  = pair.phys->states[i];
		timber::DashpotPoint        p;
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
		solver.set(row, bodies, p, scene->dt);
		s.response = p.response;
	}
}

void ContactForces::collectPoints()
{
	solver.clear(sweeps);
	for (const Pair& pair : pairs)
		solver.addPair(pair.interaction->getId1(), pair.interaction->getId2(), pair.phys->states.size());
	const int count = int(pairs.size());
#pragma omp parallel for schedule(static) if (count > smallLoop)
	for (int k = 0; k < count; ++k)
		collectPoints(k);
}

void ContactForces::bookEnergy(
        const timber::DashpotSolver::Row& row, const timber::DashpotBody& a, const timber::DashpotBody& b, timber::PointState& s, const ManifoldPhys& phys, Books& own) const
{
	const Vector3r after  = timber::relativeVelocity(row, a.newVelocity, a.newSpin, b.newVelocity, b.newSpin);
	const Vector3r mean   = (row.before + after) / 2;
	const Real     normal = s.dashpot.dot(row.normal);
	const Real     energy = timber::shearEnergy(s, phys.properties());
	own.dashpotNormal -= scene->dt * normal * mean.dot(row.normal);
	own.dashpotShear -= scene->dt * (s.dashpot - normal * row.normal).dot(mean);
	own.friction -= s.slide.dot(s.shearBefore + s.shear) / 2 + energy - s.shearEnergyBefore;
	own.elasticNormal += s.energy;
	own.elasticShear += energy;
	own.elasticPower -= (s.normal * row.normal + s.shear).dot(after);
}

void ContactForces::storePoints(size_t k, Books& own)
{
	const Pair&                        pair = pairs[k];
	const timber::DashpotSolver::Pair& rows = solver.pair(k);
	const timber::DashpotBody &        a = bodies[rows.bodyA], &b = bodies[rows.bodyB];
	Vector3r                           sum = Vector3r::Zero(), torqueA = Vector3r::Zero(), torqueB = Vector3r::Zero();
	for (size_t i = 0; i < rows.count; ++i) {
		const timber::DashpotSolver::Row& row = solver.row(rows.first + i);
		timber::PointState&               s   = pair.phys->states[i];
		const Vector3r                    f   = row.impulse / scene->dt;
		s.shear   = timber::limitedShear(s.shear, row.friction, f.dot(row.normal));
		s.dashpot = f - s.normal * row.normal - s.shear;
		sum += f;
		torqueA -= row.armA.cross(f);
		torqueB += row.armB.cross(f);
		if (trackEnergy) bookEnergy(row, a, b, s, *pair.phys, own);
	}
	if (a.inverseMass > 0) sums.add(rows.bodyA, -sum, torqueA); // fixed bodies belong to several islands, which other threads work on
	if (b.inverseMass > 0) sums.add(rows.bodyB, sum, torqueB);
}

void ContactForces::storePoints()
{
	const int count = int(solver.islandCount());
	books.assign(count, Books());
#pragma omp parallel for schedule(dynamic) if (count > 1)
	for (int island = 0; island < count; ++island)
		for (const int pair : solver.island(island))
			storePoints(pair, books[island]);
}

void ContactForces::sumBooks()
{
	elasticNormal = elasticShear = elasticPower = 0;
	for (const Pair& pair : pairs)
		lost += pair.phys->lostEnergy;
	for (const Books& own : books) {
		dashpotNormal += own.dashpotNormal;
		dashpotShear += own.dashpotShear;
		friction += own.friction;
		elasticNormal += own.elasticNormal;
		elasticShear += own.elasticShear;
		elasticPower += own.elasticPower;
	}
}

void ContactForces::action()
{
	collectPairs();
	collectBodies();
	collectPoints();
	sweepsDone += solver.solve(bodies, tolerance);
	storePoints();
	sumBooks();
	sums.handOver(*scene);
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
		const Body *               b1 = bodyAt(*scene, id1), *b2 = bodyAt(*scene, id2);
		if (b1 && b2) stiff.push_back({ id1, id2, x - b1->state->pos, x - b2->state->pos, Vector3r::UnitZ(), stiffness, stiffness });
	}
	return timber::largestEigenvalue(bodies, stiff);
}

} // namespace yade
