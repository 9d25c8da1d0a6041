// SPDX-License-Identifier: Apache-2.0
// The bound of one pixel, layer by layer (docs/errors.md, section 3). A layer is what is composited at once: a sheet,
// or a sample where every sample is composited.
#pragma once

#include <array>
#include <span>

#include "analysis/errors/bound.hpp"
#include "analysis/errors/roundings.hpp"
#include "golden/splat/projected_splat.hpp"

namespace fastsplat::analysis {

using golden::Sums;
using Terms = std::array<double, kTermCount>;

/// Known values of a layer at a pixel, and the errors gathered there. Channels: R, G, B, and alpha or tau.
struct Layer {
  Sums sums{};                 ///< of the known mixture
  double transmittance = 1.0;  ///< in front of the layer
  double dims = 1.0;           ///< exp(-tau), the derivative of opacity; 1 where sums are added
  double factor = 1.0;         ///< (1-exp(-tau))/tau
  double opacity = 0.0;
  Sums colour{};                   ///< sums over tau; 1 for alpha
  Sums behind{};                   ///< colour behind the layer, by itself
  double tau_error = 0.0;          ///< largest error of tau
  std::array<double, 3> spread{};  ///< largest error of (sums - colour * tau)
  Sums moved{};                    ///< largest first-order error of the layer, without T
  Sums straddling{};               ///< added by splats whose last layer this is, if the pixel terminates amid them
};

/// What is proved of a pixel, front to back.
struct PixelBound {
  double upper = 1.0, lower = 1.0;  ///< bounds on the device's transmittance in front of the next layer
  bool closed = false;              ///< certainly terminated
  Sums total{};                     ///< largest error of the layers so far
  Sums greatest{};                  ///< the largest, if the pixel terminated somewhere before
  Sums unseen{};                    ///< what lies behind the place where golden terminates
};

/// Effect on the pixel behind T = 1 of an error of 1 in a sum of the layer: the colour's own, and tau's.
struct Effect {
  double colour = 0.0, tau = 0.0;
  double of(const Sums& value, std::size_t c) const { return colour * value[c] + tau * value[3]; }
};

class LayerBound {
 public:
  /// Keeps a reference to `roundings`.
  LayerBound(const stages::Chain& chain, const Roundings& roundings);

  bool xray() const { return xray_; }
  /// From the known sums of a pixel's layers, front to back: what each shows and hides.
  void look_through(std::span<Layer> layers, PixelBound& pixel) const;
  Effect effect(const Layer& at, std::size_t c) const;
  /// Composites a layer whose errors are gathered. `amid`: what splats astride it add if the pixel terminates here.
  void finish(const Layer& layer, const Sums& amid, PixelBound& pixel, Terms& terms) const;
  /// Behind the last layer.
  void end(PixelBound& pixel) const;

 private:
  double shown(const Layer& layer, std::size_t c) const;
  void terminate(const Layer& layer, const Sums& amid, PixelBound& pixel, Terms& terms) const;

  const Roundings& r_;
  bool xray_, additive_;
  double brightest_;         ///< a real additive layer's colour ends here; infinite for Gaussians
  double device_brightest_;  ///< the device's
  double golden_freeze_;     ///< golden's pixels terminate below it
};

}  // namespace fastsplat::analysis
