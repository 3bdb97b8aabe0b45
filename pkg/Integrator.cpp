// SPDX-License-Identifier: GPL-2.0-or-later
#include <Integrator.hpp>
#include <bodies.hpp>
#include <kernel/rotation.hpp>
#include <kernel/threads.hpp>
#include <array>

namespace yade {

YADE_PLUGIN((SymplecticIntegrator));

SteppedBody::SteppedBody(const Body* b)
        : position(b ? b->state->pos : Vector3r(Vector3r::Zero()))
        , orientation(b ? b->state->ori : Quaternionr(Quaternionr::Identity()))
        , born(b ? b->iterBorn : -1)
        , mask(b ? int(b->groupMask) : 0)
        , blockedDOFs(b ? int(b->state->blockedDOFs) : 0)
{
}

bool SteppedBody::isStill(const Body& b) const
{
	return isSame(b) && hasPoseOf(b) && mask == int(b.groupMask) && blockedDOFs == int(b.state->blockedDOFs);
}

bool wasPlaced(const Scene& scene, const Body& b)
{
	const auto* integrator = findEngine<SymplecticIntegrator>(scene);
	if (!integrator || integrator->stepped.empty()) return scene.iter == 0 || b.iterBorn >= scene.iter;
	const size_t id = b.getId();
	return id >= integrator->stepped.size() || !integrator->stepped[id].isStill(b);
}

std::vector<bool> movedByHand(const Scene& scene, bool alsoWithin)
{
	std::vector<bool> moved;
	const auto* integrator = findEngine<SymplecticIntegrator>(scene);
	for (size_t id = 0; integrator && id < integrator->stepped.size(); ++id) {
		const Body* b = bodyAt(scene, int(id));
		const SteppedBody& before = integrator->stepped[id];
		if (!b || !(before.isMoved(*b) || (alsoWithin && before.isSame(*b) && before.wasMoved))) continue;
		moved.resize(scene.bodies->size());
		moved[id] = true;
	}
	return moved;
}

void markPlaced(const Scene& scene, Body::id_t id)
{
	auto* integrator = findEngine<SymplecticIntegrator>(scene);
	if (integrator && id >= 0 && size_t(id) < integrator->stepped.size()) integrator->stepped[id].born = -1;
}

/// Kick and drift of a free body: velocity, angular momentum and position at the end of the step.
void SymplecticIntegrator::kickAndDrift(Body::id_t id, State& s) const
{
	const Real dt = scene->dt;
	s.vel += dt / s.mass * scene->forces.getForce(id);
	s.angMom += dt * scene->forces.getTorque(id);
	s.pos += dt * s.vel;
}

/// Motion of a fixed body with its prescribed velocities. Its angular momentum follows them, so that it is right once
/// the body is released.
void SymplecticIntegrator::moveFixed(State& s) const
{
	s.pos += scene->dt * s.vel;
	s.angMom = s.ori * s.inertia.cwiseProduct(s.ori.conjugate() * s.angVel);
	const Real speed = s.angVel.norm();
	if (!(speed > 0)) return;
	const auto [sine, cosine] = timber::sineCosine<Real>(speed * scene->dt / 2);
	const Vector3r part = sine / speed * s.angVel;
	s.ori = (Quaternionr(cosine, part.x(), part.y(), part.z()) * s.ori).normalized();
}

/// Orientations and angular velocities of at most as many bodies as a Number has lanes.
template <class Number> void SymplecticIntegrator::rotate(State* const* states, size_t count) const
{
	const auto lanesOf = [&](auto member) {
		using Vector = std::remove_reference_t<decltype(member(**states))>;
		return timber::Group<Number, Vector>(count, [&](size_t i) { return &member(*states[i]); });
	};
	const auto orientation = lanesOf([](State & s) -> auto& { return s.ori.coeffs(); });
	const timber::Vec3Of<Number> momentum = lanesOf([](State & s) -> auto& { return s.angMom; }).vectors(),
	                             inertia = lanesOf([](State & s) -> auto& { return s.inertia; }).vectors();
	timber::QuatOf<Number> rotated(orientation.vectors());
	lanesOf([](State & s) -> auto& {
		return s.angVel;
	}).set(timber::freeRotation<Number>(rotated, momentum, inertia, scene->dt));
	orientation.set(rotated.coeffs());
}

/// Motion of the bodies from the given id on, as many as there are lanes.
void SymplecticIntegrator::moveGroup(Body::id_t first)
{
	State* free[timber::laneCount];
	size_t count = 0;
	const Body::id_t end = math::min(first + timber::laneCount, int(scene->bodies->size()));
	std::array<bool, timber::laneCount> moved {};
	for (Body::id_t id = first; id < end; ++id) {
		const shared_ptr<Body>& b = (*scene->bodies)[id];
		if (!b) continue;
		moved[id - first] = stepped[id].isMoved(*b);
		if (!isFree(*b->state)) {
			moveFixed(*b->state);
			continue;
		}
		kickAndDrift(id, *b->state);
		free[count++] = b->state.get();
	}
	if (count == 1) rotate<double>(free, count);
	if (count > 1) rotate<timber::Lanes>(free, count);
	for (Body::id_t id = first; id < end; ++id) {
		stepped[id] = SteppedBody((*scene->bodies)[id].get());
		stepped[id].wasMoved = moved[id - first];
	}
}

void SymplecticIntegrator::action()
{
	syncForces(*scene);
	stepped.resize(scene->bodies->size());
	const int groups = int(timber::groupsOf(scene->bodies->size()));
	timber::forAll(
	        groups, [this](int group) { moveGroup(group * timber::laneCount); }, timber::laneCount);
}

} // namespace yade
