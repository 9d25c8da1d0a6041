// SPDX-License-Identifier: Apache-2.0
#include "analysis/errors/bound.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/errors/bound_band.hpp"
#include "base/parallel/parallel.hpp"
#include "driver/tiles/compile.hpp"
#include "scene/capability.hpp"

namespace fastsplat::analysis {
namespace {

using stages::Step;

/// Allowance for the rounding of doubles.
constexpr double kSlack = 1e-12;

/// Limit on the size of a band's cells.
constexpr double kBandBytes = 48e6;
int rows_of_band(int sheets, int width) {
  return static_cast<int>(
      std::clamp(kBandBytes / (static_cast<double>(sizeof(SheetCell)) * sheets * width), 1.0, 16.0));
}

}  // namespace

const char* to_string(Known known) {
  constexpr const char* kNames[] = {"scene", "geometry", "words"};
  return kNames[static_cast<std::size_t>(known)];
}

const char* to_string(Term term) {
  constexpr const char* kNames[kTermCount] = {
      "known", "place",  "radius", "distance+index", "weight", "emission", "depth+phi",     "share",       "product",
      "sheet", "factor", "slab",   "composite",      "freeze", "pixel",    "transmittance", "second order"};
  return kNames[static_cast<std::size_t>(term)];
}

stages::Mixture known_steps(Known known) {
  using enum Step;
  switch (known) {
    case Known::Scene:
      return {};
    case Known::Geometry:
      return {Position, Snap, Radius, Depth, Phi, Distance, Index, Weight};
    case Known::Words:
      break;
  }
  return {Position, Snap, Radius, Emission, Depth, Phi, Share, Distance, Index, Weight};
}

Term Bound::dominant() const { return static_cast<Term>(std::ranges::max_element(mean) - mean.begin()); }

Bound bound(const stages::Chain& chain, const stages::Picture& real, Known known, int threads) {
  return bound(chain, real, known_steps(known), stages::Mixture::all_device(), threads);
}

void check_bounded(const stages::Chain& chain) {
  // Only circles in sheets of colours are covered by the proof.
  const scene::Methods methods = driver::offers(chain.config()).methods & ~scene::only(scene::Method::Westover);
  scene::check_capability(chain.scene(), {"error bound", methods, 0u});
  if (chain.config().colour_int_bits > 0) {
    throw_usage({.where = "colour.int_bits",
                 .what = "no error bound is proved of colours above 1",
                 .expected = "0",
                 .got = std::to_string(chain.config().colour_int_bits),
                 .fix = "add --set colour.int_bits=0"});
  }
}

Bound bound(const stages::Chain& chain, const stages::Picture& real, const stages::Mixture& mixture,
            const stages::Mixture& device, int threads) {
  check_bounded(chain);
  const scene::Scene& scene = chain.scene();
  const Roundings roundings(scene, chain.config(), chain.steps(), mixture, device);
  const auto splats = chain.steps().staged(chain.list(), mixture, false, threads).splats;
  const int width = real.width, height = real.height;
  const double more = roundings.place + [&] {
    double most = 0.0;  // most that a radius set exceeds the splat's own radius
    if (roundings.radius) {
      const auto& sets = chain.steps().sets();
      for (const auto& splat : splats) most = std::max(most, sets.radius(sets.nearest(splat.radius)) - splat.radius);
    }
    return most;
  }();
  const int lead = roundings.depth > 0.0 && chain.steps().sliced() ? 1 : 0;
  const driver::TileGrid bands =
      stages::band_grid(chain.config(), width, height, rows_of_band(chain.steps().sheets(), width));
  const stages::BandBins bins(
      bands, chain.steps().sheets(), splats.size(), threads,
      [&](std::size_t i) { return stages::extent_of(splats[i], nullptr, more); },
      [&](std::size_t i) { return std::max(0, splats[i].first - lead); });

  Bound out{{width, height, std::vector<Sums>(static_cast<std::size_t>(width) * height)}, {}};
  std::vector<std::array<double, kTermCount>> terms(static_cast<std::size_t>(bands.count()));
  parallel_for(bins.work(), threads, [&](std::size_t number) {
    const int band = static_cast<int>(number);
    const golden::Rows rows{bands.y(band), bands.y(band) + bands.height(band)};
    BoundBand sweep(chain, mixture, roundings, splats, rows, width);
    sweep.run(bins, band);
    std::ranges::copy(sweep.greatest(), &out.greatest.pixels[static_cast<std::size_t>(rows.first) * width]);
    terms[number] = sweep.terms();
  });

  // Adds the known part, saturation of an X-ray's sums, and rounding and saturation of output words.
  const stages::Picture there = chain(mixture, threads);
  const double values = 4.0 * static_cast<double>(real.pixels.size());
  for (const auto& band : terms) {
    for (std::size_t t = 0; t < kTermCount; ++t) out.mean[t] += band[t] / values;
  }
  const bool xray = scene.description.method == scene::Method::XRay;
  for (std::size_t i = 0; i < real.pixels.size(); ++i) {
    for (std::size_t c = 0; c < 4; ++c) {
      double& most = out.greatest.pixels[i][c];
      const double exact = std::abs(there.pixels[i][c] - real.pixels[i][c]);
      if (xray) most += std::max(0.0, there.pixels[i][c] + most - roundings.largest_sum);
      most += roundings.pixel + std::max(0.0, there.pixels[i][c] + most + roundings.pixel - roundings.largest_pixel);
      most += exact + kSlack;
      out.mean[static_cast<std::size_t>(Term::Known)] += exact / values;
      out.mean[static_cast<std::size_t>(Term::Pixel)] += roundings.pixel / values;
    }
  }
  return out;
}

BoundCheck check(const Bound& bound, const stages::Picture& real, const stages::Picture& device) {
  BoundCheck out;
  std::vector<double> ratios;
  for (std::size_t i = 0; i < real.pixels.size(); ++i) {
    double error = 0.0, most = 0.0;
    for (std::size_t c = 0; c < 4; ++c) {
      const double measured = std::abs(device.pixels[i][c] - real.pixels[i][c]);
      const double allowed = bound.greatest.pixels[i][c];
      ++out.values;
      out.over += measured <= allowed ? 0 : 1;  // a NaN bound does not hold
      out.worst = std::max(out.worst, measured / allowed);
      error = std::max(error, measured);
      most = std::max(most, allowed);
    }
    out.greatest_error = std::max(out.greatest_error, error);
    out.greatest_bound = std::max(out.greatest_bound, most);
    if (error > 0.0) ratios.push_back(most / error);
  }
  out.pixels = ratios.size();
  if (ratios.empty()) return out;
  std::ranges::sort(ratios);
  const auto rank = [&](double p) {
    return ratios[static_cast<std::size_t>(std::ceil(p * static_cast<double>(ratios.size()))) - 1];
  };
  out.median = rank(0.5);
  out.p90 = rank(0.9);
  out.p99 = rank(0.99);
  return out;
}

}  // namespace fastsplat::analysis
