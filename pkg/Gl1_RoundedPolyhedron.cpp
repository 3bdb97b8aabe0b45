// SPDX-License-Identifier: GPL-2.0-or-later
#include <Gl1_RoundedPolyhedron.hpp>
#ifdef YADE_OPENGL
#include <GL/gl.h>

namespace yade {

YADE_PLUGIN((Gl1_RoundedPolyhedron));

namespace {
	void vertex(const Vector3r& v) { glVertex3d(v.x(), v.y(), v.z()); }

	void drawFaces(const timber::Polyhedron& body)
	{
		for (const timber::Face& face : body.faces) {
			glBegin(GL_POLYGON);
			glNormal3d(face.plane.normal.x(), face.plane.normal.y(), face.plane.normal.z());
			for (const int k : face.corners)
				vertex(body.vertices[k]);
			glEnd();
		}
	}

	void drawEdges(const timber::Polyhedron& body)
	{
		glBegin(GL_LINES);
		for (const timber::Edge& e : body.edges) {
			vertex(body.vertices[e.tail]);
			vertex(body.vertices[e.head]);
		}
		glEnd();
	}
}

void Gl1_RoundedPolyhedron::go(const shared_ptr<Shape>& shape, const shared_ptr<State>&, bool wire, const GLViewInfo&)
{
	const timber::Polyhedron& body = static_cast<RoundedPolyhedron*>(shape.get())->geometry->sharp;
	const Vector3r& color = shape->color;
	if (!wire && !shape->wire) {
		glColor3d(color.x(), color.y(), color.z());
		glPolygonOffset(1, 1); // draws the edges in front of their faces
		glEnable(GL_POLYGON_OFFSET_FILL);
		drawFaces(body);
		glDisable(GL_POLYGON_OFFSET_FILL);
	}
	glDisable(GL_LIGHTING);
	glColor3d(color.x() / 2, color.y() / 2, color.z() / 2);
	drawEdges(body);
	glEnable(GL_LIGHTING);
}

void refreshViewer(const boost::python::object& renderer)
{
	boost::python::extract<shared_ptr<OpenGLRenderer>>(renderer)()->init();
}

} // namespace yade
#endif
