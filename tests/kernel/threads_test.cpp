// SPDX-License-Identifier: GPL-2.0-or-later
// Parallel loops.
#include <gtest/gtest.h>
#include <kernel/threads.hpp>
#include <atomic>
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
