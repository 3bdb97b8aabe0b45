// SPDX-License-Identifier: GPL-2.0-or-later
/// From the elastic forces of all contacts to the total forces on the bodies.
#pragma once
#include <ContactPhys.hpp>
#include <kernel/dashpots.hpp>

namespace yade {

class ContactForces : public GlobalEngine {
	/// A contact pair in this step. Pairs are handled in the order of their body ids, whatever the container's order:
	/// the sums then do not depend on threads or on when the collider saw the pair.
	struct Pair {
		Interaction*        interaction;
		const ManifoldGeom* geom;
		ManifoldPhys*       phys;
	};
	std::vector<Pair>                 pairs;
	std::vector<timber::DashpotBody>  bodies; ///< indexed by body id
	std::vector<timber::DashpotPoint> points; ///< of all pairs, in their order
	std::vector<Vector3r>             force, torque; ///< contact sums, indexed by body id

	void collectPairs();
	void collectBodies();
	void collectPoints();
	void storePoints();
	void bookEnergy(const timber::DashpotPoint&, timber::PointState&, const ManifoldPhys&);
	void applyForces();

public:
	void action() override;
	/// Elastic energy between this step and the last one, where the velocities are. [J]
	Real elasticNormal() const { return (elasticNormalNow + elasticNormalLast) / 2; }
	Real elasticShear() const { return (elasticShearNow + elasticShearLast) / 2; }

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(ContactForces, GlobalEngine,
		"Adds the contact forces to the bodies: elastic forces of the laws, dashpots (paper, Eqs. 17, 18, 21-24), no tension, Coulomb's limit. "
		"Must come after the InteractionLoop and all other forces (joints, gravity, ground motion) and before the integrator: the dashpots act on the mean velocity of the step, which depends on them. "
		"Energies are those between the last two steps.",
		((int, sweeps, 4, , "Gauss-Seidel sweeps for the implicit dashpots; 0: explicit dashpots, as in the paper, stable only for very small steps. [-]"))
		((bool, trackEnergy, true, , "Whether the energies below are kept. [-]"))
		((Real, dashpotNormal, 0, , "Energy dissipated by normal dashpots. [J]"))
		((Real, dashpotShear, 0, , "Energy dissipated by tangential dashpots. [J]"))
		((Real, friction, 0, , "Energy dissipated by sliding, and by tangential springs that lose stiffness. [J]"))
		((Real, lost, 0, , "Elastic energy of loaded points that ceased to exist, minus that of points born under load. [J]"))
		((Real, dashpotNormalPending, 0, Attr::hidden, "Dissipated in the step that the integrator is about to make. [J]"))
		((Real, dashpotShearPending, 0, Attr::hidden, "Dissipated in the step that the integrator is about to make. [J]"))
		((Real, elasticNormalNow, 0, Attr::hidden, "[J]"))
		((Real, elasticNormalLast, 0, Attr::hidden, "[J]"))
		((Real, elasticShearNow, 0, Attr::hidden, "[J]"))
		((Real, elasticShearLast, 0, Attr::hidden, "[J]")),
		,
		.add_property("elasticNormal", &ContactForces::elasticNormal, "Elastic energy of the normal springs. [J]")
		.add_property("elasticShear", &ContactForces::elasticShear, "Elastic energy of the tangential springs. [J]")
	);
	// clang-format on
};
REGISTER_SERIALIZABLE(ContactForces);

} // namespace yade
