// SPDX-License-Identifier: Apache-2.0
// Textured splats: detail that changes nothing else, cycles, and no effect when off, to the last bit.
#include "scene/textured_splats.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.hpp"
#include "scenes_helper.hpp"

namespace fastsplat::golden::testing {
namespace {

using scene::Method;

constexpr int kSplatPhases = 8;
const scene::SplatTexture kTexture{.phases = kSplatPhases, .amplitude = 0.8, .frame = 0, .scale = 0.4};

Lattice block() {
  Lattice lattice;
  lattice.dims = glm::ivec3(16);
  lattice.optical_depth = 0.2;
  lattice.azimuth = 30;
  lattice.elevation = 20;
  lattice.pixels_per_mm = 8;
  return lattice;
}

Image textured(Method method, const scene::SplatTexture& texture, int threads = 0) {
  scene::Scene scene = make_scene(block());
  scene.description.method = method;
  scene.description.footprint.texture = texture;
  return render(scene, {.threads = threads, .progress = {}});
}

scene::SplatTexture at_frame(int frame) {
  auto texture = kTexture;
  texture.frame = frame;
  return texture;
}

// N-8-32, N-8-33 and N-8-35: values that were computed from the page alone.
TEST(TexturedSplats, PlacesAndSamplesAreThePages) {
  const scene::Kernel kernel(2.0, 2.0);
  const glm::vec3 places[] = {{0.5F, -1.5F, 2.0F}, {-3.25F, 0.0F, 7.5F}, {10.0F, 20.0F, -30.0F}};
  constexpr std::uint32_t kHashes[] = {814672935, 3251535873, 2184589110};
  for (const int frame : {0, 5}) {
    const scene::TexturedSplats textures({.phases = 12, .amplitude = 0.8, .frame = frame, .scale = 0.4}, kernel);
    for (std::size_t i = 0; i < std::size(places); ++i)
      EXPECT_EQ(textures.number_of(places[i]), (std::uint64_t{kHashes[i]} + static_cast<std::uint64_t>(frame)) % 12)
          << i;
  }
  const scene::TexturedSplats textures({.phases = 5, .amplitude = 0.8, .frame = 0, .scale = 1.5}, kernel);
  EXPECT_EQ(textures.phases().front().side(), 32);
  const struct {
    std::size_t phase;
    double u, v, value;
  } samples[] = {
      {0, 0.3, -0.7, 0.204018041974213}, {2, -1.1, 0.4, 0.128062253873507}, {4, 1.9, 1.2, 0.643594082957448}};
  double worst = 0.0;
  for (const auto& [phase, u, v, value] : samples)
    worst = std::max(worst, std::abs(textures.phases()[phase](u, v) - value));
  std::printf("[figure] phases against the page: %.2g (limit 1e-12)\n", worst);
  EXPECT_LT(worst, 1e-12);
}

// N-8-34, and N-8-35 at the samples.
TEST(TexturedSplats, PhasesCancelAndCarryNoEnergy) {
  const scene::Kernel kernel(2.0, 2.0);
  double cycle = 0.0, energy = 0.0, largest = 0.0;
  int sums = 0;
  for (const int count : {2, 8, 24}) {
    auto settings = kTexture;
    settings.phases = count;
    const scene::TexturedSplats textures(settings, kernel);
    ASSERT_EQ(textures.phases().size(), static_cast<std::size_t>(count));
    const int side = textures.phases().front().side();
    const auto place = [side](int i) { return 2.0 * (2.0 * i / (side - 1) - 1.0); };
    std::vector<double> on_average(count, 0.0);
    double total = 0.0;
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        const double weight = kernel.footprint(place(x) * place(x) + place(y) * place(y));
        double sum = 0.0;
        for (int i = 0; i < count; ++i) {
          const double t = textures.phases()[i](place(x), place(y));
          sum += t;
          on_average[i] += weight * t;
          largest = std::max(largest, std::abs(t));
        }
        cycle = std::max(cycle, std::abs(sum));
        total += weight;
        ++sums;
      }
    }
    for (const double value : on_average) energy = std::max(energy, std::abs(value / total));
  }
  ASSERT_GT(sums, 1000);
  // Rounding of up to 24 values of at most 1, and of sums over side^2 samples.
  figure("texture_sum_over_cycle", cycle, "0, below 1e-13");
  figure("texture_energy_of_a_phase", energy, "0, below 1e-13");
  figure("texture_largest", largest, "1");
  EXPECT_LT(cycle, 1e-13);
  EXPECT_LT(energy, 1e-13);
  EXPECT_NEAR(largest, 1.0, 1e-12);
}

TEST(TexturedSplats, MeanOverTheCycleIsThePlainSplat) {
  const Image plain = textured(Method::XRay, {});
  std::vector<double> mean(plain.data.size(), 0.0);
  for (int frame = 0; frame < kSplatPhases; ++frame) {
    const Image image = textured(Method::XRay, at_frame(frame));
    EXPECT_NE(image, plain);
    for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += image.data[i] / static_cast<double>(kSplatPhases);
  }
  // Sums are linear in the footprints. The remaining errors are one rounding to float in each picture and one in the
  // plain picture. Each is at most half an ulp of the value, which is at most (1 + m) times the plain one.
  double worst = 0.0;
  int compared = 0;
  for (std::size_t i = 0; i < mean.size(); ++i) {
    if (plain.data[i] == 0.0f) continue;
    worst = std::max(
        worst, std::abs(mean[i] - plain.data[i]) / (std::ldexp(1.0, -24) * (2.0 + kTexture.amplitude) * plain.data[i]));
    ++compared;
  }
  ASSERT_GT(compared, 10000);
  figure("texture_cycle_mean_against_plain", worst, "of the roundings' bound, at most 1");
  EXPECT_LE(worst, 1.0);
}

using Plane = std::vector<double>;

/// Separable Gaussian, zero outside.
Plane blurred(const Plane& in, int width, double sigma) {
  const int reach = static_cast<int>(std::ceil(4.0 * sigma));
  std::vector<double> weights;
  double total = 0.0;
  for (int i = -reach; i <= reach; ++i) total += weights.emplace_back(std::exp(-0.5 * i * i / (sigma * sigma)));
  const int height = static_cast<int>(in.size()) / width;
  const auto pass = [&](const Plane& from, int dx, int dy) {
    Plane to(from.size(), 0.0);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        for (int i = -reach; i <= reach; ++i) {
          const int u = x + i * dx, v = y + i * dy;
          if (u >= 0 && u < width && v >= 0 && v < height)
            to[y * width + x] += weights[i + reach] / total * from[v * width + u];
        }
      }
    }
    return to;
  };
  return pass(pass(in, 1, 0), 0, 1);
}

Plane opacity_of(const Image& image) {
  Plane plane;
  for (std::size_t i = 3; i < image.data.size(); i += 4) plane.push_back(image.data[i]);
  return plane;
}

// High: the part that a blur of half a kernel unit removes. Low: the part that a blur of three half units leaves. In
// the middle of the picture, with the block on all sides.
TEST(TexturedSplats, DetailRisesAndTheLowBandStays) {
  const Lattice lattice = block();
  const int width = lattice.width;
  const double sigma = 1.5 * lattice.pixels_per_mm;
  const Image plain_image = textured(Method::XRay, {});
  const Plane plain = opacity_of(plain_image), with = opacity_of(textured(Method::XRay, kTexture));
  const Plane plain_low = blurred(plain, width, sigma), with_low = blurred(with, width, sigma);
  const Plane plain_soft = blurred(plain, width, sigma / 3.0), with_soft = blurred(with, width, sigma / 3.0);
  double low_change = 0.0, plain_high = 0.0, with_high = 0.0, level = 0.0;
  int pixels = 0;
  for (int y = width / 2 - 24; y < width / 2 + 24; ++y) {
    for (int x = width / 2 - 24; x < width / 2 + 24; ++x, ++pixels) {
      const int i = y * width + x;
      low_change += std::pow(with_low[i] - plain_low[i], 2);
      plain_high += std::pow(plain[i] - plain_soft[i], 2);
      with_high += std::pow(with[i] - with_soft[i], 2);
      level += plain_low[i];
    }
  }
  level /= pixels;

  // The low band's change if the splats' phases are independent. Each splat adds m (G * F t_i), with G the blur. A
  // pixel has as many splats as its ray passes voxels per square pixel.
  const scene::Kernel kernel(lattice.a, lattice.radius);
  const scene::TexturedSplats textures(kTexture, kernel);
  const double s = lattice.pixels_per_mm;
  double per_splat = 0.0;
  for (const scene::TexturePhase& phase : textures.phases()) {
    Plane one(static_cast<std::size_t>(width) * width, 0.0);
    for (int y = 0; y < width; ++y) {
      for (int x = 0; x < width; ++x) {
        const double u = (x - 64) / s, v = (y - 64) / s;
        if (u * u + v * v < 4.0) one[y * width + x] = kernel.footprint(u * u + v * v) * phase(u, v);
      }
    }
    for (const double value : blurred(one, width, sigma)) per_splat += value * value / kSplatPhases;
  }
  const double voxels_on_a_ray = level / lattice.optical_depth;
  const double expected = kTexture.amplitude * std::sqrt(per_splat / (s * s) / voxels_on_a_ray);
  const double change = std::sqrt(low_change / pixels) / level;
  figure("texture_high_band_energy_ratio", with_high / plain_high, "at least 2");
  figure("texture_low_band_change_expected", expected, "of its level, rms; below 0.005");
  figure("texture_low_band_change", change, "of its level, rms; at most twice the expected");
  EXPECT_GE(with_high / plain_high, 2.0);
  EXPECT_LT(expected, 0.005);
  EXPECT_LE(change, 2.0 * expected);
}

TEST(TexturedSplats, AmplitudeZeroIsOffToTheLastBit) {
  int compared = 0;
  for (const Method method : {Method::XRay, Method::Westover, Method::AxisAligned, Method::ImageAligned}) {
    auto silent = at_frame(5);
    silent.amplitude = 0.0;
    EXPECT_EQ(textured(method, silent), textured(method, {}));
    EXPECT_NE(textured(method, kTexture), textured(method, {})) << "the texture does nothing";
    ++compared;
  }
  EXPECT_EQ(compared, 4);
}

TEST(TexturedSplats, StandStillUnlessCycledAndComeBack) {
  const Image first = textured(Method::ImageAligned, at_frame(3));
  EXPECT_EQ(textured(Method::ImageAligned, at_frame(3)), first);
  EXPECT_EQ(textured(Method::ImageAligned, at_frame(3 + kSplatPhases)), first);
  EXPECT_EQ(textured(Method::ImageAligned, at_frame(3 + 1000 * kSplatPhases)), first);
  EXPECT_NE(textured(Method::ImageAligned, at_frame(4)), first);
}

TEST(TexturedSplats, AnyNumberOfThreadsGivesTheSameBits) {
  for (const Method method : {Method::XRay, Method::Westover, Method::ImageAligned}) {
    const Image one = textured(method, kTexture, 1);
    for (const int threads : {2, 3, 7}) EXPECT_EQ(textured(method, kTexture, threads), one);
  }
}

TEST(TexturedSplats, TheRayCasterHasNoTextures) { EXPECT_THROW(textured(Method::RayCast, kTexture), UserError); }

}  // namespace
}  // namespace fastsplat::golden::testing
