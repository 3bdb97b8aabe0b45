// SPDX-License-Identifier: GPL-2.0-or-later
#include <EnergyBalance.hpp>
#include <ContactForces.hpp>
#include <Gravity.hpp>
#include <GroundMotion.hpp>
#include <JointEngine.hpp>
#include <bodies.hpp>

namespace yade {

namespace {
	/// [J]
	Real kineticEnergy(const Scene& scene)
	{
		Real sum = 0;
		for (const shared_ptr<Body>& b : *scene.bodies) {
			if (!b || !isFree(*b->state)) continue;
			sum += (b->state->mass * b->state->vel.squaredNorm() + b->state->angMom.dot(b->state->angVel))
			        / 2;
		}
		return sum;
	}

	/// Relative to the reference positions, at the half step to which the velocities belong. [J]
	Real gravityEnergy(const Scene& scene)
	{
		const Vector3r gravity = gravityOf(scene);
		Real sum = 0;
		for (const shared_ptr<Body>& b : *scene.bodies) {
			if (!b || !isFree(*b->state)) continue;
			const State& s = *b->state;
			sum -= s.mass * gravity.dot(s.pos - s.refPos - scene.dt / 2 * s.vel);
		}
		return sum;
	}

	/// Elastic energy of joints after a whole step. [J]
	Real jointEnergy(const EnergySources& s)
	{
		Real energy = s.contacts ? s.contacts->elasticJoints : 0;
		if (s.joints) energy += s.joints->elastic;
		if (s.joints && !s.joints->dead) energy += s.scene.dt / 2 * s.joints->elasticPower(s.scene);
		return energy;
	}

	using Sources = const EnergySources&;
}

const std::vector<EnergyTerm> energyTerms {
	{ "kinetic", [](Sources s) { return kineticEnergy(s.scene); } },
	{ "gravity", [](Sources s) { return gravityEnergy(s.scene); } },
	{ "elastic_contacts",
	        [](Sources s) {
	                const ContactForces* c = s.contacts;
	                return c ? c->elasticNormal + c->elasticShear - c->placed : 0;
	        } },
	{ "elastic_joints", jointEnergy },
	{ "ground_motion", [](Sources s) { return s.motion ? s.motion->workUntilNow(s.scene) : 0; } },
	{ "dashpot_normal", [](Sources s) { return s.contacts ? s.contacts->dashpotNormal : 0; } },
	{ "dashpot_shear", [](Sources s) { return s.contacts ? s.contacts->dashpotShear : 0; } },
	{ "friction", [](Sources s) { return s.contacts ? s.contacts->friction : 0; } },
	{ "crushing", [](Sources s) { return s.contacts ? s.contacts->crushing : 0; } },
	{ "broken_springs", [](Sources s) { return s.joints ? s.joints->released : 0; } },
	{ "lost_contacts", [](Sources s) { return s.contacts ? s.contacts->released : 0; } },
	{ "joint_dashpot", [](Sources s) { return s.contacts ? s.contacts->jointDashpot : 0; } },
	{ "joint_yield", [](Sources s) { return s.joints ? s.joints->yielded : 0; } },
};

EnergySources energySources(const Scene& scene)
{
	return { scene, findEngine<ContactForces>(scene, true), findEngine<JointEngine>(scene, true),
		findEngine<GroundMotionEngine>(scene, true) };
}

Real createdEnergy(const Scene& scene)
{
	const EnergySources s = energySources(scene);
	return (s.contacts ? s.contacts->created + s.contacts->jointDebt : 0)
	        + (s.joints ? math::max(Real(0), s.joints->created) : 0);
}

Real energyTurnover(const Scene& scene)
{
	const EnergySources sources = energySources(scene);
	Real sum = 0;
	for (const EnergyTerm& term : energyTerms)
		if (string(term.name) != "gravity" && string(term.name) != "ground_motion") sum += term.value(sources);
	return sum;
}

boost::python::dict pyEnergy()
{
	boost::python::dict terms;
	const EnergySources sources = energySources(*Omega::instance().getScene());
	for (const EnergyTerm& term : energyTerms)
		terms[term.name] = term.value(sources);
	return terms;
}

double pyCreatedEnergy() { return createdEnergy(*Omega::instance().getScene()); }

} // namespace yade
