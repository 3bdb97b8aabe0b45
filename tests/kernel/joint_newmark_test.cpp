// SPDX-License-Identifier: GPL-2.0-or-later
/// Linear springs of stiff joints: any step is stable, and what they take is given back.
#include "joint_assembly.hpp"
#include <gtest/gtest.h>

using namespace timber;
using namespace timber::shapes;

/// Implicit springs keep the amplitude of an undamped joint at any step and advance its phase by acos(1 - y / (2 + y /
/// 2)), y = (h omega)^2; explicit ones are unstable beyond h omega = 2.
TEST(Newmark, StiffSpringsSetNoLimitToTheStep)
{
	const double start = 1e-4;
	for (const double turn : { 1.1, 2., 10., 300. }) {
		MassOnSpring m { 30, 5e7, start };
		const double h = turn / m.omega(), y = turn * turn, phase = std::acos(1 - y / (2 + y / 2));
		// Half a step earlier, on the orbit of start cos(phase k)
		m.velocity() = start * (1 - std::cos(phase)) / h;
		m.assembly.displacements = (Vector(12) << Vector::Zero(8), start, Vector::Zero(3)).finished();
		m.assembly.startSprings(h);
		for (int n = 1; n <= 200; ++n) {
			m.step(h);
			EXPECT_NEAR(m.x, start * std::cos(phase * n), 1e-9 * start * turn * turn)
			        << turn << " " << n; // rounding adds up
		}
	}
}

/// A velocity that is imposed between two steps gives a stiff spring no more than its exact amplitude, v / omega.
TEST(Newmark, ImposedVelocity)
{
	const double speed = 0.1;
	for (const double turn : { 1.1, 3., 30. }) {
		MassOnSpring m { 30, 5e7 };
		double largest = 0;
		for (int n = 0; n < 200; ++n) {
			if (n == 1) m.velocity() += speed;
			m.step(turn / m.omega());
			largest = std::max(largest, std::abs(m.x));
		}
		EXPECT_GT(largest, 0.95 * speed / m.omega()) << turn;
		EXPECT_LT(largest, 1.1 * speed / m.omega())
		        << turn; // half a step before the first sample: 1.04 to 1.07
	}
}

/// Stiff joints are solved further than others: an error of their impulses acts as (h omega)^4. Without, the energy
/// grows without limit.
TEST(Newmark, StiffJointsConvergeAtTheSolversTolerance)
{
	Random random(13);
	for (const double turn : { 3., 30. }) {
		Assembly stiff = chain(0.05);
		const Matrix W = stiff.inverseMass(), K = stiff.stiffness(), one = Matrix::Identity(18, 18);
		const double h = turn / stiff.largestFrequency();
		const Vector x0 = 1e-3 * randomFree(random, stiff);
		const Vector v0 // at rest half a step earlier
		        = (one + h / 2 * W * stiff.damping()).partialPivLu().solve(-h / 2 * W * K * x0);
		const Vector converged = stiff.run(x0, v0, h, 100), swept = stiff.run(x0, v0, h, 100, 1e-3);
		EXPECT_LT(swept.norm(), 1.1 * converged.norm()) << turn;
		// Where h omega >> 1, phases differ after 100 steps
		if (turn < 10) {
			EXPECT_LT((swept - converged).norm(), 1e-3 * converged.norm()); // tolerance
		}
	}
}

/// Without sweeps no spring is implicit, also of a stiff joint: the dashpots dissipate what the bodies lose.
TEST(Newmark, ExplicitDashpotsStoreNoEnergy)
{
	Assembly assembly = oscillator(0.001);
	Random random(14);
	const double h = 0.1;
	ASSERT_GT(assembly.stiffMass(h).norm(), 0);
	assembly.setVelocities(randomFree(random, assembly));
	const double before = kineticEnergy(assembly.bodies), dissipated = assembly.damp(h, 0);
	EXPECT_EQ(assembly.history[0].account, 0);
	EXPECT_GT(dissipated, 0);
	EXPECT_NEAR(dissipated, before - kineticEnergy(assembly.bodies), 1e-12 * before);
}
