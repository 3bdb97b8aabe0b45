// SPDX-License-Identifier: GPL-2.0-or-later
/// Time per pair and step of this kernel, Bullet and ODE (Google Benchmark), with the contact points found by each.
///   timber          manifold, elastic law and contact solver, with cached candidates; the pair vibrates as in a house
///                   at rest
///   timber points   contact points only
///   timber cold     contact points from an empty cache
///   Bullet          contact points, boxes as boxes;  Bullet hulls: boxes as convex hulls;  Bullet cold: new manifold
///                                                                                          in each step
///   ODE             contact points; ODE has no cache
#include "bullet_pair.hpp"
#include "ode_pair.hpp"
#include "timber_pair.hpp"
#include <benchmark/benchmark.h>

using namespace timber::bench;

namespace {

template <class Pair, class Step>
void add(const std::string& library, const Configuration& c, std::shared_ptr<Pair> pair, Step step)
{
	benchmark::RegisterBenchmark((library + "/" + c.name).c_str(), [pair, step](benchmark::State& state) {
		int k = 0;
		for (auto _ : state)
			step(*pair, ++k);
		const Found f = pair->found();
		state.counters["points"] = f.points;
		state.counters["expected"] = pair->configuration.points;
		state.counters["normal_error"] = f.normalError;
		state.counters["depth_error"] = f.depthError;
		if constexpr (std::is_same_v<Pair, TimberPair>) state.counters["sweeps"] = pair->sweepsPerStep();
	});
}

} // namespace

int main(int argc, char** argv)
{
	dInitODE2(0);
	static const auto all = configurations();
	for (const Configuration& c : all) {
		add("timber", c, std::make_shared<TimberPair>(c), [](TimberPair& p, int k) { p.step(k); });
		add("timber points", c, std::make_shared<TimberPair>(c),
		        [](TimberPair& p, int k) { p.updatePoints(k); });
		add("timber cold", c, std::make_shared<TimberPair>(c),
		        [](TimberPair& p, int k) { p.reset(), p.updatePoints(k); });
		add("Bullet", c, std::make_shared<BulletPair>(c, false), [](BulletPair& p, int k) { p.step(k); });
		add("Bullet hulls", c, std::make_shared<BulletPair>(c, true), [](BulletPair& p, int k) { p.step(k); });
		add("Bullet cold", c, std::make_shared<BulletPair>(c, false),
		        [](BulletPair& p, int k) { p.reset(), p.step(k); });
		add("ODE", c, std::make_shared<OdePair>(c), [](OdePair& p, int k) { p.step(k); });
	}
	benchmark::Initialize(&argc, argv);
	benchmark::RunSpecifiedBenchmarks();
}
