// SPDX-License-Identifier: GPL-2.0-or-later
/// From the elastic forces of all contacts to the total forces on the bodies.
#pragma once
#include <ContactPhysics.hpp>
#include <bodies.hpp>
#include <kernel/contact_solver.hpp>
#include <kernel/islands.hpp>
#include <kernel/stability.hpp>

namespace yade {

class ContactForces : public GlobalEngine {
	/// A contact pair in this step. Pairs are handled island by island, in the order of their body ids, whatever the container's
	/// order: the sums then do not depend on threads or on when the collider saw the pair.
	struct Pair {
		Body::id_t          id1, id2;
		const ManifoldGeom* geom; ///< of this step: a reset interaction gets new ones
		ManifoldPhys*       phys;
		size_t              points; ///< this and the next are phys's, read while it is at hand
		Real                lost; ///< [J]
		bool                hasIdsOf(const Pair& p) const { return id1 == p.id1 && id2 == p.id2; }
	};
	std::vector<Pair>                  pairs, found; ///< sorted, and in the container's order
	std::vector<size_t>                order; ///< of each of `pairs`, its place in `found`
	timber::Islands                    islands;
	std::vector<timber::Link>          links; ///< of each pair
	std::vector<timber::ContactSolver> solvers; ///< of each thread
	std::vector<timber::SolverBody>   bodies; ///< indexed by body id
	BodyForces                         sums; ///< of the contacts, on free bodies

	/// What a step makes of an island; summed in their order, whoever did them.
	struct Result {
		timber::PairEnergies books;
		int                  sweeps = 0;
	};
	std::vector<Result> results;

	void   sortPairs();
	void   collectPairs();
	void   collectBody(Body::id_t);
	void   collectBodies();
	void   findIslands();
	void   prepareContacts(timber::ContactSolver&, size_t k, const Pair&);
	void   storeForces(const timber::ContactSolver&, size_t k, const Pair&, timber::PairEnergies&);
	Result solve(timber::Islands::Island);
	void   solveAll();
	void   sumResults();

public:
	void action() override;
	/// Largest eigenvalue of M^-1 K of the contacts as they are now and the given springs, by power iteration. [1/s2]
	/// springs: list of (id1, id2, point in the world frame [m], stiffness [N/m]).
	Real largestEigenvalue(const boost::python::list& springs);

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(ContactForces, GlobalEngine,
		"Adds the contact forces to the bodies: elastic forces of the laws, dashpots (paper, Eqs. 17, 18, 21-24), no tension, Coulomb's limit. "
		"Must come after the InteractionLoop and all other forces (joints, gravity, ground motion) and before the integrator: the dashpots act on the mean velocity of the step, which depends on them.",
		((int, sweeps, 50, , "Most Gauss-Seidel sweeps for the implicit springs and dashpots; 0: explicit ones, as in the paper, stable only for very small steps. [-]"))
		((Real, tolerance, 1e-3, , "The sweeps of an island of contacts end once none of its pairs changes its impulses by more than this share of the island's root mean square, each over the root of the pair's equivalent mass. [-]"))
		((long, sweepsDone, 0, , "Sweeps of all steps so far, each those of the island that took most. [-]"))
		((bool, trackEnergy, true, , "Whether the energies below are kept. [-]"))
		((Real, dashpotNormal, 0, , "Energy dissipated by normal dashpots, and what Newmark's term has taken. [J]"))
		((Real, dashpotShear, 0, , "Energy dissipated by tangential dashpots, and what Newmark's term has taken. [J]"))
		((Real, friction, 0, , "Energy dissipated by sliding, and by tangential springs that lose stiffness. [J]"))
		((Real, lost, 0, , "Elastic energy of loaded points that ceased to exist, minus that of points born under load. [J]"))
		((Real, elasticNormal, 0, , "Energy of the normal springs at the placement of the last step. [J]"))
		((Real, elasticShear, 0, , "Energy of the tangential springs at the placement of the last step. [J]"))
		((Real, elasticPower, 0, , "Rate at which the springs' energy grows with the velocities at the end of the last step. [W]")),
		,
		.def("largestEigenvalue", &ContactForces::largestEigenvalue, (boost::python::arg("springs")), "Largest eigenvalue of M^-1 K of all contacts as they are now, plus springs given as (id1, id2, point, stiffness). [1/s2]")
	);
	// clang-format on
};
REGISTER_SERIALIZABLE(ContactForces);

} // namespace yade
