// SPDX-License-Identifier: GPL-2.0-or-later
#include <ContactForces.hpp>
#include <kernel/threads.hpp>
#include <numeric>

namespace yade {

YADE_PLUGIN((ContactForces));

/// Steps for which a point's response is kept. A member that turns at 10 rad/s has turned by 0.03 rad by then; longer gains nothing.
constexpr int responseSteps = 32;

void ContactForces::sortPairs()
{
	const auto ids = [this](size_t k) { return std::minmax(found[k].id1, found[k].id2); };
	order.resize(found.size());
	std::iota(order.begin(), order.end(), 0);
	std::sort(order.begin(), order.end(), [&](size_t k, size_t l) { return ids(k) < ids(l); });
}

void ContactForces::collectPairs()
{
	static const int ours = ManifoldGeom::getClassIndexStatic();
	found.clear();
	for (const shared_ptr<Interaction>& I : *scene->interactions) {
		if (!I->isReal() || I->geom->getClassIndex() != ours) continue;
		ManifoldPhys& phys = *static_cast<ManifoldPhys*>(I->phys.get());
		if (!phys.isIdle()) found.push_back({ I->getId1(), I->getId2(), static_cast<ManifoldGeom*>(I->geom.get()), &phys, phys.states.size(), phys.lostEnergy });
	}
	const auto wasSame = [this](const Pair& p, size_t place) { return p.hasIdsOf(found[place]); };
	if (pairs.size() != found.size() || !std::equal(pairs.begin(), pairs.end(), order.begin(), wasSame)) sortPairs();
	pairs.resize(found.size());
	std::transform(order.begin(), order.end(), pairs.begin(), [this](size_t place) { return found[place]; });
}

void ContactForces::collectBody(Body::id_t id)
{
	const shared_ptr<Body>& b = (*scene->bodies)[id];
	if (!b) return;
	const State&         s   = *b->state;
	timber::SolverBody& own = bodies[id];
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

void ContactForces::findIslands()
{
	const auto end = [this](Body::id_t id) { return bodies[id].inverseMass > 0 ? id : ~id; };
	links.resize(pairs.size());
	std::transform(pairs.begin(), pairs.end(), links.begin(), [&](const Pair& p) { return p.points > 0 ? timber::Link(end(p.id1), end(p.id2)) : timber::noLink; });
	islands.find(bodies.size(), links);
}

void ContactForces::prepareContacts(timber::ContactSolver& solver, size_t k, const Pair& p)
{
	const Real inverseMass = timber::inverseMass(bodies[p.id1], bodies[p.id2]);
	if (inverseMass > 0) p.phys->mass = 1 / inverseMass; // bodies are held and released, and get other masses
	const bool refresh = (scene->iter + p.id1 + p.id2) % responseSteps == 0; // not all pairs in the same step, and the same ones after a load
	timber::prepareContacts(solver, k, bodies, p.phys->properties(), p.phys->dampingRatio, scene->dt, refresh, p.geom->contactPoints, p.phys->states);
}

void ContactForces::storeForces(const timber::ContactSolver& solver, size_t k, const Pair& p, timber::PairEnergies& books)
{
	const timber::PairForce f = timber::storeForces(solver, k, bodies, p.phys->properties(), scene->dt, p.phys->states, trackEnergy ? &books : nullptr);
	if (bodies[p.id1].inverseMass > 0) sums.add(p.id1, -f.onB, f.torqueA); // fixed bodies belong to several islands, which other threads work on
	if (bodies[p.id2].inverseMass > 0) sums.add(p.id2, f.onB, f.torqueB);
}

/// All of a step's work on an island, while it is in the processor's cache.
ContactForces::Result ContactForces::solve(timber::Islands::Island island)
{
	Result                 result;
	timber::ContactSolver& solver = solvers[timber::threadNumber()];
	const int              count  = int(island.size());
	solver.clear(sweeps);
	for (const int pair : island)
		solver.addPair(pairs[pair].id1, pairs[pair].id2, pairs[pair].points);
	timber::forAll(count, [&](int k) { prepareContacts(solver, k, pairs[island[k]]); });
	result.sweeps = solver.solve(bodies, tolerance);
	for (int k = 0; k < count; ++k)
		storeForces(solver, k, pairs[island[k]], result.books);
	return result;
}

void ContactForces::solveAll()
{
	const int count = int(islands.count());
	results.resize(count);
	solvers.resize(timber::threadCount());
	if (count > 0) timber::forAll(count, [this](int k) { results[k] = solve(islands[k]); }, int(pairs.size()) / count);
}

void ContactForces::sumResults()
{
	elasticNormal = elasticShear = elasticPower = 0;
	for (const Pair& pair : pairs)
		if (trackEnergy) lost += pair.lost;
	int most = 0;
	for (const Result& of : results) {
		dashpotNormal += of.books.dashpotNormal;
		dashpotShear += of.books.dashpotShear;
		friction += of.books.friction;
		elasticNormal += of.books.elasticNormal;
		elasticShear += of.books.elasticShear;
		elasticPower += of.books.elasticPower;
		most = std::max(most, of.sweeps);
	}
	sweepsDone += most;
}

void ContactForces::action()
{
	collectPairs();
	collectBodies();
	findIslands();
	solveAll();
	sumResults();
	sums.handOver(*scene);
}

Real ContactForces::largestEigenvalue(const boost::python::list& extra)
{
	scene = Omega::instance().getScene().get(); // not that of before a load
	collectPairs();
	collectBodies();
	std::vector<timber::StiffPoint> stiff;
	for (const Pair& pair : pairs) {
		const int id1 = pair.id1, id2 = pair.id2;
		for (size_t k = 0; k < pair.points; ++k) {
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
