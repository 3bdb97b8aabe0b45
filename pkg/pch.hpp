// SPDX-License-Identifier: GPL-2.0-or-later
// Precompiled header, forced in front of every plugin source: YADE's headers, without their Python bindings.
//
// Each YADE class defines its bindings (pyRegisterClass) inline, and each file that includes it compiles them again: 40
// s a file.
// The running YADE has bound the classes already. A declaration is enough, and makes it the class's key function, so
// that the vtable comes from YADE's library, too. Bindings of members that are newer than the host are dropped with the
// rest.
#pragma once

#include <lib/serialization/Serializable.hpp>

#pragma push_macro("_YADE_CLASS_BASE_DOC_ATTRS_DEPREC_PY")
#undef _YADE_CLASS_BASE_DOC_ATTRS_DEPREC_PY
#define _YADE_CLASS_BASE_DOC_ATTRS_DEPREC_PY(thisClass, baseClass, docString, attrs, deprec, extras)                   \
	_REGISTER_ATTRIBUTES_DEPREC(thisClass, baseClass, attrs, deprec)                                               \
	REGISTER_CLASS_AND_BASE(thisClass, baseClass)                                                                  \
	BOOST_PP_SEQ_FOR_EACH(_ACCESS_DEPREC, thisClass, deprec)                                                       \
	void pyRegisterClass(::boost::python::object) override;

#include <core/Aabb.hpp>
#include <core/Body.hpp>
#include <core/Dispatching.hpp>
#include <core/GlobalEngine.hpp>
#include <core/Interaction.hpp>
#include <core/Omega.hpp>
#include <core/Scene.hpp>
#include <lib/base/Logging.hpp>
#ifdef YADE_OPENGL
#include <pkg/common/GLDrawFunctors.hpp>
#include <pkg/common/OpenGLRenderer.hpp>
#endif

#pragma pop_macro("_YADE_CLASS_BASE_DOC_ATTRS_DEPREC_PY")
