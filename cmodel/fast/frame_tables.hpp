// SPDX-License-Identifier: Apache-2.0
// A frame's tables, prepared for the fast unit once and shared by all tiles.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "cmodel/classify/density_stage.hpp"
#include "cmodel/composite/compositor.hpp"
#include "cmodel/cull/terminations.hpp"
#include "cmodel/fast/ellipse_kernel.hpp"
#include "cmodel/fast/fast_plan.hpp"
#include "cmodel/fast/sample_kernel.hpp"
#include "cmodel/fast/weight_memo.hpp"
#include "cmodel/numbers/config.hpp"
#include "cmodel/stream/beat.hpp"

namespace fastsplat::cmodel::fast {

/// Kinds of work of the fast unit besides circles in sheets.
struct FrameNeeds {
  bool ellipses = false, samples = false;
  bool tints = false;  ///< sheets of colours are tinted by a solid pattern
};

struct FrameTables {
  Config config;
  FastPlan plan;
  WeightMemo memo;
  SlabOpacity opacity;
  /// In mode Exponential no sum of tau gives an opacity above 1.0. Then a colour does not either, unless it exceeds tau
  /// by more than opacity_excess.
  bool opacity_holds = false;
  std::uint64_t opacity_excess = 0;
  std::optional<EllipseTable> ellipses;   ///< empty: tiles with ellipses are not sound()
  std::optional<SampleTables> samples;    ///< empty: tiles of modes 4 and 5 are not sound()
  std::optional<DensityStage> densities;  ///< empty: tiles of densities are not sound()
  /// Whether sheets of colours are tinted, which the picture's kernel cannot: their tiles are not sound().
  bool tints() const { return densities && densities->pattern().loaded(); }
  BeginFrame frame{};
  int reach = 0;  ///< largest footprint extent plus what vectors write beyond it, pixels
  Terminations* terminations = nullptr;  ///< filled in for sheets that are composited (modes 0 and 1), if not null
};

/// Made of the beats before the first tile: begin_frame and the tables. Empty if the frame needs the plain unit;
/// `why_not`, if given, is then set to the reason.
std::optional<FrameTables> frame_tables(const Config& config, std::span<const Beat> preamble,
                                        const FrameNeeds& needs = {}, const char** why_not = nullptr);

}  // namespace fastsplat::cmodel::fast
