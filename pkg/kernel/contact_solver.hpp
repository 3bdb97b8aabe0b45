// SPDX-License-Identifier: GPL-2.0-or-later
/// Total contact forces of one step: elastic forces plus dashpots, no tension, Coulomb's limit.
///
/// A face has four points, each with a critical dashpot for the mass of the whole pair (Eqs. 41-43); on a light slender
/// member they add up to rates of 1e5 /s, and explicit dashpots (Eqs. 17, 18) are unstable above some 1e-5 s. Here the
/// dashpot impulses of all points act on the mean of the velocities before and after the step,
///     p = -h C ((1 - theta) v_before + theta v_after),    theta = 1/2 + x/(12 + 2x),  x = h C / m_eff,
/// which is second order for slow dashpots (theta -> 1/2) and strongly damped for fast ones (theta -> 1; the exact decay
/// exp(-x) gives this theta to 1 %). Springs of heavily loaded light members are too stiff for the step as well: with the stiffness K
/// at hand, a point's impulse has a further part (Newmark's method),
///     -beta h2 K (v_after - v_before),    beta = y / (4 y + 2),  y = h2 K / m_eff,
/// next to nothing for springs that the step resolves (leapfrog) and 1/4 for stiff ones: up to eight of them on one member are stable
/// at any step. Spring and dashpot together have at most the force of friction.
/// The coupled equations are solved by projected Gauss-Seidel sweeps over the points, started from the last step's dashpots,
/// until they change little. No sweeps: explicit springs and dashpots, as the paper has them.
#pragma once
#include "simd.hpp"
#include <cstddef>
#include <vector>

namespace timber {

struct SolverBody {
	Vec3 velocity, spin; ///< before the step [m/s, rad/s]
	Vec3 newVelocity, newSpin; ///< in: after all forces but those of contacts; out: after the contacts too
	double inverseMass; ///< 0 for a fixed body [1/kg]
	Mat3 inverseInertia; ///< world axes [1/(kg m2)]
	Vec3 position = Vec3::Zero(); ///< [m]
};

/// Of the equivalent mass of two bodies (Eq. 43). [1/kg]
inline double inverseMass(const SolverBody& a, const SolverBody& b) { return a.inverseMass + b.inverseMass; }

/// How the relative velocity at a point answers to impulses there. It decides theta and the speed of the sweeps, and changes
/// little in some steps: it may be kept for them, but not when a body is held, released or gets another mass.
struct PointResponse {
	Vec3 normalResponse = Vec3::Zero(); ///< change of the relative velocity per unit normal impulse [1/kg]
	double shearResponse = 0; ///< largest change per unit tangential impulse [1/kg]
	double responseMass = -1; ///< inverse mass of both bodies together when it was found [1/kg]; < 0: not known
};
PointResponse responseAt(const SolverBody& a, const SolverBody& b, const Vec3& armA, const Vec3& armB, const Vec3& normal);

/// A contact point as its dashpots see it.
template <class Number> struct ContactInput {
	Vec3Of<Number> armA, armB; ///< from the centres of mass to the point [m]
	Vec3Of<Number> normal; ///< unit, from A to B
	Number elasticNormal; ///< e_n >= 0 at the placement [N]
	Vec3Of<Number> elasticShear; ///< e_s on B at the placement, before Coulomb's limit [N]
	Number normalDamping, shearDamping; ///< C_n, C_s [N s/m]
	Number friction; ///< [-]
	Vec3Of<Number> impulse; ///< guess of the total contact impulse on B [N s]
	Vec3Of<Number> normalResponse; ///< PointResponse
	Number shearResponse;
	Number normalStiffness = 0., shearStiffness = 0.; ///< K_n, K_s [N/m]
};

/// What a sweep needs of a point: impulses instead of forces, divisions done. A visit finds the impulses that solve
/// the point's own equations for the relative velocity v that the other points leave it:
///     normal     p_n = max(0, normalKept p_n + normalDrive - normalGain v_n)
///     tangential p_s = shearKept p_s + shearDrive - shearGain v_s - coupling (change of p_n), shortened to friction p_n if it is longer
template <class Number> struct ContactConstraint {
	Vec3Of<Number> armA, armB, normal;
	Vec3Of<Number> impulse; ///< total contact impulse on B [N s]
	Number normalKept, normalDrive, normalGain; ///< [-, N s, kg]
	Number shearKept, shearGain; ///< [-, kg]
	Vec3Of<Number> shearDrive; ///< [N s]
	Vec3Of<Number> coupling; ///< tangential impulse that answers the slip which a unit normal impulse causes [-]
	Number friction;
};
/// work(member of x, the same member of y) for all members of a row.
template <class RowX, class RowY, class Work> void forMembers(RowX& x, RowY& y, Work work)
{
	work(x.armA, y.armA);
	work(x.armB, y.armB);
	work(x.normal, y.normal);
	work(x.impulse, y.impulse);
	work(x.normalKept, y.normalKept);
	work(x.normalDrive, y.normalDrive);
	work(x.normalGain, y.normalGain);
	work(x.shearKept, y.shearKept);
	work(x.shearGain, y.shearGain);
	work(x.shearDrive, y.shearDrive);
	work(x.coupling, y.coupling);
	work(x.friction, y.friction);
}

/// Relative velocity of B against A at a point with the given arms. [m/s]
template <class Number>
[[gnu::always_inline]] inline Vec3Of<Number> relativeVelocity(
        const Vec3Of<Number>& armA, const Vec3Of<Number>& armB, const Vec3& vA, const Vec3& wA, const Vec3& vB, const Vec3& wB)
{
	return wide<Number>(vB) + wide<Number>(wB).cross(armB) - wide<Number>(vA) - wide<Number>(wA).cross(armA);
}

/// v, shortened to the length if it is longer.
template <class Number> Vec3Of<Number> clipped(const Vec3Of<Number>& v, Number length)
{
	const Number square = v.squaredNorm();
	return chosen(square > length * length, [&] { return Vec3Of<Number>(v * Number(length / root(square))); }, [&] { return v; });
}

/// e_s after sliding: at most friction times the normal force. [N]
template <class Number> Vec3Of<Number> limitedShear(const Vec3Of<Number>& elasticShear, Number friction, Number normalForce) { return clipped<Number>(elasticShear, friction * normalForce); }

/// Finds the impulses of all points of an island (islands.hpp) in a step: clear(), addPair() for each pair, set() for each of their points, solve().
class ContactSolver {
public:
	using Row = ContactConstraint<double>;
	/// Rows of up to laneCount points of a pair, as they are made; the sweeps take them one by one. Lanes to spare hold anything.
	using Rows = ContactConstraint<Lanes>;
	/// Two bodies and their rows.
	struct Pair {
		int bodyA, bodyB;
		size_t first; ///< of its Rows
		size_t count; ///< of its points
		double change; ///< of the impulses in the last sweep, squared and over the equivalent mass: what light members notice counts [J]
	};

	/// Starts a step. sweeps: most passes over the points, pairs always in the same order (fewer of them), the points of each there and back (no side of a face is favoured); 0: explicit dashpots.
	void clear(int sweeps);
	/// Makes room for the points of two bodies. Returns the pair's number.
	size_t addPair(int bodyA, int bodyB, size_t count);
	/// Rows of the k-th pair from its points of a step of length h [s], from the given one on: one, or up to laneCount of them from a
	/// multiple of laneCount on. May be called
	/// by several threads, each for pairs of its own.
	template <class Number> void set(size_t k, size_t first, const std::vector<SolverBody>& bodies, const ContactInput<Number>& points, double h);
	/// Impulses of all rows, and the bodies' velocities with them. After the first, a pass looks only at pairs of which a body
	/// has just been changed; a pair whose impulses change by less than `tolerance` of the root mean square of the
	/// points [-], each over the root of its equivalent mass, changes nobody (firstSweepShare of it in the first pass). Few fixed passes would do for a standing house, but
	/// between heavy and light members in an impact they are far from the solution, and what is left of the start would create
	/// energy. Returns the number of passes. Fixed bodies are only read: they may belong to several islands, which other threads work on.
	int solve(std::vector<SolverBody>& bodies, double tolerance = 0);

	const Pair& pair(size_t k) const { return pairs[k]; }
	/// Of the k-th pair: the row of a point, and the Rows that begin with it, a multiple of laneCount.
	Row row(size_t k, size_t point) const { return rowAt(pairs[k], point); }
	const Rows& rowsFrom(size_t k, size_t point) const { return rowsAt(pairs[k], point); }

private:
	int sweeps = 0;
	std::vector<Rows> rows;
	std::vector<Pair> pairs;
	std::vector<long> awake; ///< of each body: last pass for which its velocity may have changed enough to look again
	long passes = 0; ///< since the solver was made: bodies of islands that were solved before are no longer awake

	const Rows& rowsAt(const Pair& pair, size_t point) const { return rows[pair.first + point / laneCount]; }
	[[gnu::always_inline]] Row rowAt(const Pair& pair, size_t point) const
	{
		Row row;
		forMembers(row, rowsAt(pair, point), [&](auto& one, const auto& all) { one = lane(all, point % laneCount); });
		return row;
	}
	double threshold(const std::vector<SolverBody>& bodies, double tolerance) const;
	bool wake(const std::vector<SolverBody>& bodies, const Pair& pair, double allowed);
	bool sweepOn(std::vector<SolverBody>& bodies, double allowed, bool forwards);
	int sweepAll(std::vector<SolverBody>& bodies, double tolerance);
	void pushAll(std::vector<SolverBody>& bodies, const Pair& pair);
	void relax(std::vector<SolverBody>& bodies, Pair& pair, bool forwards);
};

} // namespace timber
