// SPDX-License-Identifier: GPL-2.0-or-later
// The Python module _yade_timber. Loading it defines functions only; host.py calls register_classes() once the layout
// is verified.
#include <pch.hpp>

#include <ContactPhysics.hpp>
#include <EnergyBalance.hpp>
#include <Gl1_RoundedPolyhedron.hpp>
#include <Integrator.hpp>
#include <PackedScene.hpp>
#include <SceneAdvance.hpp>
#include <SceneCheck.hpp>
#include <build_info.hpp>
#include <chrono>
#include <kernel/threads.hpp>
#include <layout_guard.hpp>
#include <thread>

namespace {

/// Registers this module's classes, and only them, with YADE; they appear in yade.wrapper. Returns their names.
/// Omega::loadPlugins() registers every name in ClassFactory's list, so names that YADE knows already are removed
/// meanwhile.
boost::python::list registerClasses()
{
	auto& names = yade::ClassFactory::instance().pluginClasses;
	auto& omega = yade::Omega::instance();
	const auto loaded = omega.getDynlibsDescriptor();
	std::list<std::string> others = names;
	others.remove_if([&](const std::string& name) { return loaded.count(name) == 0; });
	names.remove_if([&](const std::string& name) { return loaded.count(name) != 0; });
	omega.loadPlugins({});
	boost::python::list registered;
	for (const auto& name : names)
		registered.append(name);
	names.splice(names.end(), others);
	return registered;
}

/// Returns when a run in the background has made a step since `before`, or has ended: its thread has started then.
void awaitStep(long before)
{
	yade::Omega& omega = yade::Omega::instance();
	PyThreadState* released = PyEval_SaveThread(); // a PyRunner in that step needs the interpreter
	while (omega.isRunning() && omega.getScene()->iter == before)
		std::this_thread::sleep_for(std::chrono::microseconds(20));
	PyEval_RestoreThread(released);
}

/// Ends a run in the background and returns when its last step is done: whether the run would have gone on. It waits for
/// a whole step: a run that has just reached its limits has none any more and still counts as running, and YADE would
/// free what a thread that has not started is about to use. Not to be called by the thread that computes the steps.
bool finishStep()
{
	yade::Omega& omega = yade::Omega::instance();
	awaitStep(omega.getScene()->iter);
	PyThreadState* released = PyEval_SaveThread(); // a PyRunner in that step needs the interpreter
	const bool runs = omega.isRunning();
	omega.stop();
	omega.createSimulationLoop();
	PyEval_RestoreThread(released);
	return runs;
}

/// Checks a body of the scene whose shape, material or state was replaced. Collider and HealthCheck then check the
/// whole scene.
void checkReplacedPart(const yade::Body& body)
{
	yade::checkBody(body);
	yade::Scene& scene = *yade::Omega::instance().getScene();
	yade::markPlaced(scene, body.getId());
	scene.doSort = true;
}

/// Contacts of a body that begin in the next step are those of a body that was placed.
void beginContactsAnew(int id) { yade::markPlaced(*yade::Omega::instance().getScene(), id); }

/// Breaks the joints of a body that is erased: another one may get its id.
void breakJointsOf(int id)
{
	for (const auto& engine : yade::Omega::instance().getScene()->engines)
		if (auto* joints = dynamic_cast<yade::JointEngine*>(engine.get())) joints->breakJointsOf(id);
}

void setThreadCount(int count)
{
	if (count < 1)
		throw std::invalid_argument("set_thread_count: count = " + std::to_string(count) + ": it must be >= 1");
	timber::setThreadCount(count);
}

/// Python reads the record from the file: not inlined, since GCC may copy a literal in pieces that are stored apart.
[[gnu::noinline, gnu::noclone]] const char* recordInFile()
{
	static const char record[] [[gnu::used]] = TIMBER_BUILD_RECORD;
	return record;
}

std::string buildRecord() { return recordInFile(); }

} // namespace

BOOST_PYTHON_MODULE(_yade_timber)
{
	defineLayoutGuard();
	boost::python::def("build_record", &buildRecord);
	boost::python::def("register_classes", &registerClasses);
	boost::python::def("await_step", &awaitStep, (boost::python::arg("before")));
	boost::python::def("finish_step", &finishStep);
	boost::python::def("check_replaced_part", &checkReplacedPart, (boost::python::arg("body")));
	boost::python::def("begin_contacts_anew", &beginContactsAnew, (boost::python::arg("id")));
	boost::python::def("break_joints_of", &breakJointsOf, (boost::python::arg("id")));
	boost::python::scope().attr("joint_step_factor") = yade::jointStepFactor;
	boost::python::def("thread_count", &timber::threadCount);
	boost::python::def("set_thread_count", &setThreadCount, (boost::python::arg("count")));
	boost::python::def("advance_scenes", &yade::advanceScenes,
	        (boost::python::arg("scenes"), boost::python::arg("steps"), boost::python::arg("idle")));
	boost::python::def("energy", &yade::pyEnergy);
	boost::python::def("created_energy", &yade::pyCreatedEnergy);
	boost::python::def("contact_laws", &yade::pyContactLaws);
	boost::python::def("packed_placements", &yade::packedPlacements);
	boost::python::def("packed_joints", &yade::packedJoints, (boost::python::arg("engine")));
	boost::python::def("packed_contacts", &yade::packedContacts);
	boost::python::def("packed_springs", &yade::packedSprings);
	boost::python::def("dashpot_power", &yade::pyDashpotPower, (boost::python::arg("velocities")));
#ifdef YADE_OPENGL
	boost::python::def("refresh_viewer", &yade::refreshViewer);
#endif
}
