// SPDX-License-Identifier: GPL-2.0-or-later
/// Parallel loops by oneTBB. Results do not depend on the number of threads, nor on their use.
#pragma once
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace timber {

/// Loops over at most this many bodies, pairs or joints are serial. In the loops of one house, some 600 pairs, a second
/// thread costs more than it gains: a run takes 1.2 times as long. [-]
constexpr int smallLoop = 1000;
/// Bodies, pairs or joints that a thread takes at a time. [-]
constexpr int itemsAtOnce = 24;

/// Threads of a parallel loop, the calling one included: by default OpenMP's number when the program is loaded.
int threadCount();
/// count >= 1. Not within a parallel loop.
void setThreadCount(int count);
/// Index of this thread in a parallel loop.
int threadNumber();
/// Whether this thread may start a parallel loop: there are others, and it is not within a parallel loop. A thread that
/// waits for a loop within an item could otherwise begin another item in the middle of the first.
bool hasThreads();

namespace detail {
	tbb::task_arena& arena();

	/// This thread is within a parallel loop.
	struct WithinLoop {
		WithinLoop();
		~WithinLoop();
		const bool before;
	};

	template <class Work> void onThreads(int count, int chunk, Work& work)
	{
		const auto visit = [&work](const tbb::blocked_range<int>& items) {
			const WithinLoop mark;
			for (int k = items.begin(); k < items.end(); ++k)
				work(k);
		};
		arena().execute([&] { tbb::parallel_for(tbb::blocked_range<int>(0, count, chunk), visit); });
	}
}

/// work(k) for all k < count, each of which is long: on all threads. The first exception is thrown again.
template <class Work> void forAllLong(int count, Work work)
{
	if (count > 1 && hasThreads()) return detail::onThreads(count, 1, work);
	for (int k = 0; k < count; ++k)
		work(k);
}

/// work(k) for all k < count, each of which covers `each` bodies, pairs or joints.
template <class Work> void forAll(int count, Work work, int each = 1)
{
	if (count > 1 && count * each > smallLoop && hasThreads())
		return detail::onThreads(count, each < itemsAtOnce ? itemsAtOnce / each : 1, work);
	for (int k = 0; k < count; ++k)
		work(k);
}

} // namespace timber
