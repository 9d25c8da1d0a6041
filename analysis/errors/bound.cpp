// SPDX-License-Identifier: Apache-2.0
#include "analysis/errors/bound.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/errors/bound_band.hpp"
#include "analysis/errors/bound_densities.hpp"
#include "analysis/pipeline/density_frame.hpp"
#include "base/parallel/parallel.hpp"
#include "driver/tiles/compile.hpp"

namespace fastsplat::analysis {
namespace {

using stages::Step;

/// Allowance for the rounding of doubles.
constexpr double kSlack = 1e-12;

/// Limit on the size of a band's layers.
constexpr double kBandBytes = 48e6;
/// `layers`: of a row of the image.
int rows_of_band(double layers) {
  return static_cast<int>(
      std::clamp(kBandBytes / (static_cast<double>(sizeof(Layer)) * std::max(layers, 1.0)), 1.0, 16.0));
}

}  // namespace

const char* to_string(Known known) {
  constexpr const char* kNames[] = {"scene", "geometry", "words"};
  return kNames[static_cast<std::size_t>(known)];
}

const char* to_string(Term term) {
  constexpr const char* kNames[kTermCount] = {
      "known",     "place",     "radius",  "distance+index", "weight",         "emission",
      "depth+phi", "share",     "product", "sheet",          "classification", "factor",
      "slab",      "composite", "freeze",  "pixel",          "transmittance",  "second order"};
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

Bound bound(const stages::Chain& chain, const stages::Picture& real, const stages::Mixture& mixture,
            const stages::Mixture& device, int threads) {
  const scene::Scene& scene = chain.scene();
  const Roundings roundings(chain, mixture, device);
  const KnownSplats splats(chain, mixture, roundings, threads);
  const std::size_t count = splats.known.splats.size();
  const int width = real.width, height = real.height;
  std::vector<driver::Extent> extents(count);
  std::vector<int> first(count);
  WeightBound weights(chain, mixture, roundings, splats);
  const SliceBound slices(chain, mixture, roundings);
  double touched = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    weights.begin(i);
    const driver::Extent& box = extents[i] = weights.extent();
    first[i] = slices.first(splats.known.splats[i], splats.known.shape(i));
    const auto inside = [](int from, int to, int end) { return std::max(0, std::min(to, end) - std::max(from, 0)); };
    touched += static_cast<double>(inside(box.x0, box.x1, width)) * inside(box.y0, box.y1, height);
  }
  const bool samples = driver::every_sample(scene.description);
  const bool densities = chain.holds_densities();
  const int sheets = samples ? 1 : chain.steps().sheets();
  const driver::TileGrid bands = stages::band_grid(
      chain.config(), width, height, rows_of_band(samples ? touched / height : static_cast<double>(sheets) * width));
  const stages::BandBins bins(
      bands, sheets, count, threads,
      [&](std::size_t i) { return densities ? driver::widened(extents[i], stages::DensityBand::kHalo) : extents[i]; },
      [&](std::size_t i) { return first[i]; });

  Bound out{{width, height, std::vector<Sums>(static_cast<std::size_t>(width) * height)}, {}};
  std::vector<Terms> terms(static_cast<std::size_t>(bands.count()));
  parallel_for(bins.work(), threads, [&](std::size_t number) {
    const int band = static_cast<int>(number);
    const golden::Rows rows{bands.y(band), bands.y(band) + bands.height(band)};
    const auto take = [&](auto sweep) {
      sweep.run(bins, band);
      Sums* to = &out.greatest.pixels[static_cast<std::size_t>(rows.first) * width];
      for (const PixelBound& pixel : sweep.pixels()) *to++ = pixel.greatest;
      terms[number] = sweep.terms();
    };
    if (densities) {
      take(DensityBoundBand(chain, mixture, device, roundings, splats, rows, width));
    } else {
      take(BoundBand(chain, mixture, roundings, splats, rows, width));
    }
  });

  // Adds the known part, saturation of an X-ray's sums or of composited colours, and rounding and saturation of output
  // words.
  const stages::Picture there = chain(mixture, threads);
  const double values = 4.0 * static_cast<double>(real.pixels.size());
  for (const Terms& band : terms) {
    for (std::size_t t = 0; t < kTermCount; ++t) out.mean[t] += band[t] / values;
  }
  // Golden's own pictures are floats behind the gradient.
  const double slack = kSlack + (densities && mixture == stages::Mixture{} ? chain.densities().golden_error() : 0.0);
  const double largest =
      scene.description.method == scene::Method::XRay ? roundings.largest_sum : roundings.largest_light;
  for (std::size_t i = 0; i < real.pixels.size(); ++i) {
    for (std::size_t c = 0; c < 4; ++c) {
      double& most = out.greatest.pixels[i][c];
      const double exact = std::abs(there.pixels[i][c] - real.pixels[i][c]);
      most += std::max(0.0, there.pixels[i][c] + most - largest);
      most += roundings.pixel + std::max(0.0, there.pixels[i][c] + most + roundings.pixel - roundings.largest_pixel);
      most += exact + slack;
      // An output word lies between 0 and the largest one.
      const double wanted = real.pixels[i][c];
      most = std::min(most, std::max(wanted, roundings.largest_pixel - wanted) + kSlack);
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
