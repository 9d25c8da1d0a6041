// SPDX-License-Identifier: Apache-2.0
// Gaussians that cannot be drawn are dropped, counted and named; a file without any valid one is refused.
#include <gtest/gtest.h>

#include <cstdio>
#include <limits>

#include "base/error.hpp"
#include "scene/gaussians/gaussian_file.hpp"
#include "scene/gaussians/synthetic_gaussians.hpp"
#include "tests/scene/gaussian_helper.hpp"

namespace fastsplat::scene {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const double kNan = std::numeric_limits<double>::quiet_NaN(), kInfinite = std::numeric_limits<double>::infinity();

PlyTable twelve() { return table_of(make_synthetic_gaussians("shells:12")); }
PlyTable turned_nowhere(PlyTable table, std::size_t row) {
  for (const char* name : {"rot_0", "rot_1", "rot_2", "rot_3"}) table = table.with(name, 0.0, row);
  return table;
}

struct BadRow {
  const char* name;
  PlyTable table;
  const char* fault;
};

// The others do not change.
TEST(GaussianRows, BadOnesAreDroppedAndNamed) {
  const GaussianCloud whole = make_synthetic_gaussians("shells:12");
  GaussianCloud others = whole;
  others.gaussians.erase(others.gaussians.begin() + 5);
  others.harmonics.erase(others.harmonics.begin() + 5 * 16, others.harmonics.begin() + 6 * 16);
  const std::vector<BadRow> bad{
      {"nan", twelve().with("x", kNan), "x is not finite"},
      {"infinite", twelve().with("y", kInfinite), "y is not finite"},
      {"beyond a float", twelve().with("z", -1e300), "z is not finite"},
      {"too large", twelve().with("scale_1", 100.0), "scale_1 is not finite"},
      {"nan scale", twelve().with("scale_2", kNan), "scale_2 is not finite"},
      {"nan opacity", twelve().with("opacity", kNan), "opacity is not a number"},
      {"nan colour", twelve().with("f_dc_2", kNan), "f_dc_2 is not finite"},
      {"nan harmonic", twelve().with("f_rest_44", kNan), "f_rest_44 is not finite"},
      {"infinite harmonic", twelve().with("f_rest_15", kInfinite), "f_rest_15 is not finite"},
      {"nan rotation", twelve().with("rot_3", kNan), "rot_3 is not finite"},
      {"no rotation", turned_nowhere(twelve(), 5), "rotation (rot_0 to rot_3) is zero"},
      {"negative filter", twelve().and_of("filter_3D", 0.0).with("filter_3D", -1.0), "filter_3D is below 0"},
      {"nan filter", twelve().and_of("filter_3D", 0.0).with("filter_3D", kNan), "filter_3D is not finite"}};
  int files = 0;
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    for (const BadRow& one : bad) {
      const TestFile file(".ply", one.table.text(format, "double"));
      const GaussianCloud read = load_gaussians(file.path());
      EXPECT_LT(difference(read, others), 1e-6) << one.name << ", " << format;
      EXPECT_THAT(read.remarks, ElementsAre(AllOf(HasSubstr("1 of 12 Gaussians"), HasSubstr("Gaussian 5 (from 0)"),
                                                  HasSubstr(one.fault))))
          << one.name << ", " << format;
      EXPECT_EQ(read.number_of(4), 4U);
      EXPECT_EQ(read.number_of(5), 6U) << "numbers are the file's";
      ++files;
    }
  }
  std::printf("[figure] files with a bad row = %d\n", files);
}

TEST(GaussianRows, SeveralAreOneRemark) {
  const TestFile file(".ply", turned_nowhere(twelve().with("x", kNan, 3), 9).with("opacity", kNan, 11).text("ascii"));
  const GaussianCloud read = load_gaussians(file.path());
  EXPECT_EQ(read.gaussians.size(), 9U);
  EXPECT_THAT(read.remarks,
              ElementsAre(AllOf(HasSubstr("3 of 12"), HasSubstr("Gaussian 3"), HasSubstr("x is not finite"))));
}

// As text, a number too small for a double is 0.
TEST(GaussianRows, TinyNumbersAreZero) {
  std::string text = twelve().with("x", 0.123456, 5).text("ascii");
  ASSERT_NE(text.find("0.123456"), std::string::npos);
  text = replaced(text, "0.123456", "-1e-400");
  const TestFile file(".ply", text);
  const GaussianCloud read = load_gaussians(file.path());
  ASSERT_EQ(read.gaussians.size(), 12U);
  EXPECT_THAT(read.remarks, ElementsAre());
  EXPECT_EQ(read.gaussians[5].position.x, 0.0F);
}

// Numbers at the ends of logarithm and logit are a flat, a clear and an opaque Gaussian.
TEST(GaussianRows, EndsOfLogarithmsAreKept) {
  const auto table = twelve().with("scale_2", -kInfinite).with("opacity", -kInfinite, 6).with("opacity", kInfinite, 7);
  const TestFile file(".ply", table.text("binary_little_endian"));
  const GaussianCloud read = load_gaussians(file.path());
  ASSERT_EQ(read.gaussians.size(), 12U);
  EXPECT_THAT(read.remarks, ElementsAre());
  EXPECT_EQ(read.gaussians[5].scale.z, 0.0F);
  EXPECT_EQ(read.gaussians[6].opacity, 0.0F);
  EXPECT_EQ(read.gaussians[7].opacity, 1.0F);
}

std::string splats(const std::function<void(Gaussian&)>& change, std::size_t from, std::size_t to) {
  GaussianCloud cloud = make_synthetic_gaussians("cloud:8");
  for (std::size_t i = from; i < to; ++i) change(cloud.gaussians[i]);
  const TestFile file(".splat", "");
  save_gaussians(cloud, file.path());
  return bytes_of(file.path());
}

TEST(GaussianRows, SplatFilesAsWell) {
  const struct {
    const char* fault;
    std::function<void(Gaussian&)> change;
  } kinds[] = {{"y is not finite", [](Gaussian& one) { one.position.y = static_cast<float>(kNan); }},
               {"scale_1 is not finite", [](Gaussian& one) { one.scale.y = static_cast<float>(kNan); }},
               {"scale_2 is negative", [](Gaussian& one) { one.scale.z = -1.0F; }},
               {"rotation (rot_0 to rot_3) is zero", [](Gaussian& one) { one.rotation = glm::vec4(0.0F); }}};
  for (const auto& kind : kinds) {
    const TestFile some(".splat", splats(kind.change, 3, 5));
    const GaussianCloud read = load_gaussians(some.path());
    EXPECT_EQ(read.gaussians.size(), 6U);
    EXPECT_THAT(read.remarks, ElementsAre(AllOf(HasSubstr("2 of 8"), HasSubstr("Gaussian 3"), HasSubstr(kind.fault))));
    const TestFile all(".splat", splats(kind.change, 0, 8));
    EXPECT_THAT([&] { load_gaussians(all.path()); },
                ::testing::ThrowsMessage<UserError>(AllOf(HasSubstr("none of the 8"), HasSubstr(kind.fault))));
  }
}

TEST(GaussianRows, FilesWithoutValidRowsAreRefused) {
  PlyTable table = twelve();
  for (std::size_t row = 0; row < 12; ++row) table = table.with("z", kInfinite, row);
  const TestFile file(".ply", table.text("binary_little_endian"));
  try {
    load_gaussians(file.path());
    FAIL() << "it was taken";
  } catch (const UserError& error) {
    std::printf("%s\n", error.what());
    EXPECT_EQ(error.code(), ExitCode::Input);
    EXPECT_THAT(error.what(), AllOf(HasSubstr(file.path().string()), HasSubstr("none of the 12 Gaussians"),
                                    HasSubstr("z is not finite")));
  }
}

}  // namespace
}  // namespace fastsplat::scene
