// SPDX-License-Identifier: GPL-2.0-or-later
/// Decides by measured time whether the loops of a step use one thread or all.
#pragma once

namespace timber {

/// The way that has been faster is the usual one. The other one is tried again and again, for a small share of the
/// time: what other programs do on the machine changes.
class ThreadChoice {
public:
	/// Whether the next step's loops are to use all threads.
	bool usesAll() const { return usualIsAll != isTrial; }
	/// Wall time of the loops of a step, made as usesAll() said. [s]
	void add(double seconds);

private:
	struct Mean {
		double total = 0; ///< [s]
		int steps = 0;
		double value() const { return total / steps; }
	};
	bool usualIsAll = false, isTrial = false;
	bool skipsNext = true; ///< the first step in another way wakes threads, or moves data between caches
	double usualTime = 0; ///< of the steps since the last trial [s]
	double trialTime = 0; ///< of the steps of the present or the last trial [s]
	double recent = 0; ///< moving mean of the usual steps [s]
	Mean trial;
	double logRatio = 0; ///< of the time with all threads to that with one, moving mean of the trials

	void addUsual(double seconds);
	void addTrial(double seconds);
};

} // namespace timber
