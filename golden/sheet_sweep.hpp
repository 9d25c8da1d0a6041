// Sheets, front to back: what xray, axis_aligned and image_aligned share. A sheet method is two choices:
// which sheets get which share of a splat, and what becomes of a finished sheet.
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

/// Every splat whole into one sheet.
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

/// Kernel slices: the slab [z0,z1) of depth gets Phi((z1-z)/l) - Phi((z0-z)/l) of a splat centred at z, Phi =
/// Kernel::cumulative, l its depth_growth. The first slab reaches to the eye and the last to infinity, so nothing is
/// lost.
class KernelSlices final : public SheetAssignment {
 public:
  /// `largest_growth`: of any splat.
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

/// What becomes of finished sheets.
struct SheetSink {
  Sums initial{};  ///< every pixel, to begin with
  /// Takes a run of pixels of a finished sheet into the picture.
  std::function<void(std::span<Sums> pixels, std::span<const Sums> sheet)> take;
  /// One finished pixel to RGBA.
  std::function<void(const Sums& pixel, float* rgba)> store;
  /// Whether no further sheet can change what will be stored of the pixel. Empty: never.
  std::function<bool(const Sums& pixel)> settled{};
};

/// Adds every splat into its sheets, in the order given, and hands each sheet over when no later splat can reach it.
/// Pixels that no splat of a sheet touches need not be handed over; nor, unless options.plain, settled ones. Splats
/// that reach only settled pixels are then not drawn.
Image sweep_sheets(const scene::Scene& scene, const std::vector<scene::Splat>& splats, const RenderOptions& options,
                   const SheetAssignment& assignment, const SheetSink& sink);

/// sweep_sheets with the sheets composited front to back by the scene's slab opacity; a pixel whose transmittance is
/// below culling.freeze no longer changes.
Image composite_sheets(const scene::Scene& scene, const std::vector<scene::Splat>& splats, const RenderOptions& options,
                       const SheetAssignment& assignment);

}  // namespace fastsplat::golden
