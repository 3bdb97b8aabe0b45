// SPDX-License-Identifier: GPL-2.0-or-later
#include <pch.hpp>

#include <SceneAdvance.hpp>
#include <core/InteractionLoop.hpp>
#include <layout_guard.hpp>
#include <pkg/common/Collider.hpp>
#include <pkg/common/GravityEngines.hpp>
#include <pkg/common/InsertionSortCollider.hpp>
#include <pkg/common/NormShearPhys.hpp>

namespace {

using namespace yade;

/// One data member of a YADE class.
struct Field {
	std::string owner; ///< YADE class, as in yade.wrapper
	std::string attribute; ///< its attribute
	std::string pointee; ///< class pointed to, empty for a plain value
	/// Value, or the address pointed to, `shift` bytes beside the member.
	std::function<py::object(const py::object&, long)> read;
	std::function<void(const py::object&, const py::object&)> write;
};

template <typename Member> py::object readAt(const Member* member) { return py::object(*member); }
template <typename T> py::object readAt(const shared_ptr<T>* member)
{
	return py::object(reinterpret_cast<std::uintptr_t>(member->get()));
}

/// `member` maps an Owner& to a reference to its member.
template <typename Owner, typename Access>
Field makeField(const char* owner, const char* attribute, const char* pointee, Access member)
{
	using Member = std::decay_t<decltype(member(std::declval<Owner&>()))>;
	const auto read = [member](const py::object& object, long shift) {
		const auto* address = reinterpret_cast<const char*>(&member(py::extract<Owner&>(object)()));
		return readAt(reinterpret_cast<const Member*>(address + shift));
	};
	const auto write = [member](const py::object& object, const py::object& value) {
		member(py::extract<Owner&>(object)()) = py::extract<Member>(value)();
	};
	return { owner, attribute, pointee, read, write };
}

// clang-format off
#define VALUE(Owner, name) makeField<Owner>(#Owner, #name, "", [](Owner& o) -> auto& { return o.name; })
#define POINTER(Owner, name, Pointee) \
	makeField<Owner>(#Owner, #name, #Pointee, [](Owner& o) -> auto& { return o.name; })

/// Members that this package's C++ uses, and the last one of each class. Members without a Python attribute
/// (State::blockedDOFs, Interaction::functorCache) lie between others. The first difference ends the check, so State's
/// references (pos, ori), which are dereferenced when read, come after its plain members.
const std::vector<Field>& fields()
{
	static const std::vector<Field> table {
		VALUE(Body, id), VALUE(Body, groupMask), VALUE(Body, flags), POINTER(Body, material, Material),
		POINTER(Body, state, State),
		POINTER(Body, shape, Shape), POINTER(Body, bound, Bound), VALUE(Body, clumpId), VALUE(Body, iterBorn),
		VALUE(Body, timeBorn),
		VALUE(State, vel), VALUE(State, mass), VALUE(State, angVel), VALUE(State, angMom),
		VALUE(State, inertia), VALUE(State, refPos),
		VALUE(State, refOri), VALUE(State, isDamped), VALUE(State, densityScaling), VALUE(State, pos),
		VALUE(State, ori),
		VALUE(Shape, color), VALUE(Shape, wire), VALUE(Shape, highlight),
		VALUE(Aabb, refPos), VALUE(Aabb, sweepLength), VALUE(Aabb, min), VALUE(Aabb, max),
		VALUE(Material, id), VALUE(Material, density),
		VALUE(Interaction, id1), VALUE(Interaction, id2), VALUE(Interaction, iterMadeReal),
		POINTER(Interaction, geom, IGeom),
		POINTER(Interaction, phys, IPhys), VALUE(Interaction, iterBorn),
		VALUE(NormPhys, normalForce), VALUE(NormShearPhys, shearForce),
		VALUE(Engine, dead), VALUE(Engine, ompThreads),
		VALUE(Scene, dt), VALUE(Scene, iter), VALUE(Scene, time), VALUE(Scene, isPeriodic),
		VALUE(Scene, trackEnergy), VALUE(Scene, selectedBody), VALUE(Scene, stopAtIter),
		VALUE(Scene, stopAtTime),
		VALUE(Scene, doSort), POINTER(Collider, boundDispatcher, BoundDispatcher),
		VALUE(InsertionSortCollider, verletDist),
		VALUE(GravityEngine, gravity),
		POINTER(InteractionLoop, geomDispatcher, IGeomDispatcher),
		POINTER(InteractionLoop, physDispatcher, IPhysDispatcher),
		POINTER(InteractionLoop, lawDispatcher, LawDispatcher),
	};
	return table;
}
// clang-format on

/// [(class, attribute, class pointed to or "")], in the order of the check.
py::list listFields()
{
	py::list names;
	for (const auto& field : fields())
		names.append(py::make_tuple(field.owner, field.attribute, field.pointee));
	return names;
}

py::object readField(int index, const py::object& object, long shift) { return fields().at(index).read(object, shift); }

void writeField(int index, const py::object& object, const py::object& value)
{
	fields().at(index).write(object, value);
}

std::uintptr_t address(const py::object& object)
{
	return reinterpret_cast<std::uintptr_t>(py::extract<Serializable*>(object)());
}

/// Address of a scene's energy tracker, the last of the containers that Scene points to: if its offset is right, so are
/// theirs.
std::uintptr_t energyAddress(Scene& scene) { return reinterpret_cast<std::uintptr_t>(scene.energy.get()); }

/// Contents of Scene without Python attributes: (number of engines, bodies and interactions, force on body 0 [N]).
py::tuple readContainers(Scene& scene)
{
	scene.forces.sync();
	return py::make_tuple(
	        scene.engines.size(), scene.bodies->size(), scene.interactions->size(), scene.forces.getForce(0));
}

/// Number of a collider's functors for bounding boxes.
size_t countBoundFunctors(const Collider& collider) { return collider.boundDispatcher->functors.size(); }

/// Numbers of an InteractionLoop's Ig2, Ip2 and Law2 functors.
py::tuple countContactFunctors(const InteractionLoop& loop)
{
	return py::make_tuple(loop.geomDispatcher->functors.size(), loop.physDispatcher->functors.size(),
	        loop.lawDispatcher->functors.size());
}

} // namespace

void defineLayoutGuard()
{
	py::def("layout_fields", &listFields);
	py::def("read_field", &readField, (py::arg("index"), py::arg("object"), py::arg("shift") = 0));
	py::def("write_field", &writeField, (py::arg("index"), py::arg("object"), py::arg("value")));
	py::def("swap_scene", &swapScene, (py::arg("scene")));
	py::def("energy_address", &energyAddress, (py::arg("scene")));
	py::def("read_containers", &readContainers, (py::arg("scene")));
	py::def("count_bound_functors", &countBoundFunctors, (py::arg("collider")));
	py::def("count_contact_functors", &countContactFunctors, (py::arg("loop")));
	py::def("address", &address, (py::arg("object")));
}
