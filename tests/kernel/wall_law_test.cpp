// SPDX-License-Identifier: GPL-2.0-or-later
/// Cycles of walls: backbone, reloading, loss by cycles, published sets, energy balance, against closed forms.
#include <gtest/gtest.h>
#include <kernel/slip_law.hpp>
#include <kernel/wall_law.hpp>
#include <random>

using namespace timber;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double rounding = 1e-11; ///< of sums of up to 1e4 numbers, relative

const std::vector<BackbonePoint> points { { 0.004, 2000 }, { 0.01, 4000 }, { 0.03, 7000 }, { 0.05, 5000 },
	{ 0.09, 2000 }, { 0.1, 0 } };
constexpr double k = 5e5, Ff = 600, c = 0.65; ///< N/m, N, -
WallCycles cyclesOf(double target) { return { k, Ff, 0, target, c }; }

double backbone(double d)
{
	BackbonePoint last { 0, 0 };
	for (const BackbonePoint& p : points) {
		if (d <= p.stretch)
			return last.force + (p.force - last.force) * (d - last.stretch) / (p.stretch - last.stretch);
		last = p;
	}
	return 0;
}

/// A spring that is led along paths. `work`: trapezoidal rule over the steps [J].
struct Spring {
	WallLaw law;
	WallHistory history = {};
	WallLaw::Bounds bounds = {};
	double dissipated = 0, work = 0;

	void lead(double to, int steps = 1)
	{
		const double from = history.stretch;
		for (int i = 1; i <= steps; ++i) {
			const double stretch = i == steps ? to : from + (to - from) * i / steps;
			const WallForce f = law.advance(history, bounds, stretch);
			EXPECT_EQ(f.history.force, law.advance(history, stretch).history.force);
			EXPECT_GE(f.dissipated, 0);
			EXPECT_DOUBLE_EQ(f.energy, law.energy(f.history));
			work += (history.force + f.history.force) / 2 * (f.history.stretch - history.stretch);
			dissipated += f.dissipated;
			history = f.history;
		}
	}
	double energy() const { return law.energy(history); }
};

} // namespace

TEST(WallLaw, BackboneOfFirstLoading)
{
	for (const int steps : { 1, 7, 500 })
		for (const double sign : { 1., -1. }) {
			Spring spring { WallLaw(cyclesOf(1.1), points) };
			for (const double d : { 0.001, 0.004, 0.02, 0.03, 0.06, 0.09, 0.0999 }) {
				spring.lead(sign * d, steps);
				EXPECT_NEAR(spring.history.force, sign * backbone(d), rounding * 7000) << d;
			}
			spring.lead(sign * 0.12, steps);
			EXPECT_EQ(spring.history.force, 0);
			EXPECT_TRUE(spring.law.isSpent(spring.history));
			// The area under the backbone
			EXPECT_NEAR(spring.energy() + spring.dissipated, 4 + 18 + 110 + 120 + 140 + 10, rounding * 400);
			EXPECT_EQ(spring.energy(), 0);
		}
}

/// A last force above zero remains on both sides.
TEST(WallLaw, ResidualStrength)
{
	std::vector<BackbonePoint> left = points;
	left.back() = { 0.1, 1500 };
	Spring spring { WallLaw(cyclesOf(1), left) };
	for (const double d : { 0.2, -0.3, 0.2, 0.35, -0.3, 0.5 }) {
		spring.lead(d, 100);
		EXPECT_FALSE(spring.law.isSpent(spring.history));
		EXPECT_NEAR(spring.history.force, d > 0 ? 1500 : -1500, rounding * 7000) << d;
	}
}

/// Unloading with k to -F_f, along -F_f through zero, reloading from c s to the target: each force of the path.
TEST(WallLaw, LinesOfACycle)
{
	for (const double target : { 1., 1.1 }) {
		Spring spring { WallLaw(cyclesOf(target), points) };
		const double a = 0.02, B = backbone(a), aim = target * a;
		for (const double d : { a, -a })
			spring.lead(d);
		const double slack = a - (B - Ff) / k, start = c * slack, slope = (backbone(aim) - Ff) / (aim - start);
		const auto expect = [&](double d, double force) {
			spring.lead(d, 3);
			EXPECT_NEAR(spring.history.force, force, rounding * 7000) << target << " " << d;
		};
		expect(-a + 0.001, -B + 0.001 * k);
		expect(-a + (B + Ff) / k, Ff);
		expect(0, Ff);
		expect(start, Ff);
		expect(0.015, Ff + slope * (0.015 - start));
		expect(a, Ff + slope * (a - start));
		expect(aim, backbone(aim));
		expect(0.04, backbone(0.04));
	}
}

/// Steady cycles enclose the area between their lines.
TEST(WallLaw, AreaOfASteadyLoop)
{
	for (const double a : { 0.008, 0.02, 0.06 }) {
		Spring spring { WallLaw(cyclesOf(1), points) };
		for (const double d : { a, -a, a, -a })
			spring.lead(d);
		const double dissipated = spring.dissipated, energy = spring.energy(), B = backbone(a),
		             back = (B + Ff) / k, start = c * (a - (B - Ff) / k);
		const double half = back * (Ff - B) / 2 + Ff * (start + a - back) + (a - start) * (Ff + B) / 2;
		spring.lead(a);
		spring.lead(-a);
		EXPECT_NEAR(spring.dissipated - dissipated, 2 * half, rounding * 7000 * a) << a;
		EXPECT_NEAR(spring.energy(), energy, rounding * 7000 * a);
	}
}

/// The side that has not been loaded follows the backbone, whatever the other one has seen.
TEST(WallLaw, SidesHaveTheirOwnMemory)
{
	Spring spring { WallLaw(cyclesOf(1.1), points) };
	spring.lead(0.04);
	for (const double d : { -0.004, -0.02, -0.03 }) {
		spring.lead(d, 5);
		EXPECT_NEAR(spring.history.force, -backbone(-d), rounding * 7000) << d;
	}
}

/// Within the unloading line nothing is dissipated, and loading goes on along the backbone.
TEST(WallLaw, SmallTurnsBack)
{
	Spring spring { WallLaw(cyclesOf(1.1), points) };
	spring.lead(0.02);
	const double dissipated = spring.dissipated;
	for (const double d : { 0.0197, 0.0199, 0.0196, 0.02 })
		spring.lead(d);
	EXPECT_EQ(spring.dissipated, dissipated);
	EXPECT_NEAR(spring.history.force, backbone(0.02), rounding * 7000);
	spring.lead(0.025);
	EXPECT_NEAR(spring.history.force, backbone(0.025), rounding * 7000);
}

namespace {

/// SAWS parameters. [kN, mm]
struct Set {
	double F0, FI, DU, S0, R1, R2, R3, R4, alpha, beta;
};

WallLaw lawOf(const Set& s, int count)
{
	std::vector<BackbonePoint> curve;
	const double scale = s.F0 / s.S0, whole = 1 - std::exp(-s.DU / scale / 2);
	const auto force = [&](double d) { return (s.F0 + s.R1 * s.S0 * d) * (1 - std::exp(-d / scale)); };
	for (int i = 1; i < count; ++i) {
		const double d = -2 * scale * std::log(1 - whole * i / count);
		curve.push_back({ d, force(d) });
	}
	curve.push_back({ s.DU, force(s.DU) });
	curve.push_back({ s.DU - force(s.DU) / (s.R2 * s.S0), 0 });
	return { { s.R3 * s.S0, s.FI, s.R4 * s.S0, s.beta, 0, s.S0, scale, s.alpha }, curve };
}

const Set setA { 8, 1.2, 15, 5, 0.058, -0.05, 1, 0.02, 0.6, 1.1 },
        setB { 70.28, 2.425, 26.44, 27.992, 0.1022, -0.03241, 1, 0.06926, 0.8, 1.1 };

struct Cycle {
	double amplitude, first, second; ///< work of the first and the second cycle [J]
	double firstForce, secondForce, zeroForce; ///< at the amplitude, and at zero at the end [kN]
};

/// Three cycles at each amplitude, and the values of another implementation, rounded as they are given.
void expectCycles(const Set& set, const std::vector<Cycle>& cycles, double joules, double kilonewtons)
{
	Spring spring { lawOf(set, 400) };
	for (const Cycle& cycle : cycles) {
		double before = 0, force[3], work[3];
		for (int i = 0; i < 3; ++i) {
			before = spring.work;
			spring.lead(cycle.amplitude, 2000);
			force[i] = spring.history.force;
			spring.lead(-cycle.amplitude, 2000);
			spring.lead(0, 2000);
			work[i] = spring.work - before;
			EXPECT_NEAR(spring.history.force, cycle.zeroForce, rounding * 100);
		}
		EXPECT_NEAR(work[0], cycle.first, joules) << cycle.amplitude;
		EXPECT_NEAR(work[1], cycle.second, joules) << cycle.amplitude;
		EXPECT_NEAR(work[2], work[1], 1e-6 * work[1]);
		EXPECT_NEAR(force[0], cycle.firstForce, kilonewtons) << cycle.amplitude;
		EXPECT_NEAR(force[1], cycle.secondForce, kilonewtons) << cycle.amplitude;
	}
}

} // namespace

/// Values of OpenSees v3.8.0 (material SAWS, parameters of its example). Half of the last digit given.
TEST(WallLaw, PublishedSet)
{
	expectCycles(setA,
	        { { 10, 151.1, 65.6, 10.879, 9.606, 1.2 }, { 20, 289.7, 114.1, 11.099, 8.524, 1.2 },
	                { 40, 390.8, 190.8, 6.099, 5.200, 1.2 } },
	        0.06, 0.0006);
}

/// Forces of OpenSees; energies by the same rules without its jump of force in reloading, an independent calculation.
TEST(WallLaw, PublishedSetOfAnotherWall)
{
	expectCycles(setB,
	        { { 10, 921, 617, 97.05, 91.89, 2.425 }, { 20, 2230, 1966, 127.45, 123.33, 2.425 },
	                { 40, 5438, 1980, 133.61, 118.66, 2.425 } },
	        0.6, 0.006);
}

/// Random paths: work = stored + dissipated; no force jumps; the same whatever the steps, and with both sides swapped.
TEST(WallLaw, RandomPaths)
{
	std::mt19937 generator(7);
	std::uniform_real_distribution<double> uniform(-1, 1);
	std::vector<BackbonePoint> left = points;
	left.back() = { 0.1, 900 };
	for (int trial = 0; trial < 200; ++trial) {
		const bool isPublished = trial % 4 == 3;
		const double unit = isPublished ? 1 : 1e-3, stiffness = isPublished ? setA.S0 : k;
		WallCycles cycles = cyclesOf(1 + 0.2 * std::abs(uniform(generator)));
		if (trial % 2) cycles.pinchedStiffness = 0.04 * k;
		const WallLaw law = isPublished ? lawOf(trial % 8 == 3 ? setA : setB, 50)
		                                : WallLaw(cycles, trial % 3 ? points : left);
		Spring coarse { law }, fine { law }, swapped { law };
		const double range = 120 * unit * std::abs(uniform(generator));
		for (int turn = 0; turn < 40; ++turn) {
			const double to = range * uniform(generator);
			coarse.lead(to);
			swapped.lead(-to, 2);
			const double from = fine.history.stretch;
			for (int i = 1; i <= 100; ++i) {
				const WallHistory before = fine.history;
				fine.lead(i == 100 ? to : from + (to - from) * i / 100);
				const double most = 6 * stiffness * std::abs(fine.history.stretch - before.stretch);
				ASSERT_LE(std::abs(fine.history.force - before.force), most + 1e-9 * stiffness);
			}
			const double scale = stiffness * unit * 100;
			ASSERT_NEAR(coarse.history.force, fine.history.force, 1e-9 * scale) << trial << " " << turn;
			ASSERT_NEAR(
			        coarse.dissipated, fine.dissipated, 1e-9 * scale * unit * 100 + 1e-9 * fine.dissipated);
			ASSERT_NEAR(-swapped.history.force, coarse.history.force, 1e-9 * scale);
			// The trapezoidal rule misses up to four kinks a path, by k step2 / 8 each: observed 2e-3
			ASSERT_NEAR(fine.work, fine.energy() + fine.dissipated, 5e-3 * (fine.work + scale * unit));
		}
	}
}

TEST(WallLaw, TangentIsThatOfTheForce)
{
	Spring spring { WallLaw(cyclesOf(1.1), points) };
	for (const double d : { 0.02, 0.015, -0.001, -0.03, -0.02, 0.005, 0.012, 0.017, 0.035, 0.06 }) {
		spring.lead(d, 50);
		const double from = spring.history.stretch, step = 1e-7 * (d > 0 ? 1 : -1);
		WallHistory history = spring.history;
		const WallForce a = spring.law.advance(history, from + step),
		                b = spring.law.advance(a.history, from + 2 * step);
		EXPECT_NEAR(b.tangent, (b.history.force - a.history.force) / step, 1e-4 * k);
	}
}

/// A step that does not resolve the spring: no falling force, and the energy balance of the plateau.
TEST(WallLaw, HeldForceDoesNotFall)
{
	for (const double target : { 1., 1.1 })
		for (const double start : { 0.01, 0.028, 0.035, -0.02 }) {
			Spring spring { WallLaw(cyclesOf(target), points) };
			spring.lead(start, 10);
			double last = -infinity, work = spring.energy();
			WallHistory before = spring.history;
			for (int i = 1; i <= 200; ++i) {
				const double to = start + i * (0.08 - start) / 200;
				const WallForce f = spring.law.hold(spring.history, to);
				work += (before.force + f.history.force) / 2 * (to - before.stretch);
				before = f.history;
				EXPECT_GE(f.history.force, last) << start << " " << to;
				EXPECT_GE(f.tangent, 0);
				EXPECT_NEAR(f.energy + f.dissipated, work, 2e-3 * 7000 * 0.08) << start << " " << to;
				last = f.history.force;
			}
		}
}

TEST(WallLaw, NumbersThatAreNoWall)
{
	const auto unmet = [](double WallCycles::*number, double value) {
		WallCycles changed = cyclesOf(1);
		changed.*number = value;
		const char* const text = WallLaw::unmetBy(changed, points);
		return std::string(text ? text : "");
	};
	EXPECT_EQ(unmet(&WallCycles::friction, Ff), "");
	EXPECT_EQ(unmet(&WallCycles::stiffness, 4.9e5), "nowhere steeper than kn");
	EXPECT_EQ(unmet(&WallCycles::friction, -1), "with a friction force and a pinched stiffness >= 0");
	EXPECT_EQ(unmet(&WallCycles::friction, 7000), "with a pinched line below the largest force");
	EXPECT_EQ(unmet(&WallCycles::target, 0.9), "with a target >= 1");
	EXPECT_EQ(unmet(&WallCycles::reloadShare, 1.1), "with a share of reloading in [0, 1]");
	EXPECT_STREQ(WallLaw::unmetBy(cyclesOf(1), { { 0.01, 10 } }), "of two or more points");
	EXPECT_STREQ(WallLaw::unmetBy(cyclesOf(1), { { 0.01, 10 }, { 0.02, -1 } }), "of forces > 0, the last one >= 0");
}
