// SPDX-License-Identifier: GPL-2.0-or-later
#include <HealthCheck.hpp>
#include <EnergyBalance.hpp>
#include <Integrator.hpp>
#include <JointEngine.hpp>
#include <bodies.hpp>
#include <SceneCheck.hpp>
#include <validation.hpp>

namespace yade {

YADE_PLUGIN((HealthCheck));

void HealthCheck::validate() const
{
	require(every >= 1, "HealthCheck.every", every, ">= 1");
	require(speedLimit > 0, "HealthCheck.speedLimit", speedLimit, "> 0");
	require(turnLimit > 0, "HealthCheck.turnLimit", turnLimit, "> 0");
}

namespace {
	constexpr Real defaultStep = 1e-8; ///< of a YADE scene whose O.dt was not set [s]
	/// Energy created by contacts and joints that is named, as a share of the energy put in [-], and what is not [J].
	constexpr Real createdLimit = 1e-4, negligibleEnergy = 1e-3;

	int classOf(const shared_ptr<Material>& m) { return m ? m->getClassIndex() : -1; }

	template <class Part> bool areSame(const boost::weak_ptr<Part>& checked, const shared_ptr<Part>& now)
	{
		return !checked.owner_before(now) && !now.owner_before(checked);
	}
}

HealthCheck::CheckedBody::CheckedBody(const Body& b)
        : shape(b.shape)
        , material(b.material)
        , materialClass(classOf(b.material))
        , state(b.state)
        , rounded(roundedShape(b))
        , geometry(rounded ? rounded->geometry : nullptr)
        , id(b.id)
        , clumpId(b.clumpId)
        , flags(b.flags)
        , mask(b.groupMask)
        , blockedDOFs(b.state->blockedDOFs)
        , mass(b.state->mass)
        , inertia(b.state->inertia)
{
}

bool HealthCheck::CheckedBody::canKeepContacts(const Body& b) const
{
	return areSame(shape, b.shape) && materialClass == classOf(b.material) && mask == b.groupMask;
}

bool HealthCheck::CheckedBody::isCurrent(const Body& b) const
{
	return areSame(shape, b.shape) && areSame(material, b.material) && areSame(state, b.state) && id == b.id
	        && clumpId == b.clumpId && flags == b.flags && mask == b.groupMask
	        && (!rounded || rounded->geometry == geometry) && blockedDOFs == b.state->blockedDOFs
	        && mass == b.state->mass && inertia == b.state->inertia;
}

bool HealthCheck::haveBodiesChanged() const
{
	const auto isCurrent = [](const boost::optional<CheckedBody>& checked, const shared_ptr<Body>& now) {
		return bool(checked) == bool(now) && (!now || checked->isCurrent(*now));
	};
	for (size_t id = 0; id < checkedBodies.size(); ++id)
		if (!isCurrent(checkedBodies[id], (*scene->bodies)[id])) return true;
	return false;
}

/// doSort: bodies were added or replaced since the collider ran.
bool HealthCheck::hasSceneChanged()
{
	findParts(*scene, parts);
	const JointEngine* joints = findEngine<JointEngine>(*scene);
	return scene->doSort || checkedStep != scene->dt || checkedBodies.size() != scene->bodies->size()
	        || checkedParts != parts || (joints && joints->jointSet().isChanged) || haveBodiesChanged();
}

/// Boxes, contacts and mass of a body would remain those of its old geometry.
void HealthCheck::checkGeometry(const Body& b) const
{
	const size_t id = b.getId();
	if (id >= checkedBodies.size() || !checkedBodies[id] || !areSame(checkedBodies[id]->shape, b.shape)) return;
	const CheckedBody& before = *checkedBodies[id];
	if (before.rounded && before.rounded->geometry != before.geometry)
		stopRun("body " + std::to_string(id)
		        + ": vertices or radius of its shape were changed in the scene. "
		          "Assign another shape to the body");
}

void HealthCheck::checkBodies() const
{
	for (size_t id = 0; id < scene->bodies->size(); ++id) {
		const Body* b = (*scene->bodies)[id].get();
		if (!b) continue;
		if (size_t(b->getId()) != id)
			stopRun("O.bodies[" + std::to_string(id) + "]: its id is " + std::to_string(b->getId())
			        + ": it must be its place in O.bodies");
		checkBody(*b);
		checkGeometry(*b);
	}
}

/// Removes the contacts of bodies whose shape, class of material or group is another one, and those of an earlier list
/// of bodies. The collider finds the present ones.
void HealthCheck::forgetContacts()
{
	InteractionContainer& contacts = *scene->interactions;
	const auto isOfEarlierList = [&](const shared_ptr<Interaction>& I) {
		const Body *b1 = bodyAt(*scene, I->getId1()), *b2 = bodyAt(*scene, I->getId2());
		const bool beyondEnd = size_t(math::max(I->getId1(), I->getId2())) >= scene->bodies->size();
		return beyondEnd || (b1 && b2 && contacts.find(I->getId1(), I->getId2()) != I);
	};
	if (std::any_of(contacts.begin(), contacts.end(), isOfEarlierList)) contacts.clear();
	for (size_t id = 0; id < math::min(checkedBodies.size(), scene->bodies->size()); ++id) {
		const Body* b = bodyAt(*scene, Body::id_t(id));
		if (!b || !checkedBodies[id] || checkedBodies[id]->canKeepContacts(*b)) continue;
		const auto ofBody = b->intrs; // a copy: `erase` changes it
		for (const auto& contact : ofBody)
			contacts.erase(contact.second->getId1(), contact.second->getId2(), contact.second->linIx);
		markPlaced(*scene, b->getId());
		contacts.dirty = true; // the collider looks at all pairs again
	}
	scene->doSort = true;
}

/// The integrator computes angular velocities from angular momenta: without one the velocity was set by hand.
void HealthCheck::takeOverRotations()
{
	for (const shared_ptr<Body>& b : *scene->bodies) {
		if (!b || !isFree(*b->state)) continue;
		State& s = *b->state;
		if (s.angMom.isZero(0) && !s.angVel.isZero(0))
			s.angMom = s.ori * s.inertia.cwiseProduct(s.ori.conjugate() * s.angVel);
	}
}

/// Engines store data of the bodies that is wrong in another scene.
void HealthCheck::checkScene()
{
	const shared_ptr<Scene>& current = Omega::instance().getScene();
	if (!checkedParts.empty() && checkedScene.lock() != current)
		stopRun("O.engines: the engines belong to an earlier scene. Set O.engines = "
		        "yade_timber.engines(...) again");
	checkBodies();
	checkEngines(*scene);
	checkContacts(*scene);
	checkStep(*scene);
	forgetContacts();
	checkedScene = current;
	checkedParts = parts;
	checkedStep = scene->dt;
	checkedBodies.assign(scene->bodies->size(), boost::none); // YADE's iterator skips erased bodies
	for (const shared_ptr<Body>& b : *scene->bodies)
		checkedBodies[b->getId()] = CheckedBody(*b);
}

/// Parts of a body are replaced between checks of the scene only; numbers of its state may change at any time.
void HealthCheck::checkState(const Body& b) const
{
	const State& s = *b.state;
	if (b.isClump() || (s.blockedDOFs != State::DOF_NONE && s.blockedDOFs != State::DOF_ALL) || !(s.mass > 0))
		checkBody(b);
	const bool turns = isFree(s) && !(s.angVel.norm() * scene->dt <= turnLimit);
	if (s.pos.allFinite() && s.vel.allFinite() && s.angVel.allFinite() && s.ori.coeffs().allFinite()
	        && s.vel.norm() <= speedLimit && !turns)
		return;
	checkBodies(); // another cause than the time step
	std::ostringstream message;
	message << "body " << b.getId() << " left the physical range before step " << scene->iter
	        << " (t = " << scene->time << " s): position " << s.pos.transpose() << " m, velocity "
	        << s.vel.transpose() << " m/s, angular velocity " << s.angVel.transpose() << " rad/s; the time step "
	        << scene->dt << " s is probably too large";
	stopRun(message.str());
}

void HealthCheck::action()
{
	if (!(scene->dt > 0 && std::isfinite(scene->dt)))
		stopRun("O.dt = " + std::to_string(scene->dt) + " s: it must be finite and > 0");
	if (scene->isPeriodic) stopRun("O.periodic = True: periodic cells are not supported");
	if (scene->dt == defaultStep && checkedStep != defaultStep)
		std::cerr << "O.dt = " << scene->dt
		          << " s is YADE's default, with which nothing seems to move; set O.dt, "
		          << "1e-4 for timber\n";
	const bool changed = hasSceneChanged();
	if (changed) checkScene();
	takeOverRotations();
	if (!changed && scene->iter % every != 0) return;
	check();
	if (!areFastNoted) noteFastBodies();
	if (!changed && !isCreatedNoted) noteCreated();
}

/// A body that moves by more than half its thickness in a step may pass through another one.
void HealthCheck::noteFastBodies()
{
	for (const shared_ptr<Body>& b : *scene->bodies) {
		const RoundedPolyhedron* shape = b ? roundedShape(*b) : nullptr;
		if (!shape) continue;
		const Real half = shape->radius + shape->geometry->coreHalfThickness,
		           way = b->state->vel.norm() * scene->dt;
		if (!(way > half)) continue;
		std::cerr << "body " << b->getId() << " moves by " << 1000 * way << " mm in a step, more than half its "
		          << "thickness of " << 2000 * half
		          << " mm, and may pass through what it hits: O.dt = " << scene->dt << " s is large for it\n";
		areFastNoted = true;
		return;
	}
}

/// The step is too large for a contact or joint.
void HealthCheck::noteCreated()
{
	const Real created = createdEnergy(*scene);
	if (!(created > negligibleEnergy)) return;
	const Real share = created / energyTurnover(*scene);
	if (!(share > createdLimit)) return;
	std::cerr << "t = " << scene->time << " s: contacts and joints have created " << created << " J, " << share
	          << " of the energy put in: O.dt = " << scene->dt << " s is large for them\n";
	isCreatedNoted = true;
}

void HealthCheck::check() const
{
	for (const shared_ptr<Body>& b : *scene->bodies)
		if (b) checkState(*b);
}

} // namespace yade
