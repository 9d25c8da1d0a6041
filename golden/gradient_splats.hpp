// SPDX-License-Identifier: Apache-2.0
// Gradient splats: besides the density's footprint three more, for the kernel's derivatives (Mueller, Moeller, Crawfis
// 1999; splatting.md section 2 item 5).
#pragma once

#include "golden/frame_sweep.hpp"
#include "golden/sheet_geometry.hpp"

namespace fastsplat::golden {

/// A sheet's sums are d/dx, d/dy, d/dz of the density and the density itself, integrated over the slab, per kernel
/// unit. x points right, y down, z along the ray per unit of depth. A splat of density v, centred at depth zc, adds to
/// slab [z0, z1)
///     density  v F(rho) (Phi(z1-zc) - Phi(z0-zc))
///     d/dx     -2a dx times the density, with dx in kernel units; d/dy likewise
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
