// SPDX-License-Identifier: GPL-2.0-or-later
#include <CollisionTrigger.hpp>
#include <ContactForces.hpp>
#include <ContactLoop.hpp>
#include <Gravity.hpp>
#include <JointEngine.hpp>
#include <Materials.hpp>
#include <SceneCheck.hpp>
#include <Shape.hpp>
#include <bodies.hpp>
#include <validation.hpp>
#include <core/InteractionLoop.hpp>
#include <pkg/common/InsertionSortCollider.hpp>
#include <pkg/common/ParallelEngine.hpp>
#include <iomanip>
#include <set>

namespace yade {

namespace {
	bool isKindOf(const string& name, const string& base)
	{
		return name == base || Omega::instance().isInheritingFrom_recursive(name, base);
	}

	/// Task of an engine.
	struct Role {
		/// Place in the list: engines of a lower rank come before those of a higher one.
		enum Rank { beforeCollider, collision, contacts, forces, contactForces, integration, monitors, last };
		enum Number { optional, required, repeatable };
		const char* name;
		Rank rank;
		Number number;
		std::vector<const char*> classes;
	};
	const std::vector<Role> roles {
		{ "HealthCheck", Role::beforeCollider, Role::optional, { "HealthCheck" } },
		{ "ForceResetter", Role::beforeCollider, Role::required, { "ForceResetter" } },
		{ "a collider (CollisionTrigger)", Role::collision, Role::required,
		        { "CollisionTrigger", "Collider" } },
		{ "a contact loop (ContactLoop)", Role::contacts, Role::required,
		        { "ContactLoop", "InteractionLoop" } },
		{ "OverlapCheck", Role::forces, Role::optional, { "OverlapCheck" } },
		{ "JointEngine", Role::forces, Role::optional, { "JointEngine" } },
		{ "gravity", Role::forces, Role::optional, { "UniformGravity", "GravityEngine" } },
		{ "GroundMotionEngine", Role::forces, Role::optional, { "GroundMotionEngine" } },
		{ "ContactForces", Role::contactForces, Role::required, { "ContactForces" } },
		{ "an integrator (SymplecticIntegrator)", Role::integration, Role::required,
		        { "SymplecticIntegrator" } },
		{ "Sampler", Role::monitors, Role::repeatable, { "Sampler" } },
		{ "RestSkipper", Role::last, Role::optional, { "RestSkipper" } },
	};

	/// Null for an engine whose place in the list is free.
	const Role* roleOf(const Engine& engine)
	{
		const string name = engine.getClassName();
		const auto match = [&](const Role& role) {
			return std::any_of(role.classes.begin(), role.classes.end(),
			        [&](const char* base) { return isKindOf(name, base); });
		};
		const auto place = std::find_if(roles.begin(), roles.end(), match);
		return place == roles.end() ? nullptr : &*place;
	}

	/// Classes of YADE that must not run beside the package's engines, also inside a ParallelEngine.
	struct ForeignEngine {
		const char *base, *remedy;
	};
	const std::vector<ForeignEngine> foreignEngines {
		{ "NewtonIntegrator",
		        "would move the bodies a second time. Remove it: SymplecticIntegrator moves them" },
		{ "Integrator", "would move the bodies a second time. Remove it: SymplecticIntegrator moves them" },
		{ "TimeStepper",
		        "would change the time step, and finds no stiffness in these contacts. Remove it and "
		        "set O.dt" },
	};

	[[noreturn]] void refuseEngines(const string& fault)
	{
		stopRun("O.engines: " + fault + ". yade_timber.engines() gives a valid list");
	}

	[[noreturn]] void refuseBody(const Body& b, const string& fault)
	{
		stopRun("body " + std::to_string(b.getId()) + ": " + fault);
	}

	/// Visits live engines, and those inside them.
	template <class Visit> void visitLive(const std::vector<shared_ptr<Engine>>& engines, const Visit& visit)
	{
		for (const shared_ptr<Engine>& engine : engines) {
			if (!engine) refuseEngines("None stands in the list");
			if (engine->dead) continue;
			visit(*engine);
			if (const auto* parallel = dynamic_cast<const ParallelEngine*>(engine.get()))
				for (const auto& group : parallel->slaves)
					visitLive(group, visit);
		}
	}

	/// Whether an engine stands in the list itself, not inside another engine.
	bool isListed(const Scene& scene, const Engine* engine)
	{
		return std::any_of(
		        scene.engines.begin(), scene.engines.end(), [=](const auto& e) { return e.get() == engine; });
	}

	void refuseForeign(const Engine& engine)
	{
		for (const ForeignEngine& foreign : foreignEngines)
			if (isKindOf(engine.getClassName(), foreign.base))
				refuseEngines(engine.getClassName() + " " + foreign.remedy);
	}

	/// What YADE's VTKRecorder may record: the others read contacts as if they were those of spheres.
	const std::set<string> recordable { "spheres", "facets", "boxes", "velocity", "force", "mass", "id", "mask",
		"clumpId", "materialId", "colors", "coordNumber", "pericell" };

	void checkRecorder(const Engine& engine)
	{
		if (!isKindOf(engine.getClassName(), "VTKRecorder")) return;
		const gilLock lock;
		const py::list recorders(engine.pyDict()["recorders"]);
		for (int k = 0; k < py::len(recorders); ++k) {
			const string name = py::extract<string>(recorders[k]);
			if (recordable.count(name) == 0)
				refuseEngines("VTKRecorder records '" + name
				        + "', which reads contacts as those of spheres and would end the session. "
				          "Remove it from recorders; scripts/show/export_vtk.py exports a run");
		}
	}

	/// The scene's contact loop, alone or in a ContactLoop.
	const InteractionLoop& findLoop(const Scene& scene)
	{
		const auto* wrapper = findEngine<ContactLoop>(scene);
		const auto* loop = wrapper ? dynamic_cast<InteractionLoop*>(wrapper->loop.get())
		                           : findEngine<InteractionLoop>(scene);
		if (!loop) refuseEngines("ContactLoop.loop is no InteractionLoop");
		if (!loop->geomDispatcher || !loop->physDispatcher || !loop->lawDispatcher)
			refuseEngines("the InteractionLoop has no geomDispatcher, physDispatcher or lawDispatcher");
		return *loop;
	}

	/// The scene's collider, alone or in a CollisionTrigger.
	const Collider& findCollider(const Scene& scene)
	{
		const auto* wrapper = findEngine<CollisionTrigger>(scene);
		const auto* collider
		        = wrapper ? dynamic_cast<Collider*>(wrapper->collider.get()) : findEngine<Collider>(scene);
		if (!collider) refuseEngines("CollisionTrigger.collider is no collider");
		if (!collider->boundDispatcher) refuseEngines("the collider has no boundDispatcher");
		return *collider;
	}

	/// YADE's collider takes the speeds for its own margin from a NewtonIntegrator.
	void checkMargin(const Collider& collider)
	{
		const auto* sorting = dynamic_cast<const InsertionSortCollider*>(&collider);
		if (!sorting || !(sorting->verletDist > 0)) return;
		std::ostringstream fault;
		fault << "InsertionSortCollider.verletDist = " << sorting->verletDist
		      << " m: it must be 0, since the boxes have Bo1_RoundedPolyhedron_Aabb.margin";
		refuseEngines(fault.str());
	}

	/// Whether one of the functors takes a pair of classes, in either order.
	template <class Functors> bool dispatches(const Functors& functors, const string& a, const string& b)
	{
		return std::any_of(functors.begin(), functors.end(), [&](const auto& f) {
			const string first = f->get2DFunctorType1(), second = f->get2DFunctorType2();
			return (isKindOf(a, first) && isKindOf(b, second))
			        || (isKindOf(b, first) && isKindOf(a, second));
		});
	}

	/// One body of each combination of shape, material and group. Bodies without a shape or a bounding box never
	/// touch others.
	std::vector<const Body*> kindsOfBodies(const Scene& scene)
	{
		std::set<std::tuple<int, int, mask_t>> combinations;
		std::vector<const Body*> kinds;
		for (const shared_ptr<Body>& b : *scene.bodies)
			if (b && b->shape && b->isBounded()
			        && combinations
			                   .emplace(b->shape->getClassIndex(),
			                           b->material ? b->material->getClassIndex() : -1, b->groupMask)
			                   .second)
				kinds.push_back(b.get());
		return kinds;
	}

	[[noreturn]] void refusePair(const Body& a, const Body& b, const char* functor, const string& classA,
	        const string& classB, const string& remedy = "")
	{
		stopRun("bodies " + std::to_string(a.getId()) + " and " + std::to_string(b.getId())
		        + ": the InteractionLoop has no " + functor + " functor for " + classA + " and " + classB
		        + remedy);
	}

	/// Null if there is no law for the two materials.
	const ContactLaw* findLaw(const string& a, const string& b)
	{
		const auto matches = [&](const ContactLaw& law) {
			return (isKindOf(a, law.material1) && isKindOf(b, law.material2))
			        || (isKindOf(b, law.material1) && isKindOf(a, law.material2));
		};
		const auto place = std::find_if(contactLaws.begin(), contactLaws.end(), matches);
		return place == contactLaws.end() ? nullptr : &*place;
	}

	/// A functor of a base class is not enough: Ip2_ElementMat_ElementMat_SnowPhys would give timber an infinite
	/// stiffness.
	bool hasIp2(const InteractionLoop& loop, const ContactLaw& law)
	{
		const auto& functors = loop.physDispatcher->functors;
		return std::any_of(functors.begin(), functors.end(), [&](const auto& f) {
			return f->get2DFunctorType1() == law.argument && f->get2DFunctorType2() == law.argument;
		});
	}

	void checkPair(const InteractionLoop& loop, const Body& a, const Body& b)
	{
		const string shapeA = a.shape->getClassName(), shapeB = b.shape->getClassName();
		const bool areRounded = roundedShape(a) && roundedShape(b);
		if (!dispatches(loop.geomDispatcher->functors, shapeA, shapeB))
			refusePair(a, b, "Ig2", shapeA, shapeB,
			        areRounded ? ""
			                   : ". In place of " + (roundedShape(a) ? shapeB : shapeA)
			                        + " take yade_timber.box(...) or yade_timber.polyhedron(...), "
			                          "with fixed=True for the ground");
		if (!areRounded) return; // laws of other packages
		const string materialA = a.material->getClassName(), materialB = b.material->getClassName();
		const ContactLaw* law = findLaw(materialA, materialB);
		if (!law || !hasIp2(loop, *law)) refusePair(a, b, "Ip2", materialA, materialB);
		if (!dispatches(loop.lawDispatcher->functors, "ManifoldGeom", law->phys))
			refusePair(a, b, "Law2", "ManifoldGeom", law->phys);
	}
}

void checkEngines(const Scene& scene)
{
	std::map<const Role*, int> count;
	const Role* before = nullptr; // of the last engine with a role
	const Engine* late = nullptr; // without a role, after ContactForces
	std::vector<const Engine*> live;
	visitLive(scene.engines, [&](const Engine& engine) { live.push_back(&engine); });
	for (const Engine* engine : live) {
		const Role* role = roleOf(*engine);
		if (!role && before && before->rank == Role::contactForces) late = engine;
		if (!role) continue;
		if (!isListed(scene, engine))
			refuseEngines(
			        engine->getClassName() + " stands in a ParallelEngine. Put it into the list itself");
		if (late && role->rank == Role::integration) {
			refuseForeign(*late);
			refuseEngines(late->getClassName()
			        + " stands between ContactForces and the integrator, so that contacts would not know "
			          "its forces. Move it before ContactForces or to the end");
		}
		if (++count[role] > 1 && role->number != Role::repeatable)
			refuseEngines(string(role->name) + " is there twice");
		if (before && role->rank < before->rank)
			refuseEngines(string(role->name) + " must come before " + before->name);
		before = role;
	}
	for (const Role& role : roles)
		if (role.number == Role::required && count[&role] == 0)
			refuseEngines(string(role.name) + " is missing");
	for (const Engine* engine : live) {
		refuseForeign(*engine);
		checkRecorder(*engine);
	}
}

void checkContacts(const Scene& scene)
{
	const InteractionLoop& loop = findLoop(scene);
	checkMargin(findCollider(scene));
	const auto& boxes = findCollider(scene).boundDispatcher->functors;
	const std::vector<const Body*> kinds = kindsOfBodies(scene);
	for (const Body* b : kinds)
		if (roundedShape(*b) && std::none_of(boxes.begin(), boxes.end(), [](const auto& f) {
			    return f->get1DFunctorType1() == "RoundedPolyhedron";
		    }))
			refuseEngines("the collider has no Bo1_RoundedPolyhedron_Aabb");
	for (size_t i = 0; i < kinds.size(); ++i)
		for (size_t k = i; k < kinds.size(); ++k)
			if ((roundedShape(*kinds[i]) || roundedShape(*kinds[k]))
			        && (kinds[i]->groupMask & kinds[k]->groupMask))
				checkPair(loop, *kinds[i], *kinds[k]);
}

void findParts(const Scene& scene, std::vector<const void*>& parts)
{
	parts.clear();
	const auto append = [&](const auto& dispatcher) {
		parts.push_back(dispatcher.get());
		if (!dispatcher) return;
		for (const auto& functor : dispatcher->functors)
			parts.push_back(functor.get());
	};
	const auto appendInner = [&](const Engine* engine) {
		if (const auto* loop = dynamic_cast<const InteractionLoop*>(engine)) {
			append(loop->geomDispatcher);
			append(loop->physDispatcher);
			append(loop->lawDispatcher);
		} else if (const auto* collider = dynamic_cast<const Collider*>(engine))
			append(collider->boundDispatcher);
	};
	visitLive(scene.engines, [&](const Engine& engine) {
		parts.push_back(&engine);
		const auto* contactLoop = dynamic_cast<const ContactLoop*>(&engine);
		const auto* trigger = dynamic_cast<const CollisionTrigger*>(&engine);
		const Engine* inner = contactLoop ? contactLoop->loop.get()
		        : trigger                 ? trigger->collider.get()
		                                  : nullptr;
		if (inner) parts.push_back(inner);
		appendInner(inner ? inner : &engine);
	});
}

constexpr Real largestStep = 1e-2; ///< twenty times the default step of houses: larger ones are mistakes [s]

/// Largest velocity change by gravity in a step, times the step, over the rounding radius of a body. [-] Bodies at rest
/// sink by a few g h^2, and by more in stacks. 0.0025: a stack of four cubes by 1 % of the radius; 0.012: by 14 %.
constexpr Real largestSinking = 0.0025;

namespace {
	void refuseStep(const Scene& scene, const string& cause, Real limit)
	{
		std::ostringstream message;
		message << "O.dt = " << scene.dt << " s: too large for " << cause << ": it must be at most ";
		message << std::setprecision(2) << limit << " s";
		stopRun(message.str());
	}

	/// The free body of the smallest radius; null if there is none.
	const Body* thinnestBody(const Scene& scene)
	{
		const Body* thinnest = nullptr;
		for (const shared_ptr<Body>& b : *scene.bodies)
			if (b && isFree(*b->state) && roundedShape(*b)
			        && (!thinnest || roundedShape(*b)->radius < roundedShape(*thinnest)->radius))
				thinnest = b.get();
		return thinnest;
	}

	/// Largest step for the joints. [s]
	Real jointStep(const Scene& scene)
	{
		std::vector<timber::PointSpring> springs;
		if (const auto* joints = findEngine<JointEngine>(scene)) joints->addSprings(scene, springs);
		const Real squared
		        = springs.empty() ? 0 : timber::largestEigenvalue(ContactForces::placements(scene), springs);
		return squared > 0 ? jointStepFactor * 2 / std::sqrt(squared) : std::numeric_limits<Real>::infinity();
	}
}

void checkStep(const Scene& scene)
{
	if (!(scene.dt <= largestStep)) refuseStep(scene, "contacts", largestStep);
	const Real gravity = gravityOf(scene).norm();
	if (const Body* b = gravity > 0 ? thinnestBody(scene) : nullptr) {
		const Real radius = roundedShape(*b)->radius, limit = math::sqrt(largestSinking * radius / gravity);
		std::ostringstream cause;
		cause << "the contacts of body " << b->getId() << ", which sinks in them by its weight (radius "
		      << radius << " m)";
		if (scene.dt > limit) refuseStep(scene, cause.str(), limit);
	}
	const Real limit = jointStep(scene);
	if (scene.dt > limit)
		refuseStep(scene, "the joints between the lightest bodies (or take less stiff joints)", limit);
}

void checkBody(const Body& b)
{
	if (b.isClump()) refuseBody(b, "a clump is not supported: make one convex polyhedron of it, or join its parts");
	if (!b.state) refuseBody(b, "it has no state");
	if (b.flags & ~(Body::FLAG_BOUNDED | Body::FLAG_ASPHERICAL))
		refuseBody(b, "flags = " + std::to_string(b.flags) + ": they must be bounded and aspherical only");
	const State& s = *b.state;
	if (s.blockedDOFs != State::DOF_NONE && s.blockedDOFs != State::DOF_ALL)
		refuseBody(b, "some degrees of freedom are blocked: contacts allow for free and fixed bodies only");
	if (isFree(s)
	        && !(s.mass > 0 && std::isfinite(s.mass) && (s.inertia.array() > 0).all() && s.inertia.allFinite())) {
		std::ostringstream fault;
		fault << "state.mass = " << s.mass << " kg, state.inertia = " << s.inertia.transpose()
		      << " kg m2: they must be finite and > 0";
		refuseBody(b, fault.str());
	}
	const RoundedPolyhedron* shape = roundedShape(b);
	if (!shape) return;
	if (shape->vertices.empty()) refuseBody(b, "its shape has no vertices");
	const auto* material = dynamic_cast<const ElementMat*>(b.material.get());
	if (!material || material->getClassIndex() == ElementMat::getClassIndexStatic())
		refuseBody(b,
		        "material " + (b.material ? b.material->getClassName() : string("None"))
		                + ": it must be a TimberMat or SnowMat");
}

} // namespace yade
