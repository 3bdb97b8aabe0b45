// SPDX-License-Identifier: GPL-2.0-or-later
/// Loops that threads share. What they compute does not depend on how many there are.
#pragma once
#if defined(_OPENMP)
#include <omp.h>
#endif

namespace timber {

/// Loops over no more bodies, pairs or joints than this run on one thread: waking another one would cost more. [-]
constexpr int smallLoop = 100;

/// How many threads share a loop.
inline int threadCount()
{
#if defined(_OPENMP)
	return omp_get_max_threads();
#else
	return 1;
#endif
}

/// Which of them this is.
inline int threadNumber()
{
#if defined(_OPENMP)
	return omp_get_thread_num();
#else
	return 0;
#endif
}

/// Whether a loop is shared: not within one that is. Even for one thread a parallel region costs as much as a contact.
inline bool hasThreads()
{
#if defined(_OPENMP)
	return threadCount() > 1 && !omp_in_parallel();
#else
	return false;
#endif
}

/// work(k) for all k < count, each over as many bodies, pairs or joints as `each` says. A thread has the same part in each step: what is
/// in its cache is its own.
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
