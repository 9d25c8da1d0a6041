// SPDX-License-Identifier: Apache-2.0
// The bound on a band of image rows. A forward pass finds what each sheet shows, a backward pass what lies behind it;
// then each rounding is bounded splat by splat (docs/errors.md, section 3).
#pragma once

#include <array>
#include <span>
#include <vector>

#include "analysis/errors/bound.hpp"
#include "analysis/errors/roundings.hpp"
#include "analysis/pipeline/band_bins.hpp"
#include "analysis/pipeline/weight_steps.hpp"
#include "golden/splat/footprint.hpp"

namespace fastsplat::analysis {

using golden::Sums;

/// Known values of a sheet at a pixel, and the errors gathered there. Channels: R, G, B, and alpha or tau.
struct SheetCell {
  Sums sums{};                 ///< of the known mixture
  double transmittance = 1.0;  ///< in front of the sheet
  double dims = 1.0;           ///< exp(-tau), the derivative of opacity; 1 where sums are added
  double factor = 1.0;         ///< (1-exp(-tau))/tau
  double opacity = 0.0;
  Sums colour{};                   ///< sums over tau; 1 for alpha
  Sums behind{};                   ///< colour behind the sheet, by itself
  double tau_error = 0.0;          ///< largest error of tau
  std::array<double, 3> spread{};  ///< largest error of (sums - colour * tau)
  Sums moved{};                    ///< largest first-order error of the sheet's layer, without T
  Sums straddling{};               ///< added by splats whose last sheet this is, if the pixel terminates amid them
};

class BoundBand {
 public:
  /// Keeps references. `splats`: of the known mixture, binned by the sheet before their first one if depths are open
  /// ("lead" 1).
  BoundBand(const stages::Chain& chain, const stages::Mixture& known, const Roundings& roundings,
            std::span<const stages::StagedSplat> splats, golden::Rows rows, int width);

  void run(const stages::BandBins& bins, int band);
  const std::vector<Sums>& greatest() const { return greatest_; }         ///< row by row
  const std::array<double, kTermCount>& terms() const { return terms_; }  ///< sums over values

 private:
  /// A splat at a pixel.
  struct Touch {
    double weight = 0.0, error = 0.0;  ///< known weight; largest error of the device's
    double by_place = 0.0, by_radius = 0.0, by_lookup = 0.0, by_weight = 0.0;  ///< parts of the error
  };
  /// A splat's shares in sheets first .. first + size - 1, and the largest error of each part.
  struct Sliced {
    int first = 0;
    std::vector<Sums> value;        ///< known share
    std::vector<double> part;       ///< fraction of the kernel
    std::vector<double> cut;        ///< error of the fraction at boundary i, in front of sheet i; one more than sheets
    std::vector<double> word;       ///< error of a channel's word there
    Sums whole_error{};             ///< error of the whole splat
    std::vector<Sums> share_error;  ///< error of a share, in total
    std::vector<Sums> over;         ///< its part that saturation adds
    std::size_t size() const { return value.size(); }
  };
  /// Effect on the pixel behind T = 1 of an error of 1 in a sum of the sheet: the colour's own, and tau's.
  struct Effect {
    double colour = 0.0, tau = 0.0;
    double of(const Sums& value, std::size_t c) const { return colour * value[c] + tau * value[3]; }
  };

  SheetCell& cell(int sheet, int x, int y) {
    return cells_[(static_cast<std::size_t>(sheet) * static_cast<std::size_t>(rows_.end - rows_.first) +
                   static_cast<std::size_t>(y - rows_.first)) *
                      static_cast<std::size_t>(width_) +
                  static_cast<std::size_t>(x)];
  }
  std::size_t pixel(int x, int y) const {
    return static_cast<std::size_t>(y - rows_.first) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  void fill_sheets(const stages::BandBins& bins, int band);
  void fill(const stages::StagedSplat& splat);
  void look_through();
  void add(const stages::StagedSplat& splat);
  void slice(const stages::StagedSplat& splat);
  Effect effect(const SheetCell& at, std::size_t c) const;
  Touch touch(const stages::StagedSplat& splat, double dx, double dy) const;
  void add_pixel(const stages::StagedSplat& splat, const Touch& touch, int x, int y);
  void finish(int sheet);
  void finish_pixel(int sheet, SheetCell& cell, std::size_t at, int x, int y);
  void term(Term which, double amount) { terms_[static_cast<std::size_t>(which)] += amount; }

  const stages::Chain& chain_;
  const stages::Mixture& known_;
  const Roundings& r_;
  std::span<const stages::StagedSplat> splats_;
  golden::Rows rows_;
  int width_, sheets_;
  bool xray_, additive_;
  double entries_;  ///< N
  stages::WeightSteps weights_;
  std::vector<SheetCell> cells_;
  std::vector<double> upper_, lower_;  ///< bounds on the device's transmittance in front of the current sheet
  std::vector<char> closed_;           ///< certainly terminated
  std::vector<Sums> total_, greatest_;
  std::array<double, kTermCount> terms_{};
  Sliced sliced_;
  std::vector<Sums> shares_;
};

}  // namespace fastsplat::analysis
