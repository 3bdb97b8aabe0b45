// SPDX-License-Identifier: GPL-2.0-or-later
/// Parallel loops. Results do not depend on the number of threads, nor on their use.
///
/// * The calling thread takes items until none is left, and then waits only for items that another thread has begun: a
///   thread that the system does not run at the moment delays nothing.
/// * Idle threads spin for some microseconds, then sleep. Those of OpenMP spin for milliseconds and take the processor
///   from other work.
/// * thread_choice.hpp decides by measured time whether the loops of a step use more than one thread.
#pragma once

namespace timber {

/// Loops over at most this many bodies, pairs or joints are serial: starting other threads would cost more. [-]
constexpr int smallLoop = 100;
/// Bodies, pairs or joints that a thread takes at a time. [-]
constexpr int itemsAtOnce = 24;

/// Threads of a parallel loop, the calling one included: by default OpenMP's number when the program is loaded.
int threadCount();
/// count >= 1. Not within a parallel loop.
void setThreadCount(int count);
/// Index of this thread in a parallel loop.
int threadNumber();
/// Whether this thread may start a parallel loop: there are others, and it is not within a parallel loop.
bool hasThreads();
/// Ends a step of the simulation: its loops have been timed together.
void endStep();

namespace detail {
	/// Begins a timed loop; returns whether it is to run on several threads.
	bool beginLoop();
	void endLoop();
	/// body(context, k) for all k < count on several threads; a thread takes `chunk` at a time. The first exception
	/// is thrown again.
	void runOnThreads(int count, int chunk, void (*body)(void*, int), void* context);

	template <class Work> void onThreads(int count, int chunk, Work& work)
	{
		runOnThreads(
		        count, chunk, [](void* context, int k) { (*static_cast<Work*>(context))(k); }, &work);
	}
}

/// work(k) for all k < count, each of which is long: on all threads.
template <class Work> void forAllLong(int count, Work work)
{
	if (count > 1 && hasThreads()) return detail::onThreads(count, 1, work);
	for (int k = 0; k < count; ++k)
		work(k);
}

/// work(k) for all k < count, each of which covers `each` bodies, pairs or joints.
template <class Work> void forAll(int count, Work work, int each = 1)
{
	const bool isTimed = count > 1 && count * each > smallLoop && hasThreads();
	if (isTimed && detail::beginLoop()) detail::onThreads(count, each < itemsAtOnce ? itemsAtOnce / each : 1, work);
	else
		for (int k = 0; k < count; ++k)
			work(k);
	if (isTimed) detail::endLoop();
}

} // namespace timber
