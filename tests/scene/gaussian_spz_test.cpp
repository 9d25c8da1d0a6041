// SPDX-License-Identifier: Apache-2.0
// SPZ of versions 2, 3 and 4: packed here by an independent rule and read to within its steps; written; damaged.
#include <gtest/gtest.h>
#include <zstd.h>

#include <cmath>
#include <cstdio>

#include "base/error.hpp"
#include "scene/gaussians/gaussian_file.hpp"
#include "scene/gaussians/harmonics.hpp"
#include "scene/gaussians/synthetic_gaussians.hpp"
#include "tests/scene/gaussian_helper.hpp"

namespace fastsplat::scene {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string zstd(const std::string& bytes) {
  std::string out(ZSTD_compressBound(bytes.size()), '\0');
  out.resize(ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), 3));
  return out;
}
std::uint64_t rounded(double value, double most) {
  return static_cast<std::uint64_t>(std::clamp(std::floor(value + 0.5), 0.0, most));
}

struct Parts {
  std::string position, opacity, colour, scale, rotation, harmonics;
  std::string all() const { return position + opacity + colour + scale + rotation + harmonics; }
};
constexpr int kBits = 12;

/// x right, y up, z back: y and z of PLY's axes change sign, and with them all that is odd in one of them.
Parts parts_of(const GaussianCloud& cloud, int version) {
  Parts parts;
  for (std::size_t i = 0; i < cloud.gaussians.size(); ++i) {
    const Gaussian& one = cloud.gaussians[i];
    const auto harmonics = cloud.harmonics_of(i);
    for (int axis = 0; axis < 3; ++axis) {
      const double flip = axis == 0 ? 1.0 : -1.0;
      parts.position += number(
          static_cast<std::uint64_t>(std::lround(flip * double(one.position[axis]) * (1 << kBits))) & 0xFFFFFFU, 3);
      parts.scale += number(rounded(16.0 * (std::log(double(one.scale[axis])) + 10.0), 255.0), 1);
      parts.colour += number(rounded(255.0 * (0.5 + 0.15 * double(harmonics[0][axis])), 255.0), 1);
    }
    parts.opacity += number(rounded(255.0 * double(one.opacity), 255.0), 1);
    double turn[4]{double(one.rotation[1]), -double(one.rotation[2]), -double(one.rotation[3]),
                   double(one.rotation[0])};
    if (version == 2) {
      for (int k = 0; k < 3; ++k)
        parts.rotation += number(rounded(127.5 + (turn[3] < 0.0 ? -127.5 : 127.5) * turn[k], 255.0), 1);
    } else {
      unsigned largest = 0;
      for (unsigned k = 1; k < 4; ++k)
        if (std::abs(turn[k]) > std::abs(turn[largest])) largest = k;
      std::uint64_t word = largest;
      for (unsigned k = 0; k < 4; ++k) {
        if (k == largest) continue;
        const bool negative = (turn[k] < 0.0) != (turn[largest] < 0.0);
        word = word << 10U | (negative ? 512U : 0U) | rounded(511.0 * std::abs(turn[k]) * std::sqrt(2.0), 511.0);
      }
      parts.rotation += number(word, 4);
    }
    for (std::size_t k = 1; k < harmonics.size(); ++k) {
      // The sign by the harmonic itself, at a direction and at its flip.
      const auto at = harmonics_at(glm::normalize(glm::dvec3(0.3, 0.5, 0.7)));
      const auto flipped = harmonics_at(glm::normalize(glm::dvec3(0.3, -0.5, -0.7)));
      const double sign = at[k] * flipped[k] < 0.0 ? -1.0 : 1.0;
      for (int c = 0; c < 3; ++c)
        parts.harmonics += number(rounded(128.0 + 128.0 * sign * double(harmonics[k][c]), 255.0), 1);
    }
  }
  return parts;
}

std::string header(const GaussianCloud& cloud, int version, unsigned flags = 0, unsigned last = 0) {
  return "NGSP" + number(static_cast<unsigned>(version), 4) + number(cloud.gaussians.size(), 4) +
         number(static_cast<unsigned>(cloud.degree), 1) + number(kBits, 1) + number(flags, 1) + number(last, 1);
}
std::string spz(const GaussianCloud& cloud, int version, unsigned flags = 0, const std::string& records = "") {
  const Parts parts = parts_of(cloud, version);
  if (version < 4) return gzipped(header(cloud, version, flags) + parts.all() + records);
  std::string table, frames;
  for (const std::string* part :
       {&parts.position, &parts.opacity, &parts.colour, &parts.scale, &parts.rotation, &parts.harmonics}) {
    const std::string frame = zstd(*part);
    table += number(frame.size(), 8) + number(part->size(), 8);
    frames += frame;
  }
  return header(cloud, version, flags, 6) + number(32 + records.size(), 4) + std::string(12, '\0') + records + table +
         frames;
}

/// Half the steps of the format. A rotation of three rounded components and one derived: each off by half a step e, so
/// the fourth by at most 3 e (the largest is at least 1/2, the others at most 1/sqrt(2)) and 1 - cos by 6 e^2; three
/// bytes without the largest component derive a w that may be 0, where it is off by sqrt(3 x 2 e).
Apart half_steps(int version) {
  const double e = version == 2 ? 1.0 / 255.0 : 0.5 * M_SQRT1_2 / 511.0;
  return {.position = std::ldexp(0.5, -kBits),
          .scale = 0.5 / 16.0,
          .rotation = version == 2 ? 3.0 * e + 2.0 * e * e : 6.0 * e * e,
          .opacity = 0.5 / 255.0,
          .colour = kConstantHarmonic / 0.15 * 0.5 / 255.0,
          .harmonic = 0.5 / 128.0,
          .harmonics = 0.5 / 128.0};
}
void expect_within(const Apart& off, const Apart& most) {
  constexpr double kFloat = 1e-6;
  EXPECT_LE(off.position, most.position + kFloat);
  EXPECT_LE(off.scale, most.scale + kFloat);
  EXPECT_LE(off.rotation, most.rotation + kFloat);
  EXPECT_LE(off.opacity, most.opacity + kFloat);
  EXPECT_LE(off.colour, most.colour + kFloat);
  EXPECT_LE(off.harmonic, most.harmonic + kFloat);
  EXPECT_LE(off.harmonics, most.harmonics + kFloat);
}

TEST(Spz, IsReadToWithinItsSteps) {
  for (const char* name : {"shells:300", "cloud:300"}) {
    for (const int version : {2, 3, 4}) {
      const GaussianCloud cloud = make_synthetic_gaussians(name);
      const TestFile file(".dat", spz(cloud, version));  // by content
      const GaussianCloud read = load_gaussians(file.path());
      EXPECT_THAT(read.remarks, ElementsAre());
      EXPECT_FALSE(read.antialiased);
      const Apart off = apart(cloud, read);
      print(std::string(name) + ", version " + std::to_string(version), off);
      expect_within(off, half_steps(version));
      EXPECT_GT(off.position, 0.1 * half_steps(version).position);
    }
  }
}

// Written with fewer bits of harmonics, so that the file compresses: 5 for degree 1, 4 above.
TEST(Spz, IsWrittenToWithinItsSteps) {
  for (const char* name : {"shells:300", "cloud:300"}) {
    GaussianCloud cloud = make_synthetic_gaussians(name);
    cloud.antialiased = true;
    const TestFile file(".spz", "");
    save_gaussians(cloud, file.path());
    const GaussianCloud read = load_gaussians(file.path());
    EXPECT_TRUE(read.antialiased);
    const Apart off = apart(cloud, read);
    print(std::string(name) + ", written", off);
    Apart most = half_steps(3);
    most.harmonic = 4.5 / 128.0, most.harmonics = 8.5 / 128.0;
    expect_within(off, most);
    std::printf("[figure] %s: bytes a Gaussian = %.1f\n", name, double(bytes_of(file.path()).size()) / 300.0);
    // What was read is what the next file holds; of two equal components another may be left out.
    save_gaussians(read, file.path());
    const Apart again = apart(read, load_gaussians(file.path()));
    expect_within(again, {.rotation = half_steps(3).rotation});
    EXPECT_EQ(again.harmonic + again.harmonics + again.opacity + again.position, 0.0);
  }
}

TEST(Spz, FarPositionsTakeCoarserSteps) {
  GaussianCloud cloud = make_synthetic_gaussians("cloud:20");
  cloud.gaussians[3].position.x = 20000.3F;
  const TestFile file(".spz", "");
  save_gaussians(cloud, file.path());
  const double off = apart(cloud, load_gaussians(file.path())).position;
  std::printf("[figure] at 20000: position %.3g\n", off);
  EXPECT_LE(off, std::ldexp(0.5, -8) + 1e-3);  // 2^23 / 2^8 = 32768; and a float's own step at 20000
  cloud.gaussians[3].position.x = 2e7F;
  EXPECT_THAT([&] { save_gaussians(cloud, file.path()); }, ::testing::ThrowsMessage<UserError>(HasSubstr("too far")));
}

TEST(Spz, ExtensionsAndDegreeFour) {
  const GaussianCloud cloud = make_synthetic_gaussians("cloud:20");
  const std::string camera = number(0xADBE0002U, 4) + number(12, 4) + std::string(12, '\7');
  for (const int version : {2, 3, 4}) {
    // The file's axes are those of PLY, 6, so it is as if read twice.
    for (const unsigned axes : {0U, 4U, 6U}) {
      const TestFile file(".spz",
                          spz(cloud, version, 2, camera + number(0xADBE0003U, 4) + number(4, 4) + number(axes, 4)));
      const GaussianCloud read = load_gaussians(file.path());
      EXPECT_THAT(read.remarks, ElementsAre(HasSubstr("1 extension records")));
      const float sign = axes == 6 ? -1.0F : 1.0F;
      EXPECT_NEAR(read.gaussians[5].position.z, sign * cloud.gaussians[5].position.z, 1e-3F);
      EXPECT_NEAR(read.gaussians[5].position.x, cloud.gaussians[5].position.x, 1e-3F);
    }
    EXPECT_THAT(refusal_of(".spz", spz(cloud, version, 2, number(0xADBE0003U, 4) + number(4, 4) + number(9, 4))),
                HasSubstr("axes"));
    EXPECT_THAT(refusal_of(".spz", spz(cloud, version, 2, number(1, 4) + number(99, 4) + "abc")), HasSubstr("record"));
  }
  GaussianCloud four = cloud;
  four.degree = 4;
  Parts parts = parts_of(cloud, 3);
  parts.harmonics.assign(20 * 72, '\x80');
  const TestFile file(".spz", gzipped(header(four, 3) + parts.all()));
  const GaussianCloud read = load_gaussians(file.path());
  EXPECT_EQ(read.degree, 3);
  EXPECT_THAT(read.remarks, ElementsAre(HasSubstr("degree 4")));
}

TEST(Spz, DamageIsNamed) {
  const GaussianCloud cloud = make_synthetic_gaussians("cloud:300");
  const Parts parts = parts_of(cloud, 3);
  const std::string head = header(cloud, 3), packed = spz(cloud, 3), four = spz(cloud, 4);
  const auto with = [&](std::size_t at, const std::string& bytes) {
    return gzipped(patched(head, at, bytes) + parts.all());
  };
  const struct {
    std::string bytes;
    const char* said;
  } files[] = {
      {with(4, number(1, 4)), "unsupported version"},
      {with(4, number(9, 4)), "unsupported version"},
      {with(8, number(0, 4)), "no Gaussians"},
      {with(8, number(301, 4)), "shorter than its header"},
      {with(8, number(0xFFFFFFFFU, 4)), "more Gaussians than it can hold"},
      {with(12, number(5, 1)), "degree"},
      {with(12, number(2, 1)), "shorter than its header"},
      {with(13, number(24, 1)), "fraction bits"},
      {with(4, number(4, 4)), "does not match the compression"},
      {gzipped(head.substr(0, 12)), "header"},
      {packed.substr(0, packed.size() / 2), "truncated"},
      {packed.substr(0, 12), "truncated"},  // before the first unpacked byte
      {patched(packed, 10, std::string(40, '\xFF')), "damaged"},
      {patched(packed, packed.size() / 2, std::string(40, '\xFF')), "damaged"},
      {gzipped(head + std::string(3, '\0')), "shorter than its header"},
      // A bomb: a small file of zeros that says it is a scene.
      {gzipped(patched(head, 8, number(9'000'000, 4)) + std::string(20'000'000, '\0')),
       "more Gaussians than it can hold"},
      {four.substr(0, 20), "header"},
      {patched(four, 15, number(4, 1)), "number of packed parts"},
      {patched(four, 16, number(0xFFFFFFF0U, 4)), "outside the file"},
      {patched(four, 16, number(4, 4)), "outside the file"},
      {patched(four, 32, number(~std::uint64_t{0}, 8)), "shorter than its table"},
      {patched(four, 40, number(std::uint64_t{1} << 60U, 8)), "wrong size"},
      {patched(four, 8, number(299, 4)), "wrong size"},
      {patched(four, 32 + 96 + 40, std::string(40, '\xFF')), "damaged"},
      {patched(four, 32 + 96, std::string(4, '\0')), "no frame"},
      {patched(four, 4, number(3, 4)), "does not match the compression"},
  };
  for (const auto& one : files) EXPECT_THAT(refusal_of(".spz", one.bytes), HasSubstr(one.said));
  int refused = 0;
  for (const std::string& whole : {packed, four})
    for (std::size_t size = 5; size + 20 < whole.size(); size += 211) {
      const TestFile file(".spz", whole.substr(0, size));
      EXPECT_THROW(load_gaussians(file.path()), UserError) << size;
      ++refused;
    }
  std::printf("[figure] cut files refused = %d\n", refused);
}

}  // namespace
}  // namespace fastsplat::scene
