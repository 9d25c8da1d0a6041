// SPDX-License-Identifier: Apache-2.0
// Front-to-back sweep of sheets over the whole frame, for techniques that read beyond one pixel of one sheet. It does
// sheet by sheet what sweep_sheets does band by band. Stages can therefore read a sheet's neighbours in y and in depth,
// filter across it, and read the picture in front of it. Without stages the picture equals that of composite_sheets,
// bit for bit. With stages it does not depend on the number of threads.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "golden/sheet.hpp"
#include "golden/sheet_sweep.hpp"
#include "golden/splat/composite.hpp"

namespace fastsplat::golden {

/// A splat's addition to a sheet. The sweep's default is share * value * footprint.
class Deposit {
 public:
  virtual ~Deposit() = default;
  /// Adds the splat's share of sheet number `sheet` to the pixels of the footprint. Called concurrently for different
  /// rows of one sheet.
  virtual void add(Sheet& to, int sheet, const Footprint& footprint, const ProjectedSplat& splat,
                   double share) const = 0;
};

/// A finished sheet and its neighbours as splatted; before the first and behind the last sheet all sums are 0.
struct SheetWindow {
  int number = 0;  ///< of `here`; 0 is nearest to the eye
  const Sheet& before;
  const Sheet& here;
  const Sheet& behind;
};

/// Turns a finished sheet's sums into material: premultiplied emission and optical depth. Stages run in sequence on the
/// same pixels, each on the output of the previous one; the window always holds the splatted sums.
class SheetStage {
 public:
  virtual ~SheetStage() = default;
  /// Whether the stage reads `before` and `behind`. If not, it must not touch them.
  virtual bool needs_neighbours() const = 0;
  /// How many pixels beyond its own the stage reads.
  virtual int margin() const { return 0; }
  /// Pixels of row y that can come out with material; all others have none. `so_far` is the previous stage's extent.
  virtual Run extent(const SheetWindow& window, int y, Run so_far) const {
    (void)window, (void)y;
    return so_far;
  }
  /// Processes pixels begin, begin+1, ... of row y in place. Called concurrently for different rows.
  virtual void row(const SheetWindow& window, int y, int begin, std::span<Sums> pixels) const = 0;
};

/// A whole frame of layers. Outside a row's run the frame is empty, whatever `layers` holds there.
struct LayerFrame {
  int width = 0;
  std::vector<Layer> layers;  ///< row by row
  std::vector<Run> runs;      ///< one per row

  const Layer* row(int y) const { return &layers[static_cast<std::size_t>(y) * width]; }
};

/// Filters a sheet's colour and opacity before it is composited.
class LayerFilter {
 public:
  virtual ~LayerFilter() = default;
  /// True: the sheet is composited unfiltered.
  virtual bool leaves(int sheet) const = 0;
  /// Largest distance, over all sheets, that a pixel can spread, pixels.
  virtual int margin() const = 0;
  /// Pixels of row y that can come out with opacity.
  virtual Run extent(int sheet, const LayerFrame& in, int y) const = 0;
  /// Filters pixels begin, begin+1, ... of row y. Called concurrently for different rows.
  virtual void row(int sheet, const LayerFrame& in, int y, int begin, std::span<Layer> out) const = 0;
};

/// Finds splats that need not be drawn because everything in front of them is opaque.
class Occlusion {
 public:
  virtual ~Occlusion() = default;
  /// Returns the splats that reach the image and whose nearest sheet is `sheet`, in order. Leaves out a splat if every
  /// pixel of its footprint, grown by `margin` pixels on each side, is opaque. Called once per sheet, front to back;
  /// the span is valid until the next call.
  virtual std::span<const ProjectedSplat> visible(int sheet, int margin) = 0;
  /// Called after each sheet with the picture and, for each row, the pixels that the sheet may have changed.
  virtual void composited(std::span<const FrontToBack> picture, std::span<const Run> changed) = 0;
};

/// Optional steps besides adding and compositing; null and empty: none. Owns nothing.
struct FrameStages {
  const Deposit* deposit = nullptr;
  std::vector<const SheetStage*> sheet_stages{};
  const LayerFilter* filter = nullptr;
  Occlusion* occlusion = nullptr;
  /// A pixel whose transmittance is below this is terminated: it no longer changes (docs/numerics.md, N-6-6).
  double freeze_below = 0.0;
};

/// Composites the sheets front to back with the scene's slab opacity. Progress counts sheets. UserError (Usage) if the
/// sheets in memory at once exceed kFrameSweepBytes.
Image sweep_frame(const scene::Scene& scene, const std::vector<scene::Splat>& splats, const RenderOptions& options,
                  const SheetAssignment& assignment, const FrameStages& stages);

inline constexpr double kFrameSweepBytes = 4e9;

}  // namespace fastsplat::golden
