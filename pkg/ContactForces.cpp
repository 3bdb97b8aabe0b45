// SPDX-License-Identifier: GPL-2.0-or-later
#include <ContactForces.hpp>
#include <kernel/threads.hpp>

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
	own.position = s.pos;
	own.velocity = own.newVelocity = s.vel;
	own.spin = own.newSpin = s.angVel;
	own.inverseMass        = 0;
	own.inverseInertia.setZero();
	if (!isFree(s)) return;
	const Matrix3r axes = s.ori.toRotationMatrix(), scaled = axes * s.inertia.cwiseInverse().asDiagonal();
	own.inverseMass     = 1 / s.mass;
	for (int i = 0; i < 3; ++i)
		for (int j = 0; j < 3; ++j)
			own.inverseInertia(i, j) = scaled.row(i).dot(axes.row(j)); // as a product of matrices Eigen calls a function for each
	own.newVelocity += scene->dt * own.inverseMass * scene->forces.getForce(id);
	own.newSpin += scene->dt * own.inverseInertia * scene->forces.getTorque(id);
}

void ContactForces::collectBodies()
{
	const int count = int(scene->bodies->size());
	bodies.resize(count);
	sums.clear(count);
	scene->forces.sync();
	timber::forAll(count, [this](int id) { collectBody(id); });
}

void ContactForces::collectPoints(size_t k)
{
	const Pair& pair = pairs[k];
	const int   id1 = pair.interaction->getId1(), id2 = pair.interaction->getId2();
	const Real  inverseMass = timber::inverseMass(bodies[id1], bodies[id2]);
	if (inverseMass > 0) pair.phys->mass = 1 / inverseMass; // bodies are held and released, and get other masses
	const bool  refresh = (scene->iter + id1 + id2) % responseSteps == 0; // not all pairs in the same step, and the same ones after a load
	timber::setRows(solver, k, bodies, pair.phys->properties(), pair.phys->dampingRatio, scene->dt, refresh, pair.geom->contactPoints, pair.phys->states);
}

void ContactForces::collectPoints()
{
	solver.clear(sweeps);
	for (const Pair& pair : pairs)
		solver.addPair(pair.interaction->getId1(), pair.interaction->getId2(), pair.phys->states.size());
	timber::forAll(int(pairs.size()), [this](int k) { collectPoints(k); });
}

void ContactForces::storePoints(size_t k, timber::PairEnergies& own)
{
	const timber::DashpotSolver::Pair& pair = solver.pair(k);
	ManifoldPhys&                      phys = *pairs[k].phys;
	const timber::PairForce            f    = timber::takeForces(solver, k, bodies, phys.properties(), scene->dt, phys.states, trackEnergy ? &own : nullptr);
	if (bodies[pair.bodyA].inverseMass > 0) sums.add(pair.bodyA, -f.onB, f.torqueA); // fixed bodies belong to several islands, which other threads work on
	if (bodies[pair.bodyB].inverseMass > 0) sums.add(pair.bodyB, f.onB, f.torqueB);
}

void ContactForces::storePoints()
{
	const int count = int(solver.islandCount());
	books.assign(count, timber::PairEnergies());
	timber::forAllUnlike(count, 1, [this](int island) {
		for (const int pair : solver.island(island))
			storePoints(pair, books[island]);
	});
}

void ContactForces::sumBooks()
{
	elasticNormal = elasticShear = elasticPower = 0;
	for (const Pair& pair : pairs)
		if (trackEnergy) lost += pair.phys->lostEnergy;
	for (const timber::PairEnergies& own : books) {
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
