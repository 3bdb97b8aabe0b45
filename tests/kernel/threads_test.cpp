// SPDX-License-Identifier: GPL-2.0-or-later
// Parallel loops, and the choice between one thread and all by measured time.
#include <gtest/gtest.h>
#include <kernel/thread_choice.hpp>
#include <kernel/threads.hpp>
#include <atomic>
#include <numeric>
#include <stdexcept>
#include <vector>

using namespace timber;

namespace {
/// A team of that size for one test.
struct TeamOf {
	const int before = threadCount();
	explicit TeamOf(int count) { setThreadCount(count); }
	~TeamOf() { setThreadCount(before); }
};

/// Share of the steps with all threads among `steps` steps, and the time of all steps over that with one thread. [-]
struct Outcome {
	double shareOfAll, time;
};
/// one, all: time of a step with one thread and with all [s]
Outcome choose(ThreadChoice& choice, int steps, double one, double all)
{
	int withAll = 0;
	double time = 0;
	for (int k = 0; k < steps; ++k) {
		const bool usesAll = choice.usesAll();
		withAll += usesAll;
		time += usesAll ? all : one;
		choice.add(usesAll ? all : one);
	}
	return { double(withAll) / steps, time / (steps * one) };
}
}

TEST(Threads, EachItemOnce)
{
	for (const int threads : { 1, 2, 5 }) {
		const TeamOf team(threads);
		for (const int count : { 0, 1, 2, 7, 1000 }) {
			std::vector<int> visits(count, 0), expected(count, 1);
			forAll(
			        count, [&](int k) { ++visits[k]; }, 200);
			forAllLong(count, [&](int k) { ++visits[k]; });
			for (int& one : expected)
				one = 2;
			EXPECT_EQ(visits, expected) << threads << " threads";
		}
	}
}

TEST(Threads, ManyShortLoopsWithNestedOnes)
{
	const TeamOf team(3);
	std::atomic<long> sum { 0 };
	for (int loop = 0; loop < 2000; ++loop)
		forAllLong(8, [&](int k) {
			EXPECT_FALSE(hasThreads());
			EXPECT_LT(threadNumber(), 3);
			forAllLong(3, [&](int l) { sum += k * l; });
		});
	EXPECT_EQ(sum, 2000L * 28 * 3);
}

TEST(Threads, ExceptionIsThrownAgain)
{
	const TeamOf team(2);
	for (int loop = 0; loop < 100; ++loop)
		EXPECT_THROW(forAllLong(10,
		                     [](int k) {
			                     if (k == 7) throw std::runtime_error("item 7");
		                     }),
		        std::runtime_error);
	EXPECT_TRUE(hasThreads());
}

/// Trials take 2 % of the time (thread_choice.cpp: trialShare), here 20 times as long a step, and the first one 10 ms.
TEST(ThreadChoice, LossIsBoundedWhenThreadsHurt)
{
	ThreadChoice choice;
	const Outcome outcome = choose(choice, 100000, 3e-4, 6e-3);
	EXPECT_LT(outcome.time, 1.03);
	EXPECT_GT(outcome.shareOfAll, 0);
}

/// Trials with one thread take 2 % of the time, and the choice needs one trial; a step takes half as long with two
/// threads.
TEST(ThreadChoice, AllThreadsWhenTheyPay)
{
	ThreadChoice choice;
	EXPECT_LT(choose(choice, 100000, 3e-4, 1.5e-4).time, 0.52);
}

/// Less than 5 % faster is not worth a thread.
TEST(ThreadChoice, OneThreadWhenAllGainLittle)
{
	ThreadChoice choice;
	EXPECT_LT(choose(choice, 100000, 3e-4, 2.94e-4).shareOfAll, 0.05);
}

/// Other programs begin and end: the choice changes within ten trials, each after 50 times its own length.
TEST(ThreadChoice, FollowsTheMachine)
{
	ThreadChoice choice;
	choose(choice, 20000, 3e-4, 1.5e-4);
	EXPECT_TRUE(choice.usesAll());
	choose(choice, 20000, 3e-4, 6e-3);
	EXPECT_LT(choose(choice, 20000, 3e-4, 6e-3).time, 1.03);
	choose(choice, 100000, 3e-4, 1.5e-4);
	EXPECT_LT(choose(choice, 20000, 3e-4, 1.5e-4).time, 0.53);
}
