// SPDX-License-Identifier: GPL-2.0-or-later
/// Bodies with joints for the tests of joint modes: the solver's steps, and the same as dense matrices.
#pragma once
#include "heap.hpp"
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <kernel/joint_modes.hpp>
#include <limits>

namespace timber::shapes {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

/// A joint in the world frame; the bodies' frames are parallel to it.
struct Joint {
	int a, b;
	std::vector<Vec3> points; ///< [m]
	JointStiffness stiffness;
	Vec3 normal = Vec3::UnitZ();
	JointDamping damping { 0.05 };
	std::vector<int> broken = std::vector<int>(points.size(), 0);
};

inline JointState stateOf(const Joint& j)
{
	return { size_t(std::count(j.broken.begin(), j.broken.end(), 0)), j.stiffness, { 1, 1 }, { 1, 1 },
		Mat3::Identity() };
}

/// Bodies and joints with linear springs: displacements and rotations x, six numbers for each body, leave the arms as
/// they are.
struct Assembly {
	std::vector<SolverBody> bodies;
	std::vector<Joint> joints;
	/// Springs of a stiff joint from step to step.
	struct Springs {
		std::vector<Vec3> half, forces; ///< z, F [m, N]
		double account = 0; ///< [J]
		BrittleSprings law {};
	};
	std::vector<Springs> history = {}; ///< of the joints
	Vector displacements = {}; ///< x; empty: zero

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
	/// M^power, of free bodies.
	Matrix rootMass(double power) const
	{
		const Eigen::SelfAdjointEigenSolver<Matrix> inverse(inverseMass());
		const Vector values = inverse.eigenvalues().unaryExpr(
		        [=](double value) { return value > 0 ? std::pow(value, -power) : 0; });
		return inverse.eigenvectors() * values.asDiagonal() * inverse.eigenvectors().transpose();
	}
	/// The largest frequency. [1/s]
	double largestFrequency() const
	{
		const Matrix root = rootMass(-0.5);
		return std::sqrt(
		        Eigen::SelfAdjointEigenSolver<Matrix>(root * stiffness() * root).eigenvalues().maxCoeff());
	}
	/// M^1/2 f(omega^2) M^1/2 of each joint and its bodies, with the eigenvalues omega^2 of M^-1/2 K M^-1/2, by
	/// another way than the kernel's: in the coordinates of the bodies.
	template <class Function> Matrix ofModes(Function f) const
	{
		Matrix matrix = Matrix::Zero(size(), size());
		const Matrix root = rootMass(-0.5), inverse = rootMass(0.5);
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
		return ofModes([](const Joint& joint, double square) { return joint.damping.of(std::sqrt(square)); });
	}
	/// Mass of the implicit springs of stiff joints: h2 K / 4.
	Matrix stiffMass(double h) const
	{
		Matrix matrix = Matrix::Zero(size(), size());
		for (const Joint& joint : joints)
			if (modesOf(joint).isStiff(h)) matrix += h * h / 4 * stiffness(joint);
		return matrix;
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
		SpringGroup unbroken { {}, j.stiffness, j.normal };
		for (size_t i = 0; i < j.points.size(); ++i)
			if (!j.broken[i]) unbroken.anchors.push_back(j.points[i] - bodies[j.a].position);
		return jointModes(bodies[j.a], bodies[j.b], Mat3::Identity(), unbroken, stateOf(j));
	}
	/// Six numbers of the motion of a joint's bodies as a rate of the stretch of a spring, or its change.
	Vec3 stretchOf(const Joint& j, size_t spring, const Vector& x) const
	{
		const auto motion = [&](int body) {
			return Vec3(x.segment<3>(6 * body)
			        + Vec3(x.segment<3>(6 * body + 3)).cross(j.points[spring] - bodies[body].position));
		};
		return motion(j.b) - motion(j.a);
	}
	/// History of the stiff joints as after a step of h [s] that has led to the present velocities.
	void startSprings(double h)
	{
		const Vector zero = Vector::Zero(size()), x = displacements.size() > 0 ? displacements : zero,
		             middle = x - h / 2 * velocities();
		history.clear();
		for (const Joint& j : joints) {
			history.emplace_back();
			for (size_t i = 0; i < j.points.size(); ++i) {
				const Vec3 z = stretchOf(j, i, middle);
				history.back().half.push_back(z);
				history.back().forces.push_back(Vec3::Zero());
				if (!j.broken[i])
					history.back().account += springForce<double>(j.stiffness, z, j.normal).energy;
			}
		}
	}
	/// Springs of a stiff joint, by whose explicit forces accelerate() has accelerated the bodies already.
	SpringSteps<6> springSteps(const Joint& j, Springs& from, const JointModes& modes, double h) const
	{
		const Vector x = displacements.size() > 0 ? displacements : Vector(Vector::Zero(size()));
		std::vector<SpringStep<6>> steps;
		for (size_t i = 0; i < j.points.size(); ++i) {
			const Vec3 stretch = stretchOf(j, i, x);
			if (!j.broken[i])
				steps.push_back({ i, from.half[i], stretch,
				        springForce<double>(j.stiffness, stretch, j.normal).force,
				        modes.rates(j.points[i] - bodies[j.a].position), from.forces[i] });
		}
		const JointStrength none { std::numeric_limits<double>::infinity(), false };
		from.law = { j.stiffness, none, j.normal };
		return { from.law, steps, from.account, h };
	}
	/// Dashpots of one step, and the springs of stiff joints beside explicit ones. Returns the dissipated energy.
	double damp(double h, int sweeps = 50, double tolerance = 1e-14)
	{
		ContactSolver solver;
		std::vector<JointModes> modes(joints.size());
		if (history.empty()) {
			startSprings(0);
			for (Springs& s : history)
				s.account = 0;
		}
		solver.begin(bodies, h, sweeps);
		for (size_t k = 0; k < joints.size(); ++k) {
			const Joint& j = joints[k];
			modes[k] = modesOf(j);
			solver.addJoint<6>(j.a, j.b);
			ModalConstraint<6>& c = solver.prepareJoint<6>(k, modes[k], Mat3::Identity(), j.damping);
			if (sweeps > 0 && modes[k].isStiff(h)) addSprings(c, springSteps(j, history[k], modes[k], h));
		}
		solver.solve(tolerance);
		double dissipated = 0;
		for (size_t k = 0; k < joints.size(); ++k) {
			const ModalConstraint<6>& c = solver.joint<6>(k);
			dissipated += c.dissipated + c.springs.dissipated;
			history[k].account = c.springs.account;
			for (const SpringStep<6>& s : c.springs.springs) {
				history[k].half[s.spring] = s.stretch;
				history[k].forces[s.spring] = s.force;
			}
		}
		return dissipated;
	}
	/// Displacements after `steps` steps of the leapfrog from x0 with the velocities v0.
	Vector run(const Vector& x0, const Vector& v0, double h, int steps, double tolerance = 1e-14)
	{
		const Matrix W = inverseMass(), K = stiffness();
		Vector x = x0;
		displacements = x0;
		setVelocities(v0 + h / 2 * W * (K * x0 + damping() * v0)); // half a step earlier
		startSprings(h);
		for (int k = 0; k < steps; ++k) {
			displacements = x;
			accelerate(-h * W * (K * x));
			damp(h, 10000, tolerance);
			x += h * velocities();
		}
		return x;
	}
};

inline SolverBody member(double mass, const Vec3& moments, const Vec3& position)
{
	SolverBody b = body(mass, Vec3::Zero());
	if (mass > 0) b.inverseInertia = moments.cwiseInverse().asDiagonal();
	b.position = position;
	return b;
}

inline std::vector<Vec3> square(const Vec3& centre, double x, double y)
{
	return { centre + Vec3(x, y, 0), centre + Vec3(-x, y, 0), centre + Vec3(x, -y, 0), centre + Vec3(-x, -y, 0) };
}

/// A body on the ground, held by four springs about its centre: six independent oscillators.
inline Assembly oscillator(double ratio)
{
	Assembly assembly { { body(0, Vec3::Zero()), member(8, { 0.5, 0.7, 0.02 }, Vec3::Zero()) }, {} };
	assembly.joints.push_back(
	        { 0, 1, square(Vec3::Zero(), 0.06, 0.05), { 60000, 40000 }, Vec3::UnitZ(), { ratio } });
	return assembly;
}

/// Ground, slender column and beam with two joints off their centres.
inline Assembly chain(double ratio)
{
	Assembly assembly { { body(0, Vec3::Zero()), member(10, { 6, 6, 0.02 }, { 0, 0, 1.4 }),
		                    member(30, { 0.1, 40, 40 }, { 1, 0.1, 2.9 }) },
		{} };
	assembly.joints.push_back(
	        { 0, 1, square({ 0, 0, 0 }, 0.05, 0.05), { 58800, 58800 }, Vec3::UnitZ(), { ratio } });
	assembly.joints.push_back(
	        { 1, 2, square({ 0, 0, 2.8 }, 0.05, 0.06), { 58800, 30000 }, Vec3(0.6, 0, 0.8), { ratio } });
	return assembly;
}

inline Vector randomFree(Random& random, const Assembly& assembly)
{
	Vector x = Vector::Zero(Eigen::Index(assembly.size()));
	for (size_t k = 6; k < assembly.size(); ++k) // the first body is fixed
		x[Eigen::Index(k)] = uniform(random, -1, 1);
	return x;
}

/// A mass on a spring along z on the ground, undamped.
struct MassOnSpring {
	double mass, k; ///< [kg, N/m]
	double x = 0; ///< displacement [m]
	Assembly assembly { { body(0, Vec3::Zero()), body(mass, Vec3::Zero()) },
		{ { 0, 1, { Vec3::Zero() }, { k, k }, Vec3::UnitZ(), { 0 } } }, {} };

	double omega() const { return std::sqrt(k / mass); }
	double& velocity() { return assembly.bodies[1].newVelocity.z(); }
	void step(double h)
	{
		assembly.displacements = (Vector(12) << Vector::Zero(8), x, Vector::Zero(3)).finished();
		assembly.accelerate((Vector(12) << Vector::Zero(8), -h * k * x / mass, Vector::Zero(3)).finished());
		assembly.damp(h);
		x += h * velocity();
	}
};

} // namespace timber::shapes
