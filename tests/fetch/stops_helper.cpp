// SPDX-License-Identifier: Apache-2.0
#include "tests/fetch/stops_helper.hpp"

namespace fastsplat::test {

Stops stop_and_begin_again(const FetchStream& stream, FetchRun run, std::uint64_t step) {
  Stops out;
  run.again = true;
  for (run.stop_at = 1;; run.stop_at += step) {
    const FetchResult seen = run_fetch(stream, run);
    out.finding = seen.finding;
    if (out.finding.empty() && seen.stopped && !seen.all_sent) out.finding = "the second frame is not whole";
    if (!out.finding.empty()) out.finding = "stop in cycle " + std::to_string(run.stop_at) + ": " + out.finding;
    if (!out.finding.empty() || !seen.stopped) return out;
    ++out.runs;
  }
}

}  // namespace fastsplat::test
