// SPDX-License-Identifier: Apache-2.0
// .ksplat: packed here by an independent rule at its three levels, and read to within their steps.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdio>
#include <glm/gtc/packing.hpp>

#include "scene/gaussians/gaussian_file.hpp"
#include "scene/gaussians/harmonics.hpp"
#include "scene/gaussians/synthetic_gaussians.hpp"
#include "tests/scene/gaussian_helper.hpp"

namespace fastsplat::scene {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string real(float value) { return number(std::bit_cast<std::uint32_t>(value), 4); }
void put(std::string& to, std::size_t at, const std::string& bytes) { to.replace(at, bytes.size(), bytes); }

constexpr std::size_t kBucket = 32;
constexpr double kBlock = 4.0, kRange = 32767.0, kLeast = -1.25, kMost = 1.0;

/// Two sections, the second with room for more. Buckets of 32 and a last one of fewer, with centres of their own.
std::string ksplat(const GaussianCloud& cloud, int level) {
  const std::size_t split = cloud.gaussians.size() / 3, sections = 2;
  std::string file(4096 + sections * 1024, '\0'), data;
  put(file, 0, number(0, 1) + number(1, 1));
  put(file, 4,
      number(sections, 4) + number(sections, 4) + number(cloud.gaussians.size(), 4) +
          number(cloud.gaussians.size(), 4) + number(static_cast<unsigned>(level), 2));
  put(file, 36, real(static_cast<float>(kLeast)) + real(static_cast<float>(kMost)));
  const auto stored = [level](float value) { return level == 0 ? real(value) : number(glm::packHalf1x16(value), 2); };
  for (std::size_t s = 0; s < sections; ++s) {
    const std::size_t first = s == 0 ? 0 : split, end = s == 0 ? split : cloud.gaussians.size(), count = end - first;
    const std::size_t full = count / kBucket, partial = count % kBucket == 0 ? 0 : 1, room = count + 5 * s;
    const std::size_t head = 4096 + 1024 * s;
    put(file, head,
        number(count, 4) + number(room, 4) + number(kBucket, 4) + number(full + partial, 4) +
            real(static_cast<float>(kBlock)) + number(12, 2));
    put(file, head + 24, number(static_cast<std::uint64_t>(kRange), 4));
    put(file, head + 32, number(full, 4) + number(partial, 4) + number(static_cast<unsigned>(cloud.degree), 2));
    if (partial > 0) data += number(count % kBucket, 4);
    const auto centre = [](std::size_t bucket, int axis) {
      return static_cast<float>(0.01 * static_cast<double>(bucket) - 0.02 * axis);
    };
    for (std::size_t b = 0; b < full + partial; ++b)
      for (int axis = 0; axis < 3; ++axis) data += real(centre(b, axis));
    const std::size_t before = data.size();
    for (std::size_t i = first; i < end; ++i) {
      const Gaussian& one = cloud.gaussians[i];
      const auto harmonics = cloud.harmonics_of(i);
      for (int axis = 0; axis < 3; ++axis) {
        if (level == 0) {
          data += real(one.position[axis]);
          continue;
        }
        const double away = double(one.position[axis]) - double(centre((i - first) / kBucket, axis));
        data += number(static_cast<std::uint64_t>(std::lround(away / (kBlock / 2.0) * kRange + kRange)), 2);
      }
      for (int axis = 0; axis < 3; ++axis) data += stored(one.scale[axis]);
      for (int k = 0; k < 4; ++k) data += stored(one.rotation[k]);
      for (int c = 0; c < 3; ++c)
        data += number(static_cast<std::uint64_t>(std::clamp<long>(
                           std::lround(255.0 * (0.5 + kConstantHarmonic * double(harmonics[0][c]))), 0, 255)),
                       1);
      data += number(static_cast<std::uint64_t>(std::lround(255.0 * double(one.opacity))), 1);
      for (std::size_t degree = 1; degree <= static_cast<std::size_t>(cloud.degree); ++degree)
        for (int c = 0; c < 3; ++c)
          for (std::size_t k = degree * degree; k < (degree + 1) * (degree + 1); ++k)
            data += level < 2 ? stored(harmonics[k][c])
                              : number(static_cast<std::uint64_t>(
                                           std::lround((double(harmonics[k][c]) - kLeast) / (kMost - kLeast) * 255.0)),
                                       1);
    }
    data += std::string((data.size() - before) / count * (room - count), '\0');
  }
  return file + data;
}

TEST(Ksplat, IsReadToWithinItsSteps) {
  for (const char* name : {"shells:200", "cloud:200"}) {
    for (const int level : {0, 1, 2}) {
      const GaussianCloud cloud = make_synthetic_gaussians(name);
      const TestFile file(".dat", ksplat(cloud, level));  // by content
      const GaussianCloud read = load_gaussians(file.path());
      EXPECT_THAT(read.remarks, ElementsAre());
      const Apart off = apart(cloud, read);
      print(std::string(name) + ", level " + std::to_string(level), off);
      constexpr double single = 1e-6, half = 1.0 / 2048.0;  // a half has 11 bits
      EXPECT_LE(off.position, level == 0 ? 0.0 : 0.25 * kBlock / kRange + single);
      EXPECT_LE(off.scale, level == 0 ? single : half + single);
      EXPECT_LE(off.rotation, level == 0 ? single : 2.0 * half * half + single);
      EXPECT_LE(off.opacity, 0.5 / 255.0 + single);
      EXPECT_LE(off.colour, 0.5 / 255.0 + single);
      const double rest = std::max(off.harmonic, off.harmonics);
      EXPECT_LE(rest, level == 0 ? 0.0 : level == 1 ? 0.25 * half : 0.5 * (kMost - kLeast) / 255.0 + single);
    }
  }
}

TEST(Ksplat, DamageIsNamed) {
  const GaussianCloud cloud = make_synthetic_gaussians("cloud:200");
  const std::string whole = ksplat(cloud, 1);
  const std::size_t head = 4096, partial = 4096 + 2048;
  const struct {
    std::string bytes;
    const char* said;
  } files[] = {
      {whole.substr(0, 4000), "not a .ksplat file"},
      {whole.substr(0, 5000), "sections"},
      {whole.substr(0, whole.size() - 1), "shorter than section 1"},
      {patched(whole, 0, number(1, 1)), "not a .ksplat file"},
      {patched(whole, 4, number(60000, 4)), "60000 sections"},
      {patched(whole, 20, number(3, 2)), "not a .ksplat file"},
      {patched(whole, 16, number(199, 4)), "another number"},
      {patched(whole, head, number(67, 4)), "holds more than it has room for"},
      {patched(whole, head + 4, number(0xFFFFFFFFU, 4)), "shorter than section 0"},
      {patched(whole, head + 12, number(1, 4)), "holds more than it has room for"},
      {patched(whole, head + 12, number(0xFFFFFFFFU, 4)), "shorter than section 0"},
      {patched(whole, head + 20, number(4, 2)), "invalid buckets"},
      {patched(whole, head + 40, number(4, 2)), "degree of harmonics"},
      {patched(whole, head + 40, number(3, 2)), "shorter than section 1"},
      {patched(whole, partial, number(1, 4)), "too few Gaussians"},
      {patched(whole, head + 8, number(1, 4)), "too few Gaussians"},
  };
  for (const auto& one : files) EXPECT_THAT(refusal_of(".ksplat", one.bytes), HasSubstr(one.said));
}

}  // namespace
}  // namespace fastsplat::scene
