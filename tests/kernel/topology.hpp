// SPDX-License-Identifier: GPL-2.0-or-later
/// Invariants of polyhedra, and two shapes of the house.
#pragma once
#include "shapes.hpp"
#include <gtest/gtest.h>
#include <kernel/constants.hpp>
#include <kernel/inner_core.hpp>

namespace timber::shapes {

/// Closed surface, consistent orientation: Euler's formula, unit normals, all vertices inside all planes; `share`:
/// tolerance of planar faces as a fraction of the size (planarShare).
inline void expectSound(const Polyhedron& body, double share = 1e-6)
{
	EXPECT_EQ(int(body.vertices.size()) - int(body.edges.size()) + int(body.faces.size()), 2);
	Vec3 low = body.vertices[0], high = low;
	for (const Vec3& v : body.vertices) {
		low = low.cwiseMin(v);
		high = high.cwiseMax(v);
	}
	const double tolerance = share * (high - low).maxCoeff();
	for (const Face& face : body.faces) {
		EXPECT_NEAR(face.plane.normal.norm(), 1, 1e-13); // rounding
		EXPECT_GE(face.corners.size(), 3u);
		for (const Vec3& v : body.vertices)
			EXPECT_LE(face.plane.normal.dot(v), face.plane.offset + tolerance);
	}
	for (const Edge& e : body.edges)
		EXPECT_GT(e.outward.dot(body.faces[e.left].plane.normal), 0);
}

inline void expectCounts(const Polyhedron& body, size_t vertices, size_t edges, size_t faces)
{
	EXPECT_EQ(body.vertices.size(), vertices);
	EXPECT_EQ(body.edges.size(), edges);
	EXPECT_EQ(body.faces.size(), faces);
	expectSound(body);
}

inline std::vector<HalfSpace> planesOf(const Polyhedron& body)
{
	std::vector<HalfSpace> planes;
	for (const Face& face : body.faces)
		planes.push_back(face.plane);
	return planes;
}

/// Intersection of different half-spaces about the centre of their inscribed sphere, within 10 m of the origin.
inline Hull intersectionOf(const std::vector<HalfSpace>& planes)
{
	const Sphere inside = inscribedSphere(planes, Vec3::Zero(), 10);
	if (inside.radius <= 1e-12) return { HullOutcome::NoVolume };
	return intersectionAround(inside.centre, planes, 4 * planarShare);
}

const HipSlab hip { 7.43, 0.3, 0.4, 0.12 };
const Brace brace { 0.805, 2.61, 0.09, 0.045 };

} // namespace timber::shapes
