// SPDX-License-Identifier: GPL-2.0-or-later
/// Loops that threads share. What they compute does not depend on how many there are.
#pragma once
#if defined(_OPENMP)
#include <omp.h>
#endif

namespace timber {

/// Loops over no more bodies, pairs or joints than this run on one thread: waking another one would cost more. [-]
constexpr int smallLoop = 100;

inline bool hasThreads()
{
#if defined(_OPENMP)
	return omp_get_max_threads() > 1; // even for one thread a parallel region costs as much as a contact
#else
	return false;
#endif
}

/// work(k) for all k < count, each over as many bodies, pairs or joints as `each` says.
template <class Work> void forAll(int count, Work work, int each = 1)
{
	if (count * each <= smallLoop || !hasThreads()) {
		for (int k = 0; k < count; ++k)
			work(k);
		return;
	}
#pragma omp parallel for schedule(static)
	for (int k = 0; k < count; ++k)
		work(k);
}

/// The same where the cost of work(k) differs a lot: the next `share` of them go to whatever thread is free.
template <class Work> void forAllUnlike(int count, int share, Work work)
{
	if (count <= share || !hasThreads()) {
		for (int k = 0; k < count; ++k)
			work(k);
		return;
	}
#pragma omp parallel for schedule(dynamic, share)
	for (int k = 0; k < count; ++k)
		work(k);
}

} // namespace timber
