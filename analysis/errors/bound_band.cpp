// SPDX-License-Identifier: Apache-2.0
#include "analysis/errors/bound_band.hpp"

#include <algorithm>
#include <cmath>

#include "driver/tiles/compile.hpp"

namespace fastsplat::analysis {

BoundBand::BoundBand(const stages::Chain& chain, const stages::Mixture& known, const Roundings& roundings,
                     const KnownSplats& splats, golden::Rows rows, int width)
    : chain_(chain),
      known_(known),
      r_(roundings),
      splats_(splats),
      rows_(rows),
      width_(width),
      sheets_(driver::every_sample(chain.scene().description) ? 0 : static_cast<std::size_t>(chain.steps().sheets())),
      layers_(chain, roundings),
      weights_(chain, known, roundings, splats),
      slices_(chain, known, roundings),
      of_pixel_(static_cast<std::size_t>(rows.end - rows.first) * static_cast<std::size_t>(width),
                std::vector<Layer>(sheets_)),
      next_(of_pixel_.size(), 0),
      pixels_(of_pixel_.size()) {}

void BoundBand::run(const stages::BandBins& bins, int band) {
  for (int sheet = 0; sheet < bins.sheets(); ++sheet) {
    for (const std::uint32_t i : bins.bin(band, sheet)) {
      if (sheets_ > 0) {
        fill_sheets(i);
      } else {
        fill_samples(i);
      }
    }
  }
  for (std::size_t at = 0; at < pixels_.size(); ++at) layers_.look_through(of_pixel_[at], pixels_[at]);
  for (int sheet = 0; sheet < bins.sheets(); ++sheet) {
    for (const std::uint32_t i : bins.bin(band, sheet)) add(i);
    if (sheets_ > 0) finish_sheet(static_cast<std::size_t>(sheet));
  }
  for (PixelBound& at : pixels_) layers_.end(at);
}

void BoundBand::fill_sheets(std::uint32_t i) {
  const stages::StagedSplat& splat = splats_.known.splats[i];
  weights_.begin(i);
  const stages::WeightSteps& weights = weights_.rasterise(rows_, width_);
  chain_.shares(splat, splats_.known.shape(i), known_, shares_);
  for (const auto& span : weights.spans()) {
    const auto of_span = weights.weights(span);
    for (std::size_t p = 0; p < of_span.size(); ++p) {
      Layer* at = &of_pixel_[pixel(span.x, span.y) + p][static_cast<std::size_t>(splat.first)];
      for (const Sums& share : shares_) {
        for (std::size_t c = 0; c < 4; ++c) at->sums[c] += of_span[p] * share[c];
        ++at;
      }
    }
  }
}

void BoundBand::fill_samples(std::uint32_t i) {
  weights_.begin(i);
  chain_.shares(splats_.known.splats[i], splats_.known.shape(i), known_, shares_);
  weights_.visit(rows_, width_, [&](int x, int y, const Touch& touch) {
    Layer layer;
    for (std::size_t c = 0; c < 4; ++c) layer.sums[c] = touch.weight * shares_.front()[c];
    of_pixel_[pixel(x, y)].push_back(layer);
  });
}

bool BoundBand::seen(const driver::Extent& box) const {
  for (int y = std::max(box.y0, rows_.first); y < std::min(box.y1, rows_.end); ++y) {
    for (int x = std::max(box.x0, 0); x < std::min(box.x1, width_); ++x) {
      if (!pixels_[pixel(x, y)].closed) return true;
    }
  }
  return false;
}

void BoundBand::add(std::uint32_t i) {
  const stages::StagedSplat& splat = splats_.known.splats[i];
  weights_.begin(i);
  if (!seen(weights_.extent())) return;
  sliced_ = &slices_(splat, splats_.known.shape(i), weights_.ratio());
  longest_ = std::max(longest_, sliced_->size());
  weights_.visit(rows_, width_, [&](int x, int y, const Touch& touch) {
    const std::size_t at = pixel(x, y);
    if (pixels_[at].closed) return;
    if (sheets_ > 0) {
      add_pixel(touch, std::span(of_pixel_[at]).subspan(static_cast<std::size_t>(sliced_->first), sliced_->size()),
                pixels_[at]);
      return;
    }
    Layer& layer = of_pixel_[at][next_[at]++];
    add_pixel(touch, {&layer, 1}, pixels_[at]);
    layers_.finish(layer, {}, pixels_[at], terms_);
  });
}

void BoundBand::add_pixel(const Touch& touch, std::span<Layer> layers, PixelBound& pixel) {
  const Sliced& s = *sliced_;
  const double greatest = touch.weight + touch.error;  // largest weight of the device
  const std::size_t n = s.size();
  // Rounding cannot take more than the product itself.
  const auto product = [&](std::size_t m, std::size_t channel) {
    return std::min(r_.product, (s.value[m][channel] + s.share_error[m][channel]) * greatest);
  };
  for (std::size_t c = 0; c < 4; ++c) {
    // An unknown acts on all layers alike: signed sums. T is that of the known mixture.
    double weight_sum = 0.0, colour_sum = 0.0, tau_sum = 0.0;
    double cuts = 0.0, words = 0.0, products = 0.0, absolute = 0.0;
    Effect before{};
    for (std::size_t m = 0; m <= n; ++m) {
      Layer* const here = m < n ? &layers[m] : nullptr;
      const Effect one = here != nullptr ? layers_.effect(*here, c) : Effect{};
      const double t = here != nullptr ? here->transmittance : 0.0;
      const Effect now{t * one.colour, t * one.tau};
      // A boundary moves a share from one layer to the other.
      cuts += s.cut[m] * std::abs(before.of(s.whole, c) - now.of(s.whole, c));
      words += s.word[m] * (std::abs(before.colour - now.colour) + std::abs(before.tau - now.tau));
      before = now;
      if (here == nullptr) break;
      weight_sum += now.of(s.value[m], c);
      colour_sum += now.colour * s.part[m];
      tau_sum += now.tau * s.part[m];
      const double rounded = one.colour * product(m, c) + std::abs(one.tau) * product(m, 3);
      const double over = greatest * (one.colour * s.over[m][c] + std::abs(one.tau) * s.over[m][3]);
      products += t * rounded;
      words += t * over / std::max(greatest, 1e-300);
      const double moved =
          touch.error * std::abs(one.of(s.value[m], c)) + rounded + over +
          greatest * (s.part[m] * (one.colour * s.whole_error[c] + std::abs(one.tau) * s.whole_error[3]) +
                      (s.cut[m] + s.cut[m + 1]) * std::abs(one.of(s.whole, c)) +
                      (s.word[m] + s.word[m + 1]) * (one.colour + std::abs(one.tau)));
      here->moved[c] += moved;
      absolute += t * moved;
    }
    const double weights = std::abs(weight_sum);
    const double emission = greatest * (std::abs(colour_sum) * s.whole_error[c] + std::abs(tau_sum) * s.whole_error[3]);
    const double all = touch.error * weights + emission + greatest * (cuts + words) + products;
    pixel.total[c] += all;
    layers[n - 1].straddling[c] += std::max(0.0, absolute - all);
    term(Term::Place, touch.by_place * weights);
    term(Term::Radius, touch.by_radius * weights);
    term(Term::Lookup, touch.by_lookup * weights);
    term(Term::Weight, touch.by_weight * weights);
    term(Term::Emission, emission);
    term(Term::Depth, greatest * cuts);
    term(Term::Share, greatest * words);
    term(Term::Product, products);
  }
  if (layers_.xray()) return;
  for (std::size_t m = 0; m < n; ++m) {
    Layer& here = layers[m];
    here.tau_error += touch.error * s.value[m][3] + greatest * s.share_error[m][3] + product(m, 3);
    for (std::size_t c = 0; c < 3; ++c) {
      const double colour = here.colour[c];
      here.spread[c] += touch.error * std::abs(s.value[m][c] - colour * s.value[m][3]) +
                        greatest * (s.share_error[m][c] + colour * s.share_error[m][3]) + product(m, c) +
                        colour * product(m, 3);
    }
  }
}

void BoundBand::finish_sheet(std::size_t sheet) {
  for (std::size_t at = 0; at < pixels_.size(); ++at) {
    const std::span<Layer> layers(of_pixel_[at]);
    Sums amid{};  // of splats that began at this sheet or before it, and do not end in front of it
    for (std::size_t s = sheet; pixels_[at].lower < r_.freeze && s < std::min(sheets_, sheet + longest_); ++s) {
      for (std::size_t c = 0; c < 4; ++c) amid[c] += layers[s].straddling[c];
    }
    layers_.finish(layers[sheet], amid, pixels_[at], terms_);
  }
}

}  // namespace fastsplat::analysis
