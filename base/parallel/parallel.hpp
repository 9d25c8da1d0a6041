// Independent jobs on several threads (oneTBB). Results must not depend on who runs what: jobs write to disjoint
// places.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

namespace fastsplat {

/// What `threads` means: itself, or all cores if it is 0.
std::size_t thread_count(int threads);

/// job(i) for every i in [0, count), each exactly once, on at most `threads` threads (0: all cores).
/// An exception of a job reaches the caller; jobs that have not begun then never do.
void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& job);

/// The same for every i in [0, work.size()), those with the most work first: so that nobody ends with a long one alone.
void parallel_for(std::span<const std::uint64_t> work, int threads, const std::function<void(std::size_t)>& job);

}  // namespace fastsplat
