// SPDX-License-Identifier: Apache-2.0
// Runs independent jobs on several threads (oneTBB). Jobs must write to disjoint places, so that results do not depend
// on the schedule.
#pragma once

#include <algorithm>
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

/// The numbers of the jobs, most work first, so that no long job runs last and alone.
std::vector<std::size_t> longest_first(std::span<const std::uint64_t> work);
/// parallel_for() for every i in [0, work.size()), in that order.
void parallel_for(std::span<const std::uint64_t> work, int threads, const std::function<void(std::size_t)>& job);

/// The numbers of the keys, least key first; equal ones keep their order. No key is NaN.
std::vector<std::uint32_t> stable_order(std::span<const double> keys, int threads);

/// Elements of a part: enough to outweigh a call.
inline constexpr std::size_t kPart = 4096;
inline constexpr std::size_t part_count(std::size_t elements) { return (elements + kPart - 1) / kPart; }

/// Calls job(part, first, end) for the elements cut into parts; the last may be shorter.
template <class Job>
void parallel_parts(std::size_t elements, int threads, const Job& job) {
  parallel_for(part_count(elements), threads,
               [&](std::size_t part) { job(part, part * kPart, std::min(part * kPart + kPart, elements)); });
}

}  // namespace fastsplat
