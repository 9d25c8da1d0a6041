// Files of 3-D Gaussians that lie: about their size, their properties or their numbers. One line each, exit code 3.
#include <gtest/gtest.h>

#include <cstdio>
#include <functional>
#include <limits>

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

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string ascii() { return table().text("ascii"); }
std::string binary() { return table().text("binary_little_endian"); }

PlyTable with(const std::string& name, double value, std::size_t row = 5) {
  PlyTable out = table();
  for (std::size_t i = 0; i < out.names.size(); ++i)
    if (out.names[i] == name) out.rows[row][i] = value;
  return out;
}

PlyTable without(const std::string& name) {
  PlyTable out = table();
  for (std::size_t i = 0; i < out.names.size(); ++i) {
    if (out.names[i] != name) continue;
    out.names.erase(out.names.begin() + static_cast<std::ptrdiff_t>(i));
    for (auto& row : out.rows) row.erase(row.begin() + static_cast<std::ptrdiff_t>(i));
    break;
  }
  return out;
}

std::string splat(std::size_t float_at, float value) {
  GaussianCloud cloud = make_synthetic_gaussians("cloud:8");
  if (float_at < 3) {
    cloud.gaussians[3].position[static_cast<int>(float_at)] = value;
  } else {
    cloud.gaussians[3].scale[static_cast<int>(float_at) - 3] = value;
  }
  const TestFile file(".splat", "");
  save_gaussians(cloud, file.path());
  return bytes_of(file.path());
}

const float kNan = std::numeric_limits<float>::quiet_NaN();
const double kInfinite = std::numeric_limits<double>::infinity();

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
      {"no_format", ".ply", [] { return replaced(ascii(), "format ascii 1.0\n", ""); }, {":2", "not a format"}},
      {"header_cut", ".ply", [] { return ascii().substr(0, 100); }, {"no end"}},
      {"word", ".ply", [] { return replaced(ascii(), "property float y", "propery float y"); }, {":5", "'propery'"}},
      {"type", ".ply", [] { return replaced(ascii(), "property float y", "property half y"); }, {":5", "half"}},
      {"property_first", ".ply", [] { return replaced(ascii(), "element vertex 12\n", ""); }, {":3", "'property'"}},
      {"twice", ".ply", [] { return replaced(ascii(), "property float y", "property float x"); }, {"x is there twice"}},
      {"count_word", ".ply", [] { return replaced(ascii(), "vertex 12", "vertex -12"); }, {":3", "-12"}},
      {"count_none", ".ply", [] { return replaced(ascii(), "vertex 12", "vertex 0"); }, {"no Gaussian"}},
      {"count_huge",
       ".ply",
       [] { return replaced(ascii(), "vertex 12", "vertex 18446744073709551615"); },
       {"shorter", "18446744073709551615"}},
      {"count_more", ".ply", [] { return replaced(ascii(), "vertex 12", "vertex 13"); }, {"shorter", "12 whole"}},
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
       {"longer", "248 bytes more"}},
      {"binary_cut", ".ply", [] { return binary().substr(0, binary().size() - 1); }, {"shorter", "2975 bytes"}},
      {"binary_longer", ".ply", [] { return binary() + '\n'; }, {"longer", "1 bytes more"}},
      {"no_vertex", ".ply", [] { return replaced(ascii(), "element vertex", "element point"); }, {"no element vertex"}},
      {"list",
       ".ply",
       [] { return replaced(ascii(), "property float nx", "property list uchar float nx"); },
       {"vertex holds a list"}},
      {"list_before",
       ".ply",
       [] { return replaced(ascii(), "element vertex", "element face 3\nproperty list uchar int v\nelement vertex"); },
       {"face holds a list"}},
      {"no_opacity", ".ply", [] { return without("opacity").text("ascii"); }, {"opacity is missing"}},
      {"no_scale", ".ply", [] { return without("scale_2").text("ascii"); }, {"scale_2 is missing"}},
      {"no_rotation", ".ply", [] { return without("rot_0").text("ascii"); }, {"rot_0 is missing"}},
      {"no_colour", ".ply", [] { return without("f_dc_1").text("ascii"); }, {"f_dc_1 is missing"}},
      {"no_x", ".ply", [] { return without("x").text("ascii"); }, {"the property x is missing"}},
      {"rest_count", ".ply", [] { return without("f_rest_44").text("ascii"); }, {"0, 9, 24 or 45", "got 44"}},
      {"rest_gap", ".ply", [] { return without("f_rest_7").text("ascii"); }, {"f_rest_7 is missing"}},
      {"nan_x",
       ".ply",
       [] { return with("x", kNan).text("binary_little_endian"); },
       {"Gaussian 5", "position is not finite"}},
      {"inf_y",
       ".ply",
       [] { return with("y", kInfinite).text("binary_big_endian"); },
       {"Gaussian 5", "position is not finite"}},
      {"large_z", ".ply", [] { return with("z", 1e300).text("ascii"); }, {"Gaussian 5", "position is not finite"}},
      {"nan_text", ".ply", [] { return with("x", kNan).text("ascii"); }, {"Gaussian 5", "position is not finite"}},
      {"scale_huge",
       ".ply",
       [] { return with("scale_1", 100.0).text("ascii"); },
       {"Gaussian 5", "scale is not finite"}},
      {"scale_nan",
       ".ply",
       [] { return with("scale_1", kNan).text("binary_little_endian"); },
       {"Gaussian 5", "scale is not finite"}},
      {"opacity_nan",
       ".ply",
       [] { return with("opacity", kNan).text("binary_little_endian"); },
       {"Gaussian 5", "opacity"}},
      {"colour_nan",
       ".ply",
       [] { return with("f_rest_44", kNan).text("binary_little_endian"); },
       {"Gaussian 5", "colour is not finite"}},
      {"rotation_nan",
       ".ply",
       [] { return with("rot_3", kNan).text("binary_little_endian"); },
       {"Gaussian 5", "rotation has no direction"}},
      {"no_direction",
       ".ply",
       [] {
         PlyTable t = table();
         for (std::size_t i = t.names.size() - 4; i < t.names.size(); ++i) t.rows[5][i] = 0.0;
         return t.text("ascii");
       },
       {"Gaussian 5", "rotation has no direction"}},
      {"no_number", ".ply", [] { return ascii() + "\n" + "0.5x"; }, {"longer"}},
      {"letters",
       ".ply",
       [] { return replaced(ascii(), "end_header\n", "end_header\n0x12 "); },
       {"not a number", "'0x12'"}},
      {"splat_empty", ".splat", [] { return std::string(); }, {"empty"}},
      {"splat_cut",
       ".splat",
       [] { return splat(0, 1.0F).substr(0, 100); },
       {"multiple of 32", "100 bytes, 4 too many"}},
      {"splat_longer", ".splat", [] { return splat(0, 1.0F) + "x"; }, {"257 bytes, 1 too many"}},
      {"splat_nan", ".splat", [] { return splat(1, kNan); }, {"Gaussian 3 (byte 96)", "position is not finite"}},
      {"splat_scale", ".splat", [] { return splat(4, kNan); }, {"Gaussian 3", "scale is not finite"}},
      {"splat_negative", ".splat", [] { return splat(5, -1.0F); }, {"Gaussian 3", "scale is negative"}},
      {"splat_rotation",
       ".splat",
       [] { return std::string(28, '\0') + std::string(4, '\x80'); },
       {"Gaussian 0", "rotation has no direction"}},
      {"ending", ".spz", [] { return std::string("x"); }, {".ply or .splat"}},
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

// Every file cut anywhere is refused, or was whole to begin with; nothing else happens.
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
