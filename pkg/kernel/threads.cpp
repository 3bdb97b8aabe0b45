// SPDX-License-Identifier: GPL-2.0-or-later
#include "threads.hpp"
#include "thread_choice.hpp"
#include <algorithm>
#include <atomic>
#include <cassert>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>
#if defined(_OPENMP)
#include <omp.h>
#endif

namespace timber {
namespace {
	using Clock = std::chrono::steady_clock;

	/// Time for which a thread spins before it sleeps: as long as the serial parts of a step, and the time to wake
	/// a thread.
	constexpr auto spinTime = std::chrono::microseconds(50);

	thread_local int number = 0;
	thread_local bool isInLoop = false;

	void pause()
	{
#if defined(__x86_64__) || defined(__i386__)
		__builtin_ia32_pause();
#endif
	}

	/// Lets threads wait until a condition on atomic numbers holds.
	class Gate {
		std::mutex mutex;
		std::condition_variable condition;
		std::atomic<int> sleepers { 0 };

	public:
		template <class Condition> void wait(Condition holds)
		{
			const auto end = Clock::now() + spinTime;
			do
				for (int k = 0; k < 16; ++k) {
					if (holds()) return;
					pause();
				}
			while (Clock::now() < end);
			std::unique_lock lock(mutex);
			++sleepers;
			condition.wait(lock, holds);
			--sleepers;
		}
		/// To be called after the numbers have changed.
		void notify()
		{
			if (sleepers == 0) return;
			std::unique_lock(mutex).unlock();
			condition.notify_all();
		}
	};

	/// Items of which one thread takes the first; the others help when they have none left.
	struct alignas(64) Share {
		std::atomic<int> next { 0 };
		int end = 0;
	};

	class Team {
		/// Low bit: the loop may be entered; the rest: twice the number of other threads in it.
		std::atomic<unsigned> state { 0 };
		std::atomic<unsigned> loops { 0 }; ///< started so far
		Gate started, left;
		int chunk = 1;
		void (*body)(void*, int) = nullptr;
		void* context = nullptr;
		std::vector<std::unique_ptr<Share>> shares; ///< one a thread
		std::mutex errorMutex;
		std::exception_ptr error;
		int running = 1; ///< threads, the calling one included

		void setUp(int count, int threads);
		bool enter();
		void leave();
		void take(Share&);
		void work();
		void serve(int thread);
		void startThreads(int threads);

	public:
		void run(int count, int perTurn, void (*body)(void*, int), void* context);
	};

	void Team::setUp(int count, int threads)
	{
		while (int(shares.size()) < threads)
			shares.push_back(std::make_unique<Share>());
		for (int k = 0; k < int(shares.size()); ++k) {
			shares[k]->next = k < threads ? int(long(count) * k / threads) : count;
			shares[k]->end = k < threads ? int(long(count) * (k + 1) / threads) : count;
		}
	}

	bool Team::enter()
	{
		unsigned seen = state;
		while (seen & 1)
			if (state.compare_exchange_weak(seen, seen + 2)) return true;
		return false;
	}

	void Team::leave()
	{
		if (state.fetch_sub(2) == 2) left.notify();
	}

	void Team::take(Share& share)
	{
		for (int first = share.next.fetch_add(chunk); first < share.end; first = share.next.fetch_add(chunk))
			for (int k = first; k < std::min(first + chunk, share.end); ++k)
				body(context, k);
	}

	/// The thread's own share first: the same items in each step, which stay in its cache.
	void Team::work()
	{
		isInLoop = true;
		try {
			for (size_t k = 0; k < shares.size(); ++k)
				take(*shares[(number + k) % shares.size()]);
		} catch (...) {
			const std::lock_guard lock(errorMutex);
			if (!error) error = std::current_exception();
		}
		isInLoop = false;
	}

	void Team::serve(int thread)
	{
		number = thread;
#if defined(_OPENMP)
		omp_set_num_threads(1); // YADE's loops within an item
#endif
		for (unsigned seen = 0;;) {
			started.wait([&] { return loops != seen; });
			seen = loops;
			if (thread >= threadCount() || !enter()) continue;
			work();
			leave();
		}
	}

	void Team::startThreads(int threads)
	{
		for (; running < threads; ++running)
			std::thread(&Team::serve, this, running).detach();
	}

	void Team::run(int count, int perTurn, void (*given)(void*, int), void* data)
	{
		assert(state == 0 && count > 0 && perTurn > 0);
		body = given;
		context = data;
		chunk = perTurn;
		setUp(count, threadCount());
		startThreads(threadCount());
		state = 1;
		++loops;
		started.notify();
		work();
		state &= ~1u;
		left.wait([this] { return state == 0; });
		if (error) std::rethrow_exception(std::exchange(error, nullptr));
	}

	/// Never destroyed: its threads wait until the process ends.
	Team& team()
	{
		static Team* const only = new Team;
		return *only;
	}

	int initialCount()
	{
#if defined(_OPENMP)
		return omp_get_max_threads();
#else
		return 1;
#endif
	}

	std::atomic<int> teamSize { initialCount() };
	ThreadChoice choice;
	double stepTime = 0; ///< of the loops of the present step [s]
	Clock::time_point loopStart;
}

int threadCount() { return teamSize; }

void setThreadCount(int count)
{
	assert(count >= 1 && !isInLoop);
	teamSize = count;
	choice = {};
}

int threadNumber() { return number; }

bool hasThreads() { return teamSize > 1 && !isInLoop; }

void endStep()
{
	if (!hasThreads() || stepTime == 0) return;
	choice.add(stepTime);
	stepTime = 0;
}

bool detail::beginLoop()
{
	loopStart = Clock::now();
	return choice.usesAll();
}

void detail::endLoop() { stepTime += std::chrono::duration<double>(Clock::now() - loopStart).count(); }

void detail::runOnThreads(int count, int chunk, void (*body)(void*, int), void* context)
{
	team().run(count, chunk, body, context);
}

} // namespace timber
