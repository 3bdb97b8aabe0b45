// SPDX-License-Identifier: GPL-2.0-or-later
/// Engine of the contact solver: collects pairs, damped joints and bodies, solves island by island, sums forces and
/// energies.
#pragma once
#include <ContactPhysics.hpp>
#include <ImplicitJoints.hpp>
#include <kernel/contact_solver.hpp>
#include <kernel/islands.hpp>
#include <kernel/stability.hpp>

namespace yade {

class ContactForces : public GlobalEngine {
	/// A pair in this step. Pairs are ordered by body ids (an island lists indices of them), not in the container's
	/// order: the sums then depend neither on threads nor on the history of the collider. Copies of phys's numbers
	/// save reading phys for them: it is seldom in the processor's cache.
	struct ContactPair {
		Body::id_t id1, id2;
		const ManifoldGeom* geom; ///< of this step: a reset interaction gets another one
		ManifoldPhys* phys;
		size_t points; ///< copy of the number of phys's records; 0 if all of them are idle
		Real released, placed; ///< copies of phys->releasedEnergy and phys->placedEnergy [J]
	};
	struct IslandResult {
		timber::PairEnergies energies;
		ImplicitJointResult joints;
		timber::Convergence convergence;
	};
	/// With contact geometry: by body ids, in the container's order, and in that of the last step
	std::vector<const Interaction*> interactions, found, unordered;
	std::vector<ContactPair> pairs; ///< ordered by body ids
	std::vector<ImplicitJoint> joints; ///< damped or stiff
	timber::Islands islands; ///< of the pairs, and of the joints after them
	std::vector<timber::Link> links; ///< of each pair and joint
	std::vector<timber::ContactSolver> solvers; ///< of each thread
	std::vector<timber::SolverBody> bodies; ///< indexed by body id
	std::vector<IslandResult> results; ///< of each island
	std::vector<size_t> supports; ///< of the links, those with a fixed body
	std::vector<timber::PairForce> linkForces; ///< of those links
	BodyForces sums; ///< of contacts, and of the joints that the solver treats

	static void findPairs(const std::vector<const Interaction*>&, std::vector<ContactPair>&);
	static std::vector<ContactPair> pairsOf(const Scene&);
	void collectPairs();
	void collectBody(Body::id_t);
	void collectBodies();
	void checkPlacements() const;
	void findIslands();
	void addForce(size_t link, const timber::PairForce&);
	void sumSupports();
	void addImposedWork();
	void restorePermanentForces();
	IslandResult solveIsland(timber::Islands::Island);
	void solveAll();
	void sumResults();
	void addJoints(const ImplicitJointResult&);

public:
	void postLoad(ContactForces&) { validate(); }
	void preSave(ContactForces&);
	void validate() const;
	void action() override;
	/// Largest eigenvalue of M^-1 K of the present contacts and joints of the current scene. [1/s2]
	Real largestEigenvalue() const;
	/// Power that the present dashpots of a scene take from its bodies at these velocities, linearised: contacts
	/// neither slide nor open. bodies: masses, placements and velocities, indexed by body id [W]
	static Real dashpotPower(const Scene&, const std::vector<timber::SolverBody>& bodies);
	/// Linearised springs of the present contacts and joints of a scene. bodies: masses and placements, indexed by
	/// body id
	static std::vector<timber::PointSpring> linearSprings(const Scene&, const std::vector<timber::SolverBody>&);
	/// Masses and placements of a scene's bodies, indexed by body id; zero for those that were erased.
	static std::vector<timber::SolverBody> placements(const Scene&);

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(ContactForces, GlobalEngine,
		"Adds the contact forces to the bodies, free and fixed: elastic forces of the laws, dashpots (paper, Eqs. 17, 18, "
		"21-24), no tension, Coulomb friction. Adds the forces of the joints' dashpots "
		"(TimberJoint.dampingRatio, TimberJoint.dampingTime), too. "
		"Must come after the InteractionLoop and all other forces (joints, gravity, ground motion) and before "
		"the integrator: the dashpots act on the mean velocity of the step, which depends on them.",
		((int, sweeps, 10000, Attr::triggerPostLoad, "Largest number of Gauss-Seidel sweeps for the implicit "
			"springs and dashpots. Steps that need more are counted by unconverged. 0 gives the paper's "
			"explicit springs and dashpots, stable only for very small steps. [-]"))
		((Real, tolerance, 3e-3, Attr::triggerPostLoad, "The sweeps of an island end when the changes of its "
			"impulses are less than this share of the resultant impulses on its bodies, each divided by the "
			"square root of its mass; at rest a tenth of the first sweep's changes replaces that. [-]"))
		((long, sweepsDone, 0, , "Sum over the steps of the largest number of sweeps of an island. [-]"))
		((int, sweepsMax, 0, , "Largest number of sweeps of a step. [-]"))
		((long, unconverged, 0, , "Number of steps that ended at the limit of the sweeps while impulses still "
			"changed, or points had returned too much energy. [-]"))
		((Real, worstChange, 0, , "Largest last change of a pair's or joint's impulses in such a step, as "
			"twice its kinetic energy. [J]"))
		((Real, dashpotNormal, 0, , "Energy dissipated by normal dashpots. [J]"))
		((Real, dashpotShear, 0, , "Energy dissipated by tangential dashpots. [J]"))
		((Real, friction, 0, , "Energy dissipated by sliding. [J]"))
		((Real, crushing, 0, , "Energy dissipated by contacts at their bearing strength. [J]"))
		((Real, jointDashpot, 0, , "Energy dissipated by the dashpots of joints. [J]"))
		((Real, released, 0, , "Elastic energy released with loaded points that ceased to exist, minus the "
			"energy given to new points. [J]"))
		((Real, placed, 0, , "Energy that normal springs had because bodies were placed in contact. [J]"))
		((Real, created, 0, , "Energy that contact points and joints returned beyond their stored energy, "
			"counted when they cease to exist. [J]"))
		((Real, jointDebt, 0, , "Energy that stiff joints have returned beyond their stored energy so far. "
			"[J]"))
		((Real, imposedWork, 0, , "Work that fixed bodies have done on others by moving. [J]"))
		((Real, elasticJoints, 0, , "Energy that stiff joints have stored in the middle between the last "
			"placement and the next one. [J]"))
		((Real, elasticNormal, 0, , "Energy of the normal springs in the middle between the last placement and "
			"the next one. [J]"))
		((Real, elasticShear, 0, , "Energy of the tangential springs in the middle between the last placement "
			"and the next one. [J]"))
		((vector<Vector3r>, permanentForces, , Attr::hidden, "Of a loaded scene before its first step, by body "
			"id: forces of O.forces.setPermF. [N]"))
		((vector<Vector3r>, permanentTorques, , Attr::hidden, "Torques of O.forces.setPermT. [N m]")),
		,
		.def("largestEigenvalue", &ContactForces::largestEigenvalue, "Largest eigenvalue of M^-1 K of the "
			"present contacts and joints of the scene. [1/s2]")
	);
	// clang-format on
};
REGISTER_SERIALIZABLE(ContactForces);

} // namespace yade
