// SPDX-License-Identifier: GPL-2.0-or-later
/// Modes of joints: closed forms of single oscillators, two joints against a dense linear system, conservation, limits.
#include "heap.hpp"
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <gtest/gtest.h>
#include <kernel/joint_modes.hpp>
#include <unsupported/Eigen/MatrixFunctions>

using namespace timber;
using namespace timber::shapes;

namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;
constexpr double pi = 3.14159265358979323846;

/// A joint in the world frame; the bodies' frames are parallel to it.
struct Joint {
	int a, b;
	std::vector<Vec3> points; ///< [m]
	JointStiffness stiffness;
	Vec3 normal = Vec3::UnitZ();
	double ratio = 0.05;
	std::vector<int> broken = std::vector<int>(points.size(), 0);
};

JointState stateOf(const Joint& j)
{
	return { size_t(std::count(j.broken.begin(), j.broken.end(), 0)), j.stiffness, 1, 1, Quat::Identity() };
}

/// Bodies and joints with linear springs: displacements and rotations x, six numbers for each body, leave the arms as
/// they are.
struct Assembly {
	std::vector<SolverBody> bodies;
	std::vector<Joint> joints;
	std::vector<NewmarkHistory> history = {}; ///< of the joints

	size_t size() const { return 6 * bodies.size(); }
	/// Zero for a fixed body.
	Matrix inverseMass() const
	{
		Matrix matrix = Matrix::Zero(size(), size());
		for (size_t k = 0; k < bodies.size(); ++k) {
			matrix.block<3, 3>(6 * k, 6 * k) = bodies[k].inverseMass * Mat3::Identity();
			matrix.block<3, 3>(6 * k + 3, 6 * k + 3) = bodies[k].inverseInertia;
		}
		return matrix;
	}
	/// Sum of the springs of one joint.
	Matrix stiffness(const Joint& joint) const
	{
		Matrix matrix = Matrix::Zero(size(), size());
		const Mat3 k = joint.stiffness.shear * Mat3::Identity()
		        + (joint.stiffness.normal - joint.stiffness.shear) * joint.normal * joint.normal.transpose();
		for (size_t i = 0; i < joint.points.size(); ++i) {
			Matrix stretch = Matrix::Zero(3, size());
			for (const auto& [body, sign] : { std::pair(joint.a, -1.), std::pair(joint.b, 1.) }) {
				stretch.block<3, 3>(0, 6 * body) = sign * Mat3::Identity();
				stretch.block<3, 3>(0, 6 * body + 3)
				        = -sign * crossMatrix(joint.points[i] - bodies[body].position);
			}
			if (!joint.broken[i]) matrix += stretch.transpose() * k * stretch;
		}
		return matrix;
	}
	Matrix stiffness() const
	{
		Matrix matrix = Matrix::Zero(size(), size());
		for (const Joint& joint : joints)
			matrix += stiffness(joint);
		return matrix;
	}
	/// M^1/2 f(omega^2) M^1/2 of each joint and its bodies, with the eigenvalues omega^2 of M^-1/2 K M^-1/2, by
	/// another way than the kernel's: in the coordinates of the bodies.
	template <class Function> Matrix ofModes(Function f) const
	{
		Matrix matrix = Matrix::Zero(size(), size());
		const Matrix root = Eigen::SelfAdjointEigenSolver<Matrix>(inverseMass()).operatorSqrt(); // M^-1/2
		const Matrix inverse = root.completeOrthogonalDecomposition().pseudoInverse();
		for (const Joint& joint : joints) {
			const Eigen::SelfAdjointEigenSolver<Matrix> modes(root * stiffness(joint) * root);
			// Rounding of the rigid motions' eigenvalues
			const double zero = 1e-12 * modes.eigenvalues().maxCoeff();
			const Vector values = modes.eigenvalues().unaryExpr(
			        [&](double square) { return square > zero ? f(joint, square) : 0; });
			matrix += inverse * modes.eigenvectors() * values.asDiagonal()
			        * modes.eigenvectors().transpose() * inverse;
		}
		return matrix;
	}
	Matrix damping() const
	{
		return ofModes([](const Joint& joint, double square) { return 2 * joint.ratio * std::sqrt(square); });
	}
	Matrix newmark(double h) const
	{
		return ofModes([h](const Joint&, double square) {
			const double y = h * h * square;
			return y > stiffPhase * stiffPhase ? y * y / (4 * y + 2) : 0;
		});
	}
	Vector velocities() const
	{
		Vector v(size());
		for (size_t k = 0; k < bodies.size(); ++k)
			v.segment<6>(6 * k) << bodies[k].newVelocity, bodies[k].newSpin;
		return v;
	}
	void setVelocities(const Vector& v)
	{
		for (size_t k = 0; k < bodies.size(); ++k) {
			bodies[k].velocity = bodies[k].newVelocity = v.segment<3>(6 * k);
			bodies[k].spin = bodies[k].newSpin = v.segment<3>(6 * k + 3);
		}
	}
	/// Starts a step: the velocities before it are those after the last one, the new ones contain an acceleration.
	void accelerate(const Vector& change)
	{
		setVelocities(velocities());
		for (size_t k = 0; k < bodies.size(); ++k) {
			bodies[k].newVelocity += change.segment<3>(6 * k);
			bodies[k].newSpin += change.segment<3>(6 * k + 3);
		}
	}
	JointModes modesOf(const Joint& j) const
	{
		std::vector<Vec3> anchors = j.points;
		for (Vec3& point : anchors)
			point -= bodies[j.a].position;
		return jointModes(bodies[j.a], bodies[j.b], Mat3::Identity(),
		        { anchors, j.broken, j.stiffness, j.normal }, stateOf(j));
	}
	/// Newmark's terms as after a step of h [s] that has led to the present velocities.
	void startNewmark(double h)
	{
		history.clear();
		for (const Joint& j : joints) {
			const SolverBody &a = bodies[j.a], &b = bodies[j.b];
			const JointModes modes = modesOf(j);
			const Vec3 arm = modes.centre, other = a.position + arm - b.position;
			Vec6 w;
			w << b.newVelocity + b.newSpin.cross(other) - a.newVelocity - a.newSpin.cross(arm),
			        b.newSpin - a.newSpin;
			const Vec6 eta = modes.modes.transpose() * w;
			const Vec6 g = modes.frequencies.unaryExpr([h](double omega) {
				const double y = h * h * omega * omega;
				return y > stiffPhase * stiffPhase ? y * y / (4 * y + 2) : 0;
			});
			const Vec6 momentum = modes.modes * g.cwiseProduct(eta);
			history.push_back({ eta.dot(g.cwiseProduct(eta)) / 2, momentum.head<3>(), momentum.tail<3>() });
		}
	}
	/// The dashpots of one step. Returns the dissipated energy.
	double damp(double h, int sweeps = 50, double tolerance = 1e-14)
	{
		ContactSolver solver;
		std::vector<JointModes> modes(joints.size());
		history.resize(joints.size());
		solver.begin(bodies, h, sweeps);
		for (size_t k = 0; k < joints.size(); ++k) {
			const Joint& j = joints[k];
			modes[k] = modesOf(j);
			solver.addJoint(j.a, j.b);
			solver.prepareJoint(k, modes[k], Mat3::Identity(), j.ratio, history[k]);
		}
		solver.solve(tolerance);
		double dissipated = 0;
		for (size_t k = 0; k < joints.size(); ++k) {
			dissipated += solver.joint(k).dissipated;
			history[k] = solver.joint(k).history;
		}
		return dissipated;
	}
	/// Displacements after `steps` steps of the leapfrog from x0 with the velocities v0.
	Vector run(const Vector& x0, const Vector& v0, double h, int steps, double tolerance = 1e-14)
	{
		const Matrix W = inverseMass(), K = stiffness();
		Vector x = x0;
		history.clear();
		setVelocities(v0 + h / 2 * W * (K * x0 + damping() * v0)); // half a step earlier
		for (int k = 0; k < steps; ++k) {
			accelerate(-h * W * (K * x));
			damp(h, 10000, tolerance);
			x += h * velocities();
		}
		return x;
	}
	/// The same at a time [s] by the matrix exponential.
	Vector exact(const Vector& x0, const Vector& v0, double time) const
	{
		const Eigen::Index n = Eigen::Index(size());
		Matrix A = Matrix::Zero(2 * n, 2 * n);
		A.topRightCorner(n, n).setIdentity();
		A.bottomLeftCorner(n, n) = -inverseMass() * stiffness();
		A.bottomRightCorner(n, n) = -inverseMass() * damping();
		Vector start(2 * n);
		start << x0, v0;
		return ((A * time).exp() * start).head(n);
	}
};

SolverBody member(double mass, const Vec3& moments, const Vec3& position)
{
	SolverBody b = body(mass, Vec3::Zero());
	if (mass > 0) b.inverseInertia = moments.cwiseInverse().asDiagonal();
	b.position = position;
	return b;
}

std::vector<Vec3> square(const Vec3& centre, double x, double y)
{
	return { centre + Vec3(x, y, 0), centre + Vec3(-x, y, 0), centre + Vec3(x, -y, 0), centre + Vec3(-x, -y, 0) };
}

/// A body on the ground, held by four springs about its centre: six independent oscillators.
Assembly oscillator(double ratio)
{
	Assembly assembly { { body(0, Vec3::Zero()), member(8, { 0.5, 0.7, 0.02 }, Vec3::Zero()) }, {} };
	assembly.joints.push_back({ 0, 1, square(Vec3::Zero(), 0.06, 0.05), { 60000, 40000 }, Vec3::UnitZ(), ratio });
	return assembly;
}

/// Ground, slender column and beam with two joints off their centres.
Assembly chain(double ratio)
{
	Assembly assembly { { body(0, Vec3::Zero()), member(10, { 6, 6, 0.02 }, { 0, 0, 1.4 }),
		                    member(30, { 0.1, 40, 40 }, { 1, 0.1, 2.9 }) },
		{} };
	assembly.joints.push_back({ 0, 1, square({ 0, 0, 0 }, 0.05, 0.05), { 58800, 58800 }, Vec3::UnitZ(), ratio });
	assembly.joints.push_back(
	        { 1, 2, square({ 0, 0, 2.8 }, 0.05, 0.06), { 58800, 30000 }, Vec3(0.6, 0, 0.8), ratio });
	return assembly;
}

Vector randomFree(Random& random, const Assembly& assembly)
{
	Vector x = Vector::Zero(Eigen::Index(assembly.size()));
	for (size_t k = 6; k < assembly.size(); ++k) // the first body is fixed
		x[Eigen::Index(k)] = uniform(random, -1, 1);
	return x;
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

/// One step multiplies the modal velocity by (1 - x + g) / (1 + x + g), x = h zeta omega, with Newmark's g for h omega
/// > 1: it never changes its energy upwards, however large x is.
TEST(Oscillator, IsStableAtAnyRate)
{
	for (const double x : { 1e-3, 0.9, 1e3, 1e6 }) {
		const double g = x > 1 ? std::pow(x, 4) / (4 * x * x + 2) : 0;
		Assembly one = oscillator(1);
		one.setVelocities((Vector(12) << 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 0, 0).finished());
		one.startNewmark(x / std::sqrt(4 * 60000 / 8.));
		one.damp(x / std::sqrt(4 * 60000 / 8.));
		// Rounding of some products
		EXPECT_NEAR(one.velocities()[8], 2 * (1 - x + g) / (1 + x + g), 1e-12) << x;
	}
}

/// Newmark's term keeps the amplitude of an undamped joint at any step and advances its phase by acos(1 - y / (2 + 2
/// beta y)), y = (h omega)^2;
/// without it the scheme is unstable beyond h omega = 2.
TEST(Oscillator, StiffSpringsSetNoLimitToTheStep)
{
	const double mass = 30, k = 5e7, omega = std::sqrt(k / mass), start = 1e-4;
	for (const double turn : { 1.1, 2., 10., 300. }) {
		Assembly assembly { { body(0, Vec3::Zero()), body(mass, Vec3::Zero()) },
			{ { 0, 1, { Vec3::Zero() }, { k, k }, Vec3::UnitZ(), 0 } }, {} };
		const double h = turn / omega, y = turn * turn,
		             phase = std::acos(1 - y / (2 + 2 * y * y / (4 * y + 2)));
		double x = start;
		// Half a step earlier, on the orbit of start cos(phase k)
		assembly.bodies[1].newVelocity.z() = start * (1 - std::cos(phase)) / h;
		assembly.setVelocities(assembly.velocities());
		assembly.startNewmark(h);
		for (int n = 1; n <= 200; ++n) {
			assembly.accelerate(
			        (Vector(12) << Vector::Zero(8), -h * k * x / mass, Vector::Zero(3)).finished());
			assembly.damp(h);
			x += h * assembly.bodies[1].newVelocity.z();
			EXPECT_NEAR(x, start * std::cos(phase * n), 1e-9 * start * turn * turn)
			        << turn << " " << n; // rounding adds up
		}
	}
}

/// A velocity that is imposed between two steps gives a stiff spring no more than its exact amplitude.
TEST(Oscillator, ImposedVelocity)
{
	const double mass = 30, k = 5e7, omega = std::sqrt(k / mass), speed = 0.1;
	for (const double turn : { 1.1, 3., 30. }) {
		Assembly assembly { { body(0, Vec3::Zero()), body(mass, Vec3::Zero()) },
			{ { 0, 1, { Vec3::Zero() }, { k, k }, Vec3::UnitZ(), 0 } }, {} };
		const double h = turn / omega;
		double x = 0, largest = 0;
		for (int n = 0; n < 200; ++n) {
			if (n == 1) assembly.bodies[1].newVelocity.z() += speed;
			assembly.accelerate(
			        (Vector(12) << Vector::Zero(8), -h * k * x / mass, Vector::Zero(3)).finished());
			assembly.damp(h);
			x += h * assembly.bodies[1].newVelocity.z();
			largest = std::max(largest, std::abs(x));
		}
		EXPECT_GT(largest, 0.01 * speed / omega) << turn;
		EXPECT_LT(largest, 1.1 * speed / omega)
		        << turn; // of a step with h omega = 1.1, the coarsest resolved one
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
		double stored = 0; // by Newmark's term
		for (const NewmarkHistory& newmark : assembly.history)
			stored += newmark.stored;
		// Residual of the sweeps
		EXPECT_NEAR(before - kineticEnergy(assembly.bodies), dissipated + stored, 1e-9 * before) << h;
		EXPECT_GE(dissipated, 0) << h;
	}
}

/// The sweeps solve M v' = M v + h f - h D (v + v') / 2 - N (v' - v) of all bodies, N: Newmark's term.
TEST(Chain, SolvesTheDenseSystem)
{
	Random random(7);
	for (const double ratio : { 0.02, 0.3, 1. })
		for (const double h : { 2.5e-4, 5e-3 }) {
			Assembly assembly = chain(ratio);
			const Matrix W = assembly.inverseMass(), D = assembly.damping(), N = assembly.newmark(h),
			             one = Matrix::Identity(18, 18);
			const Vector v = randomFree(random, assembly), change = randomFree(random, assembly);
			const Vector expected = (one + h / 2 * W * D + W * N)
			                                .partialPivLu()
			                                .solve(v + change - h / 2 * W * D * v + W * N * v);
			assembly.setVelocities(v);
			assembly.startNewmark(h);
			assembly.accelerate(change);
			assembly.damp(h, 5000);
			EXPECT_LT((assembly.velocities() - expected).norm(), 1e-9 * expected.norm())
			        << ratio << " " << h; // residual of the sweeps
		}
}

/// Stiff joints are solved further than others: an error of their impulses acts as (h omega)^4. Without, the energy
/// grows without limit.
TEST(Chain, StiffJointsConvergeAtTheSolversTolerance)
{
	Random random(13);
	for (const double turn : { 3., 30. }) {
		Assembly stiff = chain(0.05);
		const Matrix W = stiff.inverseMass(), K = stiff.stiffness(), one = Matrix::Identity(18, 18);
		const double h = turn / std::sqrt((W * K).eigenvalues().real().maxCoeff());
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

/// The error against the matrix exponential falls with the square of the step.
TEST(Chain, ConvergesWithSecondOrderToTheExponential)
{
	Random random(11);
	for (const double ratio : { 0.05, 0.5 }) {
		Assembly assembly = chain(ratio);
		const Vector x0 = 1e-3 * randomFree(random, assembly), v0 = 0.1 * randomFree(random, assembly);
		const double time = 0.1;
		const Vector expected = assembly.exact(x0, v0, time);
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

/// Without sweeps there is no Newmark's term, also of a stiff joint: the dashpots dissipate what the bodies lose.
TEST(Oscillator, ExplicitDashpotsStoreNoEnergy)
{
	Assembly assembly = oscillator(0.001);
	Random random(14);
	const double h = 0.1;
	ASSERT_GT(assembly.newmark(h).norm(), 0);
	assembly.setVelocities(randomFree(random, assembly));
	const double before = kineticEnergy(assembly.bodies), dissipated = assembly.damp(h, 0);
	EXPECT_EQ(assembly.history[0].stored, 0);
	EXPECT_EQ(assembly.history[0].linear, Vec3::Zero());
	EXPECT_GT(dissipated, 0);
	EXPECT_NEAR(dissipated, before - kineticEnergy(assembly.bodies), 1e-12 * before);
}

/// Modes depend on springs, masses, moments of inertia and the orientation of the bodies against each other.
TEST(JointModes, FitWhatTheyWereComputedFor)
{
	const JointState state { 4, { 100, 200 }, 0.7, 3, about(Vec3::UnitX(), 0.3) };
	EXPECT_TRUE(state.fits(state));
	const auto changed = [&](auto change) {
		JointState other = state;
		change(other);
		return other;
	};
	EXPECT_FALSE(state.fits(changed([](JointState& s) { s.springs = 3; })));
	EXPECT_FALSE(state.fits(changed([](JointState& s) { s.stiffness.shear = 201; })));
	EXPECT_FALSE(state.fits(changed([](JointState& s) { s.pairInverseMass = 0.8; })));
	EXPECT_FALSE(state.fits(changed([](JointState& s) { s.inverseInertia = 3.1; })));
	for (const double share : { 0.9, 1.1 }) {
		const Quat turned = about(Vec3::UnitZ(), share * modeAngle) * state.relative;
		EXPECT_EQ(state.fits(changed([&](JointState& s) { s.relative = turned; })), share < 1);
		// The same orientation
		EXPECT_EQ(
		        state.fits(changed([&](JointState& s) { s.relative.coeffs() = -turned.coeffs(); })), share < 1);
	}
	EXPECT_FALSE(JointState().fits(state));
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
			solver.prepareJoint(
			        solver.addJoint(assembly.joints[k].a, assembly.joints[k].b), modes[k], axes, 1, {});
		solver.solve(1e-10);
		double dissipated = 0, stored = 0;
		for (size_t k = 0; k < assembly.joints.size(); ++k) {
			EXPECT_GE(solver.joint(k).dissipated, -1e-6 * before) << trial << " " << h;
			dissipated += solver.joint(k).dissipated;
			stored += solver.joint(k).history.stored;
		}
		EXPECT_NEAR(kineticEnergy(assembly.bodies) + dissipated + stored, before, 1e-6 * before)
		        << trial << " " << h;
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
	PointRecord record;
	solver.begin(assembly.bodies, h, 5000);
	HeapPoint p = central(3000, 50000);
	p.friction = 1e3; // sticks
	p.armA = Vec3(0.05, 0.05, 2.8) - start[1].position;
	p.armB = Vec3(0.05, 0.05, 2.8) - start[2].position;
	solver.prepare<double>(solver.addPair(1, 2, &record, 1), 0, p);
	std::vector<JointModes> modes;
	for (const Joint& j : assembly.joints)
		modes.push_back(assembly.modesOf(j));
	for (size_t k = 0; k < 2; ++k)
		solver.prepareJoint(
		        solver.addJoint(assembly.joints[k].a, assembly.joints[k].b), modes[k], Mat3::Identity(), 1, {});
	solver.solve(1e-12);
	Vector impulse = Vector::Zero(18); // of the contact
	const Vec3 contact = worldImpulse(record.step);
	impulse.segment<6>(6) << -contact, -p.armA.cross(contact);
	impulse.segment<6>(12) << contact, p.armB.cross(contact);
	const Assembly before { start, assembly.joints, {} };
	const Matrix W = assembly.inverseMass();
	const Vector v = before.velocities(), after = assembly.velocities();
	const Vector expected = v + W * impulse - h / 2 * W * assembly.damping() * (v + after);
	EXPECT_GT(contact.z(), 0);
	EXPECT_LT((after - expected).norm(), 1e-8 * expected.norm()); // residual of the sweeps
}
