// SPDX-License-Identifier: Apache-2.0
// Valid files of 3-D Gaussians: every format and order of properties, round trips, and the shipped files.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/error.hpp"
#include "scene/gaussians/gaussian_file.hpp"
#include "scene/gaussians/synthetic_gaussians.hpp"
#include "tests/paths.hpp"
#include "tests/scene/gaussian_helper.hpp"

namespace fastsplat::scene {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kFloat = 1e-6;  // logarithms and logits there and back

/// The same Gaussians with `degree` of their harmonics.
GaussianCloud of_degree(const GaussianCloud& from, int degree) {
  GaussianCloud out = from;
  out.degree = degree;
  out.harmonics.clear();
  for (std::size_t i = 0; i < from.gaussians.size(); ++i) {
    const auto some = from.harmonics_of(i).first(static_cast<std::size_t>(harmonic_count(degree)));
    out.harmonics.insert(out.harmonics.end(), some.begin(), some.end());
  }
  return out;
}

TEST(GaussianFiles, AVolumeIsNamedAsOne) {
  const TestFile file(".nrrd", "NRRD0004\ntype: uint8\n");
  EXPECT_THAT([&] { load_gaussians(file.path()); },
              ::testing::ThrowsMessage<UserError>(::testing::HasSubstr("give it with --volume")));
}

TEST(GaussianPly, EveryFormatTypeAndDegree) {
  const GaussianCloud whole = make_synthetic_gaussians("shells:60");
  for (const int degree : {0, 1, 2, 3})
    for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"})
      for (const char* type : {"float", "double", "float32", "float64"}) {
        const TestFile file(".ply", table_of(of_degree(whole, degree)).text(format, type));
        EXPECT_LT(difference(load_gaussians(file.path()), of_degree(whole, degree)), kFloat)
            << format << ' ' << type << " degree " << degree;
      }
}

TEST(GaussianPly, PropertiesInAnyOrderAndOthersBetween) {
  const GaussianCloud cloud = make_synthetic_gaussians("cloud:40");
  PlyTable table = table_of(cloud);
  // In reverse, with two unused properties.
  std::ranges::reverse(table.names);
  table.names.insert(table.names.begin() + 5, "confidence");
  table.names.push_back("label");
  for (auto& row : table.rows) {
    std::ranges::reverse(row);
    row.insert(row.begin() + 5, 7.25);
    row.push_back(-1.0);
  }
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    const TestFile file(".ply", table.text(format, "float", "comment by hand\nobj_info none\n"));
    EXPECT_LT(difference(load_gaussians(file.path()), cloud), kFloat) << format;
  }
}

TEST(GaussianPly, OtherElementsAndTypesArePassedOver) {
  const TestFile file(".ply",
                      "ply\r\nformat ascii 1.0\r\nelement camera 2\r\nproperty uchar id\r\nproperty int x\r\n"
                      "element vertex 1\r\nproperty short x\r\nproperty int y\r\nproperty double z\r\n"
                      "property float opacity\r\nproperty float scale_0\r\nproperty float scale_1\r\n"
                      "property float scale_2\r\nproperty float rot_0\r\nproperty float rot_1\r\n"
                      "property float rot_2\r\nproperty float rot_3\r\nproperty float f_dc_0\r\n"
                      "property float f_dc_1\r\nproperty float f_dc_2\r\nelement face 1\r\n"
                      "property list uchar int vertex_indices\r\nend_header\r\n"
                      "1 2\r\n3 4\r\n-3 +70000 1e-1 0 0 0 0 0 0 0 2 1 1 1\r\n3 0 0 0\r\n");
  const GaussianCloud cloud = load_gaussians(file.path());
  ASSERT_EQ(cloud.gaussians.size(), 1U);
  EXPECT_EQ(cloud.gaussians[0].position, glm::vec3(-3.0F, 70000.0F, 0.1F));
  EXPECT_EQ(cloud.gaussians[0].scale, glm::vec3(1.0F));
  EXPECT_EQ(cloud.gaussians[0].opacity, 0.5F);
  EXPECT_EQ(cloud.gaussians[0].rotation, glm::vec4(0.0F, 0.0F, 0.0F, 1.0F));
}

TEST(GaussianPly, WrittenAndReadAgain) {
  for (const char* name : {"shells:200", "cloud:200"}) {
    const GaussianCloud cloud = make_synthetic_gaussians(name);
    for (const PlyText text : {PlyText::Binary, PlyText::Ascii}) {
      const TestFile file(".ply", "");
      save_gaussians(cloud, file.path(), text);
      const double worst = difference(load_gaussians(file.path()), cloud);
      figure(std::string(name) + (text == PlyText::Ascii ? ", ascii" : ", binary") + ": worst difference", worst);
      EXPECT_LT(worst, kFloat);
    }
  }
}

TEST(SplatFile, WrittenAndReadAgain) {
  const GaussianCloud cloud = make_synthetic_gaussians("cloud:300");
  const TestFile file(".splat", "");
  save_gaussians(cloud, file.path());
  EXPECT_EQ(std::filesystem::file_size(file.path()), 300U * 32U);
  const GaussianCloud read = load_gaussians(file.path());
  EXPECT_EQ(read.degree, 0);
  ASSERT_EQ(read.gaussians.size(), cloud.gaussians.size());
  double turn = 0.0, opacity = 0.0, colour = 0.0;
  for (std::size_t i = 0; i < read.gaussians.size(); ++i) {
    EXPECT_EQ(read.gaussians[i].position, cloud.gaussians[i].position);
    EXPECT_EQ(read.gaussians[i].scale, cloud.gaussians[i].scale);
    turn = std::max(turn, double(glm::distance(read.gaussians[i].rotation, cloud.gaussians[i].rotation)));
    opacity = std::max(opacity, std::abs(double(read.gaussians[i].opacity) - double(cloud.gaussians[i].opacity)));
    const glm::vec3 apart = read.harmonics_of(i)[0] - cloud.harmonics_of(i)[0];
    for (int c = 0; c < 3; ++c) colour = std::max(colour, std::abs(0.2820948 * double(apart[c])));
  }
  figure("rotation, bytes", turn);
  figure("opacity, bytes", opacity);
  figure("colour, bytes", colour);
  EXPECT_LT(turn, 2.0 / 128.0);
  EXPECT_LE(opacity, 0.5 / 255.0 + 1e-6);
  EXPECT_LE(colour, 0.5 / 255.0 + 1e-6);
  // A byte read and written again is unchanged.
  const std::string first = bytes_of(file.path());
  save_gaussians(read, file.path());
  EXPECT_LT(difference(load_gaussians(file.path()), read), 2.0 / 128.0);
  EXPECT_EQ(first.size(), bytes_of(file.path()).size());
}

// Each writer counts what it clamps.
TEST(GaussianFiles, ClampedValuesAreCounted) {
  GaussianCloud cloud = make_synthetic_gaussians("cloud:40");
  const auto each = static_cast<std::size_t>(harmonic_count(cloud.degree));
  const auto lost = [&cloud](const char* name) {
    std::string all;
    for (const std::string& text : lost_in_gaussian_file(cloud, name)) all += text + "\n";
    return all;
  };
  cloud.up = {}, cloud.antialiased = cloud.linear = false;
  for (const char* name : {"a.ply", "a.compressed.ply", "a.spz"}) EXPECT_EQ(lost(name), "") << name;
  EXPECT_THAT(lost("a.glb"), HasSubstr("declares the order by distance from the eye: add --order centres"));
  cloud.by_distance = true;
  EXPECT_EQ(lost("a.glb"), "");
  for (const char* name : {"a.ply", "a.spz", "a.splat"})
    EXPECT_THAT(lost(name), HasSubstr("declares the order by depth: add --order distance")) << name;
  cloud.by_distance = false;
  cloud.gaussians[3].scale.y = 0.0F;
  cloud.gaussians[4].scale.z = 1e12F;
  cloud.harmonics[5 * each].x = -20.0F;
  for (const std::size_t i : {6U, 7U, 8U}) cloud.harmonics[i * each + 3].z = 4.1F;
  const std::string packed = lost("a.compressed.ply"), spz = lost("a.spz"), splat = lost("a.splat");
  std::printf("%s%s%s%s", packed.c_str(), spz.c_str(), splat.c_str(), lost("a.ply").c_str());
  EXPECT_THAT(packed, HasSubstr("holds scales from 2.06e-09 to 4.85e+08: those of 2 of 40 Gaussians"));
  EXPECT_THAT(packed, HasSubstr("holds colours from -3.5 to 4.5: those of 1 of 40 Gaussians"));
  EXPECT_THAT(packed, HasSubstr("holds harmonics from -4 to 4: those of 3 of 40 Gaussians"));
  EXPECT_THAT(spz, HasSubstr("holds scales from 4.54e-05 to 379: those of 2 of 40 Gaussians"));
  EXPECT_THAT(spz, HasSubstr("holds colours from -0.44 to 1.44: those of 1 of 40 Gaussians"));
  EXPECT_THAT(spz, HasSubstr("holds harmonics from -1 to 0.992: those of 3 of 40 Gaussians"));
  EXPECT_THAT(splat, HasSubstr("holds colours from 0 to 1: those of 1 of 40 Gaussians"));
  EXPECT_THAT(splat, Not(HasSubstr("scales")));
  EXPECT_THAT(lost("a.ply"), HasSubstr("holds scales from 1e-10 to 3.4e+38: those of 1 of 40 Gaussians"));
  EXPECT_THAT(lost("a.glb"), Not(HasSubstr("clamped")));
  // What was read from a file, the same format holds.
  for (const char* ending : {".ply", ".compressed.ply", ".spz", ".splat"}) {
    const TestFile file(ending, "");
    save_gaussians(cloud, file.path());
    cloud = load_gaussians(file.path());
    EXPECT_THAT(lost(file.path().c_str()), Not(HasSubstr("clamped")));
  }
}

// A distant Gaussian leaves .spz few bits for the others' positions.
TEST(GaussianFiles, MovedGaussiansAreCounted) {
  GaussianCloud cloud = make_synthetic_gaussians("cloud:400");
  cloud.gaussians[9].position.x = 1e6F;
  const TestFile file(".spz", "");
  save_gaussians(cloud, file.path());
  const GaussianCloud read = load_gaussians(file.path());
  std::size_t moved = 0;
  for (std::size_t i = 0; i < 400; ++i) {
    const Gaussian& one = cloud.gaussians[i];
    const float off = glm::distance(one.position, read.gaussians[i].position);
    moved += off > std::max({one.scale.x, one.scale.y, one.scale.z}) ? 1 : 0;
  }
  EXPECT_GT(moved, 20U);
  const auto lost = lost_in_gaussian_file(cloud, file.path());
  EXPECT_THAT(lost, ::testing::Contains(HasSubstr(".spz moves " + std::to_string(moved) + " of 400 Gaussians")));
}

TEST(SplatFile, OneByHand) {
  std::string bytes(32, '\0');
  bytes[3] = '\x3f', bytes[2] = '\x80';                                    // x = 1.0
  bytes[15] = '\x40';                                                      // scale 2.0, 0, 0
  bytes[24] = '\xff', bytes[25] = '\x00', bytes[26] = '\x80';              // colour
  bytes[27] = '\x33';                                                      // opacity 0.2
  bytes[28] = '\x80', bytes[29] = '\x00', bytes[30] = bytes[31] = '\x80';  // a half turn about x, backwards
  const TestFile file(".splat", bytes);
  const GaussianCloud cloud = load_gaussians(file.path());
  ASSERT_EQ(cloud.gaussians.size(), 1U);
  EXPECT_EQ(cloud.gaussians[0].position, glm::vec3(1.0F, 0.0F, 0.0F));
  EXPECT_EQ(cloud.gaussians[0].scale, glm::vec3(2.0F, 0.0F, 0.0F));
  EXPECT_FLOAT_EQ(cloud.gaussians[0].opacity, 0.2F);
  EXPECT_EQ(cloud.gaussians[0].rotation, glm::vec4(0.0F, -1.0F, 0.0F, 0.0F));
  EXPECT_NEAR(cloud.harmonics[0].x, 0.5 / 0.28209479, 1e-5);
}

TEST(SyntheticGaussians, AreAsManyAsWereAskedForAndSound) {
  for (const char* name :
       {"shells:1", "shells:2", "shells:7", "shells:2000", "cloud:1", "cloud:500", "outdoor:1", "outdoor:500"}) {
    const GaussianCloud cloud = make_synthetic_gaussians(name);
    EXPECT_EQ(std::to_string(cloud.gaussians.size()), std::string(name).substr(std::string(name).find(':') + 1));
    for (std::size_t i = 0; i < cloud.gaussians.size(); ++i) {
      check_gaussian(cloud.gaussians[i], cloud.harmonics_of(i), name);
      EXPECT_NEAR(glm::length(cloud.gaussians[i].rotation), 1.0F, 1e-5F);
    }
  }
}

// The same numbers under every compiler. Recorded with GCC 12.
TEST(SyntheticGaussians, AreTheSameUnderEveryCompiler) {
  struct Recorded {
    const char* name;
    std::uint64_t hash;
  };
  for (const auto& [name, recorded] :
       {Recorded{"shells:150", 0x3311e6839069ebab}, Recorded{"shells:2000", 0x955c1ffb9e060141},
        Recorded{"cloud:200", 0x2304bb7e6bf23905}, Recorded{"cloud:500", 0x1b6b31c8aefc0b7a},
        Recorded{"outdoor:500", 0xa45fbbac6c67921d}, Recorded{"outdoor:20000:7", 0x2cfad5b4b5273be6}}) {
    const std::uint64_t hash = content_hash(make_synthetic_gaussians(name));
    std::printf("[figure] numbers of %s = 0x%016llx\n", name, static_cast<unsigned long long>(hash));
    EXPECT_EQ(hash, recorded) << name;
  }
}

// The shipped files equal the generator's output: another design or another compiler's last bit shows here.
TEST(SyntheticGaussians, TheFilesThatShipAreTheirs) {
  const std::filesystem::path folder = std::filesystem::path(FASTSPLAT_SOURCE_DIR) / "docs/examples/gaussians";
  const GaussianCloud shells = make_synthetic_gaussians("shells:150"), cloud = make_synthetic_gaussians("cloud:200");
  if (std::getenv("FASTSPLAT_WRITE_EXAMPLES") != nullptr) {
    std::filesystem::create_directories(folder);
    save_gaussians(shells, folder / "shells.ply", PlyText::Ascii);
    save_gaussians(cloud, folder / "cloud.splat");
  }
  EXPECT_LT(difference(load_gaussians(folder / "shells.ply"), shells), kFloat);
  const GaussianCloud splats = load_gaussians(folder / "cloud.splat");
  ASSERT_EQ(splats.gaussians.size(), cloud.gaussians.size());
  for (std::size_t i = 0; i < splats.gaussians.size(); ++i)
    EXPECT_LT(glm::distance(splats.gaussians[i].position, cloud.gaussians[i].position), 1e-6F);
}

}  // namespace
}  // namespace fastsplat::scene
