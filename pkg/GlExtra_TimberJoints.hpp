// SPDX-License-Identifier: GPL-2.0-or-later
/// Drawing of the joints in YADE's viewer.
#pragma once
#ifdef YADE_OPENGL
#include <pch.hpp>

namespace yade {

class GlExtra_TimberJoints : public GlExtraDrawer {
public:
	void validate() const;
	void postLoad(GlExtra_TimberJoints&) { validate(); }
	void render() override;
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(GlExtra_TimberJoints, GlExtraDrawer,
		"Draws the joints of the scene's :yref:`JointEngine` in front of all bodies: a dot coloured by load "
		"from blue through yellow to red, a larger amber dot if some springs are broken, a red cross if all "
		"are. Add it to ``qt.Renderer().extraDrawers``.",
		((Real, size, 6, Attr::triggerPostLoad, "Diameter of a dot, > 0. [pixels]"))
		((Real, cross, 0.07, Attr::triggerPostLoad, "Half length of the arms of a cross, > 0. [m]")));
	// clang-format on
};
REGISTER_SERIALIZABLE(GlExtra_TimberJoints);

} // namespace yade
#endif
