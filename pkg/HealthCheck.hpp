// SPDX-License-Identifier: GPL-2.0-or-later
/// Stops a run whose scene cannot be computed or whose numbers are no longer physical.
#pragma once
#include <Shape.hpp>
#include <boost/optional.hpp>

namespace yade {

class HealthCheck : public GlobalEngine {
	/// Parts and mass of a body at the last check of the scene.
	struct CheckedBody {
		// weak: the last owner of an object of Python must not be released in a step, without Python's lock
		boost::weak_ptr<Shape> shape;
		boost::weak_ptr<Material> material;
		int materialClass; ///< index; -1: no material
		boost::weak_ptr<State> state;
		const RoundedPolyhedron* rounded; ///< the shape; null for another one
		shared_ptr<const timber::RoundedPolyhedron> geometry; ///< its geometry
		Body::id_t id, clumpId;
		int flags, mask;
		unsigned blockedDOFs;
		Real mass;
		Vector3r inertia;

		explicit CheckedBody(const Body&);
		/// Whether its contacts are still valid: same shape and group, material of the same class.
		bool canKeepContacts(const Body&) const;
		bool isCurrent(const Body&) const;
	};
	std::vector<boost::optional<CheckedBody>> checkedBodies; ///< by id, as those of the scene at the last check
	/// Of the engines (findParts): at the last check of the scene, and in this step.
	std::vector<const void*> checkedParts, parts;
	Real checkedStep = NaN; ///< O.dt at the last check of the scene [s]
	boost::weak_ptr<Scene> checkedScene;
	bool areFastNoted = false, isCreatedNoted = false;

	bool hasSceneChanged();
	bool haveBodiesChanged() const;
	void checkScene();
	void checkBodies() const;
	void checkGeometry(const Body&) const;
	void forgetContacts();
	void takeOverRotations();
	void checkState(const Body&) const;
	void noteFastBodies();
	void noteCreated();

public:
	void postLoad(HealthCheck&) { validate(); }
	void validate() const;
	void action() override;
	/// The bodies' numbers now. Throws runtime_error.
	void check() const;
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(HealthCheck, GlobalEngine,
		"Stops a run with an error before a step that cannot be computed. Must come before the collider. "
		"When bodies, their parts and masses, joints, engines, functors or the time step were changed it checks "
		"that the list of engines is complete, in order, without a second integrator and of this scene, that "
		"all pairs of shapes and materials have functors, that materials and masses are valid, and that the step "
		"is small enough for contacts under gravity and for the joints. "
		"A free body with an angular velocity but no angular momentum gets the momentum of that velocity. "
		"Then and at an interval it checks that positions and velocities are finite, speeds and rotations "
		"plausible, names the first body that moves by more than half its thickness in a step, and says when "
		"contacts and joints have created more than 1e-4 of the energy put in.",
		((int, every, 100, Attr::triggerPostLoad, "Steps between checks of the bodies. [-]"))
		((Real, speedLimit, 200, Attr::triggerPostLoad, "Largest plausible speed of a body. [m/s]"))
		((Real, turnLimit, 1.5, Attr::triggerPostLoad, "Largest plausible rotation of a free body in a step. "
			"[rad]")),
		,
		.def("check", &HealthCheck::check, "Checks the bodies' numbers now; raises RuntimeError.")
	);
	// clang-format on
};
REGISTER_SERIALIZABLE(HealthCheck);

} // namespace yade
