// SPDX-License-Identifier: Apache-2.0
// Front-to-back sweep of sheets, shared by xray, axis_aligned and image_aligned. A sheet method makes two choices:
// which sheets get which share of a splat, and what happens to a finished sheet.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "golden/render.hpp"
#include "golden/splat/projected_splat.hpp"
#include "scene/sheet_plan.hpp"

namespace fastsplat::golden {

/// Which sheets a splat goes to.
class SheetAssignment {
 public:
  virtual ~SheetAssignment() = default;
  /// Number of sheets; sheet 0 is nearest to the eye.
  virtual int sheets() const = 0;
  /// The most sheets that one splat can reach.
  virtual int reach() const = 0;
  /// The nearest sheet the splat reaches.
  virtual int first(const ProjectedSplat& splat) const = 0;
  /// The share of the splat that sheet first(splat)+i gets; the shares add up to 1.
  virtual void shares(const ProjectedSplat& splat, std::vector<double>& out) const = 0;
};

/// Assigns every splat whole to one sheet.
class WholeSplats final : public SheetAssignment {
 public:
  explicit WholeSplats(int sheets) : sheets_(sheets) {}
  int sheets() const override { return sheets_; }
  int reach() const override { return 1; }
  int first(const ProjectedSplat& splat) const override { return splat.sheet; }
  void shares(const ProjectedSplat&, std::vector<double>& out) const override { out.assign(1, 1.0); }

 private:
  int sheets_;
};

/// Kernel slices: of a splat centred at z, the slab [z0,z1) of depth gets Phi((z1-z)/l) - Phi((z0-z)/l), with Phi =
/// Kernel::cumulative and l = depth_growth. The first slab reaches to the eye and the last to infinity, so nothing is
/// lost.
class KernelSlices final : public SheetAssignment {
 public:
  /// `largest_growth`: upper bound on any splat's depth_growth.
  KernelSlices(const scene::Kernel& kernel, const scene::SlabGrid& grid, double largest_growth)
      : kernel_(kernel), grid_(grid), largest_growth_(largest_growth) {}
  int sheets() const override { return grid_.count; }
  int reach() const override;
  int first(const ProjectedSplat& splat) const override;
  void shares(const ProjectedSplat& splat, std::vector<double>& out) const override;

 private:
  const scene::Kernel& kernel_;
  scene::SlabGrid grid_;
  double largest_growth_;
};

/// The sheets of image_aligned.
KernelSlices image_slabs(const scene::Scene& scene);

/// Receives finished sheets.
struct SheetSink {
  Sums initial{};  ///< initial value of every pixel
  /// Combines a run of pixels of a finished sheet with the picture.
  std::function<void(std::span<Sums> pixels, std::span<const Sums> sheet)> take;
  /// Converts one finished pixel to RGBA.
  std::function<void(const Sums& pixel, float* rgba)> store;
  /// Whether no further sheet can change the stored value of the pixel. Empty: never.
  std::function<bool(const Sums& pixel)> settled{};
};

/// Adds every splat to its sheets in the given order, and passes each sheet to `sink` once no later splat can reach it.
/// Pixels that no splat of a sheet touches may be omitted; so may settled ones, unless options.plain. Splats that reach
/// only settled pixels are then not drawn.
Image sweep_sheets(const scene::Scene& scene, const std::vector<scene::Splat>& splats, const RenderOptions& options,
                   const SheetAssignment& assignment, const SheetSink& sink);

/// sweep_sheets that composites the sheets front to back with the scene's slab opacity; a pixel whose transmittance is
/// below culling.freeze no longer changes.
Image composite_sheets(const scene::Scene& scene, const std::vector<scene::Splat>& splats, const RenderOptions& options,
                       const SheetAssignment& assignment);

}  // namespace fastsplat::golden
