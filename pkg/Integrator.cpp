// SPDX-License-Identifier: GPL-2.0-or-later
#include <Integrator.hpp>
#include <bodies.hpp>
#include <kernel/rotation.hpp>
#include <kernel/threads.hpp>

namespace yade {

YADE_PLUGIN((SymplecticIntegrator));

namespace {
	/// Zeroes the components of blocked directions; `first` is the flag of the x component.
	Vector3r unblocked(Vector3r v, unsigned blocked, unsigned first)
	{
		for (int axis = 0; blocked && axis < 3; ++axis)
			if (blocked & (first << axis)) v[axis] = 0;
		return v;
	}
}

/// Velocity, place and angular momentum of a free body after the step.
void SymplecticIntegrator::push(Body::id_t id, State& s) const
{
	const Real dt = scene->dt;
	s.vel += dt / s.mass * unblocked(scene->forces.getForce(id), s.blockedDOFs, State::DOF_X);
	s.angMom += dt * unblocked(scene->forces.getTorque(id), s.blockedDOFs, State::DOF_RX);
	s.pos += dt * s.vel;
}

/// A held body goes on with its velocities, which somebody else may set; released, it has the angular momentum that belongs to them.
void SymplecticIntegrator::carryOn(State& s) const
{
	s.pos += scene->dt * s.vel;
	s.angMom = s.ori * s.inertia.cwiseProduct(s.ori.conjugate() * s.angVel);
	const Real speed = s.angVel.norm();
	if (speed > 0) s.ori = (Quaternionr(AngleAxisr(speed * scene->dt, s.angVel / speed)) * s.ori).normalized();
}

/// Orientations and angular velocities of up to as many bodies as a Number has lanes.
template <class Number> void SymplecticIntegrator::turn(State* const* states, size_t count) const
{
	const auto all = [&](auto member) {
		using Vector = std::remove_reference_t<decltype(member(**states))>;
		return timber::Group<Number, Vector>(count, [&](size_t i) { return &member(*states[i]); });
	};
	const auto orientation = all([](State& s) -> auto& { return s.ori.coeffs(); });
	const timber::Vec3Of<Number> momentum = all([](State& s) -> auto& { return s.angMom; }).vectors(), inertia = all([](State& s) -> auto& { return s.inertia; }).vectors();
	timber::QuatOf<Number> turned(orientation.vectors());
	all([](State& s) -> auto& { return s.angVel; }).set(timber::freeRotation<Number>(turned, momentum, inertia, scene->dt));
	orientation.set(turned.coeffs());
}

/// The bodies from the given id on, as many as there are lanes.
void SymplecticIntegrator::move(Body::id_t first) const
{
	State* turning[timber::laneCount];
	size_t count = 0;
	const Body::id_t end = math::min(first + timber::laneCount, int(scene->bodies->size()));
	for (Body::id_t id = first; id < end; ++id) {
		const shared_ptr<Body>& b = (*scene->bodies)[id];
		if (!b) continue;
		if (!isFree(*b->state)) {
			carryOn(*b->state);
			continue;
		}
		push(id, *b->state);
		turning[count++] = b->state.get();
	}
	if (count == 1) turn<double>(turning, count);
	if (count > 1) turn<timber::Lanes>(turning, count);
}

void SymplecticIntegrator::action()
{
	scene->forces.sync();
	const int groups = int(timber::groupsOf(scene->bodies->size()));
	timber::forAll(groups, [this](int group) { move(group * timber::laneCount); }, timber::laneCount);
}

} // namespace yade
