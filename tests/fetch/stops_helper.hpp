// SPDX-License-Identifier: Apache-2.0
// A fetch master that is stopped, in one cycle after another, and begins again.
#pragma once

#include <cstdint>

#include "tests/fetch/fetch_bench_helper.hpp"

namespace fastsplat::test {

struct Stops {
  std::uint64_t runs = 0;
  std::string finding;  ///< the first thing that was wrong; empty: none
};

/// Runs of the same frame with `run`'s timings, each stopped `step` cycles later than the one before, until one ends
/// before its stop. After each the frame is sent again, whole and without an error.
Stops stop_and_begin_again(const FetchStream& stream, FetchRun run, std::uint64_t step);

}  // namespace fastsplat::test
