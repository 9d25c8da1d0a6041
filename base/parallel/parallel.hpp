// SPDX-License-Identifier: Apache-2.0
// Runs independent jobs on several threads (oneTBB). Jobs must write to disjoint places, so that results do not depend
// on the schedule.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace fastsplat {

/// The number of threads: `threads`, or all cores if it is 0.
std::size_t thread_count(int threads);

/// Calls job(i) once for every i in [0, count), on at most `threads` threads (0: all cores).
/// An exception of a job reaches the caller; jobs not yet begun are then skipped.
void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& job);

/// The same for every i in [0, work.size()), in order of decreasing work[i], so that no long job runs last and alone.
void parallel_for(std::span<const std::uint64_t> work, int threads, const std::function<void(std::size_t)>& job);

/// The numbers of the keys, least key first; equal ones keep their order. No key is NaN.
std::vector<std::uint32_t> stable_order(std::span<const double> keys, int threads);

/// Jobs on consecutive elements are worth a call from about this many on.
inline constexpr std::size_t kPart = 4096;

/// Calls job(part, first, end) for [0, count) cut into parts of kPart elements; the last may be shorter.
template <class Job>
void parallel_parts(std::size_t count, int threads, const Job& job) {
  parallel_for((count + kPart - 1) / kPart, threads, [&](std::size_t part) {
    job(part, part * kPart, part * kPart + kPart < count ? part * kPart + kPart : count);
  });
}

}  // namespace fastsplat
