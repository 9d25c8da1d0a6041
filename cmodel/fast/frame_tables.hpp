// What a frame's tables say, made ready for the fast unit once and shared by all tiles.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "cmodel/beat.hpp"
#include "cmodel/compositor.hpp"
#include "cmodel/config.hpp"
#include "cmodel/fast/fast_plan.hpp"
#include "cmodel/fast/row_kernel.hpp"
#include "cmodel/fast/weight_memo.hpp"

namespace fastsplat::cmodel::fast {

struct FrameTables {
  Config config;
  JobFrame jobs;
  WeightMemo memo;
  SlabOpacity opacity;
  /// No sum of tau makes an opacity above 1.0 in mode Exponential, so no colour that is not above tau does, nor one
  /// that is above by no more than opacity_excess.
  bool opacity_holds = false;
  std::uint64_t opacity_excess = 0;
  int reach = 0;  ///< largest extent of a footprint with what vectors write beyond it, pixels
};

/// From the beats before the first tile: begin_frame and the tables. Empty where only the plain unit will do;
/// `why_not`, where given, is then set to words that say why.
std::optional<FrameTables> frame_tables(const Config& config, std::span<const Beat> preamble,
                                        const char** why_not = nullptr);

}  // namespace fastsplat::cmodel::fast
