// SPDX-License-Identifier: GPL-2.0-or-later
/// Yielding joint springs: backbone, loops, pinching, loss of strength, energy balance and frames against closed forms.
#include "shapes.hpp"
#include <gtest/gtest.h>
#include <kernel/slip_law.hpp>

using namespace timber;
using namespace timber::shapes;

namespace {

constexpr double rounding = 1e-12; ///< of sums of up to 1e4 numbers, relative

// Numbers of a nailed fitting: it yields at 5 mm.
constexpr double k = 1e6, F = 5000, y = F / k, dc = 0.012, du = 0.03;
SlipLaw lawOf(double phi) { return { k, phi, { { F / k, F }, { dc, F }, { du, 0 } } }; }

/// Backbone of first loading [N], written from its definition.
double backbone(double r)
{
	if (r < y) return k * r;
	if (r < dc) return F;
	return r < du ? F * (du - r) / (du - dc) : 0;
}

/// A spring that is led along paths. `work`: trapezoidal rule over the steps [J].
struct Spring {
	SlipLaw law;
	SlipHistory history = {};
	Vec3 stretch = Vec3::Zero(), force = Vec3::Zero();
	double energy = 0, dissipated = 0, work = 0;

	void move(const Vec3& to)
	{
		const SlipForce f = slipForce(law, history, to);
		EXPECT_GE(f.dissipated, 0);
		work += (force + f.force).dot(to - stretch) / 2;
		dissipated += f.dissipated;
		energy = f.energy;
		force = f.force;
		history = f.history;
		stretch = to;
	}
	/// Straight path in equal steps.
	void lead(const Vec3& to, int steps)
	{
		const Vec3 from = stretch;
		for (int i = 1; i <= steps; ++i)
			move(from + double(i) / steps * (to - from));
	}
};

const double shares[] = { 0, 0.3, 1 };
const Vec3 direction = Vec3(2, -1, 2) / 3; ///< unit

} // namespace

TEST(SlipLaw, BackboneOfFirstLoading)
{
	for (const double phi : shares) {
		Spring spring { lawOf(phi) };
		for (const double r : { 0., 0.001, y, 0.007, dc, 0.02, 0.0299, du, 0.04 }) {
			spring.lead(r * direction, 3);
			EXPECT_LT((spring.force - backbone(r) * direction).norm(), rounding * F) << phi << " " << r;
		}
	}
}

namespace {

/// Points of a wall test: hardening, two peaks, a gentler start than the second line, no force at the end. [m, N]
const std::vector<BackbonePoint> points { { 0.002, 1000 }, { 0.005, 3700 }, { 0.012, 5000 }, { 0.016, 4200 },
	{ 0.02, 4600 }, { 0.03, 1500 }, { 0.04, 0 } };
constexpr double steepest = 9e5; ///< of the second line [N/m]

double interpolated(double r)
{
	BackbonePoint last { 0, 0 };
	for (const BackbonePoint& point : points) {
		if (r <= point.stretch)
			return last.force
			        + (point.force - last.force) * (r - last.stretch) / (point.stretch - last.stretch);
		last = point;
	}
	return 0;
}

double areaUnderPoints()
{
	double area = 0;
	BackbonePoint last { 0, 0 };
	for (const BackbonePoint& point : points) {
		area += (point.force + last.force) / 2 * (point.stretch - last.stretch);
		last = point;
	}
	return area;
}

} // namespace

/// First loading follows the lines through any points; all work to the last one is dissipated, however long the steps.
TEST(SlipLaw, BackboneThroughPoints)
{
	const double area = areaUnderPoints();
	for (const double phi : shares)
		for (const int steps : { 1, 7, 300 }) {
			Spring spring { SlipLaw(steepest, phi, points) };
			for (int i = 1; i <= 80; ++i) {
				const double r = 0.0005 * i;
				spring.lead(r * direction, steps);
				EXPECT_LT((spring.force - interpolated(r) * direction).norm(), rounding * F)
				        << phi << " " << r;
			}
			EXPECT_NEAR(spring.energy, 0, rounding * area);
			EXPECT_NEAR(spring.dissipated, area, rounding * area) << phi << " " << steps;
		}
}

/// Steady cycles dissipate 4 phi B (a - B / k); behind a peak as before it.
TEST(SlipLaw, AreaOfASteadyLoopOfPoints)
{
	for (const double phi : shares)
		for (const double a : { 0.003, 0.008, 0.018, 0.025 }) {
			Spring spring { SlipLaw(steepest, phi, points) };
			spring.lead(a * direction, 9);
			spring.lead(-a * direction, 9);
			const double dissipated = spring.dissipated, force = interpolated(a);
			spring.lead(a * direction, 50);
			EXPECT_LT((spring.force - force * direction).norm(), rounding * F);
			spring.lead(-a * direction, 50);
			EXPECT_NEAR(spring.dissipated - dissipated, 4 * phi * force * (a - force / steepest),
			        rounding * F * a * 100);
		}
}

TEST(SlipLaw, PointsThatAreNoBackbone)
{
	EXPECT_EQ(SlipLaw::unmetBy(steepest, points), nullptr);
	EXPECT_STREQ(SlipLaw::unmetBy(0.99 * steepest, points), "nowhere steeper than kn");
	EXPECT_STREQ(SlipLaw::unmetBy(steepest, { { 0.01, 0 } }), "of two or more points");
	EXPECT_STREQ(SlipLaw::unmetBy(steepest, { { 0.01, 10 }, { 0.01, 0 } }), "of ascending stretches > 0");
	EXPECT_STREQ(SlipLaw::unmetBy(steepest, { { 0.01, 10 }, { 0.02, 5 } }), "of forces > 0, the last one 0");
	EXPECT_STREQ(SlipLaw::unmetBy(steepest, { { 0.01, 10 }, { 0.02, 0 }, { 0.03, 0 } }),
	        "of forces > 0, the last one 0");
	EXPECT_STREQ(SlipLaw::unmetBy(steepest, { { 0.01, std::nan("") }, { 0.02, 0 } }), "finite");
}

/// A steady cycle of amplitude a encloses the parallelogram of the friction part, 4 phi F g (a - F g / k), and nothing
/// else.
TEST(SlipLaw, AreaOfASteadyLoop)
{
	for (const double phi : shares)
		for (const double a : { 0.003, 0.008, 0.02 }) { // elastic, yielding, softening
			Spring spring { lawOf(phi) };
			spring.lead(a * direction, 4);
			spring.lead(-a * direction, 4); // steady from here on
			const double work = spring.work, dissipated = spring.dissipated,
			             limit = backbone(std::max(a, y)) / k;
			const double area = 4 * phi * k * limit * std::max(0., a - limit);
			spring.lead(a * direction, 10000);
			spring.lead(-a * direction, 10000);
			// 2e4 plastic flows, each rounded to 5e-18 m
			EXPECT_NEAR(spring.dissipated - dissipated, area, F * 1e-13);
			// K step^2 / 8 for each of at most 10 kinks
			EXPECT_NEAR(spring.work - work, area, 10 * k * std::pow(2 * a / 10000, 2) / 8);
		}
}

/// Slip part: no force within the slack, and the same elastic line back to the backbone, in any direction.
TEST(SlipLaw, PinchingPath)
{
	const double a = 0.02, slack = a - backbone(a) / k;
	for (const double phi : shares) {
		Spring spring { lawOf(phi) };
		spring.lead(a * direction, 7);
		Random random(61);
		for (const double r : { 0.019, 0.0175, 0.01, 0., 0.01, 0.0175, 0.019, 0.02 }) {
			const Vec3 way = randomDirection(random);
			spring.move(r * way);
			const Vec3 friction = phi * k * (spring.stretch - spring.history.plastic),
			           slip = spring.force - friction;
			EXPECT_LT((slip - (1 - phi) * k * std::max(0., r - slack) * way).norm(), rounding * F) << r;
		}
	}
}

/// Inside the slack the friction part alone acts: phi F g against the motion.
TEST(SlipLaw, ForceInTheSlack)
{
	const double a = 0.02;
	Spring spring { lawOf(0.3) };
	spring.move(a * direction);
	spring.move(Vec3::Zero());
	EXPECT_LT((spring.force + 0.3 * backbone(a) * direction).norm(), rounding * F);
	spring.move(0.006 * direction); // more than twice the elastic limit, 2.8 mm
	EXPECT_LT((spring.force - 0.3 * backbone(a) * direction).norm(), rounding * F);
}

/// Strength falls to zero at d_u. All energy is dissipated then: the area below the backbone, however long the steps.
TEST(SlipLaw, EnergyToFailure)
{
	const double area = F * (dc + du) / 2 - F * F / (2 * k);
	for (const double phi : shares)
		for (const int steps : { 1, 7, 10000 }) {
			Spring spring { lawOf(phi) };
			spring.lead(du * direction, steps);
			EXPECT_LT(spring.force.norm(), rounding * F);
			EXPECT_NEAR(spring.energy, 0, rounding * area);
			EXPECT_NEAR(spring.dissipated, area, rounding * area) << phi << " " << steps;
			if (steps < 1000) continue;
			// K step^2 / 8 for each of two kinks
			EXPECT_NEAR(spring.work, area, 2 * k * std::pow(du / steps, 2) / 8);
		}
}

/// Cycles of increasing amplitude to failure: the area below the backbone, and the friction part's loops, with closed
/// forms for both.
TEST(SlipLaw, EnergyOfGrowingCycles)
{
	const double phi = 0.4;
	Spring spring { lawOf(phi) };
	const double first = 0.008, second = 0.011; // on the plateau
	for (const double a : { first, -first, second, -second })
		spring.move(a * direction);
	// slip part: F (R - y); friction part: phi F per plastic stretch, which is the path less 2 y for each reversal
	// and y at the start
	const double slip = (1 - phi) * F * (second - y),
	             path = first - y + 2 * (first - y) + (first + second - 2 * y) + 2 * (second - y);
	EXPECT_NEAR(spring.dissipated, slip + phi * F * path, rounding * F * path);
	EXPECT_NEAR(spring.energy, F * F / (2 * k), rounding * F * y);
}

/// Radial paths: forces, history and dissipated energy do not depend on the length of the steps.
TEST(SlipLaw, LongStepsAreShortStepsOnRadialPaths)
{
	for (const double phi : shares) {
		Spring once { lawOf(phi) }, often { lawOf(phi) };
		for (const double a : { 0.003, -0.008, 0.011, -0.011, 0.002, 0.011, 0.02, -0.02, 0.01, 0.02, 0.025 }) {
			once.move(a * direction);
			often.lead(a * direction, 1000);
			EXPECT_LT((once.force - often.force).norm(), rounding * F) << a;
			EXPECT_LT((once.history.plastic - often.history.plastic).norm(), rounding * du) << a;
			EXPECT_NEAR(once.history.largest, often.history.largest, rounding * du);
			EXPECT_NEAR(once.energy, often.energy, rounding * F * du) << a;
			// See the head of slip_law.hpp: tested in EnergyOfALongStep
			if (a == 0.02 || a == 0.011) continue;
			EXPECT_NEAR(once.dissipated, often.dissipated, rounding * F * du) << phi << " " << a;
		}
	}
}

/// Circles of radius a: plastic stretch and stretch have a right-angled triangle with the elastic limit. The friction
/// part dissipates 2 pi phi F sqrt(a^2 - y^2) in a turn, the slip part nothing.
TEST(SlipLaw, EnergyOfACircle)
{
	const double a = 0.011, phi = 0.3;
	const int steps = 20000; // radial return: error of first order, y / a * angle of a step = 1e-4
	Spring spring { lawOf(phi) };
	spring.move({ a, 0, 0 });
	const auto turn = [&] {
		for (int i = 1; i <= steps; ++i)
			spring.move({ a * std::cos(2 * M_PI * i / steps), 0, a * std::sin(2 * M_PI * i / steps) });
	};
	turn();
	turn();
	const double dissipated = spring.dissipated, exact = 2 * M_PI * phi * F * std::sqrt(a * a - y * y);
	turn();
	EXPECT_NEAR(spring.dissipated - dissipated, exact, 2e-4 * exact);
	EXPECT_NEAR(spring.history.plastic.norm(), std::sqrt(a * a - y * y), 2e-4 * a);
}

namespace {

/// Smooth path of a few periods in three dimensions from the origin, `size` in [m]; time 0 to 1.
struct Path {
	Vec3 amplitude[3], phase[3];
	explicit Path(Random& random, double size)
	{
		for (int n = 0; n < 3; ++n) {
			amplitude[n] = randomVector(random, size);
			phase[n] = randomVector(random, M_PI);
		}
	}
	Vec3 at(double time) const
	{
		Vec3 x = Vec3::Zero();
		for (int n = 0; n < 3; ++n)
			for (int c = 0; c < 3; ++c)
				x[c] += amplitude[n][c]
				        * (std::sin((n + 2) * 2 * M_PI * time + phase[n][c]) - std::sin(phase[n][c]));
		return x;
	}
};

/// Work minus stored and dissipated energy of a spring led along a path. [J]
double imbalance(const Path& path, double phi, int steps)
{
	Spring spring { lawOf(phi) };
	for (int i = 1; i <= steps; ++i)
		spring.move(path.at(double(i) / steps));
	return spring.work - spring.energy - spring.dissipated;
}
/// Longest step along a path. [m]
double longestStep(const Path& path, int steps)
{
	double longest = 0;
	for (int i = 1; i <= steps; ++i)
		longest = std::max(longest, (path.at(double(i) / steps) - path.at(double(i - 1) / steps)).norm());
	return longest;
}

} // namespace

/// Paths that yield, soften and break: the balance closes with the second order of the trapezoidal rule.
TEST(SlipLaw, EnergyBalanceOnRandomPaths)
{
	Random random(62);
	const int steps = 2000, finer = 8;
	double coarse = 0, fine = 0;
	for (int trial = 0; trial < 60; ++trial) {
		const Path path(random, uniform(random, 0.002, 0.015));
		const double phi = shares[trial % 3], one = imbalance(path, phi, steps),
		             other = imbalance(path, phi, finer * steps);
		// the work of a step with a kink is off by k step^2 / 8; 8 reversals of each component give some 30
		// kinks
		EXPECT_LT(std::abs(one), 30 * k * std::pow(longestStep(path, steps), 2) / 8) << trial;
		coarse += one * one;
		fine += other * other;
	}
	EXPECT_GT(std::log(coarse / fine) / (2 * std::log(finer)), 1.8); // order
}

TEST(SlipLaw, ForceIsTheGradientOfTheStoredEnergyAtConstantHistory)
{
	Random random(63);
	for (int trial = 0; trial < 200; ++trial) {
		const SlipLaw law = lawOf(uniform(random, 0, 1));
		const SlipHistory history { randomVector(random, 0.004), 0.011 };
		// Within the elastic limit and R
		const Vec3 at = history.plastic + randomVector(random, 0.8 * y / std::sqrt(3.));
		if (at.norm() > 0.99 * history.largest) continue;
		for (int axis = 0; axis < 3; ++axis) {
			const Vec3 h = 1e-7 * Vec3::Unit(axis);
			const SlipForce ahead = slipForce(law, history, at + h), back = slipForce(law, history, at - h),
			                here = slipForce(law, history, at);
			EXPECT_EQ(here.dissipated, 0);
			// Curvature of the kink at r = s: k h / 4 at most
			EXPECT_NEAR(here.force[axis], (ahead.energy - back.energy) / 2e-7, 1e-3);
		}
	}
}

TEST(SlipLaw, TurnsWithTheScene)
{
	Random random(64);
	for (int trial = 0; trial < 30; ++trial) {
		const Quat rotation = randomRotation(random);
		const Path path(random, 0.01);
		Spring here { lawOf(0.3) }, there { lawOf(0.3) };
		for (int i = 1; i <= 200; ++i) {
			here.move(path.at(i / 200.));
			there.move(rotation * path.at(i / 200.));
			// Rounding at r = s: the direction of e amplifies it
			EXPECT_LT((rotation * here.force - there.force).norm(), 1e-9 * F);
		}
		EXPECT_NEAR(here.dissipated, there.dissipated, 1e-9 * F * du);
	}
}

TEST(SlipLaw, TheSameStretchAgainChangesNothing)
{
	Spring spring { lawOf(0.3) };
	EXPECT_EQ(slipForce(spring.law, {}, Vec3::Zero()).force, Vec3(Vec3::Zero()));
	for (const double r : { 0.003, 0.01, 0.02, -0.01 }) {
		spring.move(r * direction);
		const SlipForce again = slipForce(spring.law, spring.history, spring.stretch);
		EXPECT_LT((again.force - spring.force).norm(), rounding * F);
		EXPECT_NEAR(again.dissipated, 0, rounding * F * du);
	}
}

namespace {

/// Two springs between A at the origin and B.
struct Joint {
	Joint(const Vec3& along = Vec3::Zero())
	        : axis(along)
	{
		const std::vector<Vec3> anchors { { 0.1, 0, 0 }, { -0.1, 0, 0 } };
		springs().assign(anchors, anchors, { 0, 0 });
	}
	JointSprings springs() { return { groups.data(), 2 }; }
	JointForce place(const Vec3& distance)
	{
		return yieldingForces(laws, { axesA, axesB, distance }, axis, springs());
	}
	std::vector<SpringBreak> breaks() { return spentSprings(laws, { k, k }, axesA, Vec3::UnitZ(), springs()); }

	Mat3 axesA = Mat3::Identity(), axesB = Mat3::Identity();

private:
	std::vector<SpringLanes> groups { groupsOf(2) };
	Vec3 axis; ///< zero: in all directions

public:
	SlipSprings laws { lawOf(0.3), axis, 2 };
};

} // namespace

/// Springs whose histories stay are computed in groups: bit for bit what each gives alone, also beside broken ones.
TEST(SlipJoint, GroupsGiveWhatSingleSpringsDo)
{
	constexpr size_t count = 7, broken = 2;
	Random random(65);
	std::vector<SpringLanes> groups { groupsOf(count) };
	const JointSprings springs { groups.data(), count };
	const std::vector<Vec3> anchors(count, Vec3::Zero());
	std::vector<int> flags(count, 0);
	flags[broken] = 1;
	springs.assign(anchors, anchors, flags);
	SlipSprings laws(lawOf(0.3), Vec3::Zero(), count);
	std::vector<SlipHistory> histories(count);
	for (size_t i = 0; i < count; ++i)
		histories[i].largest = uniform(random, 0, 0.01);
	laws.setHistories(std::vector<Vec3>(count, Vec3::Zero()), [&] {
		std::vector<double> largest;
		for (const SlipHistory& history : histories)
			largest.push_back(history.largest);
		return largest;
	}());
	const Mat3 axes = Mat3::Identity();
	Vec3 distance = Vec3::Zero();
	int steps[2] = {};
	for (int step = 0; step < 2000; ++step) {
		distance += randomVector(random, 3e-4);
		const JointForce total = yieldingForces(laws, { axes, axes, distance }, Vec3::Zero(), springs);
		double energy = 0, dissipated = 0;
		bool stays = true;
		for (size_t i = 0; i < count; ++i) {
			if (i == broken) continue;
			const SlipForce alone = slipForce(lawOf(0.3), histories[i], distance);
			EXPECT_EQ(springs.force(i), alone.force) << step;
			EXPECT_EQ(laws.plastic()[i], alone.history.plastic);
			EXPECT_EQ(laws.largest()[i], alone.history.largest);
			stays = stays && alone.history.plastic == histories[i].plastic
			        && alone.history.largest == histories[i].largest;
			histories[i] = alone.history;
			energy += alone.energy;
			dissipated += alone.dissipated;
		}
		++steps[stays];
		EXPECT_EQ(total.energy, energy);
		EXPECT_EQ(total.dissipated, dissipated);
	}
	EXPECT_GT(std::min(steps[0], steps[1]), 100); // both ways are taken
}

/// A rigid rotation of both bodies, here by 120 degrees, turns the forces with the history and does no work.
TEST(SlipJoint, HistoryTurnsWithTheBody)
{
	const Mat3 rotation = about({ 1, 1, 1 }, 2 * M_PI / 3).toRotationMatrix();
	Joint joint;
	joint.place({ 0, 0.002, 0.011 });
	const JointForce before = joint.place({ 0.001, 0, 0.004 });
	joint.axesA = joint.axesB = rotation;
	const JointForce after = joint.place(rotation * Vec3(0.001, 0, 0.004));
	EXPECT_LT((after.force - rotation * before.force).norm(), rounding * F);
	EXPECT_LT((after.torqueA - rotation * before.torqueA).norm(), rounding * F);
	EXPECT_NEAR(after.energy, before.energy, rounding * F * y);
	EXPECT_NEAR(after.dissipated, 0, rounding * F * y);
	EXPECT_LT(std::abs(before.force.normalized().dot(Vec3(1, 0, 4).normalized())), 0.999); // not along the stretch
}

/// Equal and opposite forces at the same point: no torque on the pair.
TEST(SlipJoint, AngularMomentumIsConserved)
{
	Joint joint;
	joint.axesB = about({ 0, 1, 0 }, 0.04).toRotationMatrix();
	joint.place({ 0.002, 0.002, 0.011 });
	const Vec3 distance(0.001, -0.003, 0.004);
	const JointForce f = joint.place(distance);
	EXPECT_GT(f.torqueA.norm(), 10);
	EXPECT_LT((f.torqueA + f.torqueB - distance.cross(f.force)).norm(), rounding * F);
}

/// B turns about y: the springs' stretches differ, and they break one by one.
TEST(SlipJoint, SpringsBreakOneByOne)
{
	Joint joint;
	joint.place({ 0, 0, 0.02 });
	EXPECT_TRUE(joint.breaks().empty());
	joint.axesB = about({ 0, 1, 0 }, -0.15).toRotationMatrix(); // lifts spring 0 by 15 mm, lowers the other one
	const JointForce both = joint.place({ 0, 0, 0.02 });
	const std::vector<SpringBreak> breaks = joint.breaks();
	ASSERT_EQ(breaks.size(), 1u);
	EXPECT_EQ(breaks[0].spring, 0u);
	EXPECT_EQ(breaks[0].cause, BreakCause::Tension);
	EXPECT_EQ(breaks[0].energy, 0);
	EXPECT_EQ(joint.springs().force(0), Vec3(Vec3::Zero()));
	EXPECT_GT(joint.springs().force(1).norm(), 100);
	EXPECT_GT(both.dissipated, 0);
	joint.springs().breakSpring(0);
	joint.place({ 0, 0, 0.02 });
	EXPECT_TRUE(joint.breaks().empty());
}

/// Springs along one axis: no force across it, the force of the law along it, and the axis turns with A.
TEST(SlipJoint, SpringsAlongAnAxis)
{
	Joint joint(Vec3::UnitZ()), free;
	EXPECT_EQ(joint.place({ 0.02, 0.011, 0 }).force, Vec3(Vec3::Zero()));
	EXPECT_EQ(joint.laws.largest()[0], 0);
	const Vec3 force = joint.place({ 0.02, -0.011, 0.004 }).force;
	EXPECT_LT((force - free.place({ 0, 0, 0.004 }).force).norm(), rounding * F);
	joint.axesA = joint.axesB = about({ 1, 0, 0 }, M_PI / 2).toRotationMatrix(); // z becomes -y
	EXPECT_LT((joint.place({ 0.02, -0.004, 0.3 }).force - Vec3(0, -force.z(), 0)).norm(), rounding * F);
}

/// Axis and bodies move on closed paths: the work on both bodies is the stored energy plus the dissipated one.
TEST(SlipJoint, EnergyOfSpringsAlongAnAxis)
{
	Joint joint({ 0.6, 0, 0.8 });
	const int steps = 20000;
	const auto place = [&](double t) {
		joint.axesA = about({ 0, 1, 0 }, 0.03 * std::sin(2 * t)).toRotationMatrix();
		joint.axesB = about({ 1, 2, 0 }, 0.05 * std::sin(t)).toRotationMatrix();
		return joint.place(Vec3(0.004 * std::sin(3 * t), 0.02 * t, 0.009 * std::sin(t)));
	};
	double work = 0, dissipated = 0;
	JointForce last = place(0);
	for (int k = 1; k <= steps; ++k) {
		const double t = 2. * k / steps, before = 2. * (k - 1) / steps;
		const JointForce now = place(t);
		const Vec3 move(0.004 * (std::sin(3 * t) - std::sin(3 * before)), 0.02 * (t - before),
		        0.009 * (std::sin(t) - std::sin(before)));
		const Vec3 spinA(0, 0.03 * (std::sin(2 * t) - std::sin(2 * before)), 0),
		        spinB = 0.05 * (std::sin(t) - std::sin(before)) * Vec3(1, 2, 0).normalized();
		work += ((last.force + now.force).dot(move) - (last.torqueA + now.torqueA).dot(spinA)
		                - (last.torqueB + now.torqueB).dot(spinB))
		        / 2;
		dissipated += now.dissipated;
		last = now;
	}
	EXPECT_GT(dissipated, F * y);
	// The sum over steps and the radial return: 1e-4 / 2 at 10 000 steps
	EXPECT_NEAR(work, last.energy + dissipated, 1e-4 * dissipated);
}
