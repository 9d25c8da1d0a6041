// SPDX-License-Identifier: Apache-2.0
// Loops and a sort over threads: each job once, the most work first, and an exception that ends it soon.
#include "base/parallel/parallel.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <vector>

namespace fastsplat {
namespace {

TEST(Parallel, EveryJobOnceOnAnyNumberOfThreads) {
  std::size_t jobs = 0;
  for (const std::size_t count : {0u, 1u, 7u, 1000u}) {
    for (const int threads : {0, 1, 2, 8}) {
      std::vector<std::atomic<int>> runs(count);
      parallel_for(count, threads, [&](std::size_t i) { ++runs[i]; });
      for (const auto& run : runs) EXPECT_EQ(run, 1) << count << " jobs, " << threads << " threads";
      jobs += count;
    }
  }
  std::printf("[figure] jobs run once each = %zu\n", jobs);
}

TEST(Parallel, TheMostWorkFirstAndEqualOnesInOrder) {
  const std::vector<std::uint64_t> work{3, 9, 0, 9, 4};
  std::vector<std::size_t> order;
  parallel_for(work, 1, [&](std::size_t i) { order.push_back(i); });
  EXPECT_EQ(order, (std::vector<std::size_t>{1, 3, 4, 0, 2}));
}

TEST(Parallel, StableOrderOnAnyNumberOfThreadsAndWithoutAWord) {
  std::vector<double> keys;
  for (std::uint32_t i = 0; i < 50000; ++i) keys.push_back((i * 2654435761U >> 24) - 100.0);  // 256 values
  keys.push_back(-0.0);  // equal to the other zeros
  std::vector<std::uint32_t> expected(keys.size());
  std::iota(expected.begin(), expected.end(), 0U);
  std::ranges::stable_sort(expected, {}, [&](std::uint32_t i) { return keys[i]; });
  testing::internal::CaptureStderr();
  for (const int threads : {0, 1, 2, 64}) EXPECT_EQ(stable_order(keys, threads), expected) << threads << " threads";
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_TRUE(stable_order({}, 0).empty());
  std::printf("[figure] keys of 256 values in order = %zu\n", expected.size());
}

TEST(Parallel, AnExceptionReachesTheCallerAndNoFurtherJobBegins) {
  std::atomic<int> begun{0};
  std::atomic<bool> thrown{false};
  // The first job lasts until the eleventh, in another thread, has thrown and was caught. What does its thread do next?
  const auto job = [&](std::size_t i) {
    ++begun;
    if (i == 0) {
      for (int ms = 0; ms < 5000 && !thrown; ++ms) std::this_thread::sleep_for(std::chrono::milliseconds(1));
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    if (i == 10) {
      thrown = true;
      throw std::runtime_error("job 10");
    }
  };
  EXPECT_THROW(parallel_for(100000, 2, job), std::runtime_error);
  std::printf("[figure] jobs begun of 100000, the eleventh of which throws = %d\n", begun.load());
  EXPECT_EQ(begun, 11);
}

}  // namespace
}  // namespace fastsplat
