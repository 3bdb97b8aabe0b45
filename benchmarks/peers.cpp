// SPDX-License-Identifier: GPL-2.0-or-later
/// Time per pair and step of this kernel, Bullet and ODE, in one program (Google Benchmark), with what each of them finds.
///   timber          manifold, elastic law, dashpots and limits; candidates cached, the pair trembles as in a standing house
///   timber points   the contact points alone
///   timber cold     contact points from an empty cache
///   Bullet          its contact points, boxes as boxes;  Bullet hulls: boxes as convex hulls;  Bullet cold: new manifold each time
///   ODE             its contact points, which are always cold
#include "bullet_pair.hpp"
#include "ode_pair.hpp"
#include "timber_pair.hpp"
#include <benchmark/benchmark.h>

using namespace timber::bench;

namespace {

template <class Pair, class Step> void add(const std::string& who, const Configuration& c, std::shared_ptr<Pair> pair, Step step)
{
	benchmark::RegisterBenchmark((who + "/" + c.name).c_str(), [pair, step](benchmark::State& state) {
		int k = 0;
		for (auto _ : state)
			step(*pair, ++k);
		const Found f = pair->found();
		state.counters["points"] = f.points;
		state.counters["expected"] = pair->wanted.points;
		state.counters["normal_error"] = f.normalError;
		state.counters["depth_error"] = f.depthError;
		if constexpr (std::is_same_v<Pair, TimberPair>) state.counters["passes"] = pair->passesPerStep();
	});
}

} // namespace

int main(int argc, char** argv)
{
	dInitODE2(0);
	static const auto all = configurations();
	for (const Configuration& c : all) {
		add("timber", c, std::make_shared<TimberPair>(c), [](TimberPair& p, int k) { p.step(k); });
		add("timber points", c, std::make_shared<TimberPair>(c), [](TimberPair& p, int k) { p.geometry(k); });
		add("timber cold", c, std::make_shared<TimberPair>(c), [](TimberPair& p, int k) { p.forget(), p.geometry(k); });
		add("Bullet", c, std::make_shared<BulletPair>(c, false), [](BulletPair& p, int k) { p.step(k); });
		add("Bullet hulls", c, std::make_shared<BulletPair>(c, true), [](BulletPair& p, int k) { p.step(k); });
		add("Bullet cold", c, std::make_shared<BulletPair>(c, false), [](BulletPair& p, int k) { p.forget(), p.step(k); });
		add("ODE", c, std::make_shared<OdePair>(c), [](OdePair& p, int k) { p.step(k); });
	}
	benchmark::Initialize(&argc, argv);
	benchmark::RunSpecifiedBenchmarks();
}
