// SPDX-License-Identifier: GPL-2.0-or-later
/// Parallel loops with OpenMP. Results do not depend on the number of threads.
#pragma once
#if defined(_OPENMP)
#include <omp.h>
#endif

namespace timber {

/// Loops over at most this many bodies, pairs or joints are serial: starting other threads would cost more. [-]
constexpr int smallLoop = 100;

/// Threads of a parallel loop.
inline int threadCount()
{
#if defined(_OPENMP)
	return omp_get_max_threads();
#else
	return 1;
#endif
}

/// Index of this thread in a parallel loop.
inline int threadNumber()
{
#if defined(_OPENMP)
	return omp_get_thread_num();
#else
	return 0;
#endif
}

/// Whether a loop runs in parallel: not with one thread (a parallel region costs as much as a contact), and not within a parallel loop.
inline bool hasThreads()
{
#if defined(_OPENMP)
	return threadCount() > 1 && !omp_in_parallel();
#else
	return false;
#endif
}

/// work(k) for all k < count, each of which covers `each` bodies, pairs or joints. The schedule is static: a thread has the same items in
/// each step, and they stay in its cache.
template <class Work> void forAll(int count, Work work, int each = 1)
{
	if (count == 1 || count * each <= smallLoop || !hasThreads()) {
		for (int k = 0; k < count; ++k)
			work(k);
		return;
	}
#pragma omp parallel for schedule(static)
	for (int k = 0; k < count; ++k)
		work(k);
}

} // namespace timber
