// SPDX-License-Identifier: GPL-2.0-or-later
/// Drawing of the elements in YADE's viewer.
#pragma once
#ifdef YADE_OPENGL
#include <Shape.hpp>

namespace yade {

class Gl1_RoundedPolyhedron : public GlShapeFunctor {
public:
	void go(const shared_ptr<Shape>&, const shared_ptr<State>&, bool wire, const GLViewInfo&) override;
	RENDERS(RoundedPolyhedron);
	// clang-format off
	YADE_CLASS_BASE_DOC(Gl1_RoundedPolyhedron, GlShapeFunctor, "Draws a :yref:`RoundedPolyhedron` with its sharp "
		"edges.");
	// clang-format on
};
REGISTER_SERIALIZABLE(Gl1_RoundedPolyhedron);

/// Lets a viewer that was opened before this module was imported list its drawing functors again. renderer:
/// yade.qt.Renderer().
void refreshViewer(const boost::python::object& renderer);

} // namespace yade
#endif
