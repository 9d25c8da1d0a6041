// SPDX-License-Identifier: Apache-2.0
#include "analysis/errors/bound_densities.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "analysis/pipeline/density_frame.hpp"

namespace fastsplat::analysis {
namespace {

constexpr auto kFirstTerm = static_cast<std::size_t>(Term::Place);
static_assert(static_cast<std::size_t>(Term::Product) - kFirstTerm == 7);

}  // namespace

double DensityBoundBand::Density::error() const { return std::accumulate(errors.begin(), errors.end(), 0.0); }

DensityBoundBand::DensityBoundBand(const stages::Chain& chain, const stages::Mixture& known,
                                   const stages::Mixture& device, const Roundings& roundings, const KnownSplats& splats,
                                   golden::Rows rows, int width)
    : chain_(chain),
      known_(known),
      r_(roundings),
      splats_(splats),
      rows_(rows),
      with_halo_{std::max(rows.first - stages::DensityBand::kHalo, 0),
                 std::min(rows.end + stages::DensityBand::kHalo, chain.scene().description.height)},
      width_(width),
      height_(chain.scene().description.height),
      sheets_(chain.steps().sheets()),
      layers_(chain, roundings),
      weights_(chain, known, roundings, splats),
      slices_(chain, known, roundings),
      ranges_(chain.densities(), device),
      densities_(static_cast<std::size_t>(with_halo_.end - with_halo_.first) * static_cast<std::size_t>(width) *
                 static_cast<std::size_t>(sheets_)),
      alone_(static_cast<std::size_t>(sheets_)),
      together_(alone_),
      pixels_(static_cast<std::size_t>(rows.end - rows.first) * static_cast<std::size_t>(width)) {}

std::size_t DensityBoundBand::index(int x, int y, int sheet) const {
  const auto row = static_cast<std::size_t>(y - with_halo_.first), column = static_cast<std::size_t>(x);
  return (row * static_cast<std::size_t>(width_) + column) * static_cast<std::size_t>(sheets_) +
         static_cast<std::size_t>(sheet);
}

const DensityBoundBand::Density& DensityBoundBand::at(int x, int y, int sheet) const {
  static constexpr Density kNothing{};
  return sheet < 0 || sheet >= sheets_ ? kNothing : densities_[index(x, y, sheet)];
}

void DensityBoundBand::run(const stages::BandBins& bins, int band) {
  for (int sheet = 0; sheet < bins.sheets(); ++sheet) {
    for (const std::uint32_t i : bins.bin(band, sheet)) add(i);
  }
  PixelBound* pixel = pixels_.data();
  for (int y = rows_.first; y < rows_.end; ++y) {
    for (int x = 0; x < width_; ++x) bound(x, y, *pixel++);
  }
}

void DensityBoundBand::add(std::uint32_t i) {
  weights_.begin(i);
  const Sliced& s = slices_(splats_.known.splats[i], splats_.known.shape(i), weights_.ratio());
  weights_.visit(with_halo_, width_, [&](int x, int y, const Touch& touch) {
    const double greatest = touch.weight + touch.error;
    for (std::size_t m = 0; m < s.size(); ++m) {
      const double value = s.value[m][3], error = s.share_error[m][3], whole = s.part[m] * s.whole_error[3],
                   cut = (s.cut[m] + s.cut[m + 1]) * s.whole[3];
      Density& to = densities_[index(x, y, s.first + static_cast<int>(m))];
      to.known += touch.weight * value;
      const std::array parts{touch.by_place * value,
                             touch.by_radius * value,
                             touch.by_lookup * value,
                             touch.by_weight * value,
                             greatest * whole,
                             greatest * cut,
                             greatest * std::max(0.0, error - whole - cut),
                             std::min(r_.product, (value + error) * greatest)};
      for (std::size_t part = 0; part < parts.size(); ++part) to.errors[part] += parts[part];
    }
  });
}

stages::DensityRange DensityBoundBand::around(int x, int y, int sheet, bool with_errors) const {
  const auto range = [&](int i, int j, int of) {
    const Density& density = at(i, j, of);
    if (!with_errors) return stages::Range{density.known, density.known};
    const double error = density.error();
    return stages::Range{std::clamp(density.known - error, 0.0, r_.largest_sum),
                         std::min(density.known + error, r_.largest_sum)};
  };
  const auto difference = [](const stages::Range& before, const stages::Range& behind, double factor) {
    return stages::Range{factor * (behind.low - before.high), factor * (behind.high - before.low)};
  };
  const stages::Beside column = stages::beside(x, width_), row = stages::beside(y, height_);
  return {.density = range(x, y, sheet),
          .across = {difference(range(column.before, y, sheet), range(column.behind, y, sheet), column.factor),
                     difference(range(x, row.before, sheet), range(x, row.behind, sheet), row.factor),
                     difference(range(x, y, sheet - 1), range(x, y, sheet + 1), 1.0)},
          .x = x,
          .y = y,
          .sheet = sheet};
}

DensityBoundBand::Off DensityBoundBand::off(const stages::ClassifiedRange& range, const Layer& layer) const {
  Off out{.tau = range.tau.off(layer.sums[3])};
  if (!(range.tau.high > 0.0)) return out;
  for (std::size_t c = 0; c < 3; ++c) {
    const double over = range.colour[c].high * range.tau.high + range.rounded - range.largest;
    out.spread[c] = range.colour[c].off(layer.colour[c]) * range.tau.high + range.rounded + std::max(0.0, over);
  }
  return out;
}

double DensityBoundBand::effect(const Layer& layer, const Off& off, std::size_t c) const {
  if (c == 3) return (1.0 - layer.behind[3]) * layer.dims * off.tau;
  return std::abs(layer.colour[c] - layer.behind[c]) * layer.dims * off.tau + layer.factor * off.spread[c];
}

void DensityBoundBand::share_out(double amount, int x, int y, int sheet) {
  std::array<double, 8> sums{};
  const stages::Beside column = stages::beside(x, width_), row = stages::beside(y, height_);
  for (const Density* one :
       {&at(x, y, sheet), &at(column.before, y, sheet), &at(column.behind, y, sheet), &at(x, row.before, sheet),
        &at(x, row.behind, sheet), &at(x, y, sheet - 1), &at(x, y, sheet + 1)}) {
    for (std::size_t part = 0; part < sums.size(); ++part) sums[part] += one->errors[part];
  }
  const double all = std::accumulate(sums.begin(), sums.end(), 0.0);
  if (!(all > 0.0)) return;
  for (std::size_t part = 0; part < sums.size(); ++part) terms_[kFirstTerm + part] += amount * sums[part] / all;
}

void DensityBoundBand::bound(int x, int y, PixelBound& pixel) {
  of_pixel_.assign(static_cast<std::size_t>(sheets_), Layer{});
  for (int s = 0; s < sheets_; ++s) {
    const auto sheet = static_cast<std::size_t>(s);
    const stages::DensityRange known = around(x, y, s, false), all = around(x, y, s, true);
    alone_[sheet] = together_[sheet] = {};
    if (!(all.density.high > 0.0)) continue;
    of_pixel_[sheet].sums =
        chain_.densities()({.density = known.density.low,
                            .across = {known.across[0].low, known.across[1].low, known.across[2].low},
                            .x = x,
                            .y = y,
                            .sheet = s},
                           known_);
    alone_[sheet] = ranges_(known);
    together_[sheet] = ranges_(all);
  }
  layers_.look_through(of_pixel_, pixel);
  for (int s = 0; s < sheets_ && !pixel.closed; ++s) {
    const auto sheet = static_cast<std::size_t>(s);
    Layer& layer = of_pixel_[sheet];
    const Off alone = off(alone_[sheet], layer), together = off(together_[sheet], layer);
    layer.tau_error = together.tau;
    layer.spread = together.spread;
    double of_densities = 0.0;
    for (std::size_t c = 0; c < 4; ++c) {
      layer.moved[c] = effect(layer, together, c);
      const double moved = layer.transmittance * layer.moved[c],
                   classified = std::min(moved, layer.transmittance * effect(layer, alone, c));
      pixel.total[c] += moved;
      terms_[static_cast<std::size_t>(Term::Classification)] += classified;
      of_densities += moved - classified;
    }
    share_out(of_densities, x, y, s);
    layers_.finish(layer, {}, pixel, terms_);
  }
  layers_.end(pixel);
}

}  // namespace fastsplat::analysis
