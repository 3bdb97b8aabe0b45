// SPDX-License-Identifier: GPL-2.0-or-later
/// Modes of joints: closed forms of single oscillators, two joints against a dense linear system, conservation, limits.
#include "joint_assembly.hpp"
#include <gtest/gtest.h>
#include <unsupported/Eigen/MatrixFunctions>

using namespace timber;
using namespace timber::shapes;

namespace {

constexpr double pi = 3.14159265358979323846;

/// Displacements of an assembly at a time [s] by the matrix exponential.
Vector exact(const Assembly& a, const Vector& x0, const Vector& v0, double time)
{
	const Eigen::Index n = Eigen::Index(a.size());
	Matrix A = Matrix::Zero(2 * n, 2 * n);
	A.topRightCorner(n, n).setIdentity();
	A.bottomLeftCorner(n, n) = -a.inverseMass() * a.stiffness();
	A.bottomRightCorner(n, n) = -a.inverseMass() * a.damping();
	Vector start(2 * n);
	start << x0, v0;
	return ((A * time).exp() * start).head(n);
}

} // namespace

/// Translations along three axes and rotations about them: the damped oscillation exp(-zeta omega t) sin(omega_d t),
/// and its logarithmic decrement over ten periods. I phi'' + c_phi phi' + k_phi phi = 0 with k_phi = sum k r^2 and
/// c_phi = 2 zeta sqrt(I k_phi).
TEST(Oscillator, HasTheDampingRatioInEachDirection)
{
	const double k[] = { 4 * 40000, 4 * 40000, 4 * 60000, 4 * 60000 * 0.05 * 0.05, 4 * 60000 * 0.06 * 0.06,
		4 * 40000 * (0.06 * 0.06 + 0.05 * 0.05) };
	const double m[] = { 8, 8, 8, 0.5, 0.7, 0.02 };
	for (const double zeta : { 0.02, 0.05, 0.3 })
		for (int axis = 0; axis < 6; ++axis) {
			Assembly one = oscillator(zeta);
			const double omega = std::sqrt(k[axis] / m[axis]), damped = omega * std::sqrt(1 - zeta * zeta),
			             h = 2 * pi / damped / 400;
			Vector x0 = Vector::Zero(12), v0 = Vector::Zero(12);
			x0[6 + axis] = 1;
			v0[6 + axis] = -zeta * omega; // x = exp(-zeta omega t) cos(omega_d t)
			const int periods = zeta < 0.1 ? 10 : 2;
			const Vector x = one.run(x0, v0, h, 400 * periods);
			const double decrement = -std::log(x[6 + axis]) / periods,
			             expected = 2 * pi * zeta / std::sqrt(1 - zeta * zeta);
			EXPECT_NEAR(decrement, expected, 2e-3 * expected)
			        << zeta << " " << axis; // (omega h)^2 = 2.5e-4, phase error of ten periods included
			EXPECT_LT((x - x[6 + axis] * x0).norm(), 1e-9) << "other directions do not move";
		}
}

/// Dashpots of tau times the stiffness: each direction has the ratio tau omega / 2; of the tangent stiffness kappa k:
/// kappa times as much. The ratio of the modes falls with kappa^1/2.
TEST(Oscillator, HasDashpotsOfTheTangentStiffness)
{
	const double omega = std::sqrt(4 * 60000 / 8.), h = 2 * pi / omega / 400;
	for (const JointDamping& damping : { JointDamping { 0, 4e-4 }, JointDamping { 0, 4e-4, 0.25 },
	             JointDamping { 0.05, 4e-4, 0.25 }, JointDamping { 0.05, 4e-4, 0 } }) {
		const double zeta
		        = damping.ratio * std::sqrt(damping.tangent) + damping.time * damping.tangent * omega / 2;
		Assembly one = oscillator(0);
		one.joints[0].damping = damping;
		Vector x0 = Vector::Zero(12), v0 = Vector::Zero(12);
		x0[8] = 1;
		v0[8] = -zeta * omega;
		const int steps = int(std::lround(10 * 2 * pi / (omega * std::sqrt(1 - zeta * zeta)) / h));
		// Error of h omega, and of the phase of ten periods
		EXPECT_NEAR(one.run(x0, v0, h, steps)[8], std::exp(-zeta * omega * h * steps), 3e-3);
	}
}

/// The power is that of D in the coordinates of the bodies.
TEST(Chain, TakesThePowerOfItsDashpots)
{
	Random random(23);
	Assembly assembly = chain(0.1);
	for (Joint& joint : assembly.joints)
		joint.damping = { 0.1, 2e-3, 0.3 };
	const Vector v = randomFree(random, assembly);
	assembly.setVelocities(v);
	double power = 0;
	for (const Joint& j : assembly.joints)
		power += dashpotPower(
		        assembly.bodies[j.a], assembly.bodies[j.b], assembly.modesOf(j), Mat3::Identity(), j.damping);
	EXPECT_NEAR(power, v.dot(assembly.damping() * v), 1e-10 * power); // rounding
}

/// One step multiplies the modal velocity by (1 - x + g) / (1 + x + g), x = h zeta omega, with g = (h omega)^2 / 4 of
/// the implicit springs of a stiff joint: it never changes its energy upwards, however large x is.
TEST(Oscillator, IsStableAtAnyRate)
{
	for (const double x : { 1e-3, 0.9, 1e3, 1e6 }) {
		const double g = x > 0.5 ? x * x / 4 : 0; // h omega > 1 of its fastest mode makes a joint stiff
		Assembly one = oscillator(1);
		one.setVelocities((Vector(12) << 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 0, 0).finished());
		one.startSprings(x / std::sqrt(4 * 60000 / 8.));
		one.damp(x / std::sqrt(4 * 60000 / 8.));
		// Rounding of some products, and of terms that are g times as large as their difference
		EXPECT_NEAR(one.velocities()[8], 2 * (1 - x + g) / (1 + x + g), 1e-12 + 1e-15 * g) << x;
	}
}

/// A chain with strong damping and long steps: all energy that disappears is dissipated, and none appears.
TEST(Chain, LosesTheEnergyThatIsDissipated)
{
	Random random(3);
	for (const double h : { 1e-4, 1e-2, 1., 1e3 }) {
		Assembly assembly = chain(1);
		assembly.setVelocities(randomFree(random, assembly));
		// Rigid dashpots of light members converge slowly
		const double before = kineticEnergy(assembly.bodies), dissipated = assembly.damp(h, 500000);
		double stored = 0;
		for (const Assembly::Springs& springs : assembly.history)
			stored += springs.account;
		// Residual of the sweeps
		EXPECT_NEAR(before - kineticEnergy(assembly.bodies), dissipated + stored, 1e-9 * before) << h;
		EXPECT_GE(dissipated, 0) << h;
	}
}

/// The sweeps solve M v' = M v + h f - h D (v + v') / 2 - N (v' - v) of all bodies, N = h2 K / 4 of stiff joints.
TEST(Chain, SolvesTheDenseSystem)
{
	Random random(7);
	for (const double ratio : { 0.02, 0.3, 1. })
		for (const double h : { 2.5e-4, 5e-3 }) {
			Assembly assembly = chain(ratio);
			const Matrix W = assembly.inverseMass(), D = assembly.damping(), N = assembly.stiffMass(h),
			             one = Matrix::Identity(18, 18);
			const Vector v = randomFree(random, assembly), change = randomFree(random, assembly);
			const Vector expected = (one + h / 2 * W * D + W * N)
			                                .partialPivLu()
			                                .solve(v + change - h / 2 * W * D * v + W * N * v);
			assembly.setVelocities(v);
			assembly.startSprings(h);
			assembly.accelerate(change);
			assembly.damp(h, 5000);
			EXPECT_LT((assembly.velocities() - expected).norm(), 1e-9 * expected.norm())
			        << ratio << " " << h; // residual of the sweeps
		}
}

/// The error against the matrix exponential falls with the square of the step.
TEST(Chain, ConvergesWithSecondOrderToTheExponential)
{
	Random random(11);
	for (const double ratio : { 0.05, 0.5 }) {
		Assembly assembly = chain(ratio);
		const Vector x0 = 1e-3 * randomFree(random, assembly), v0 = 0.1 * randomFree(random, assembly);
		const double time = 0.1;
		const Vector expected = exact(assembly, x0, v0, time);
		double before = 0;
		for (const int steps : { 400, 800, 1600 }) {
			const double error
			        = (assembly.run(x0, v0, time / steps, steps) - expected).norm() / expected.norm();
			if (before > 0) {
				EXPECT_NEAR(before / error, 4, 0.2) << ratio << " " << steps; // higher orders
			}
			before = error;
		}
		EXPECT_LT(before, 1e-3); // the fastest mode turns by 0.06 rad in a step
	}
}

/// Free bodies: the impulses are opposite and act along one line.
TEST(Chain, ConservesMomentumAndAngularMomentum)
{
	Random random(5);
	Assembly assembly = chain(0.5);
	assembly.bodies[0] = member(5, { 0.3, 0.4, 0.2 }, { 0.1, -0.2, -0.5 });
	assembly.setVelocities(Vector::NullaryExpr(18, [&] { return uniform(random, -1, 1); }));
	const auto momenta = [&] {
		Vec6 sum = Vec6::Zero();
		for (const SolverBody& b : assembly.bodies) {
			const Vec3 p = b.newVelocity / b.inverseMass;
			sum.head<3>() += p;
			sum.tail<3>() += b.position.cross(p) + b.inverseInertia.inverse() * b.newSpin;
		}
		return sum;
	};
	const Vec6 before = momenta();
	assembly.damp(1e-3);
	EXPECT_LT((momenta() - before).norm(), 1e-12 * before.norm());
}

TEST(Chain, RigidMotionIsNotDamped)
{
	Assembly assembly = chain(1);
	assembly.bodies[0] = member(5, { 0.3, 0.4, 0.2 }, { 0.1, -0.2, -0.5 });
	const Vec3 spin(0.3, -1, 2);
	Vector v(18);
	for (size_t k = 0; k < 3; ++k)
		v.segment<6>(Eigen::Index(6 * k)) << Vec3(1, 2, 3) + spin.cross(assembly.bodies[k].position), spin;
	assembly.setVelocities(v);
	assembly.damp(1e-3);
	EXPECT_LT((assembly.velocities() - v).norm(), 1e-12 * v.norm());
}

/// A joint with one spring left resists no rotation about it.
TEST(Oscillator, OneSpringDampsNoRotation)
{
	Assembly one = oscillator(1);
	one.joints[0].broken = { 1, 1, 1, 0 };
	one.setVelocities(
	        (Vector(12) << 0, 0, 0, 0, 0, 0, Vec3(1, 2, 3).cross(Vec3(0.06, 0.05, 0)), Vec3(1, 2, 3)).finished());
	const Vector v = one.velocities();
	one.damp(1e-2);
	// The square root of the rounding of a zero eigenvalue
	EXPECT_LT((one.velocities() - v).norm(), 1e-6 * v.norm());
}

/// sweeps = 0: the impulse of the velocities before the step, -h D w.
TEST(Oscillator, ExplicitWithoutSweeps)
{
	Assembly assembly = chain(0.3);
	Random random(13);
	const double h = 1e-5;
	const Vector v = randomFree(random, assembly), change = randomFree(random, assembly);
	assembly.setVelocities(v);
	assembly.accelerate(change);
	assembly.damp(h, 0);
	const Vector expected = v + change - h * assembly.inverseMass() * assembly.damping() * v;
	// Rounding times the ratio of the column's inertias
	EXPECT_LT((assembly.velocities() - expected).norm(), 1e-11 * expected.norm());
}

/// Modes depend on springs, masses, moments of inertia and the placement of the bodies against each other.
TEST(JointModes, FitWhatTheyWereComputedFor)
{
	const JointState state { 4, { 100, 200 }, { 0.3, 0.4 }, { 1, 2 }, about(Vec3::UnitX(), 0.3).toRotationMatrix(),
		{ 0, 0, 0.01 } };
	const double shift = 0.02;
	EXPECT_TRUE(state.fits(state, modeAngle, shift));
	const auto changed = [&](auto change) {
		JointState other = state;
		change(other);
		return other;
	};
	for (const JointState& other : {
	             changed([](JointState& s) { s.springs = 3; }),
	             changed([](JointState& s) { s.stiffness.shear = 201; }),
	             changed([](JointState& s) { s.inverseMass.reverseInPlace(); }),
	             changed([](JointState& s) { s.inverseInertia.reverseInPlace(); }),
	     })
		EXPECT_FALSE(state.fits(other, modeAngle, shift));
	for (const double share : { 0.9, 1.1 }) {
		for (const double limit : { 1e-3, modeAngle }) {
			const Mat3 turned = about(Vec3::UnitZ(), share * limit) * state.relative;
			EXPECT_EQ(state.fits(changed([&](JointState& s) { s.relative = turned; }), limit, shift),
			        share < 1);
		}
		EXPECT_EQ(state.fits(changed([&](JointState& s) { s.opening.x() = share * shift; }), modeAngle, shift),
		        share < 1);
	}
	EXPECT_FALSE(JointState().fits(state, modeAngle, shift));
}

namespace {

/// A body on an arm about a ball joint at the origin, turned by a rotation vector [rad].
Assembly onArm(const Vec3& turn)
{
	const Mat3 axes = Eigen::AngleAxisd(turn.norm(), turn.stableNormalized()).toRotationMatrix();
	Assembly assembly { { body(0, Vec3::Zero()), member(10, { 0.07, 0.2, 0.01 }, axes * Vec3(0.3, 0, 2)) }, {} };
	SolverBody& bob = assembly.bodies[1];
	bob.inverseInertia = axes * bob.inverseInertia * axes.transpose();
	assembly.joints.push_back({ 0, 1, { Vec3::Zero() }, { 1e8, 1e8 }, Vec3::UnitZ(), { 0 } });
	return assembly;
}

} // namespace

/// (4): bound of E by finite differences, which some axis reaches but for the sum over three.
TEST(JointModes, KnowTheirErrorAfterARotation)
{
	Random random(17);
	const Assembly start = onArm(Vec3::Zero());
	const JointModes modes = start.modesOf(start.joints[0]);
	double largest = 0;
	for (int trial = 0; trial < 100; ++trial) {
		const Assembly turned = onArm(1e-6 * randomDirection(random));
		const Mat6 T = turned.modesOf(turned.joints[0]).twists, // R = T T^T
		        E = modes.modes.transpose() * T * T.transpose() * modes.modes - Mat6::Identity();
		largest = std::max(largest, E.norm() / 1e-6);
	}
	EXPECT_LE(largest, modes.sensitivity * (1 + 1e-3)); // curvature, rounding
	EXPECT_GT(largest, modes.sensitivity / 2);
	EXPECT_LT(modes.largestTurn(5e-4, { 0 }), modeError / modes.sensitivity * (1 + 1e-12));
}

/// Springs of one stiffness, turned by any angle, have at most 2^1/2 times the frequency, of two stiffnesses more: what
/// is not stiff with that reserve is not stiff in any placement.
TEST(JointModes, KnowWhetherATurnMayMakeThemStiff)
{
	Random random(31);
	double largest = 0;
	const auto modesOf = [](const Quat& turn, const JointStiffness& k) {
		const Vec3 moments(0.1, 6, 6), arm(0, 1, 0); // one direction moves by far most easily
		Assembly a { { member(10, moments, arm), member(10, moments, turn * arm) }, {} };
		const Mat3 axes = turn.toRotationMatrix();
		a.bodies[1].inverseInertia = axes * a.bodies[1].inverseInertia * axes.transpose();
		a.joints.push_back({ 0, 1, square(Vec3::Zero(), 0.06, 0.05), k, Vec3::UnitZ(), { 0 } });
		return a.modesOf(a.joints[0]);
	};
	for (const JointStiffness& k : { JointStiffness { 6e4, 6e4 }, JointStiffness { 6e4, 2e4 } })
		for (int trial = 0; trial < 200; ++trial) {
			const JointModes first = modesOf(randomRotation(random), k);
			const double omega = modesOf(randomRotation(random), k).frequencies[5], h = 1 / omega;
			EXPECT_TRUE(first.mayBeStiff(1.001 * h));
			if (k.normal == k.shear) largest = std::max(largest, omega / first.frequencies[5]);
		}
	EXPECT_GT(largest, 1.3);
	EXPECT_FALSE(modesOf(Quat::Identity(), { 6e4, 6e4 }).mayBeStiff(1e-6));
}

/// Visits converge with modes of a placement that is as far away as they serve.
TEST(JointModes, ConvergeUpToTheirLargestTurn)
{
	Random random(29);
	const double h = 5e-4;
	const Assembly start = onArm(Vec3::Zero());
	const JointModes modes = start.modesOf(start.joints[0]);
	ASSERT_TRUE(modes.isStiff(h));
	for (int trial = 0; trial < 20; ++trial) {
		Assembly turned = onArm(modes.largestTurn(h, { 0 }) * randomDirection(random));
		turned.setVelocities(
		        (Vector(12) << Vector::Zero(6), randomDirection(random), randomDirection(random)).finished());
		turned.startSprings(h);
		ContactSolver solver;
		solver.begin(turned.bodies, h, 100);
		solver.addJoint<6>(0, 1);
		ModalConstraint<6>& c = solver.prepareJoint<6>(0, modes, Mat3::Identity(), { 0 });
		addSprings(c, turned.springSteps(turned.joints[0], turned.history[0], modes, h));
		const Convergence end = solver.solve(1e-8);
		EXPECT_TRUE(end.converged);
		EXPECT_LT(end.sweeps, 15); // (1/4)^15 = 1e-9
	}
}

/// The converged impulse dissipates energy whatever the modes are: those of another placement, of other bodies, of
/// springs that are gone.
TEST(JointModes, OldOnesAddNoEnergy)
{
	Random random(5);
	for (int trial = 0; trial < 300; ++trial) {
		Assembly assembly = chain(1);
		assembly.setVelocities(randomFree(random, assembly));
		const double before = kineticEnergy(assembly.bodies), h = std::pow(10, uniform(random, -5, -2));
		ContactSolver solver;
		solver.begin(assembly.bodies, h, 500);
		std::vector<JointModes> modes;
		for (const Joint& j : assembly.joints)
			modes.push_back(assembly.modesOf(j));
		// The bodies have turned since then
		const Mat3 axes = about(randomDirection(random), modeAngle).toRotationMatrix();
		for (size_t k = 0; k < assembly.joints.size(); ++k)
			solver.prepareJoint<6>(
			        solver.addJoint<6>(assembly.joints[k].a, assembly.joints[k].b), modes[k], axes, { 1 });
		solver.solve(1e-10);
		double dissipated = 0;
		for (size_t k = 0; k < assembly.joints.size(); ++k) {
			EXPECT_GE(solver.joint<6>(k).dissipated, -1e-6 * before) << trial << " " << h;
			dissipated += solver.joint<6>(k).dissipated;
		}
		EXPECT_NEAR(kineticEnergy(assembly.bodies) + dissipated, before, 1e-6 * before) << trial << " " << h;
	}
}

/// A contact and a damped joint between the same bodies: both laws hold at the end of the sweeps.
TEST(Chain, IsSolvedTogetherWithContacts)
{
	Random random(17);
	Assembly assembly = chain(1);
	assembly.setVelocities(randomFree(random, assembly));
	const double h = 1e-3;
	const std::vector<SolverBody> start = assembly.bodies;
	ContactSolver solver;
	solver.begin(assembly.bodies, h, 5000);
	HeapPoint p = central(3000, 50000);
	p.friction = 1e3; // sticks
	p.armA = Vec3(0.05, 0.05, 2.8) - start[1].position;
	p.armB = Vec3(0.05, 0.05, 2.8) - start[2].position;
	solver.prepare<double>(solver.addPair(1, 2, 1), 0, p);
	std::vector<JointModes> modes;
	for (const Joint& j : assembly.joints)
		modes.push_back(assembly.modesOf(j));
	for (size_t k = 0; k < 2; ++k)
		solver.prepareJoint<6>(solver.addJoint<6>(assembly.joints[k].a, assembly.joints[k].b), modes[k],
		        Mat3::Identity(), { 1 });
	solver.solve(1e-12);
	Vector impulse = Vector::Zero(18); // of the contact
	const Vec3 contact = worldImpulse(*solver.stepsOf(solver.pair(0)));
	impulse.segment<6>(6) << -contact, -p.armA.cross(contact);
	impulse.segment<6>(12) << contact, p.armB.cross(contact);
	const Assembly before { start, assembly.joints, {} };
	const Matrix W = assembly.inverseMass();
	const Vector v = before.velocities(), after = assembly.velocities();
	const Vector expected = v + W * impulse - h / 2 * W * assembly.damping() * (v + after);
	EXPECT_GT(contact.z(), 0);
	EXPECT_LT((after - expected).norm(), 1e-8 * expected.norm()); // residual of the sweeps
}

namespace {
/// Bodies with one joint of a single spring along its normal.
Assembly axial(Random& random)
{
	Assembly a { { member(8, { 0.5, 0.7, 0.02 }, Vec3(0.2, 0, 0.1)),
		             member(20, { 0.1, 3, 4 }, Vec3(0.3, 0.4, -0.2)) },
		{} };
	a.joints.push_back({ 0, 1, { Vec3(0.1, 0.15, 0.05) }, { 3e5, 0 }, randomDirection(random), { 0, 2e-3, 0.4 } });
	a.setVelocities(Vector::NullaryExpr(12, [&] { return uniform(random, -1, 1); }));
	return a;
}
SpringAxis lineOf(const Assembly& a)
{
	const Joint& j = a.joints[0];
	return { a.bodies[0], a.bodies[1], j.normal, j.points[0] - a.bodies[0].position,
		j.points[0] - a.bodies[1].position, j.stiffness.normal };
}
/// Velocities after a step of one mode. Returns the energy that its dashpots dissipate.
double stepAlongLine(Assembly& a, double h)
{
	const Joint& j = a.joints[0];
	const SpringAxis line = lineOf(a);
	BrittleSprings law(j.stiffness, { std::numeric_limits<double>::infinity(), false }, j.normal);
	ContactSolver solver;
	solver.begin(a.bodies, h, 50);
	solver.addJoint<1>(0, 1);
	ModalConstraint<1>& c = solver.prepareJoint<1>(0, line, Mat3::Identity(), j.damping);
	if (h * line.frequency() > stiffPhase) {
		const Vec3 from = j.normal.dot(a.history[0].half[0]) * j.normal;
		const SpringStep<1> step { 0, from, Vec3::Zero(), Vec3::Zero(), std::sqrt(line.response) * j.normal,
			Vec3::Zero() };
		addSprings(c, SpringSteps<1>(law, { step }, a.history[0].account, h));
	}
	solver.solve(1e-14);
	return solver.joint<1>(0).dissipated + solver.joint<1>(0).springs.dissipated;
}
}

/// A single spring along an axis has one mode with a stiffness: frequency, power of the dashpots and step are those of
/// the six. (Rounding leaves the five others 1e-8 of its frequency, so dashpots proportional to the frequency would
/// differ by as much.)
TEST(Axis, MovesBodiesAsItsSixModesDo)
{
	Random random(41);
	for (const double h : { 1e-5, 1e-4, 1e-3, 5e-3 })
		for (int trial = 0; trial < 20; ++trial) {
			Assembly one = axial(random);
			one.startSprings(h);
			Assembly six = one;
			const SpringAxis line = lineOf(one);
			const SolverBody &a = one.bodies[0], &b = one.bodies[1];
			const JointModes modes = six.modesOf(six.joints[0]);
			const JointDamping& damping = one.joints[0].damping;
			const double power = dashpotPower(a, b, line, damping);
			EXPECT_NEAR(line.frequency(), modes.frequencies[5], 1e-12 * line.frequency());
			EXPECT_NEAR(power, dashpotPower(a, b, modes, Mat3::Identity(), damping), 1e-11 * power);
			const double dissipated = stepAlongLine(one, h);
			EXPECT_NEAR(six.damp(h, 50), dissipated, 1e-11 * dissipated) << h;
			EXPECT_LT((one.velocities() - six.velocities()).norm(), 1e-11 * six.velocities().norm()) << h;
		}
}

/// Dashpots along one line act as one: the sum moves the bodies as two do that the sweeps visit one after the other.
TEST(Axis, DashpotsOfALineAddUp)
{
	Random random(66);
	for (const double h : { 1e-5, 1e-4, 5e-4 })
		for (int trial = 0; trial < 20; ++trial) {
			Assembly a = axial(random);
			const JointDamping first { 0.03, 2e-3, 0.4 }, second { 0.1, 1e-3, 1 };
			std::vector<SolverBody> two = a.bodies, one = a.bodies;
			ContactSolver apart, together;
			apart.begin(two, h, 100000);
			together.begin(one, h, 50);
			SpringAxis line = lineOf(a);
			for (const JointDamping& damping : { first, second }) {
				const size_t place = apart.addJoint<1>(0, 1);
				apart.prepareJoint<1>(place, line, Mat3::Identity(), damping);
			}
			line.others = second.of(line.frequency());
			together.addJoint<1>(0, 1);
			together.prepareJoint<1>(0, line, Mat3::Identity(), first);
			apart.solve(1e-14);
			together.solve(1e-14);
			const double dissipated = together.joint<1>(0).dissipated;
			// Rounding: of velocities of some m/s and energies of some 10 J
			EXPECT_NEAR(apart.joint<1>(0).dissipated + apart.joint<1>(1).dissipated, dissipated,
			        1e-11 * dissipated + 1e-14);
			for (int k = 0; k < 2; ++k) {
				const Vec3 changed = one[k].newVelocity - a.bodies[k].newVelocity;
				EXPECT_LT((two[k].newVelocity - one[k].newVelocity).norm(),
				        1e-11 * changed.norm() + 1e-14);
			}
		}
}
