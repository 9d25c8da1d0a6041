// SPDX-License-Identifier: Apache-2.0
#include "golden/gaussians.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "golden/bands.hpp"
#include "golden/splat/composite.hpp"

namespace fastsplat::golden {
namespace {

using scene::ProjectedGaussian;

/// The picture's pixels strictly between `from` and `to`: [first, end).
struct Between {
  int first, end;
  Between(double from, double to, int least, int most)
      : first(static_cast<int>(std::clamp(std::floor(from) + 1.0, double(least), double(most)))),
        end(static_cast<int>(std::clamp(std::ceil(to), double(least), double(most)))) {}
};

/// For each band, the indices of the Gaussians that reach it, in order.
std::vector<std::vector<std::uint32_t>> bins_of(const std::vector<ProjectedGaussian>& splats, const Bands& bands,
                                                double cutoff) {
  std::vector<std::vector<std::uint32_t>> bins(static_cast<std::size_t>(bands.count()));
  for (std::uint32_t i = 0; i < splats.size(); ++i) {
    const double reach = cutoff * std::sqrt(splats[i].shape.yy);
    const Between rows(splats[i].y - reach, splats[i].y + reach, 0, bands.image_height);
    if (rows.first >= rows.end) continue;
    const int last = (rows.end - 1) / bands.rows_per_band;
    for (int band = rows.first / bands.rows_per_band; band <= last; ++band)
      bins[static_cast<std::size_t>(band)].push_back(i);
  }
  return bins;
}

/// The contribution of one Gaussian to one pixel.
struct Sample {
  double depth = 0.0, alpha = 0.0;
  glm::dvec3 colour{0.0};
};

/// Calls take(x, y, alpha) for every pixel of the rows inside the cutoff.
template <class Take>
void rasterise(const ProjectedGaussian& splat, double cutoff, const Rows& rows, int width, const Take& take) {
  const double a = splat.shape.yy / splat.shape.determinant(), b = -splat.shape.xy / splat.shape.determinant(),
               c = splat.shape.xx / splat.shape.determinant(), rim = cutoff * cutoff;
  const double reach = cutoff * std::sqrt(splat.shape.yy);
  const Between inside(splat.y - reach, splat.y + reach, rows.first, rows.end);
  for (int y = inside.first; y < inside.end; ++y) {
    const double dy = y - splat.y, square = (b * dy) * (b * dy) - a * (c * dy * dy - rim);
    if (!(square > 0.0)) continue;
    const double middle = splat.x - b * dy / a, half = std::sqrt(square) / a;
    const Between columns(middle - half - 1.0, middle + half + 1.0, 0, width);  // a pixel more: q decides
    for (int x = columns.first; x < columns.end; ++x) {
      const double dx = x - splat.x, q = a * dx * dx + 2.0 * b * dx * dy + c * dy * dy;
      if (q < rim) take(x, y, splat.opacity * std::exp(-0.5 * q));
    }
  }
}

void add(FrontToBack& pixel, double alpha, const glm::dvec3& colour) {
  pixel.add({alpha * colour.x, alpha * colour.y, alpha * colour.z, alpha});
}

}  // namespace

Image render_gaussians(const scene::GaussianScene& scene, const std::vector<ProjectedGaussian>& projected,
                       const GaussianOptions& options) {
  const int width = scene.camera.width(), height = scene.camera.height();
  const double cutoff = scene.description.cutoff;
  Image image(width, height);
  const Bands bands{height};
  const auto bins = bins_of(projected, bands, cutoff);
  std::vector<std::uint64_t> cost;
  for (const auto& bin : bins) cost.push_back(bin.size());

  std::atomic<std::uint64_t> composited = 0;
  for_each_band(cost, options.threads, options.progress, [&](int band) {
    const Rows rows = bands.rows(band);
    const auto pixels_of_band = static_cast<std::size_t>(rows.end - rows.first) * static_cast<std::size_t>(width);
    std::vector<FrontToBack> pixels(pixels_of_band);
    std::vector<std::vector<Sample>> samples(options.order == GaussianOrder::Pixels ? pixels_of_band : 0);
    std::uint64_t here = 0;
    for (const std::uint32_t i : bins[static_cast<std::size_t>(band)]) {
      const ProjectedGaussian& splat = projected[i];
      rasterise(splat, cutoff, rows, width, [&](int x, int y, double alpha) {
        const auto at =
            static_cast<std::size_t>(y - rows.first) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
        if (options.cap_samples) alpha = std::min(alpha, scene::kMostAlpha);
        if (options.order == GaussianOrder::Pixels) {
          samples[at].push_back({scene::depth_of_maximum(scene, splat, x, y), alpha, splat.colour});
        } else if (!(pixels[at].transmittance < scene::kFinished)) {
          add(pixels[at], alpha, splat.colour);
          ++here;
        }
      });
    }
    for (std::size_t at = 0; at < samples.size(); ++at) {
      std::ranges::stable_sort(samples[at], {}, &Sample::depth);
      for (const Sample& sample : samples[at]) {
        if (pixels[at].transmittance < scene::kFinished) break;
        add(pixels[at], sample.alpha, sample.colour);
        ++here;
      }
    }
    composited += here;
    float* out = image.pixel(0, rows.first);
    for (const FrontToBack& pixel : pixels) {
      pixel.store(out);
      out += image.channels;
    }
  });
  if (options.samples != nullptr) *options.samples = composited;
  return image;
}

}  // namespace fastsplat::golden
