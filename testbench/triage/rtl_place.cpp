// SPDX-License-Identifier: Apache-2.0
#include "testbench/triage/rtl_place.hpp"

#include <fmt/format.h>

namespace fastsplat::testbench {
namespace {

constexpr std::size_t kWords = 4;  ///< of a pixel

/// The bank of the divergence's word: that of its pixel in the window or block.
struct Bank {
  int row, column;
};
Bank bank_of(const cmodel::Config& config, const TapCopy& at, std::size_t lane, int halo) {
  const int lanes = config.lanes, number = static_cast<int>(lane), mask = lanes - 1;
  return {.row = (at.y + halo + number / lanes) & mask, .column = (at.x + halo + number % lanes) & mask};
}

}  // namespace

RtlPlace rtl_place(const cmodel::Config& config, const Divergence& divergence, int halo) {
  const TapCopy& at = divergence.model ? *divergence.model : *divergence.rtl;
  const bool of_a_word = divergence.model && divergence.rtl && !divergence.header;
  const auto below = [](const char* module, const std::string& instance) {
    return RtlPlace{module, "u_top.u_core." + instance};
  };
  const auto in_bank = [&](std::size_t lane, const char* unit) {
    const Bank bank = bank_of(config, at, lane, halo);
    return fmt::format("u_splat.gen_row[{}].gen_bank[{}].{}", bank.row, bank.column, unit);
  };
  switch (at.tap) {
    case cmodel::Tap::Snap:
      if (!of_a_word || config.has_ellipses()) break;
      return below("fastsplat_snap", divergence.word % 2 == 0 ? "u_splat.u_snap_x" : "u_splat.u_snap_y");
    case cmodel::Tap::Footprint:
      if (!of_a_word) break;
      return below("fastsplat_lane", in_bank(divergence.word, "u_lane"));
    case cmodel::Tap::Sheet:
      if (!of_a_word) break;
      return below("fastsplat_sheet_bank", in_bank(divergence.word / kWords, "u_bank"));
    case cmodel::Tap::Composite: {
      if (!of_a_word) return below("fastsplat_compositor", "u_compositor");
      const Bank bank = bank_of(config, at, divergence.word / kWords, halo);
      const int lane = (bank.row * config.lanes + bank.column) % config.composited_at_once();
      return below("fastsplat_composite_lane", fmt::format("u_compositor.gen_lane[{}].u_composite", lane));
    }
    case cmodel::Tap::Pixel:
      return below("fastsplat_pixel_out", "u_pixel_out");
  }
  return below("fastsplat_splat_array", "u_splat");
}

}  // namespace fastsplat::testbench
