// SPDX-License-Identifier: GPL-2.0-or-later
/// Random convex bodies of 4 to 64 corners: each is accepted, has the volume of its convex hull and a sound core.
/// TIMBER_HULLS: their number.
#include "topology.hpp"
#include <algorithm>
#include <cstdlib>
#include <kernel/constants.hpp>
#include <set>
#include <string>

using namespace timber;
using namespace timber::shapes;

namespace {

using Points = std::vector<Vec3>;
using LongVec3 = Eigen::Matrix<long double, 3, 1>;

/// Outer sides of all planes through three points that have no point outside, by trial: independent of the kernel.
std::vector<HalfSpace> supportingPlanes(const Points& points)
{
	std::vector<LongVec3> x;
	for (const Vec3& p : points)
		x.push_back(p.cast<long double>());
	const double size = sizeOf(points);
	std::vector<HalfSpace> planes;
	const auto tryPlane = [&](size_t a, size_t b, size_t c) {
		LongVec3 normal = (x[b] - x[a]).cross(x[c] - x[a]);
		if (normal.norm() < 1e-8L * size * size) return; // a line
		const long double rounding = 1e-16L * size * size * size;
		bool isAbove = false, isBelow = false;
		for (size_t k = 0; k < x.size() && !(isAbove && isBelow); ++k) {
			const long double height = normal.dot(x[k] - x[a]);
			isAbove = isAbove || height > rounding;
			isBelow = isBelow || height < -rounding;
		}
		if (isAbove && isBelow) return;
		normal *= (isAbove ? -1 : 1) / normal.norm();
		planes.push_back({ normal.cast<double>(), double(normal.dot(x[a])) });
	};
	for (size_t a = 0; a < x.size(); ++a)
		for (size_t b = a + 1; b < x.size(); ++b)
			for (size_t c = b + 1; c < x.size(); ++c)
				tryPlane(a, b, c);
	return planes;
}

using LongVec2 = Eigen::Matrix<long double, 2, 1>;

/// Area of the convex hull of points in a plane (Andrew's chains).
long double hullArea(std::vector<LongVec2> points)
{
	const auto cross = [](const LongVec2& a, const LongVec2& b) { return a.x() * b.y() - a.y() * b.x(); };
	std::sort(points.begin(), points.end(),
	        [](const LongVec2& p, const LongVec2& q) { return std::pair(p.x(), p.y()) < std::pair(q.x(), q.y()); });
	long double area = 0;
	for (const int side : { 1, -1 }) {
		std::vector<LongVec2> chain;
		for (const LongVec2& p : points) {
			while (chain.size() > 1
			        && side * cross(chain.back() - chain[chain.size() - 2], p - chain.back()) <= 0)
				chain.pop_back();
			chain.push_back(p);
		}
		for (size_t k = 1; k < chain.size(); ++k)
			area += side * cross(chain[k - 1] - points[0], chain[k] - points[0]) / 2;
	}
	return area;
}

/// Volume of the convex hull: the area of a section is quadratic between the heights of two corners. No hull in space
/// is needed.
double sectionVolume(const Points& points)
{
	std::vector<LongVec3> x;
	for (const Vec3& p : points)
		x.push_back((p - points[0]).cast<long double>());
	std::sort(x.begin(), x.end(), [](const LongVec3& p, const LongVec3& q) { return p.z() < q.z(); });
	const auto sectionArea = [&](long double z) {
		std::vector<LongVec2> crossings;
		for (const LongVec3& p : x)
			for (const LongVec3& q : x) {
				if (p.z() > z || q.z() < z) continue;
				const long double share = q.z() > p.z() ? (z - p.z()) / (q.z() - p.z()) : 0;
				crossings.emplace_back(p.head<2>() + share * (q - p).head<2>());
			}
		return crossings.empty() ? 0 : hullArea(crossings);
	};
	long double volume = 0;
	for (size_t k = 1; k < x.size(); ++k) {
		// Three inner points: the ends may be faces
		const long double low = x[k - 1].z(), high = x[k].z(), part = (high - low) / 4;
		volume += (high - low) / 3
		        * (2 * sectionArea(low + part) - sectionArea(low + 2 * part) + 2 * sectionArea(high - part));
	}
	return double(volume);
}

double largestHeight(const std::vector<HalfSpace>& planes, const Vec3& x)
{
	double height = -1e300;
	for (const HalfSpace& h : planes)
		height = std::max(height, h.normal.dot(x) - h.offset);
	return height;
}

Points onGrid(Points points, double grid)
{
	for (Vec3& p : points)
		p = (p / grid).array().round() * grid;
	return points;
}

/// Each corner of a box is kept or cut off.
Points choppedBox(Random& random)
{
	const Vec3 half(0.5, uniform(random, 0.05, 0.5), uniform(random, 0.05, 0.5));
	Points points;
	for (const Vec3& corner : boxVertices({ 2, 2, 2 })) {
		if (random() % 2) points.push_back(corner.cwiseProduct(half));
		else
			for (int k = 0; k < 3; ++k) {
				Vec3 cut = corner;
				cut[k] *= 1 - std::pow(10, uniform(random, -4, -0.05));
				points.push_back(cut.cwiseProduct(half));
			}
	}
	return points;
}

Points prism(Random& random)
{
	const int sides = 3 + int(random() % 30);
	const double height = std::pow(10, uniform(random, -1.3, 1)), flat = uniform(random, 0.1, 1);
	std::vector<Eigen::Vector2d> outline;
	for (int k = 0; k < sides; ++k)
		outline.emplace_back(std::cos(2 * M_PI * k / sides), flat * std::sin(2 * M_PI * k / sides));
	return prismVertices(outline, height);
}

/// A box with a low roof on some faces: corners that are nearly coplanar with four others.
Points lowRoofs(Random& random)
{
	Points points = boxVertices({ 1, 1, 1 });
	for (const Vec3& normal : { Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, -1) })
		if (random() % 3)
			for (int k = int(random() % 3); k >= 0; --k) {
				const Vec3 along = randomVector(random, 0.4);
				points.push_back(along - along.dot(normal) * normal
				        + (0.5 + std::pow(10, uniform(random, -5.5, -2))) * normal);
			}
	return points;
}

Points ballPoints(Random& random, int count)
{
	Points points;
	for (int k = 0; k < count; ++k)
		points.push_back(std::cbrt(uniform(random, 0.2, 1)) * randomDirection(random));
	return points;
}

Points randomPoints(Random& random, int kind)
{
	const int corners = 4 + int(std::pow(61, uniform(random, 0, 1))) - 1;
	const Vec3 axes(1, std::pow(20, uniform(random, -1, 0)), std::pow(20, uniform(random, -1, 0)));
	switch (kind) {
		case 0: return ellipsoidPoints(random, corners, { 1, 1, 1 });
		case 1: return ellipsoidPoints(random, corners, axes);
		case 2: return ballPoints(random, corners);
		case 3: return choppedBox(random);
		case 4: return prism(random);
		case 5: return onGrid(ellipsoidPoints(random, std::min(corners, 40), axes), 0.01);
		case 6: return lowRoofs(random);
		case 7: return onGrid(moved(choppedBox(random), randomRotation(random), Vec3::Zero()), 1e-3);
		default: return moved(prism(random), randomRotation(random), randomVector(random, 10));
	}
}

/// Without points that are no corners by more than planarShare; the kernel must name them, and no others.
bool removeRefused(Points& points, Polyhedron& body)
{
	for (size_t k = 0; k < points.size(); ++k)
		for (size_t l = points.size(); --l > k;)
			if ((points[k] - points[l]).norm() < 2e-6 * sizeOf(points))
				points.erase(points.begin() + long(l));
	while (points.size() >= 4)
		try {
			body = Polyhedron::fromVertices(points);
			return true;
		} catch (const PolyhedronError& error) {
			const std::string text = error.what();
			if (text.find("in one plane") != std::string::npos) return false; // rounded thin bodies
			if (text.find("is no corner") == std::string::npos) {
				ADD_FAILURE() << text;
				return false;
			}
			const size_t k = std::stoul(text.substr(std::string("vertex ").size()));
			const Vec3 point = points[k];
			points.erase(points.begin() + long(k));
			if (points.size() < 4) return false;
			// PlanarShare
			EXPECT_LE(largestHeight(supportingPlanes(points), point), 1.02e-6 * sizeOf(points)) << text;
		}
	return false;
}

/// Closed, each edge between two faces, corners in the planes of their faces and inside the others.
void expectClosed(const Polyhedron& body, double tolerance)
{
	EXPECT_EQ(body.vertices.size() + body.faces.size(), body.edges.size() + 2);
	std::set<std::pair<int, int>> sides;
	for (const Face& face : body.faces) {
		EXPECT_GE(face.corners.size(), 3u);
		for (size_t k = 0; k < face.corners.size(); ++k) {
			EXPECT_TRUE(
			        sides.insert({ face.corners[k], face.corners[(k + 1) % face.corners.size()] }).second);
			EXPECT_NEAR(
			        face.plane.normal.dot(body.vertices[face.corners[k]]), face.plane.offset, tolerance);
			EXPECT_TRUE(face.sidePlanes[k].normal.allFinite() && face.bevelPlanes[k].normal.allFinite());
		}
		for (const Vec3& v : body.vertices)
			EXPECT_LE(face.plane.normal.dot(v), face.plane.offset + tolerance);
	}
	for (const auto& [tail, head] : sides)
		EXPECT_TRUE(sides.count({ head, tail }));
	EXPECT_EQ(sides.size(), 2 * body.edges.size());
	for (const Edge& e : body.edges)
		EXPECT_TRUE(e.outward.allFinite() && e.direction.allFinite());
}

/// A body with a face down on a plate has points that push it up.
void expectRests(const RoundedPolyhedron& body)
{
	static const RoundedPolyhedron plate = roundedBox({ 100, 100, 1 }, 0.1);
	const auto widest = std::max_element(body.core.faces.begin(), body.core.faces.end(),
	        [](const Face& f, const Face& g) { return f.corners.size() < g.corners.size(); });
	const Quat turn = Quat::FromTwoVectors(widest->plane.normal, Vec3(0, 0, -1));
	const double overlap = 0.01 * body.radius;
	double low = 1e300;
	for (const Vec3& v : body.core.vertices)
		low = std::min(low, (turn * v).z());
	const Pose pose { Vec3(0, 0, 0.5 + body.radius - overlap - low), turn };
	const auto points = contacts(plate, body, {}, pose);
	EXPECT_FALSE(points.empty());
	for (const ContactPoint& p : points) {
		EXPECT_TRUE(p.position.allFinite());
		EXPECT_GT(p.normal.z(), 0.9);
		EXPECT_LE(p.overlap, 1.001 * overlap);
	}
}

} // namespace

TEST(RandomHulls, AllAreAcceptedWithTheirVolumeAndCore)
{
	const char* const number = std::getenv("TIMBER_HULLS");
	Random random(46);
	int bodies = 0;
	for (int trial = 0; bodies < (number ? std::atoi(number) : 400); ++trial) {
		SCOPED_TRACE("trial " + std::to_string(trial));
		Points points = randomPoints(random, trial % 9);
		Polyhedron sharp;
		if (!removeRefused(points, sharp)) continue;
		const double volume = sectionVolume(points);
		const auto planes = supportingPlanes(points);
		EXPECT_NEAR(massProperties(sharp).volume, volume, 1e-9 * volume);
		Vec3 middle = Vec3::Zero();
		for (const Vec3& p : points)
			middle += p / double(points.size());
		const double room = -largestHeight(planes, middle), size = sizeOf(points);
		if (room < 1e-3 * size) continue;
		++bodies;
		const double radius
		        = trial % 2 && sharp.shortestEdge() < 9 * room ? 0 : uniform(random, 0.01, 0.95) * room;
		try {
			const RoundedPolyhedron body = RoundedPolyhedron::fromSharp(sharp, radius);
			expectClosed(body.core, warpShare * size);
			EXPECT_NEAR(massProperties(body.sharp).volume, volume, 1e-9 * volume);
			for (const Vec3& v : body.core.vertices)
				EXPECT_LE(largestHeight(planes, v), -body.radius + warpShare * size);
			expectRests(body);
		} catch (const PolyhedronError& error) {
			ADD_FAILURE() << error.what();
		}
		if (HasFailure() && !number) break;
	}
}

/// The message's largest radius is that of the inscribed sphere.
TEST(RandomHulls, LargestRadius)
{
	Random random(47);
	for (int trial = 0; trial < 90; ++trial) {
		Points points = randomPoints(random, trial % 9);
		Polyhedron sharp;
		if (!removeRefused(points, sharp)) continue;
		try {
			RoundedPolyhedron::fromSharp(sharp, 10);
			ADD_FAILURE() << "accepted";
		} catch (const PolyhedronError& error) {
			const std::string text = error.what(), before = "inscribed sphere, ";
			ASSERT_NE(text.find(before), std::string::npos) << text;
			const double largest = std::stod(text.substr(text.find(before) + before.size()));
			EXPECT_NO_THROW(RoundedPolyhedron::fromSharp(sharp, 0.99 * largest)) << trial;
			EXPECT_THROW(RoundedPolyhedron::fromSharp(sharp, 1.01 * largest), PolyhedronError) << trial;
		}
	}
}

/// Corners typed to two decimals. Reference: SciPy's (Qhull's) intersection of the half-spaces.
TEST(RandomHulls, TwoDecimals)
{
	const RoundedPolyhedron body
	        = rounded({ { -0.79, 0.59, 0.15 }, { 0.38, -0.78, 0.49 }, { 0.80, -0.60, 0.02 }, { 0.89, 0.45, 0.0 },
	                { 0.55, -0.06, 0.83 }, { 0.87, 0.50, 0.0 }, { -0.94, -0.34, -0.10 }, { 0.53, 0.85, 0.07 } });
	EXPECT_EQ(body.core.vertices.size(), 20u);
	// Its last digit
	EXPECT_NEAR(massProperties(body.core).volume / massProperties(body.sharp).volume, 0.959, 0.0005);
	EXPECT_NEAR(body.core.shortestEdge(), 5e-4, 1e-4); // likewise
}
