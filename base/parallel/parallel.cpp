// SPDX-License-Identifier: Apache-2.0
#include "base/parallel/parallel.hpp"

#ifndef __EMSCRIPTEN__
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>
#include <tbb/task_arena.h>
#endif

#include <algorithm>
#include <atomic>
#include <numeric>
#include <optional>
#include <vector>

namespace fastsplat {

#ifdef __EMSCRIPTEN__
// One thread: a page from disk gets no more (shared memory needs a server's headers).
std::size_t thread_count(int /*threads*/) { return 1; }

void parallel_for(std::size_t count, int /*threads*/, const std::function<void(std::size_t)>& job) {
  for (std::size_t i = 0; i < count; ++i) job(i);
}
#else
std::size_t thread_count(int threads) {
  return static_cast<std::size_t>(threads > 0 ? threads : tbb::info::default_concurrency());
}

namespace {

template <class Work>
void with_threads(int threads, const Work& work) {
  // oneTBB warns on stderr when asked for more workers than cores unless this allows them.
  std::optional<tbb::global_control> allow;
  if (threads > tbb::info::default_concurrency())
    allow.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  tbb::task_arena arena(static_cast<int>(std::max<std::size_t>(thread_count(threads), 1)));
  arena.execute(work);
}

}  // namespace

void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& job) {
  const std::size_t workers = std::min(thread_count(threads), count);
  // Each worker takes the next job. By default oneTBB splits the range in advance, whatever the jobs' cost: one of two
  // threads then had 59 to 72 % of a frame.
  std::atomic<std::size_t> next{0};
  with_threads(threads, [&] {
    tbb::parallel_for(
        std::size_t{0}, workers,
        [&](std::size_t) {
          try {
            for (std::size_t i = next++; i < count; i = next++) job(i);
          } catch (...) {
            next = count;  // the other workers finish their current jobs
            throw;
          }
        },
        tbb::simple_partitioner());
  });
}
#endif

std::vector<std::uint32_t> stable_order(std::span<const double> keys, [[maybe_unused]] int threads) {
  struct Key {
    double value;
    std::uint32_t number;
    bool operator<(const Key& other) const {
      return value < other.value || (value == other.value && number < other.number);
    }
  };
  std::vector<Key> sorted(keys.size());
  for (std::uint32_t i = 0; i < keys.size(); ++i) sorted[i] = {keys[i], i};
#ifdef __EMSCRIPTEN__
  std::sort(sorted.begin(), sorted.end());
#else
  with_threads(threads, [&] { tbb::parallel_sort(sorted.begin(), sorted.end()); });
#endif
  std::vector<std::uint32_t> out(keys.size());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = sorted[i].number;
  return out;
}

std::vector<std::size_t> longest_first(std::span<const std::uint64_t> work) {
  std::vector<std::size_t> order(work.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return work[a] > work[b]; });
  return order;
}

void parallel_for(std::span<const std::uint64_t> work, int threads, const std::function<void(std::size_t)>& job) {
  const std::vector<std::size_t> order = longest_first(work);
  parallel_for(order.size(), threads, [&](std::size_t i) { job(order[i]); });
}

}  // namespace fastsplat
