// What a frame's tables say, made ready for the fast unit once and shared by all tiles.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "cmodel/classify/density_stage.hpp"
#include "cmodel/composite/compositor.hpp"
#include "cmodel/fast/ellipse_kernel.hpp"
#include "cmodel/fast/fast_plan.hpp"
#include "cmodel/fast/sample_kernel.hpp"
#include "cmodel/fast/weight_memo.hpp"
#include "cmodel/numbers/config.hpp"
#include "cmodel/stream/beat.hpp"

namespace fastsplat::cmodel::fast {

/// What a frame has besides circles in sheets.
struct FrameNeeds {
  bool ellipses = false, samples = false;
  bool tints = false;  ///< sheets of colours are tinted by a solid pattern
};

struct FrameTables {
  Config config;
  FastPlan plan;
  WeightMemo memo;
  SlabOpacity opacity;
  /// No sum of tau makes an opacity above 1.0 in mode Exponential, so no colour that is not above tau does, nor one
  /// that is above by no more than opacity_excess.
  bool opacity_holds = false;
  std::uint64_t opacity_excess = 0;
  std::optional<EllipseTable> ellipses;   ///< none: tiles with ellipses are given up
  std::optional<SampleTables> samples;    ///< none: tiles whose samples are composited one by one are given up
  std::optional<DensityStage> densities;  ///< none: tiles of densities are given up
  /// Tiles of colours are given up: the picture's kernel knows no tint.
  bool tints() const { return densities && densities->pattern().loaded(); }
  BeginFrame frame{};
  int reach = 0;  ///< largest extent of a footprint with what vectors write beyond it, pixels
};

/// From the beats before the first tile: begin_frame and the tables. Empty where only the plain unit will do;
/// `why_not`, where given, is then set to words that say why.
std::optional<FrameTables> frame_tables(const Config& config, std::span<const Beat> preamble,
                                        const FrameNeeds& needs = {}, const char** why_not = nullptr);

}  // namespace fastsplat::cmodel::fast
