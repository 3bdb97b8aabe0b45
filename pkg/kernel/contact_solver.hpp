// SPDX-License-Identifier: GPL-2.0-or-later
/// Contact impulses of one step by projected Gauss-Seidel: implicit springs and dashpots, no tension, Coulomb friction.
///
/// Each of the four points of a face has a critical dashpot for the mass of the whole pair (Eqs. 41-43). On a light slender member their
/// rates add up to 1e5 /s, and explicit dashpots (Eqs. 17, 18) are unstable above some 1e-5 s. Springs of heavily loaded light members
/// are too stiff for the step as well. Both are therefore implicit here: dashpots by the theta method, springs by Newmark's method.
/// Normal and tangential impulse p of a point obey, each in its direction,
///     p = h e - h C ((1 - theta) v + theta v') - beta h2 K (v' - v)                            (1)
///     theta = 1/2 + x / (12 + 2 x),   x = a h C
///     beta  = y / (4 y + 2),          y = a h2 K
/// theta tends to 1/2 (second order) for slow dashpots and to 1 (strong damping) for fast ones; the exact decay exp(-x) has this theta to
/// 1 %. beta is negligible for springs that the step resolves (leapfrog) and 1/4 for stiff ones. N springs on one member are stable if
/// N y (1/4 - beta) = N y / (8 y + 4) < 1: up to eight at any step.
/// Let u be the current relative velocity, in which the current impulse p0 acts already: v' = u + a (p - p0). Then (1) is
///     p = f p0 + b - M u                                                                        (2)
///     M = D / (1 + a D),   f = a M,   b = (h e + G v) / (1 + a D)
///     D = theta h C + beta h2 K,   G = beta h2 K - (1 - theta) h C
/// The solver applies (2) to one point after the other, with the limits of the contact:
///     normal      p_n = max(0, f_n p_n0 + b_n - M_n u_n)                                        (3)
///     tangential  p_s = f_s p_s0 + b_s - M_s u_s - c_s (p_n - p_n0), shortened to mu p_n           (4)
/// Let u' = u_n + a (p_n - p_n0) be the velocity that (3) gives, and r the one with which the overlap ends within the step. The spring then
/// acts for a part of the step only: a point that separates, u' > r, returns at most its elastic energy U, the work p_n u' / 2,
///     separation  p_n <= max(p_r, p_U),   u'(p_r) = r,   p_U u'(p_U) = 2 U                      (5)
/// A point in an impact (impact.hpp) separates with the velocity w: if u' exceeds w or r, or is > 0 without a force,
///     impact      p_n = max(0, p_n0 + (w - u_n) / a)                                              (6)
/// Hertz's spring hardens: F(n) = c n^1.5, C(n) = C_n (n / n_0)^(1/4) about the overlap n_0 of the step. A point that closes by d = -h v' - 0.1 n_0 adds
/// the difference between the force at the next placement and its linear extrapolation, and that of the dashpot for the part of d that the
/// velocity v before the step does not explain. Otherwise a light member that is struck would move through its contact within a step:
///     hardening   p_n = (2) + (1 - a M_n) (beta_d h (F(n_0 + d) - F(n_0) - K_n d) + (C(n_0 + (d + h v) / 2) - C_n) d)    (7)
/// with d > 0, h v <= 0, d + h v >= 0, and beta_d of the secant stiffness (F(n_0 + d) - F(n_0)) / d.
///
/// Mass-weighted velocities: W = M^1/2 V for the velocities and spins V of a pair, M^-1 = R R^T (Cholesky). A row of J gives a component of the
/// relative velocity at a point, u = J V. With rows G = J R an impulse p changes u by G G^T p:
///     u = u0 + G dW,   dW += G^T p                                                              (8)
/// with the component u0 before the sweeps and the change dW of W since then. Each point has three rows: normal and two tangents.
///
/// Glossary (n: normal, s: tangential)
///     a          response       inverse effective mass: change of the relative velocity per unit impulse; a_s: the largest one [1/kg]
///     b_n, b_s   bias           impulse of the elastic force and of the velocity before the step [N s]
///     beta       -              Newmark's parameter [-]
///     c          hardening      constant of Hertz's spring [N/m^1.5]
///     c_s        coupling       tangential impulse that opposes the slip caused by a unit normal impulse [-]
///     C_n, C_s   damping        dashpot constant (Eqs. 41, 42) [N s/m]
///     D          -              weight of the velocity after the step [kg]
///     e_n, e_s   elastic force  of the springs at the placement of the step [N]
///     f_n, f_s   impulse factor share of the current impulse that remains [-]
///     G          -              weight of the velocity before the step [kg]; in (8): rows
///     h          step           length of the step [s]
///     K_n, K_s   stiffness      of the springs (Eqs. 39, 40) [N/m]
///     M_n, M_s   mass           effective mass of bodies, spring and dashpot together [kg]
///     mu         friction       Coulomb coefficient [-]
///     p          impulse        of the contact on B; p0: before a visit of the point [N s]
///     theta      -              weight of the velocity after the step [-]
///     r          release        velocity of separation with which the overlap ends within the step [m/s]
///     U          energy         of the normal spring at the placement of the step [J]
///     u, v, v'   -              velocity of B relative to A: current, before and after the step [m/s]
///     w          rebound        velocity of separation at the end of an impact [m/s]
///     x          -              a h C: decay rate of the dashpot times h [-]
///     y          -              a h2 K: square of the spring's natural frequency times h [-]
///
/// Dashpots of joints (joint_dashpot.hpp) are visited before the first sweep over the pairs, and whenever no pair changes any more.
///
/// Phases of a step, for each island (islands.hpp):
///     1. begin(), addPair() and addDashpot() list the pairs and the damped joints;
///     2. prepare() makes the constraint of each point from its ContactInput (contact_pair.hpp: prepareContacts()), prepareDashpot() that of
///        each joint;
///     3. solve(): warm start with the impulses of the last step, then sweeps over the pairs and joints;
///     4. constraint() and dashpot() give the impulses (contact_pair.hpp: storeForces(), joint_dashpot.hpp: dashpotForce()).
#pragma once
#include "contact_constraint.hpp"
#include "joint_dashpot.hpp"
#include <cassert>
#include <cstddef>
#include <vector>

namespace timber {

/// Two bodies in contact and their constraints.
struct SolverPair {
	int bodyA, bodyB;
	size_t first; ///< index of the first constraint group; of the first point: laneCount times that
	size_t count; ///< of contact points
	double squaredChange; ///< of the impulses in the last sweep, over the equivalent mass: changes matter by their effect on light members [J]
};

class ContactSolver {
public:
	using Constraint = ContactConstraint<double>;
	/// Up to laneCount points of a pair: the prepare and store phases process several at a time, the sweeps one by one. Unused lanes are undefined.
	using ConstraintGroup = ContactConstraint<Lanes>;

	/// Phase 1: starts a step of these bodies. sweepLimit: upper bound of the sweeps over the points; 0: explicit springs and dashpots.
	void begin(const std::vector<SolverBody>& bodies, int sweepLimit);
	/// Phase 1: reserves the constraints of two bodies with that many points. Returns the pair's index.
	size_t addPair(int bodyA, int bodyB, size_t count);
	/// Phase 2: constraints of the k-th pair for a step of h [s]: point `first`, or up to laneCount points from `first`, a multiple of
	/// laneCount, on. Thread-safe for different pairs.
	template <class Number> void prepare(size_t k, size_t first, const std::vector<SolverBody>& bodies, const ContactInput<Number>& given, double h);
	/// Phase 2, after prepare(): the point is in an impact with w of (6) [m/s]. Not for explicit springs and dashpots.
	void setImpact(size_t k, size_t point, double rebound);
	/// Phase 1: reserves the constraint of a joint's dashpots. Returns its index.
	size_t addDashpot(int bodyA, int bodyB);
	/// Phase 2: constraint of the k-th joint for a step of h [s]. Thread-safe for different joints.
	void prepareDashpot(size_t k, const std::vector<SolverBody>& bodies, const JointModes& modes, const Mat3& axesA, double ratio, double h);
	/// Phase 3: computes impulses and new velocities. Pairs are visited in the order of their indices, the points of a pair forwards and
	/// backwards in turn, so that no side of a face is favoured. After the first sweep only active pairs are visited: those of which a body
	/// has just changed. A pair counts as changed above `tolerance` times the root mean square of the island's impulses, each over the root
	/// of its equivalent mass [-] (firstSweepShare of that in the first sweep). Where the island rests the root mean square of the first sweep's
	/// changes is smaller and takes its place, down to restTolerance times that of the impulses. A joint counts as one point. Returns the number of sweeps.
	/// A small fixed number of sweeps would suffice for a standing house. In an impact between heavy and light members the remaining error
	/// of the warm start would create energy.
	/// Fixed bodies are only read: they may belong to several islands, which other threads solve.
	int solve(std::vector<SolverBody>& bodies, double tolerance = 0);

	bool isExplicit() const { return maxSweeps == 0; }
	const SolverPair& pair(size_t k) const
	{
		assert(k < pairs.size());
		return pairs[k];
	}
	/// Phase 4: constraint of a point of the k-th pair, and the group that begins with a point whose index is a multiple of laneCount.
	Constraint constraint(size_t k, size_t point) const { return constraintAt(pair(k), point); }
	const ConstraintGroup& constraintGroup(size_t k, size_t point) const { return groupAt(pair(k), point); }
	/// Phases 2 to 4: a point of the k-th pair in the sweeps.
	const SweepPoint& point(size_t k, size_t point) const { return points[pair(k).first * laneCount + point]; }
	/// Phase 4: the k-th joint.
	const DashpotConstraint& dashpot(size_t k) const
	{
		assert(k < dashpots.size());
		return dashpots[k];
	}

private:
	const std::vector<SolverBody>* allBodies = nullptr; ///< of the step
	int maxSweeps = 0;
	std::vector<ConstraintGroup> groups;
	std::vector<SweepPoint> points;
	std::vector<WeightedBody> weighted; ///< of each body of the island, by its index
	std::vector<SolverPair> pairs;
	std::vector<DashpotConstraint> dashpots;
	std::vector<long> activeUntil; ///< of each body: last sweep in which its pairs are visited
	long solveCount = 0; ///< since construction
	long sweepCount = 0; ///< since construction: bodies of islands solved before are inactive

	const ConstraintGroup& groupAt(const SolverPair& pair, size_t point) const
	{
		assert(point < pair.count);
		return groups[pair.first + point / laneCount];
	}
	[[gnu::always_inline]] Constraint constraintAt(const SolverPair& pair, size_t point) const
	{
		Constraint one;
		forMembers(one, groupAt(pair, point), [&](auto& member, const auto& all) { member = lane(all, point % laneCount); });
		return one;
	}
	SweepPoint* pointsOf(const SolverPair& pair) { return &points[pair.first * laneCount]; }
	void startBody(int k);
	void finishBodies(std::vector<SolverBody>& bodies);
	void finishImpulses(const SolverPair& pair);
	void warmStart(const SolverPair& pair);
	BodyMotion motionOf(const std::vector<SolverBody>& bodies, int k) { return { bodies[k], weighted[k] }; }
	void solvePair(const std::vector<SolverBody>& bodies, SolverPair& pair, bool forwards);
	double squaredThreshold(const std::vector<SolverBody>& bodies, double tolerance) const;
	/// Connection: SolverPair or DashpotConstraint.
	template <class Connection> bool activateNeighbours(const std::vector<SolverBody>& bodies, const Connection& c, double threshold);
	bool sweepOnce(const std::vector<SolverBody>& bodies, double threshold, bool forwards);
	bool sweepDashpots(const std::vector<SolverBody>& bodies, double threshold);
	int sweepToConvergence(const std::vector<SolverBody>& bodies, double tolerance);
};

} // namespace timber
