// SPDX-License-Identifier: Apache-2.0
// Everything that makes one pixel of a Chain's picture, step by step, in any mixture (docs/errors.md, section 8).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "analysis/pipeline/chain.hpp"
#include "analysis/pipeline/pixel_steps.hpp"

namespace fastsplat::stages {

/// A splat with a weight at the pixel.
struct SplatTrace {
  std::uint32_t splat = 0;        ///< its number in the chain
  StagedSplat placed;             ///< as the driver places it
  std::optional<double> entries;  ///< q: squared distance in radial table entries; without one in some index kinds
  double weight = 0.0;            ///< at the pixel
};

/// Its part in a sheet.
struct ShareTrace {
  std::uint32_t splat = 0;  ///< index in PixelTrace::splats
  golden::Sums share{};     ///< R, G, B, tau of the splat in the sheet
  golden::Sums product{};   ///< share times weight
};

/// A sheet at the pixel; with every sample composited, one sample of it.
struct SheetTrace {
  int sheet = 0;
  std::vector<ShareTrace> shares;
  golden::Sums sums{};   ///< R, G, B, tau, saturated by step sheet
  double factor = 1.0;   ///< (1-exp(-tau))/tau
  RealSlab slab;         ///< its colour and opacity
  golden::Sums after{};  ///< C_R, C_G, C_B, T behind it; an X-ray's sums
};

struct PixelTrace {
  std::vector<SplatTrace> splats;  ///< in the order in which they are added
  std::vector<SheetTrace> sheets;  ///< in the order in which they are composited, up to the one that terminates
  bool terminated = false;         ///< nothing behind the last sheet can change the pixel
  golden::Sums out{};              ///< R, G, B, A
};

/// One pixel of a chain's picture. Values are in the device's units in every mixture: with all steps real they differ
/// from golden's picture by the rounding of doubles.
class PixelChain {
 public:
  /// Keeps a reference to the chain. Throws UserError (Usage) outside the picture, and for densities, whose pixels
  /// depend on their neighbours.
  PixelChain(const Chain& chain, int x, int y, int threads);

  PixelTrace operator()(const Mixture& mixture) const;

 private:
  const Chain& chain_;
  int x_, y_, threads_;
  std::vector<std::uint32_t> near_;  ///< splats that can touch the pixel in some mixture
};

}  // namespace fastsplat::stages
