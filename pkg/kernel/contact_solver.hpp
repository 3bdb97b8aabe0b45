// SPDX-License-Identifier: GPL-2.0-or-later
/// Contact impulses of one step by projected Gauss-Seidel: implicit springs and dashpots, no tension, Coulomb friction.
///
/// Equations (1) to (7): docs/theory.md, section 5.
///
/// Of the tangential impulses that (5) admits p_s is the closest to (4). A visit is then a step along the gradient of a
/// convex function, followed by projections on convex sets: repeated visits lead to a fixed point. (An impulse that is
/// shortened in its own direction may alternate between two values for ever where the responses of the two tangents
/// differ.)
/// Pairs with several points do not get the velocity w of an impact after the sweeps: their dashpots add up and
/// dissipate more than (2) of impact.hpp.
/// The closing displacement d of (7) is at most the overlap left until the force is constant.
///
/// Convergence. In (3) p_n is a continuous function of b that does not increase, with slopes between -1/a and 0
/// (tests/kernel/visit_test.cpp). So p_n and v' = b + a p_n are related by a monotone function, v' falls while p_n
/// grows, and it is the derivative of a convex function of p_n. All normal impulses together minimise the sum of these
/// functions and of the kinetic energy p^T A p / 2 + p^T u_0: a convex function that grows without bound, hence with a
/// minimum. A visit is its exact minimisation in one coordinate, and sweeps over the coordinates converge to the
/// minimum.
/// Friction (4) is not the derivative of an energy: a wedged body may have several solutions, or none. Then the sweeps
/// end at their limit with impulses that obey (3) to (6) point by point, and ContactForces counts the step.
///
/// Accelerated sweeps. Where light members are pressed between heavy ones plain sweeps converge slowly, and a small
/// change in the last one does not mean a small error: points return more than (5) admits. A step that takes more than
/// plainSweeps, or in which points have returned too much after checkedSweeps or more, goes on with sweeps over all
/// pairs and joints. A step along the conjugate direction G precedes each of them:
///     Z <- Z' + gamma G,   G <- gamma G + (Z' - Z),   gamma = |Z' - Z|^2 / |Z' - Z|^2 of the sweep before    (9)
/// with all impulses and velocities Z before, Z' after a sweep; gamma >= 1 starts anew with G = Z' - Z and no step
/// (nonlinear conjugate gradients after Fletcher and Reeves; Silcowitz, Niebe and Erleben, Visual Comput. 26 (2010),
/// 893-901). They end after a sweep, so that (3) to (6) hold. If newtonInterval of them are not enough, Newton's method is
/// tried (contact_newton.cpp).
///
/// Mass-weighted velocities: W = R^-1 V for the velocities and spins V of a pair, R R^T: the inverse of its mass matrix
/// (Cholesky). A row of J gives a component of the relative velocity at a point, u = J V. An impulse p changes u by
/// (J R) (J R)^T p:
///     u = u_0 + J R dW,   dW += (J R)^T p                                                       (8)
/// with the component u_0 before the sweeps and the change dW of W since then. Each point has three rows: normal and
/// two tangents.
///
/// Glossary (n: normal, s: tangential)
///     a          response       inverse effective mass: change of the relative velocity per unit impulse; a_s: the
///                               largest one [1/kg]
///     a_ns       column         tangential velocity change by a unit normal impulse [1/kg]
///     A_n, A_s   energy         accounts of the springs (PointRecord) [J]
///     b          base           velocity of separation without the point's own impulse [m/s]
///     B_n, B_s   bias           in (2): impulse of the elastic force and of the velocity before the step [N s]
///     beta       -              Newmark's parameter [-]
///     c          hardening      c n_0^q: part of the normal force that hardens [N]
///     C_n, C_s   damping        dashpot constant (Eqs. 41, 42) [N s/m]
///     D          -              weight of the velocity after the step [kg]
///     e_n, e_s   elastic force  of the springs at the placement of the step [N]
///     F_Y        strength       of the contact (bearing_strength.hpp): h F_Y [N s]
///     f_n, f_s   factor         share of the current impulse that remains [-]
///     gamma      -              share of the last direction in the next one [-]
///     h          step           its length [s]
///     K_n, K_s   stiffness      of the springs (Eqs. 39, 40) [N/m]
///     M_n, M_s   mass           effective mass of bodies, spring and dashpot together [kg]
///     mu         friction       Coulomb coefficient [-]
///     n_0, q     overlap, exponent of the law [m, -]
///     p          impulse        of the contact on B; p0: before a visit of the point [N s]
///     Q          -              weight of the velocity before the step [kg]
///     s          reboundSoftness of (6) [-]
///     theta      -              weight of the velocity after the step [-]
///     u, v, v'   velocity       of B relative to A: current, before and after the step; u_0: after all forces but
///                               those of contacts [m/s]
///     w          rebound        largest velocity of separation of an impact [m/s]
///     x          -              a h C: decay rate of the dashpot times h [-]
///     y          -              a h2 K: square of the spring's natural frequency times h [-]
///
/// Joints (joint_modes.hpp) are visited before the first sweep over the pairs, in every fourth sweep (jointInterval),
/// and whenever no pair changes any more.
///
/// Phases of a step, for each island (islands.hpp):
///     1. begin(), addPair() and addJoint() list the pairs and the damped joints;
///     2. prepareContacts() (contact_pair.hpp) prepares the points of each pair, prepareJoint() each joint;
///     3. solve(): warm start with the impulses of the last step, sweeps over the pairs and joints, restitution of
///       points that act alone;
///     4. storeForces() (contact_pair.hpp) stores forces, history and energies of the points; jointImpulse() gives the
///       impulse of a joint.
#pragma once
#include "contact_step.hpp"
#include "joint_modes.hpp"
#include <algorithm>
#include <cassert>
#include <cstddef>
#include <tuple>
#include <vector>

namespace timber {

/// Two bodies in contact.
struct SolverPair {
	int bodyA, bodyB;
	size_t first, count; ///< of its points in the island
	double inverseMass; ///< of the equivalent mass [1/kg]
	/// Of the impulses in the last visit, over the equivalent mass: changes matter by their effect on light members
	/// [J]
	double squaredChange;
};

/// How the sweeps of an island ended.
struct Convergence {
	int sweeps = 0;
	/// false: after the last sweep that the limit allows, some impulses still changed, or points had returned too
	/// much energy
	bool converged = true;
	double change
	        = 0; ///< then the largest change of a pair or joint in its last visit: twice its kinetic energy [J]
};

/// Joints of n modes. The list keeps its memory when it is cleared.
template <int n> class JointList {
	std::vector<ModalConstraint<n>> all;
	size_t count = 0;

public:
	void clear() { count = 0; }
	/// A joint without springs; its other numbers are not set.
	ModalConstraint<n>& add()
	{
		if (count == all.size()) all.emplace_back();
		all[count].springs.springs.clear();
		return all[count++];
	}
	size_t size() const { return count; }
	ModalConstraint<n>& operator[](size_t k)
	{
		assert(k < count);
		return all[k];
	}
	const ModalConstraint<n>& operator[](size_t k) const { return const_cast<JointList&>(*this)[k]; }
	ModalConstraint<n>* begin() { return all.data(); }
	ModalConstraint<n>* end() { return all.data() + count; }
	const ModalConstraint<n>* begin() const { return all.data(); }
	const ModalConstraint<n>* end() const { return all.data() + count; }
};

class ContactSolver {
public:
	/// Phase 1: starts a step of h [s] of these bodies. sweepLimit: upper bound of the sweeps over the points; 0:
	/// explicit springs and dashpots.
	void begin(std::vector<SolverBody>& bodies, double h, int sweepLimit);
	/// Phase 1: lists two bodies with that many points. Returns the pair's index.
	size_t addPair(int bodyA, int bodyB, size_t count);
	/// Phase 1: lists a joint of n modes. Returns its index among them.
	template <int n> size_t addJoint(int bodyA, int bodyB);
	/// Phase 2: points of the k-th pair from `first` on, one or up to laneCount. Thread-safe for different pairs.
	template <class Number> void prepare(size_t k, size_t first, const StepInput<Number>& input);
	/// Phase 2: the k-th joint of n modes; arguments as of prepareModes(): modes for n = 6, axis for n = 1.
	/// Thread-safe for different joints.
	template <int n, class Modes>
	ModalConstraint<n>& prepareJoint(size_t k, const Modes& modes, const Mat3& axesA, const JointDamping& damping)
	{
		ModalConstraint<n>& constraint = joints<n>()[k];
		prepareModes(constraint, bodiesOf(constraint), modes, axesA, damping, h);
		return constraint;
	}
	/// Phase 3: computes impulses and new velocities. Pairs are visited in the order of their indices, the points
	/// of a pair forwards and backwards in turn, so that no side of a face is favoured. After the first sweep only
	/// active pairs are visited: those of which a body has just changed. Changes count by their kinetic energy. A
	/// pair counts as changed above the share tolerance^2 [-] of that of the bodies' resultant impulses, over the
	/// number of points of the island (firstSweepShare^2 of that in the first sweep), or sweepReduction^2 of that
	/// of the first sweep's changes where it is less. Impulses of a point count only down to restTolerance^2: 1e-3
	/// of what a block of 1 t exerts on a board of 0.1 kg changes its velocity by 0.5 m/s. A joint counts as one
	/// point.
	/// Accelerated sweeps (9) visit all pairs.
	/// A few sweeps are enough for a standing house. Where heavy and light members collide, the rest of the warm
	/// start's error would create energy.
	/// Fixed bodies are only read: they may belong to several islands, which other threads solve.
	Convergence solve(double tolerance = 0);

	bool isExplicit() const { return maxSweeps == 0; }
	double stepLength() const { return h; } ///< [s]
	const SolverPair& pair(size_t k) const
	{
		assert(k < pairs.size());
		return pairs[k];
	}
	/// Connection: SolverPair or ModalConstraint.
	template <class Connection> SolverBodies bodiesOf(const Connection& c) const
	{
		return { (*bodies)[c.bodyA], (*bodies)[c.bodyB], weighted[c.bodyA].root, weighted[c.bodyB].root };
	}
	/// Phases 2 to 4: steps of the points of a pair, one after the other.
	PointStep* stepsOf(const SolverPair& pair)
	{
		assert(pair.first + pair.count <= pointCount);
		return steps.data() + pair.first;
	}
	const PointStep* stepsOf(const SolverPair& pair) const { return steps.data() + pair.first; }
	/// Phase 4: the k-th joint of n modes.
	template <int n> const ModalConstraint<n>& joint(size_t k) const { return joints<n>()[k]; }

private:
	std::vector<SolverBody>* bodies = nullptr; ///< of the step
	double h = 0;
	int maxSweeps = 0;
	std::vector<WeightedBody> weighted; ///< of each body of the island, by its index
	std::vector<SolverPair> pairs;
	/// Of all points in the order of the visits: the sweeps read them one after the other. It does not shrink.
	std::vector<PointStep> steps;
	size_t pointCount = 0; ///< of the island
	std::tuple<JointList<6>, JointList<1>> allJoints;
	std::vector<int> freeBodies; ///< of the island, by index
	std::vector<long> activeUntil; ///< of each body: last sweep in which its pairs are visited
	long solveCount = 0; ///< since construction
	long sweepCount = 0; ///< since construction: bodies of islands solved before are inactive
	double twiceKinetic = 0; ///< kinetic energy of the island's bodies after all other forces, times two [J]

	template <int n> auto& joints() { return std::get<JointList<n>>(allJoints); }
	template <int n> const auto& joints() const { return std::get<JointList<n>>(allJoints); }
	/// Calls visit(joint) for all joints of six modes, then of one. kinds: allJoints
	template <class Kinds, class Visit> static void visitEach(Kinds& kinds, Visit visit)
	{
		std::apply([&](auto&... kind) { (std::for_each(kind.begin(), kind.end(), visit), ...); }, kinds);
	}
	template <class Visit> void visitJoints(Visit visit) { visitEach(allJoints, visit); }
	template <class Visit> void visitJoints(Visit visit) const { visitEach(allJoints, visit); }
	void startBody(int k);
	/// Starts a body once a step.
	void useBody(int k)
	{
		assert(k >= 0 && size_t(k) < weighted.size());
		if (weighted[k].step != solveCount) startBody(k);
	}
	void finishBodies();
	void warmStart(const SolverPair& pair);
	template <int n> void solveJoint(ModalConstraint<n>& joint, double share);
	template <class Connection> PairVector changeOf(const Connection& c) const
	{
		return PairVector::of(weighted[c.bodyA].change, weighted[c.bodyB].change);
	}
	template <class Connection> void setChange(const Connection& c, const PairVector& change)
	{
		change.store(weighted[c.bodyA].change, weighted[c.bodyB].change);
	}
	void solvePair(SolverPair& pair, bool forwards);
	double sumOfChanges() const;
	double squaredThreshold(double tolerance, double firstChanges) const;
	bool activateChanged(double threshold);
	template <class Connection> bool activateNeighbours(const Connection& c, double threshold);
	bool sweepOnce(double threshold, bool forwards, double share);
	bool sweepJoints(double threshold, double share = 1);
	double largestChange() const;
	void applyRestitution(const SolverPair& pair);
	bool returnsTooMuch() const;
	/// Calls visit(x, weight) for each number x of (9); weight: in the norm [1/kg].
	template <class Visit> void visitUnknowns(Visit visit);
	struct ConjugateDirection;
	void stepAlong(ConjugateDirection& direction);
	bool sweepAll(double threshold);
	bool sweepAccelerated(double threshold, int& sweeps);
	class Newton;
	/// Returns whether the impulses of all points and joints are the solution of the step.
	bool solveByNewton();
	bool tryNewton();
	Convergence sweepToConvergence(double tolerance);
};

} // namespace timber
