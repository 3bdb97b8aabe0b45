// SPDX-License-Identifier: GPL-2.0-or-later
#include "thread_choice.hpp"
#include <algorithm>
#include <cassert>
#include <cmath>

namespace timber {
namespace {
	/// Share of the time for trials: bounds the loss when all threads are far slower than one. [-]
	constexpr double trialShare = 0.02;
	/// Shortest trial: some time slices of the system [s], some steps [-].
	constexpr double trialLength = 0.02;
	constexpr int trialSteps = 4;
	/// Weights of the last step and of the last trial in the moving means: on a busy machine single trials differ
	/// by a factor of two. [-]
	constexpr double stepWeight = 1. / 256, ratioWeight = 1. / 8;
	/// Bound of the logarithm that one trial counts. [-]
	constexpr double largestLog = 1.4;
	/// Time with all threads over time with one below which all are used: other programs can use a thread that
	/// gains less. [-]
	constexpr double worthwhile = 0.95;
}

void ThreadChoice::add(double seconds)
{
	assert(seconds >= 0);
	if (isTrial) addTrial(seconds);
	else addUsual(seconds);
}

void ThreadChoice::addUsual(double seconds)
{
	usualTime += seconds;
	if (skipsNext) {
		skipsNext = false;
		return;
	}
	recent = recent > 0 ? recent + stepWeight * (seconds - recent) : seconds;
	if (recent == 0 || usualTime < trialLength || usualTime * trialShare < trialTime) return;
	isTrial = skipsNext = true;
	trialTime = 0;
	trial = {};
}

void ThreadChoice::addTrial(double seconds)
{
	trialTime += seconds;
	if (skipsNext) {
		skipsNext = false;
		return;
	}
	trial.total += seconds;
	++trial.steps;
	if (trial.steps < trialSteps || trial.total < trialLength) return;
	const double ratio = std::log(usualIsAll ? recent / trial.value() : trial.value() / recent);
	logRatio += ratioWeight * (std::clamp(ratio, -largestLog, largestLog) - logRatio);
	isTrial = false;
	skipsNext = true;
	usualTime = 0;
	const bool allIsBetter = logRatio < std::log(worthwhile);
	if (allIsBetter != usualIsAll) recent = trial.value();
	usualIsAll = allIsBetter;
}

} // namespace timber
