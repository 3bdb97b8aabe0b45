// SPDX-License-Identifier: GPL-2.0-or-later
#include <ContactForces.hpp>
#include <JointEngine.hpp>
#include <kernel/constants.hpp>
#include <kernel/threads.hpp>
#include <validation.hpp>

namespace yade {

YADE_PLUGIN((ContactForces));

namespace {
	/// Placement, velocities, mass and inertia of a body; the new velocities are without its forces.
	void setBody(timber::SolverBody& body, const State& s)
	{
		body.position = s.pos;
		body.velocity = body.newVelocity = s.vel;
		body.spin = body.newSpin = s.angVel;
		body.axes = s.ori.toRotationMatrix();
		body.inverseMass = 0;
		body.inverseInertia.setZero();
		if (!isFree(s)) return;
		const Matrix3r scaled = body.axes * s.inertia.cwiseInverse().asDiagonal();
		body.inverseMass = 1 / s.mass;
		// Element by element: Eigen would call a function for the matrix product, which takes longer
		for (int i = 0; i < 3; ++i)
			for (int j = 0; j < 3; ++j)
				body.inverseInertia(i, j) = scaled.row(i).dot(body.axes.row(j));
	}

	/// Work of a body that moves in a step of h [s], against forces on it. [J]
	Real workAgainst(const BodyForces& forces, Body::id_t id, const State& s, Real h)
	{
		if (size_t(id) >= forces.force.size()) return 0;
		return -h * (forces.force[id].dot(s.vel) + forces.torque[id].dot(s.angVel));
	}

	/// Interactions with contact geometry, in the container's order.
	void findInteractions(const Scene& scene, std::vector<const Interaction*>& found)
	{
		static const int manifoldIndex = ManifoldGeom::getClassIndexStatic();
		found.clear();
		for (const shared_ptr<Interaction>& I : *scene.interactions)
			if (I->isReal() && I->geom->getClassIndex() == manifoldIndex) found.push_back(I.get());
	}

	void sortByIds(std::vector<const Interaction*>& interactions)
	{
		const auto isBefore = [](const Interaction* I, const Interaction* J) {
			return std::minmax({ I->getId1(), I->getId2() }) < std::minmax({ J->getId1(), J->getId2() });
		};
		if (!std::is_sorted(interactions.begin(), interactions.end(), isBefore))
			std::sort(interactions.begin(), interactions.end(), isBefore);
	}
}

void ContactForces::validate() const
{
	require(sweeps >= 0, "ContactForces.sweeps", sweeps, ">= 0");
	requirePositive("ContactForces.tolerance", tolerance);
}

/// Pairs with contact points or released energy.
void ContactForces::findPairs(const std::vector<const Interaction*>& interactions, std::vector<ContactPair>& contacts)
{
	contacts.clear();
	for (const Interaction* I : interactions) {
		ManifoldPhys& phys = *static_cast<ManifoldPhys*>(I->phys.get());
		if (!phys.isIdle())
			contacts.push_back({ I->getId1(), I->getId2(), static_cast<ManifoldGeom*>(I->geom.get()), &phys,
			        phys.isActing ? phys.records.size() : 0, phys.releasedEnergy, phys.placedEnergy });
	}
}

std::vector<ContactForces::ContactPair> ContactForces::pairsOf(const Scene& scene)
{
	std::vector<const Interaction*> interactions;
	findInteractions(scene, interactions);
	sortByIds(interactions);
	std::vector<ContactPair> contacts;
	findPairs(interactions, contacts);
	return contacts;
}

/// The sorted list stays valid while the container is the same. It is sorted again if a new interaction has the address
/// of an erased one.
void ContactForces::collectPairs()
{
	findInteractions(*scene, found);
	if (found != unordered) {
		unordered = found;
		interactions = found;
	}
	sortByIds(interactions);
	findPairs(interactions, pairs);
}

void ContactForces::collectBody(Body::id_t id)
{
	const shared_ptr<Body>& b = (*scene->bodies)[id];
	timber::SolverBody& body = bodies[id];
	body.inverseMass = 0;
	if (!b) return;
	setBody(body, *b->state);
	if (body.inverseMass == 0) return;
	body.newVelocity += scene->dt * body.inverseMass * scene->forces.getForce(id);
	body.newSpin += scene->dt * body.inverseInertia * scene->forces.getTorque(id);
}

void ContactForces::collectBodies()
{
	const int count = int(scene->bodies->size());
	bodies.resize(count);
	sums.clear(count);
	syncForces(*scene);
	timber::forAll(count, [this](int id) { collectBody(id); });
}

/// Bodies must not be placed with larger overlaps than weights cause: their springs would throw them apart.
void ContactForces::checkPlacements() const
{
	for (const ContactPair& pair : pairs)
		if (pair.placed > 0 && pair.phys->placedOverlap > timber::largestPlacedOverlap)
			stopRun("bodies " + std::to_string(pair.id1) + " and " + std::to_string(pair.id2)
			        + " were placed with an overlap of " + std::to_string(1000 * pair.phys->placedOverlap)
			        + " mm: at most " + std::to_string(1000 * timber::largestPlacedOverlap)
			        + " mm; move one of them");
}

void ContactForces::findIslands()
{
	const auto nodeOf = [this](Body::id_t id) { return bodies[id].inverseMass > 0 ? id : ~id; };
	links.resize(pairs.size() + joints.size());
	std::transform(pairs.begin(), pairs.end(), links.begin(), [&](const ContactPair& p) {
		return p.points > 0 ? timber::Link(nodeOf(p.id1), nodeOf(p.id2)) : timber::noLink;
	});
	std::transform(joints.begin(), joints.end(), links.begin() + pairs.size(),
	        [&](const ImplicitJoint& j) { return timber::Link(nodeOf(j.joint->bodyA), nodeOf(j.joint->bodyB)); });
	islands.find(bodies.size(), links);
	supports.clear();
	for (size_t k = 0; k < links.size(); ++k)
		if (math::min(links[k].first, links[k].second) < 0) supports.push_back(k);
	linkForces.resize(links.size());
}

/// A fixed body may belong to several islands, which other threads solve: sumSupports() adds its forces.
void ContactForces::addForce(size_t link, const timber::PairForce& f)
{
	const auto [a, b] = links[link];
	if (a >= 0) sums.add(a, -f.onB, f.torqueA);
	if (b >= 0) sums.add(b, f.onB, f.torqueB);
	if (math::min(a, b) < 0) linkForces[link] = f;
}

/// Forces on fixed bodies, in the order of the links: they do not depend on the number of threads.
void ContactForces::sumSupports()
{
	for (const size_t link : supports) {
		const timber::PairForce& f = linkForces[link];
		const auto [a, b] = links[link];
		if (a < 0) sums.add(~a, -f.onB, f.torqueA);
		if (b < 0) sums.add(~b, f.onB, f.torqueB);
	}
}

/// Work of fixed bodies that move, against the forces of contacts and joints on them.
void ContactForces::addImposedWork()
{
	const JointEngine* springs = findEngine<JointEngine>(*scene);
	for (const shared_ptr<Body>& b : *scene->bodies) {
		if (!b || isFree(*b->state) || (b->state->vel.isZero(0) && b->state->angVel.isZero(0))) continue;
		const Body::id_t id = b->getId();
		imposedWork += workAgainst(sums, id, *b->state, scene->dt);
		if (springs) imposedWork += workAgainst(springs->forces(), id, *b->state, scene->dt);
	}
}

/// All phases of the solver (contact_solver.hpp) for one island, while it is in the processor's cache.
ContactForces::IslandResult ContactForces::solveIsland(timber::Islands::Island island)
{
	IslandResult result;
	timber::ContactSolver& solver = solvers[timber::threadNumber()];
	const int count = int(island.size()),
	          pairCount = int(std::lower_bound(island.begin(), island.end(), int(pairs.size())) - island.begin());
	const auto pair = [&](int k) -> const ContactPair& { return pairs[island[k]]; };
	const auto joint = [&](int k) -> ImplicitJoint& { return joints[island[k] - int(pairs.size())]; };
	solver.begin(bodies, scene->dt, sweeps);
	for (int k = 0; k < pairCount; ++k)
		solver.addPair(pair(k).id1, pair(k).id2, pair(k).points);
	for (int k = pairCount; k < count; ++k)
		addJoint(solver, joint(k));
	timber::forAll(count, [&](int k) {
		if (k < pairCount)
			timber::prepareContacts(solver, k, pair(k).phys->properties(), pair(k).geom->contactPoints,
			        pair(k).phys->records);
		else prepareJoint(solver, joint(k), bodies);
	});
	result.convergence = solver.solve(tolerance);
	for (int k = 0; k < pairCount; ++k) {
		const timber::PairForce f = timber::storeForces(
		        solver, k, pair(k).phys->properties(), pair(k).phys->records, result.energies);
		pair(k).phys->normalForce = f.normalOnB;
		pair(k).phys->shearForce = f.onB - f.normalOnB;
		addForce(island[k], f);
	}
	for (int k = pairCount; k < count; ++k)
		addForce(island[k], storeJoint(solver, joint(k), bodies, result.joints));
	return result;
}

void ContactForces::solveAll()
{
	const int count = int(islands.count());
	results.resize(count);
	solvers.resize(timber::threadCount());
	if (count > 0)
		timber::forAll(
		        count, [this](int k) { results[k] = solveIsland(islands[k]); }, int(links.size()) / count);
}

void ContactForces::sumResults()
{
	elasticNormal = elasticShear = 0;
	for (const ContactPair& pair : pairs) {
		placed += pair.placed;
		released += math::max(Real(0), pair.released);
		created += math::max(Real(0), Real(-pair.released));
	}
	int mostSweeps = 0;
	Real largestChange = 0;
	ImplicitJointResult solvedJoints;
	bool allConverged = true;
	for (const IslandResult& result : results) {
		dashpotNormal += result.energies.dashpotNormal;
		dashpotShear += result.energies.dashpotShear;
		friction += result.energies.friction;
		crushing += result.energies.crushing;
		elasticNormal += result.energies.elasticNormal;
		elasticShear += result.energies.elasticShear;
		solvedJoints.add(result.joints);
		mostSweeps = std::max(mostSweeps, result.convergence.sweeps);
		allConverged = allConverged && result.convergence.converged;
		largestChange = std::max(largestChange, result.convergence.change);
	}
	sweepsDone += mostSweeps;
	sweepsMax = std::max(sweepsMax, mostSweeps);
	if (!allConverged) ++unconverged;
	worstChange = std::max(worstChange, largestChange);
	addJoints(solvedJoints);
}

/// Energies and breaks of the joints in the solver.
void ContactForces::addJoints(const ImplicitJointResult& result)
{
	elasticJoints = result.stored;
	jointDashpot += result.dashpots;
	jointDebt = result.debt;
	JointEngine* engine = findEngine<JointEngine>(*scene);
	if (!engine) return;
	engine->yielded += result.yielded;
	engine->released += result.released;
	std::vector<ImplicitBreak> breaks = result.breaks;
	std::sort(breaks.begin(), breaks.end(), [](const ImplicitBreak& a, const ImplicitBreak& b) {
		return std::pair(a.joint, a.spring.spring) < std::pair(b.joint, b.spring.spring);
	});
	for (const ImplicitBreak& one : breaks)
		engine->breakSpring(one.joint, one.spring);
}

/// YADE's container of forces is not saved.
void ContactForces::preSave(ContactForces&)
{
	const shared_ptr<Scene>& current = Omega::instance().getScene();
	if (findEngine<ContactForces>(*current, true) != this || !current->forces.getPermForceUsed()) return;
	syncForces(*current); // before it, forces of bodies that were appended since are not found
	const size_t count = current->bodies->size();
	permanentForces.assign(count, Vector3r::Zero());
	permanentTorques.assign(count, Vector3r::Zero());
	for (const shared_ptr<Body>& b : *current->bodies) {
		if (!b) continue;
		permanentForces[b->getId()] = current->forces.getPermForce(b->getId());
		permanentTorques[b->getId()] = current->forces.getPermTorque(b->getId());
	}
}

/// After loading, in the first step: permanent forces that were set since then replace those of the file.
void ContactForces::restorePermanentForces()
{
	const bool areOthersSet = scene->forces.getPermForceUsed();
	for (size_t id = 0; id < permanentForces.size() && !areOthersSet; ++id) {
		scene->forces.setPermForce(id, permanentForces[id]);
		scene->forces.setPermTorque(id, permanentTorques[id]);
	}
	permanentForces.clear();
	permanentTorques.clear();
}

void ContactForces::action()
{
	if (!permanentForces.empty()) restorePermanentForces();
	collectPairs();
	checkPlacements();
	collectBodies();
	const ImplicitJointResult lost = findImplicitJoints(*scene, bodies, sweeps > 0, joints);
	jointDashpot += lost.dashpots;
	created += lost.debt;
	findIslands();
	solveAll();
	sumResults();
	sumSupports();
	addImposedWork();
	sums.handOver(*scene);
}

std::vector<timber::SolverBody> ContactForces::placements(const Scene& scene)
{
	std::vector<timber::SolverBody> states(scene.bodies->size());
	for (const shared_ptr<Body>& b : *scene.bodies)
		if (b) setBody(states[b->getId()], *b->state);
	return states;
}

std::vector<timber::PointSpring> ContactForces::linearSprings(
        const Scene& scene, const std::vector<timber::SolverBody>& bodies)
{
	std::vector<timber::PointSpring> springs;
	for (const ContactPair& pair : pairsOf(scene))
		for (size_t k = 0; k < pair.points; ++k) {
			const timber::ContactPoint& at = pair.geom->contactPoints[k];
			const timber::PointRecord& record = pair.phys->records[k];
			const Real kn = record.stiffness;
			springs.push_back({ pair.id1, pair.id2, at.position - bodies[pair.id1].position,
			        at.position - bodies[pair.id2].position, at.normal, kn, pair.phys->shearRatio * kn,
			        record.normalForce * at.normal + record.shearForce });
		}
	if (const JointEngine* joints = findEngine<JointEngine>(scene)) joints->addSprings(scene, springs);
	return springs;
}

Real ContactForces::dashpotPower(const Scene& scene, const std::vector<timber::SolverBody>& bodies)
{
	Real power = yade::dashpotPower(scene, bodies);
	for (const ContactPair& pair : pairsOf(scene)) {
		const timber::SolverBody &a = bodies[pair.id1], &b = bodies[pair.id2];
		const timber::PairProperties properties = pair.phys->properties();
		for (size_t k = 0; k < pair.points; ++k) {
			const timber::ContactPoint& at = pair.geom->contactPoints[k];
			const Vector3r u = timber::relativeVelocity<double>(at.position - a.position,
			        at.position - b.position, a.velocity, a.spin, b.velocity, b.spin);
			const Real along = u.dot(at.normal),
			           cn = timber::normalDamping<double>(properties, pair.phys->records[k].stiffness),
			           cs = timber::shearDamping<double>(properties, cn);
			power += cn * along * along + cs * (u.squaredNorm() - along * along);
		}
	}
	return power;
}

Real ContactForces::largestEigenvalue() const
{
	// An engine of a loaded scene has no scene before its first step
	const Scene& now = *Omega::instance().getScene();
	const std::vector<timber::SolverBody> masses = placements(now);
	return timber::largestEigenvalue(masses, linearSprings(now, masses));
}

} // namespace yade
