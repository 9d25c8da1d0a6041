// SPDX-License-Identifier: Apache-2.0
// fastsplat_top of `tiny` between a source and a sink that keep AXI4-Stream's rules: what is offered stays.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cmodel/stream/beat.hpp"
#include "testbench/device/pattern.hpp"

namespace fastsplat::test {

/// A frame is sent; in a cycle of it the host gives it up, as docs/integration.md says, and sends the next one. Or
/// aresetn is low for a cycle, and the source, which is not reset, offers some beats more before it sends the next
/// frame.
struct TopRun {
  std::uint64_t reset_at = 0;  ///< cycle
  bool hard = false;
  bool drops = true;     ///< the host writes DROP with RESET
  unsigned strobe = 15;  ///< of that write; any other is refused, and nothing may happen
  std::size_t more = 0;  ///< beats of the first frame after a hard reset; their w0 is made to look like a begin_frame
  testbench::Pattern source = {}, sink = {};
};

struct TopResult {
  std::string finding;                            ///< the first thing that was wrong; empty: none
  bool reset = false;                             ///< before all of the first frame had come out
  std::vector<std::vector<std::uint32_t>> tiles;  ///< that came out behind the reset and were not cut short
  std::uint32_t error = 0;                        ///< the register, at the end
};

TopResult run_top(const std::vector<cmodel::Beat>& first, const std::vector<cmodel::Beat>& next, const TopRun& run);

}  // namespace fastsplat::test
