// SPDX-License-Identifier: GPL-2.0-or-later
#include "threads.hpp"
#include <algorithm>
#include <cassert>
#include <tbb/info.h>
#include <tbb/task_scheduler_observer.h>
#if defined(_OPENMP)
#include <omp.h>
#endif

namespace timber {
namespace {
	thread_local bool isInLoop = false;

	int initialCount()
	{
#if defined(_OPENMP)
		return omp_get_max_threads();
#else
		return 1;
#endif
	}

	int count = initialCount();

	/// Threads of the arena: more than there are processors gain nothing, and oneTBB warns of them.
	int arenaSize() { return std::min(count, tbb::info::default_concurrency()); }

	/// YADE's own loops within an item run on one thread.
	class OneOpenMPThread : public tbb::task_scheduler_observer {
	public:
		explicit OneOpenMPThread(tbb::task_arena& arena)
		        : tbb::task_scheduler_observer(arena)
		{
			observe(true);
		}
		void on_scheduler_entry(bool isWorker) override
		{
#if defined(_OPENMP)
			if (isWorker) omp_set_num_threads(1);
#endif
		}
	};
}

int threadCount() { return count; }

void setThreadCount(int threads)
{
	assert(threads >= 1 && !isInLoop);
	count = threads;
	detail::arena().terminate();
	detail::arena().initialize(arenaSize());
}

int threadNumber() { return std::max(0, tbb::this_task_arena::current_thread_index()); }

bool hasThreads() { return count > 1 && !isInLoop; }

/// Never destroyed: the order in which a program's threads and libraries end is not ours.
tbb::task_arena& detail::arena()
{
	struct Team {
		tbb::task_arena arena { arenaSize() };
		OneOpenMPThread observer { arena };
	};
	static Team* const team = new Team;
	return team->arena;
}

detail::WithinLoop::WithinLoop()
        : before(isInLoop)
{
	isInLoop = true;
}

detail::WithinLoop::~WithinLoop() { isInLoop = before; }

} // namespace timber
