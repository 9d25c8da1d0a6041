// Sheets, front to back, each over the whole frame: for techniques that look beyond one pixel of one sheet. The
// work of sweep_sheets band by band is done here sheet by sheet. Stages can therefore read a sheet's neighbours in y
// and in depth, filter across it, and read the picture in front of it. Without a stage the picture is that of
// composite_sheets, bit for bit; with any stages it does not depend on the number of threads.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "golden/sheet.hpp"
#include "golden/sheet_sweep.hpp"
#include "golden/splat/composite.hpp"

namespace fastsplat::golden {

/// What a sheet gets of a splat. The default of the sweep is share * value * footprint.
class Deposit {
 public:
  virtual ~Deposit() = default;
  /// Adds the splat's share of sheet number `sheet` to the pixels of the footprint. Called for different rows of one
  /// sheet at once.
  virtual void add(Sheet& to, int sheet, const Footprint& footprint, const ProjectedSplat& splat,
                   double share) const = 0;
};

/// A finished sheet and its neighbours as the splats left them; beyond the first and the last sheet all sums are 0.
struct SheetWindow {
  int number = 0;  ///< of `here`; 0 is nearest to the eye
  const Sheet& before;
  const Sheet& here;
  const Sheet& behind;
};

/// Turns a finished sheet's sums into material: premultiplied emission and optical depth. Stages run one after another
/// on the same pixels, each on what the one before it made; the window always shows what was splatted.
class SheetStage {
 public:
  virtual ~SheetStage() = default;
  /// Whether it reads `before` and `behind`; else these are not to be touched.
  virtual bool needs_neighbours() const = 0;
  /// By how many pixels it reads beyond its own.
  virtual int margin() const { return 0; }
  /// Pixels of row y that can come out with material, all others having none: `so_far` of the stage before.
  virtual Run extent(const SheetWindow& window, int y, Run so_far) const {
    (void)window, (void)y;
    return so_far;
  }
  /// Pixels begin, begin+1, ... of row y, in place. Called for different rows at once.
  virtual void row(const SheetWindow& window, int y, int begin, std::span<Sums> pixels) const = 0;
};

/// A whole frame of layers. Outside a row's run there is nothing, whatever `layers` holds there.
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
  /// True: the sheet is composited as it is.
  virtual bool leaves(int sheet) const = 0;
  /// The farthest that any sheet's pixel can reach, pixels.
  virtual int margin() const = 0;
  /// Pixels of row y that can come out with opacity.
  virtual Run extent(int sheet, const LayerFrame& in, int y) const = 0;
  /// Pixels begin, begin+1, ... of row y. Called for different rows at once.
  virtual void row(int sheet, const LayerFrame& in, int y, int begin, std::span<Layer> out) const = 0;
};

/// Which splats need not be splatted, since what is in front of them is opaque.
class Occlusion {
 public:
  virtual ~Occlusion() = default;
  /// The splats that reach the image and whose nearest sheet is `sheet`, in their order, without those of which every
  /// pixel of the footprint grown by `margin` pixels on every side is opaque. Asked once per sheet, front to back;
  /// valid until asked again.
  virtual std::span<const ProjectedSplat> visible(int sheet, int margin) = 0;
  /// The picture after each sheet, and the pixels of each row that the sheet may have changed.
  virtual void composited(std::span<const FrontToBack> picture, std::span<const Run> changed) = 0;
};

/// What is done besides adding and compositing; null and empty: nothing. Nothing is owned.
struct FrameStages {
  const Deposit* deposit = nullptr;
  std::vector<const SheetStage*> sheet_stages{};
  const LayerFilter* filter = nullptr;
  Occlusion* occlusion = nullptr;
  /// A pixel whose transmittance is below this no longer changes (docs/numerics.md, "freeze").
  double freeze_below = 0.0;
};

/// Composites the sheets front to back by the scene's slab opacity. Progress counts sheets. UserError (Usage) when the
/// sheets that are live at once do not fit into kFrameSweepBytes.
Image sweep_frame(const scene::Scene& scene, const std::vector<scene::Splat>& splats, const RenderOptions& options,
                  const SheetAssignment& assignment, const FrameStages& stages);

inline constexpr double kFrameSweepBytes = 4e9;

}  // namespace fastsplat::golden
