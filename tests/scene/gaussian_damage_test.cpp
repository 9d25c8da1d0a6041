// SPDX-License-Identifier: Apache-2.0
// Files of 3-D Gaussians with false sizes or properties. One line each, exit code 3.
#include <gtest/gtest.h>

#include <cstdio>
#include <functional>

#include "base/error.hpp"
#include "scene/gaussians/gaussian_file.hpp"
#include "scene/gaussians/synthetic_gaussians.hpp"
#include "tests/scene/gaussian_helper.hpp"

namespace fastsplat::scene {
namespace {

using ::testing::HasSubstr;

struct Damage {
  const char* name;
  const char* ending;
  std::function<std::string()> bytes;
  std::vector<const char*> said;
};

PlyTable table() { return table_of(make_synthetic_gaussians("shells:12")); }

std::string ascii() { return table().text("ascii"); }
std::string binary() { return table().text("binary_little_endian"); }
std::string splat() {
  const TestFile file(".splat", "");
  save_gaussians(make_synthetic_gaussians("cloud:8"), file.path());
  return bytes_of(file.path());
}

const std::vector<Damage>& damages() {
  static const std::vector<Damage> list{
      {"empty", ".ply", [] { return std::string(); }, {"empty"}},
      {"no_ply", ".ply", [] { return std::string("hello\nworld\n"); }, {":1", "not a PLY file"}},
      {"no_line_end", ".ply", [] { return std::string(9000, 'x'); }, {":1", "no end"}},
      {"format",
       ".ply",
       [] { return replaced(ascii(), "format ascii 1.0", "format ascii 2.0"); },
       {":2", "'format ascii 2.0'"}},
      {"format_word",
       ".ply",
       [] { return replaced(ascii(), "format ascii 1.0", "format text 1.0"); },
       {":2", "binary_little_endian"}},
      {"no_format", ".ply", [] { return replaced(ascii(), "format ascii 1.0\n", ""); }, {":2", "unknown PLY format"}},
      {"element_twice",
       ".ply",
       [] { return replaced(ascii(), "end_header", "element vertex 2\nproperty float x\nend_header"); },
       {"vertex is given twice"}},
      {"header_cut", ".ply", [] { return ascii().substr(0, 100); }, {"no end"}},
      {"word", ".ply", [] { return replaced(ascii(), "property float y", "propery float y"); }, {":5", "'propery'"}},
      {"type", ".ply", [] { return replaced(ascii(), "property float y", "property half y"); }, {":5", "half"}},
      {"property_first", ".ply", [] { return replaced(ascii(), "element vertex 12\n", ""); }, {":3", "'property'"}},
      {"twice", ".ply", [] { return replaced(ascii(), "property float y", "property float x"); }, {"x is given twice"}},
      {"count_word", ".ply", [] { return replaced(ascii(), "vertex 12", "vertex -12"); }, {":3", "-12"}},
      {"count_none", ".ply", [] { return replaced(ascii(), "vertex 12", "vertex 0"); }, {"no Gaussian"}},
      {"count_huge",
       ".ply",
       [] { return replaced(ascii(), "vertex 12", "vertex 18446744073709551615"); },
       {"shorter", "18446744073709551615"}},
      {"count_more", ".ply", [] { return replaced(ascii(), "vertex 12", "vertex 13"); }, {"shorter", "12 complete"}},
      {"count_less", ".ply", [] { return replaced(ascii(), "vertex 12", "vertex 11"); }, {"longer"}},
      {"binary_huge",
       ".ply",
       [] { return replaced(binary(), "vertex 12", "vertex 99999999999999"); },
       {"shorter", "99999999999999"}},
      {"binary_more",
       ".ply",
       [] { return replaced(binary(), "vertex 12", "vertex 13"); },
       {"shorter", "13 of 'vertex', 248 bytes each", "2976 bytes"}},
      {"binary_less",
       ".ply",
       [] { return replaced(binary(), "vertex 12", "vertex 11"); },
       {"longer", "248 more bytes"}},
      {"binary_cut", ".ply", [] { return binary().substr(0, binary().size() - 1); }, {"shorter", "2975 bytes"}},
      {"binary_longer", ".ply", [] { return binary() + "\nx"; }, {"longer", "2 more bytes"}},
      {"no_vertex", ".ply", [] { return replaced(ascii(), "element vertex", "element point"); }, {"no element vertex"}},
      {"list",
       ".ply",
       [] { return replaced(ascii(), "property float nx", "property list uchar float nx"); },
       {"vertex holds a list"}},
      {"list_before",
       ".ply",
       [] { return replaced(ascii(), "element vertex", "element face 3\nproperty list uchar int v\nelement vertex"); },
       {"face holds a list"}},
      {"no_opacity", ".ply", [] { return table().without("opacity").text("ascii"); }, {"opacity is missing"}},
      {"no_scale", ".ply", [] { return table().without("scale_1").text("ascii"); }, {"scale_1 is missing"}},
      {"no_rotation", ".ply", [] { return table().without("rot_0").text("ascii"); }, {"rot_0 is missing"}},
      {"no_colour", ".ply", [] { return table().without("f_dc_1").text("ascii"); }, {"f_dc_1 is missing"}},
      {"no_x", ".ply", [] { return table().without("x").text("ascii"); }, {"the property x is missing"}},
      {"rest_count", ".ply", [] { return table().without("f_rest_44").text("ascii"); }, {"0, 9, 24 or 45", "got 44"}},
      {"rest_gap", ".ply", [] { return table().without("f_rest_7").text("ascii"); }, {"f_rest_7 is missing"}},
      {"no_number", ".ply", [] { return ascii() + "\n" + "0.5x"; }, {"longer"}},
      {"letters",
       ".ply",
       [] { return replaced(ascii(), "end_header\n", "end_header\n0x12 "); },
       {"not a number", "'0x12'"}},
      {"splat_empty", ".splat", [] { return std::string(); }, {"empty"}},
      {"splat_of_text", ".splat", [] { return std::string(64, 'a'); }, {"got text"}},
      {"properties",
       ".ply",
       [] {
         std::string many;
         for (int i = 0; i < 5000; ++i) many += "property float p" + std::to_string(i) + "\n";
         return replaced(ascii(), "end_header", many + "end_header");
       },
       {"too many properties"}},
      {"splat_cut", ".splat", [] { return splat().substr(0, 100); }, {"multiple of 32", "100 bytes, 4 too many"}},
      {"splat_longer", ".splat", [] { return splat() + "x"; }, {"257 bytes, 1 too many"}},
  };
  return list;
}

class GaussianDamage : public ::testing::TestWithParam<std::size_t> {};
INSTANTIATE_TEST_SUITE_P(Files, GaussianDamage, ::testing::Range(std::size_t{0}, damages().size()),
                         [](const auto& param_info) { return damages()[param_info.param].name; });

TEST_P(GaussianDamage, IsOneLine) {
  const Damage& damage = damages()[GetParam()];
  const TestFile file(damage.ending, damage.bytes());
  try {
    load_gaussians(file.path());
    FAIL() << "it was taken";
  } catch (const UserError& error) {
    const std::string line = error.what();
    std::printf("%s\n", line.c_str());
    EXPECT_EQ(error.code(), ExitCode::Input);
    EXPECT_THAT(line, HasSubstr(file.path().string()));
    for (const char* words : damage.said) EXPECT_THAT(line, HasSubstr(words));
    EXPECT_EQ(line.find('\n'), std::string::npos);
    EXPECT_LT(line.size(), 400U);
  }
}

// Every cut file is refused, or was complete; no other outcome.
TEST(GaussianDamage, CutAnywhere) {
  int refused = 0;
  for (const std::string& whole : {ascii(), binary()}) {
    for (std::size_t size = 1; size + 20 < whole.size(); size += 37) {
      const TestFile file(".ply", whole.substr(0, size));
      EXPECT_THROW(load_gaussians(file.path()), UserError) << size;
      ++refused;
    }
  }
  std::printf("[figure] cut files refused = %d\n", refused);
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace fastsplat::scene
