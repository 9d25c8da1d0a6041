// SPDX-License-Identifier: Apache-2.0
// fastsplat_top of `tiny` between a source and a sink that keep AXI4-Stream's rules: what is offered stays.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cmodel/stream/beat.hpp"
#include "testbench/device/pattern.hpp"

namespace fastsplat::test {

/// A frame is sent; in a cycle of it the host gives it up, as docs/integration.md says, and sends the next one. Or
/// aresetn is low for a cycle, and the source, which is not reset, offers some beats more before it sends the next
/// frame.
struct TopRun {
  std::uint64_t reset_at = 0;  ///< cycle; 0: never
  bool hard = false;
  bool drops = true;  ///< the host writes DROP with RESET
  /// Then it writes this to CONTROL instead, and nothing may happen: with some bytes alone, or the address offered
  /// before the word, while the bus still shows another one.
  std::optional<std::uint32_t> harmless = {};
  unsigned strobe = 15;
  bool address_first = false;
  std::size_t more = 0;  ///< beats of the first frame after a hard reset, each made nearly a begin_frame
  testbench::Pattern source = {}, sink = {};
  std::uint64_t status_at = ~std::uint64_t{0};  ///< cycle in which the address of STATUS is offered, too
  std::uint32_t mask = 0;                       ///< IRQ_MASK; the host clears these bits of IRQ when they interrupt
};

struct TopResult {
  std::string finding;                            ///< the first thing that was wrong; empty: none
  bool reset = false;                             ///< before all of the first frame had come out
  std::vector<std::vector<std::uint32_t>> tiles;  ///< that came out behind the reset and were not cut short
  std::uint32_t error = 0;                        ///< the register, at the end
  /// Cycles behind the reset: the sink takes a tile's last beat; `irq` is high and was low before.
  std::vector<std::uint64_t> lasts, interrupts;
  std::uint64_t first_taken = 0;  ///< cycle in which the slice took the first beat of all
  bool busy = false;              ///< STATUS, as read by `status_at`
};

TopResult run_top(const std::vector<cmodel::Beat>& first, const std::vector<cmodel::Beat>& next, const TopRun& run);

}  // namespace fastsplat::test
