// SPDX-License-Identifier: GPL-2.0-or-later
#include <GlExtra_TimberJoints.hpp>
#ifdef YADE_OPENGL
#include <GL/gl.h>
#include <JointEngine.hpp>
#include <validation.hpp>

namespace yade {

YADE_PLUGIN((GlExtra_TimberJoints));

namespace {
	// Okabe and Ito 2008
	const Vector3r blue(0, 0.45, 0.70), yellow(0.94, 0.89, 0.26), red(0.84, 0.37, 0), amber(0.90, 0.62, 0);

	Vector3r loadColor(Real load)
	{
		return load < 0.5 ? Vector3r(blue + 2 * load * (yellow - blue))
		                  : Vector3r(yellow + (2 * load - 1) * (red - yellow));
	}

	void drawDot(const Vector3r& x, const Vector3r& color, Real size)
	{
		glPointSize(float(size));
		glColor3d(color.x(), color.y(), color.z());
		glBegin(GL_POINTS);
		glVertex3d(x.x(), x.y(), x.z());
		glEnd();
	}

	void drawCross(const Vector3r& x, Real arm)
	{
		glLineWidth(2);
		glColor3d(red.x(), red.y(), red.z());
		glBegin(GL_LINES);
		for (const Vector3r& d :
		        { Vector3r(1, 1, 1), Vector3r(-1, 1, 1), Vector3r(1, -1, 1), Vector3r(1, 1, -1) })
			for (const Vector3r& end : { Vector3r(x - arm * d), Vector3r(x + arm * d) })
				glVertex3d(end.x(), end.y(), end.z());
		glEnd();
		glLineWidth(1);
	}
}

void GlExtra_TimberJoints::validate() const
{
	requirePositive("GlExtra_TimberJoints.size", size);
	requirePositive("GlExtra_TimberJoints.cross", cross);
}

void GlExtra_TimberJoints::render()
{
	const auto scenePtr = Omega::instance().getScene();
	glPushAttrib(GL_ENABLE_BIT | GL_POINT_BIT);
	glDisable(GL_LIGHTING);
	glDisable(GL_DEPTH_TEST);
	glEnable(GL_POINT_SMOOTH);
	if (const auto* engine = findEngine<JointEngine>(*scenePtr)) {
		for (const timber::JointEntry& j : engine->jointSet().joints) {
			const Body* b = bodyAt(*scenePtr, j.bodyA);
			if (!b || j.springs == 0) continue;
			const Vector3r x = b->state->pos + b->state->ori * j.centreA;
			if (j.isBroken()) drawCross(x, cross);
			else if (j.intact < j.springs) drawDot(x, amber, 1.5 * size);
			else drawDot(x, loadColor(math::min(Real(1), engine->jointSet().load(j))), size);
		}
	}
	glPopAttrib();
}

} // namespace yade
#endif
