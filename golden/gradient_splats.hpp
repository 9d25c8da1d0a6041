// Gradient splats: three more footprints beside the density's, the kernel's derivatives (Mueller, Moeller, Crawfis
// 1999; splatting.md section 2 item 5).
#pragma once

#include "golden/frame_sweep.hpp"
#include "golden/sheet_geometry.hpp"

namespace fastsplat::golden {

/// A sheet's sums are d/dx, d/dy, d/dz of the density and the density, integrated over the slab, per kernel unit; x
/// right, y down, z along the ray per unit of depth. Of a splat with density v, centred at depth zc, the slab [z0, z1)
/// gets
///     density  v F(rho) (Phi(z1-zc) - Phi(z0-zc))
///     d/dx     -2a dx times that, with dx in kernel units; so too d/dy
///     d/dz     v F(rho) (Phi'(z1-zc) - Phi'(z0-zc))
class GradientSplats final : public Deposit {
 public:
  GradientSplats(const scene::Kernel& kernel, const SheetGeometry& geometry) : kernel_(kernel), geometry_(geometry) {}
  void add(Sheet& to, int sheet, const Footprint& footprint, const ProjectedSplat& splat, double share) const override;

 private:
  const scene::Kernel& kernel_;
  const SheetGeometry& geometry_;
};

}  // namespace fastsplat::golden
