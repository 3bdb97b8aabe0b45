// SPDX-License-Identifier: GPL-2.0-or-later
// The Python module _yade_timber. Loading it defines the guard's functions only; host.py calls register_classes() once the guard is content.
#include <pch.hpp>

#include <Gl1_RoundedPolyhedron.hpp>
#include <PackedScene.hpp>
#include <build_info.hpp>
#include <layout_guard.hpp>

namespace {

/// Hand this module's classes, and only them, to YADE's registration; they appear in yade.wrapper. Returns their names.
/// Omega::loadPlugins() registers every name in ClassFactory's list, so the names YADE knows already step aside meanwhile.
boost::python::list registerClasses()
{
	auto& names = yade::ClassFactory::instance().pluginClasses;
	auto& omega = yade::Omega::instance();
	const auto known = omega.getDynlibsDescriptor();
	std::list<std::string> others = names;
	others.remove_if([&](const std::string& name) { return known.count(name) == 0; });
	names.remove_if([&](const std::string& name) { return known.count(name) != 0; });
	omega.loadPlugins({});
	boost::python::list registered;
	for (const auto& name : names)
		registered.append(name);
	names.splice(names.end(), others);
	return registered;
}

std::string buildRecord() { return TIMBER_BUILD_RECORD; }

} // namespace

BOOST_PYTHON_MODULE(_yade_timber)
{
	defineLayoutGuard();
	boost::python::def("build_record", &buildRecord);
	boost::python::def("register_classes", &registerClasses);
	boost::python::def("packed_placements", &yade::packedPlacements);
	boost::python::def("packed_joints", &yade::packedJoints, (boost::python::arg("engine")));
	boost::python::def("packed_contacts", &yade::packedContacts);
#ifdef YADE_OPENGL
	boost::python::def("refresh_viewer", &yade::refreshViewer);
#endif
}
