// SPDX-License-Identifier: GPL-2.0-or-later
/// The joints in YADE's own viewer.
#pragma once
#ifdef YADE_OPENGL
#include <pch.hpp>

namespace yade {

class GlExtra_TimberJoints : public GlExtraDrawer {
public:
	void render() override;
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(GlExtra_TimberJoints, GlExtraDrawer,
		"Draws the joints of the scene's :yref:`JointEngine` over everything else: a dot coloured by load from blue over yellow to red, a larger amber dot once some springs are broken, a red cross when all are. "
		"Add it to ``qt.Renderer().extraDrawers``.",
		((Real, size, 6, , "Diameter of a dot. [pixels]"))
		((Real, cross, 0.07, , "Half the length of a cross's arms. [m]")));
	// clang-format on
};
REGISTER_SERIALIZABLE(GlExtra_TimberJoints);

} // namespace yade
#endif
