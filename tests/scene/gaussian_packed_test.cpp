// SPDX-License-Identifier: Apache-2.0
// Compressed PLY as SuperSplat writes it: packed here by an independent rule, and read to within its steps.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdio>

#include "base/error.hpp"
#include "scene/gaussians/gaussian_file.hpp"
#include "scene/gaussians/harmonics.hpp"
#include "scene/gaussians/morton_order.hpp"
#include "scene/gaussians/synthetic_gaussians.hpp"
#include "tests/scene/gaussian_helper.hpp"

namespace fastsplat::scene {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr std::size_t kTogether = 256;  // Gaussians of a chunk

void put(std::string& to, std::uint32_t word) {
  for (unsigned shift = 0; shift < 32; shift += 8) to.push_back(static_cast<char>((word >> shift) & 0xFFU));
}
std::uint32_t step(double value, double low, double high, unsigned bits) {
  const double most = (1U << bits) - 1U;
  return static_cast<std::uint32_t>(std::lround(high > low ? (value - low) / (high - low) * most : 0.0));
}
std::uint32_t three(const glm::dvec3& value, const glm::dvec3& low, const glm::dvec3& high) {
  return step(value.x, low.x, high.x, 11) << 21U | step(value.y, low.y, high.y, 10) << 11U |
         step(value.z, low.z, high.z, 11);
}
std::uint32_t turn(const glm::vec4& rotation) {
  int largest = 0;
  for (int i = 1; i < 4; ++i)
    if (std::abs(rotation[i]) > std::abs(rotation[largest])) largest = i;
  const double sign = rotation[largest] < 0.0F ? -1.0 : 1.0;
  auto word = static_cast<std::uint32_t>(largest);
  for (int i = 0; i < 4; ++i)
    if (i != largest) word = word << 10U | step(sign * double(rotation[i]), -M_SQRT1_2, M_SQRT1_2, 10);
  return word;
}
glm::dvec3 logarithms(const Gaussian& one) { return glm::log(glm::dvec3(one.scale)); }
glm::dvec3 colour_of(const GaussianCloud& cloud, std::size_t i) {
  return 0.5 + kConstantHarmonic * glm::dvec3(cloud.harmonics_of(i)[0]);
}

struct Sizes {
  bool coloured = true;  ///< chunks bound their colours, as newer files do
  std::string comment{};
};

std::string packed(const GaussianCloud& cloud, const Sizes& sizes = {}) {
  const std::size_t count = cloud.gaussians.size(), chunks = (count + kTogether - 1) / kTogether;
  std::string header =
      "ply\nformat binary_little_endian 1.0\n" + sizes.comment + "element chunk " + std::to_string(chunks) + "\n";
  for (const char* name : {"min_x", "min_y", "min_z", "max_x", "max_y", "max_z", "min_scale_x", "min_scale_y",
                           "min_scale_z", "max_scale_x", "max_scale_y", "max_scale_z"})
    header += std::string("property float ") + name + "\n";
  for (const char* name : {"min_r", "min_g", "min_b", "max_r", "max_g", "max_b"})
    if (sizes.coloured) header += std::string("property float ") + name + "\n";
  header += "element vertex " + std::to_string(count) + "\n";
  for (const char* name : {"position", "rotation", "scale", "color"})
    header += std::string("property uint packed_") + name + "\n";
  const int rest = harmonic_count(cloud.degree) - 1;
  if (rest > 0) header += "element sh " + std::to_string(count) + "\n";
  for (int i = 0; i < 3 * rest; ++i) header += "property uchar f_rest_" + std::to_string(i) + "\n";

  std::string bounds, words, bytes;
  for (std::size_t first = 0; first < count; first += kTogether) {
    glm::dvec3 low[3]{glm::dvec3(1e9), glm::dvec3(1e9), glm::dvec3(sizes.coloured ? 1e9 : 0.0)};
    glm::dvec3 high[3]{glm::dvec3(-1e9), glm::dvec3(-1e9), glm::dvec3(sizes.coloured ? -1e9 : 1.0)};
    const std::size_t end = std::min(first + kTogether, count);
    for (std::size_t i = first; i < end; ++i) {
      const glm::dvec3 values[3]{glm::dvec3(cloud.gaussians[i].position), logarithms(cloud.gaussians[i]),
                                 colour_of(cloud, i)};
      for (int k = 0; k < (sizes.coloured ? 3 : 2); ++k)
        low[k] = glm::min(low[k], values[k]), high[k] = glm::max(high[k], values[k]);
    }
    for (int k = 0; k < (sizes.coloured ? 3 : 2); ++k)
      for (const glm::dvec3& end_of : {low[k], high[k]})
        for (int axis = 0; axis < 3; ++axis)
          put(bounds, std::bit_cast<std::uint32_t>(static_cast<float>(end_of[axis])));
    for (std::size_t i = first; i < end; ++i) {
      const Gaussian& one = cloud.gaussians[i];
      put(words, three(glm::dvec3(one.position), low[0], high[0]));
      put(words, turn(one.rotation));
      put(words, three(logarithms(one), low[1], high[1]));
      const glm::dvec3 colour = colour_of(cloud, i);
      std::uint32_t word = 0;
      for (int c = 0; c < 3; ++c) word = word << 8U | step(colour[c], low[2][c], high[2][c], 8);
      put(words, word << 8U | step(double(one.opacity), 0.0, 1.0, 8));
      for (int c = 0; c < 3; ++c)
        for (const glm::vec3& harmonic : cloud.harmonics_of(i).subspan(1))
          bytes.push_back(static_cast<char>(static_cast<unsigned char>(
              std::clamp(std::floor((double(harmonic[c]) / 8.0 + 0.5) * 256.0), 0.0, 255.0))));
    }
  }
  return header + "end_header\n" + bounds + words + bytes;
}

/// Half steps: of 1023 over positions of -1.5 to 1.5 and logarithms that differ by at most 5, of 255 over 1 (and
/// colours a little beyond), of 256 over 8. Three components of a rotation each off by sqrt(2)/2046 and the fourth by
/// as much again: the angle between is below 4e-3, and 1 minus its cosine below 1e-5.
void expect_within_steps(const Apart& off) {
  EXPECT_LT(off.position, 3.2 / 2046.0);
  EXPECT_LT(off.scale, 5.0 / 2046.0);
  EXPECT_LT(off.rotation, 1e-5);
  EXPECT_LT(off.opacity, 0.51 / 255.0);
  EXPECT_LT(off.colour, 0.6 / 255.0);
  EXPECT_LE(std::max(off.harmonic, off.harmonics), 4.0 / 256.0 + 1e-6);
}

/// The order in which it is written.
GaussianCloud sorted(const GaussianCloud& cloud) {
  GaussianCloud out = cloud;
  out.gaussians.clear(), out.harmonics.clear();
  for (const std::size_t i : morton_order(cloud)) {
    out.gaussians.push_back(cloud.gaussians[i]);
    for (const glm::vec3& harmonic : cloud.harmonics_of(i)) out.harmonics.push_back(harmonic);
  }
  return out;
}

// 300 Gaussians: a whole chunk and a part of one.
TEST(PackedPly, IsReadToWithinItsSteps) {
  for (const char* name : {"shells:300", "cloud:300"}) {
    for (const bool coloured : {true, false}) {
      const GaussianCloud cloud = make_synthetic_gaussians(name);
      const TestFile file(".compressed.ply", packed(cloud, {.coloured = coloured}));
      const GaussianCloud read = load_gaussians(file.path());
      EXPECT_THAT(read.remarks, ElementsAre());
      ASSERT_EQ(read.gaussians.size(), 300U);
      ASSERT_EQ(read.degree, cloud.degree);
      const Apart off = apart(cloud, read);
      print(std::string(name) + (coloured ? ", coloured bounds" : ", plain bounds"), off);
      expect_within_steps(off);
    }
  }
}

// Written in Morton order; read back to within the steps of the bounds of each chunk, which are those of its Gaussians.
TEST(PackedPly, IsWrittenToWithinItsSteps) {
  for (const char* name : {"shells:700", "cloud:700"}) {
    GaussianCloud cloud = make_synthetic_gaussians(name);
    cloud.antialiased = true;
    const TestFile file(".compressed.ply", "");
    save_gaussians(cloud, file.path());
    const GaussianCloud read = load_gaussians(file.path());
    EXPECT_TRUE(read.antialiased);
    EXPECT_EQ(read.up, cloud.up);
    const Apart off = apart(sorted(cloud), read);
    print(std::string(name) + ", written", off);
    std::printf("[figure] %s: bytes a Gaussian = %.1f\n", name, double(bytes_of(file.path()).size()) / 700.0);
    expect_within_steps(off);
  }
}

// One Gaussian far away and one of absurd colour, and the widest and the narrowest: others lose what the page says.
TEST(PackedPly, OutliersHarmOnlyTheirChunk) {
  GaussianCloud cloud = make_synthetic_gaussians("cloud:6000");
  const auto each = static_cast<std::size_t>(harmonic_count(cloud.degree));
  cloud.gaussians[7].position.x = 1e30F;
  cloud.harmonics[9 * each].x = 1e30F;
  cloud.gaussians[11].scale = {1e30F, 0.0F, 1.0F};
  const TestFile file(".compressed.ply", "");
  const auto lost = lost_in_gaussian_file(cloud, file.path());
  for (const std::string& text : lost) std::printf("%s\n", text.c_str());
  ASSERT_EQ(lost.size(), 3U);
  EXPECT_THAT(lost[0], HasSubstr("holds scales from 2.06e-09 to 4.85e+08: those of 1 of 6000 Gaussians were clamped"));
  EXPECT_THAT(lost[1], HasSubstr("holds colours from -3.5 to 4.5: those of 1 of 6000 Gaussians were clamped"));
  EXPECT_THAT(lost[2], HasSubstr("Gaussians by more than their own size"));
  save_gaussians(cloud, file.path());
  const GaussianCloud read = load_gaussians(file.path()), wanted = sorted(cloud);
  std::size_t coarse = 0, moved = 0;
  double colour = 0.0, scale = 0.0;
  for (std::size_t i = 0; i < 6000; ++i) {
    const Gaussian &one = wanted.gaussians[i], &other = read.gaussians[i];
    const auto off = double(glm::distance(one.position, other.position));
    coarse += off > 3.2 / 1023.0 ? 1 : 0;
    moved += off > double(std::max({one.scale.x, one.scale.y, one.scale.z})) && off > 0.005 ? 1 : 0;
    if (one.scale.x < 1e20F) scale = std::max(scale, double(glm::length(glm::log(one.scale) - glm::log(other.scale))));
    const float ours = wanted.harmonics_of(i)[0].x, theirs = read.harmonics_of(i)[0].x;
    if (ours < 1e20F) colour = std::max(colour, kConstantHarmonic * std::abs(double(ours) - double(theirs)));
  }
  std::printf("[figure] coarse positions = %zu, moved = %zu, colour = %.2g, log scale = %.2g\n", coarse, moved, colour,
              scale);
  EXPECT_LT(coarse, kTogether);
  EXPECT_LE(moved, std::stoul(lost[2].substr(lost[2].find("moves ") + 6)));
  EXPECT_LE(std::stoul(lost[2].substr(lost[2].find("moves ") + 6)), coarse);
  EXPECT_LE(colour, 8.0 / 255.0);
  EXPECT_LE(scale, std::sqrt(3.0) * 40.0 / 1023.0);
}

// Neighbours of the curve are neighbours in space: steps between them add up to far less than in the order of the file.
// An outlier does not change that.
TEST(PackedPly, MortonOrderKeepsNeighboursTogether) {
  const GaussianCloud cloud = make_synthetic_gaussians("cloud:3000");
  GaussianCloud distant = cloud;
  distant.gaussians[7].position = glm::vec3(1e30F);
  const auto order = morton_order(distant);
  std::vector<bool> seen(order.size());
  double along = 0.0, before = 0.0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    seen[order[i]] = true;
    if (i == 0) continue;
    along += double(glm::distance(cloud.gaussians[order[i]].position, cloud.gaussians[order[i - 1]].position));
    before += double(glm::distance(cloud.gaussians[i].position, cloud.gaussians[i - 1].position));
  }
  EXPECT_TRUE(std::ranges::all_of(seen, [](bool one) { return one; }));
  std::printf("[figure] length along the curve = %.2f of that in the file's order\n", along / before);
  EXPECT_LT(along, 0.3 * before);
}

TEST(PackedPly, CommentsCountAsInOthers) {
  const TestFile file(".ply", packed(make_synthetic_gaussians("cloud:20"), {.comment = "comment Vertical Axis: x\n"}));
  EXPECT_EQ(load_gaussians(file.path()).up, UpAxis::X);
}

TEST(PackedPly, DamageIsNamed) {
  const std::string whole = packed(make_synthetic_gaussians("cloud:300"));
  const struct {
    std::string bytes;
    const char* said;
  } files[] = {
      {replaced(whole, "element chunk 2", "element chunk 1"), "chunks of 256"},
      {replaced(whole, "element chunk 2", "element chink 2"), "wrong elements"},
      {replaced(whole, "uint packed_scale", "int packed_scale"), "packed_scale"},
      {replaced(whole, "uint packed_scale", "uint packed_size"), "packed_scale"},
      {replaced(whole, "float max_scale_y", "float max_scala_y"), "max_scale_y"},
      {replaced(whole, "element sh 300", "element sh 299"), "sh rows"},
      {replaced(whole, "property uchar f_rest_8\n", ""), "9, 24 or 45"},
      {whole.substr(0, whole.size() - 1), "shorter"},
      {whole.substr(0, whole.size() - 3000), "shorter"},
      {whole + "x", "longer"},
      {replaced(whole, "element vertex 300", "element vertex 0"), "no Gaussian"},
  };
  for (const auto& one : files) {
    const TestFile file(".ply", one.bytes);
    try {
      load_gaussians(file.path());
      ADD_FAILURE() << one.said << ": it was taken";
    } catch (const UserError& error) {
      std::printf("%s\n", error.what());
      EXPECT_EQ(error.code(), ExitCode::Input);
      EXPECT_THAT(error.what(), AllOf(HasSubstr(file.path().string()), HasSubstr(one.said)));
    }
  }
}

}  // namespace
}  // namespace fastsplat::scene
