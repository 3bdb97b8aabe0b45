// SPDX-License-Identifier: GPL-2.0-or-later
#include <HealthCheck.hpp>
#include <bodies.hpp>
#include <SceneCheck.hpp>
#include <validation.hpp>

namespace yade {

YADE_PLUGIN((HealthCheck));

void HealthCheck::validate() const
{
	require(every >= 1, "HealthCheck.every", every, ">= 1");
	require(speedLimit > 0, "HealthCheck.speedLimit", speedLimit, "> 0");
	require(turnLimit > 0, "HealthCheck.turnLimit", turnLimit, "> 0");
}

/// doSort: bodies were added or replaced since the collider ran.
bool HealthCheck::hasSceneChanged() const
{
	const auto isSame = [](const CheckedEngine& checked, const shared_ptr<Engine>& now) { return checked == CheckedEngine(now.get(), now->dead); };
	return scene->doSort || checkedEngines.size() != scene->engines.size()
	        || !std::equal(checkedEngines.begin(), checkedEngines.end(), scene->engines.begin(), isSame);
}

void HealthCheck::checkBodies() const
{
	for (const shared_ptr<Body>& b : *scene->bodies)
		if (b) checkBody(*b);
}

/// Engines store data of the bodies that is wrong in another scene.
void HealthCheck::checkScene()
{
	const shared_ptr<Scene>& current = Omega::instance().getScene();
	if (!checkedEngines.empty() && checkedScene.lock() != current)
		throw std::runtime_error("O.engines: the engines belong to an earlier scene. Set O.engines = yade_timber.engines(...) again");
	checkBodies();
	checkEngines(*scene);
	checkContacts(*scene);
	checkedScene = current;
	checkedEngines.clear();
	for (const shared_ptr<Engine>& e : scene->engines)
		checkedEngines.emplace_back(e.get(), e->dead);
}

/// Parts of a body are replaced between checks of the scene only; numbers of its state may change at any time.
void HealthCheck::checkState(const Body& b) const
{
	const State& s = *b.state;
	if (b.isClump() || (s.blockedDOFs != State::DOF_NONE && s.blockedDOFs != State::DOF_ALL) || !(s.mass > 0)) checkBody(b);
	const bool turns = isFree(s) && !(s.angVel.norm() * scene->dt <= turnLimit);
	if (s.pos.allFinite() && s.vel.allFinite() && s.angVel.allFinite() && s.ori.coeffs().allFinite() && s.vel.norm() <= speedLimit && !turns) return;
	checkBodies(); // another cause than the time step
	std::ostringstream message;
	message << "body " << b.getId() << " left the physical range before step " << scene->iter << " (t = " << scene->time << " s): position "
	        << s.pos.transpose() << " m, velocity " << s.vel.transpose() << " m/s, angular velocity " << s.angVel.transpose() << " rad/s; the time step " << scene->dt << " s is probably too large";
	throw std::runtime_error(message.str());
}

void HealthCheck::action()
{
	if (!(scene->dt > 0 && std::isfinite(scene->dt))) throw std::runtime_error("O.dt = " + std::to_string(scene->dt) + " s: it must be finite and > 0");
	if (scene->isPeriodic) throw std::runtime_error("O.periodic = True: periodic cells are not supported");
	const bool changed = hasSceneChanged();
	if (!changed && scene->iter % every != 0) return;
	if (changed) checkScene();
	check();
}

void HealthCheck::check() const
{
	for (const shared_ptr<Body>& b : *scene->bodies)
		if (b) checkState(*b);
}

} // namespace yade
