// SPDX-License-Identifier: GPL-2.0-or-later
/// libFuzzer target, not part of the normal build: bytes become two polyhedra and their placements.
///   cmake --preset fuzz && cmake --build --preset fuzz && build/fuzz/fuzz_manifold -max_len=128 -runs=10000000
///   CORPUS_FOLDER
/// A refused polyhedron is a valid outcome; anything not finite, unbounded, unsorted or dependent on the cache is not.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <kernel/constants.hpp>
#include <kernel/inner_core.hpp>
#include <kernel/manifold.hpp>
#include <kernel/separating_axis.hpp>
#include "shapes.hpp"

using namespace timber;

namespace {

/// Reads numbers off the input; zeros when it is used up.
class Bytes {
public:
	Bytes(const std::uint8_t* data, size_t size)
	        : data(data)
	        , size(size)
	{
	}
	int byte()
	{
		if (size == 0) return 0;
		--size;
		return *data++;
	}
	/// On a coarse grid, so that coplanar, parallel and coincident features are common; now and then any bits at
	/// all.
	double coordinate()
	{
		const int grid = byte();
		if (grid == 255) return anyBits();
		const double fine = grid % 16 == 15 ? (byte() - 128) * 1e-7 : 0;
		return (grid / 16 - 8) / 8. + fine;
	}
	Vec3 vector()
	{
		const double x = coordinate(), y = coordinate(), z = coordinate();
		return { x, y, z };
	}
	Quat rotation()
	{
		if (byte() % 2 == 0) return Quat::Identity();
		const Quat q(coordinate(), coordinate(), coordinate(), coordinate());
		return q.coeffs().allFinite() && q.norm() > 1e-6 && q.norm() < 1e6 ? q.normalized() : Quat::Identity();
	}

private:
	const std::uint8_t* data;
	size_t size;

	double anyBits()
	{
		std::uint64_t bits = 0;
		for (int k = 0; k < 8; ++k)
			bits = bits << 8 | std::uint64_t(byte());
		double value;
		std::memcpy(&value, &bits, sizeof value);
		return value;
	}
};

/// A box cut by some planes: nearly always a body.
Polyhedron readCutBox(Bytes& bytes, int cuts)
{
	const Vec3 half = bytes.vector().cwiseAbs() + Vec3::Constant(0.05);
	std::vector<HalfSpace> planes;
	for (int k = 0; k < 3; ++k)
		for (const double side : { -1., 1. })
			planes.push_back({ side * Vec3::Unit(k), half[k] });
	for (int k = 0; k < cuts; ++k) {
		const Vec3 normal = bytes.vector();
		planes.push_back({ normal, normal.cwiseAbs().dot(half) * (bytes.byte() + 1) / 256 });
	}
	for (HalfSpace& h : planes) {
		const double length = h.normal.norm();
		if (length == 0) throw PolyhedronError("no normal");
		h = { h.normal / length, h.offset / length };
	}
	const Sphere inside = inscribedSphere(planes, Vec3::Zero(), 2 * half.norm());
	if (inside.radius <= 0) throw PolyhedronError("no volume");
	Hull hull = intersectionAround(inside.centre, planes, 4 * planarShare * half.norm());
	if (hull.outcome != HullOutcome::Sound) throw PolyhedronError("not sound");
	return hull.body;
}

Polyhedron readPoints(Bytes& bytes, int count)
{
	std::vector<Vec3> points;
	for (int k = 0; k < count; ++k)
		points.push_back(bytes.vector());
	return Polyhedron::fromVertices(points);
}

/// Members of houses and bodies of extreme proportions, made once: most inputs then are about placements.
const std::vector<RoundedPolyhedron>& knownBodies()
{
	using namespace shapes;
	static const std::vector<RoundedPolyhedron> bodies = [] {
		std::vector<RoundedPolyhedron> shapes;
		for (const Vec3& extents : { Vec3(0.105, 0.105, 2.73), Vec3(0.105, 7.28, 0.12), Vec3(7.28, 8.19, 0.2),
		             Vec3(1, 1, 1), Vec3(1, 1, 1e-3), Vec3(1, 1e-3, 1e-3), Vec3(1e-3, 1e-3, 1e-3) })
			shapes.push_back(roundedBox(extents));
		for (const auto& points : { Brace { 0.91, 2.73, 0.09, 0.045 }.vertices(),
		             HipSlab { 8, 0.5, 0.4, 0.12 }.vertices(), tetrahedronVertices(0.3),
		             octahedronVertices(0.2), hexagonalPrismVertices(0.1, 1.5), pyramidVertices(1, 0.2) }) {
			const Vec3 centre = massProperties(Polyhedron::fromVertices(points)).centroid;
			shapes.push_back(rounded(moved(points, Quat::Identity(), -centre)));
		}
		return shapes;
	}();
	return bodies;
}

RoundedPolyhedron readBody(Bytes& bytes)
{
	const int choice = bytes.byte();
	if (choice % 4 != 0) return knownBodies()[choice / 4 % knownBodies().size()];
	const int kind = bytes.byte();
	const Polyhedron shape = kind % 8 == 0 ? readPoints(bytes, 4 + kind / 8 % 8) : readCutBox(bytes, kind % 8 - 1);
	std::vector<Vec3> points = shape.vertices;
	for (Vec3& p : points)
		p *= std::pow(10, kind / 64 - 2);
	return RoundedPolyhedron::fromSharp(Polyhedron::fromVertices(points),
	        bytes.byte() % 2 ? 0 : shape.thickness() * std::pow(10, kind / 64 - 3));
}

void require(bool condition, const char* what)
{
	if (condition) return;
	std::cerr << "fuzz_manifold: " << what << std::endl;
	std::abort();
}

void check(const RoundedPolyhedron& a, const RoundedPolyhedron& b, const Pose& poseA, const Pose& poseB,
        const std::vector<ContactPoint>& points)
{
	Vec3 axis;
	const double gap
	        = coreGap(a.core, b.core, (poseA.orientation.conjugate() * poseB.orientation).toRotationMatrix(),
	                poseA.orientation.conjugate() * (poseB.position - poseA.position), axis);
	const double limit = a.radius + b.radius + std::max({ -gap, a.coreHalfThickness, b.coreHalfThickness, 1e-4 });
	// Cores that just touch in a pattern that is off have no point
	const double noise = 1e-12 * (a.boundingRadius + b.boundingRadius);
	require(gap >= -noise || !points.empty(), "overlapping cores without a point");
	for (size_t k = 0; k < points.size(); ++k) {
		const ContactPoint& p = points[k];
		require(p.position.allFinite() && p.normal.allFinite() && std::isfinite(p.overlap), "not finite");
		require(std::abs(p.normal.norm() - 1) < 1e-9, "normal is no unit vector");
		require(p.overlap > 0 && p.overlap <= limit * (1 + 1e-9) + 1e-9, "overlap out of bounds");
		require(k == 0 || points[k - 1].id < p.id, "ids not sorted or not unique");
	}
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, size_t size)
{
	Bytes bytes(data, size);
	try {
		const RoundedPolyhedron a = readBody(bytes), b = readBody(bytes);
		const int switches = bytes.byte();
		const ContactKinds kinds { (switches & 1) != 0, (switches & 2) != 0 };
		const Pose poseA { Vec3::Zero(), bytes.rotation() };
		CandidateCache cache;
		std::vector<ContactPoint> points, fresh;
		for (int step = 0; step < 3; ++step) {
			const Pose poseB { bytes.vector() * (a.boundingRadius + b.boundingRadius), bytes.rotation() };
			// Placements are checked by the caller
			if (!poseB.position.allFinite() || poseB.position.norm() > 1e6) return 0;
			updateManifold(a, b, poseA, poseB, kinds, cache, points);
			check(a, b, poseA, poseB, points);
			const double gap = updateManifold(a, b, poseA, poseB, kinds, cache, points);
			const Pose nearer { poseB.position - 0.999 * gap * poseB.position.normalized(),
				poseB.orientation };
			require(gap == 0 || shapes::contacts(a, b, poseA, nearer, kinds).empty(),
			        "a contact within the gap that was promised");
			CandidateCache empty;
			updateManifold(a, b, poseA, poseB, kinds, empty, fresh);
			require(points.size() == fresh.size(), "the cache changes the result");
		}
	} catch (const PolyhedronError&) {
	}
	return 0;
}
