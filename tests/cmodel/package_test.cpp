// SPDX-License-Identifier: Apache-2.0
// The package for the RTL: it has every name that rtl/ reads; configurations without RTL have none.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <regex>
#include <set>

#include "base/error.hpp"
#include "cmodel/rtl_package/sv_package.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/paths.hpp"

namespace fastsplat::test {
namespace {

/// Names of `fastsplat_pkg::` in rtl/, except names that narrow.svh builds from a site's name.
std::set<std::string> names_read() {
  std::set<std::string> names;
  static const std::regex use(R"(fastsplat_pkg::([A-Za-z_0-9]*[A-Za-z0-9])\b)");
  for (const auto& entry : std::filesystem::recursive_directory_iterator(std::string(FASTSPLAT_SOURCE_DIR) + "/rtl")) {
    if (!entry.is_regular_file()) continue;
    std::ifstream file(entry.path());
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    for (std::sregex_iterator match(text.begin(), text.end(), use), end; match != end; ++match)
      names.insert((*match)[1].str());
  }
  return names;
}

/// The number that the package gives a name; -1 if it has none.
long constant_of(const std::string& package, const std::string& name) {
  std::smatch match;
  return std::regex_search(package, match, std::regex("localparam int " + name + " = ([0-9]+);"))
             ? std::stol(match[1].str())
             : -1;
}

TEST(Package, HasEveryNameThatTheRtlReads) {
  const std::set<std::string> names = names_read();
  EXPECT_GT(names.size(), 100U);
  std::size_t checked = 0;
  for (const char* config : {"tiny", "small", "base"}) {
    ASSERT_FALSE(cmodel::rtl_violation(named_config(config)));
    const std::string package = cmodel::sv_package(named_config(config));
    static const std::regex word("[A-Za-z_0-9]+");
    std::set<std::string> words;
    for (std::sregex_iterator match(package.begin(), package.end(), word), end; match != end; ++match)
      words.insert(match->str());
    for (const std::string& name : names) {
      EXPECT_TRUE(words.contains(name)) << config << ": rtl/ reads " << name << ", which the package does not have";
      ++checked;
    }
  }
  std::printf("[figure] names of the package that rtl/ reads = %zu, looked up = %zu\n", names.size(), checked);
}

// N-2-8: tables are indexed by bits, so the RTL cannot have a single phase, lane or segment.
TEST(Package, IsNotMadeForASingleLanePhaseOrSegment) {
  int refused = 0;
  const auto refuses = [&](int cmodel::Config::*key, int value, const char* where) {
    cmodel::Config config = named_config("small");
    config.*key = value;
    const auto violation = cmodel::rtl_violation(config);
    ASSERT_TRUE(violation) << where;
    EXPECT_EQ(violation->where, where) << one_line(*violation);
    EXPECT_EQ(violation->got, std::to_string(value));
    ++refused;
  };
  refuses(&cmodel::Config::phases, 1, "snap.phases");
  refuses(&cmodel::Config::lanes, 1, "array.lanes");
  refuses(&cmodel::Config::opacity_segments, 1, "opacity.segments");
  std::printf("[figure] configurations refused = %d\n", refused);
}

struct RtlLimit {
  const char* where;
  std::string got;  ///< empty: the RTL has this configuration
  std::function<void(cmodel::Config&)> change;
};

// N-2-8: the configurations are legal (N-2-7). Each lies at a limit of the RTL or one step beyond.
TEST(Package, IsMadeUpToTheLimitsOfTheRtl) {
  std::vector<RtlLimit> limits;
  const cmodel::ConfigKey& kind = *cmodel::find_key("index.kind");
  for (int value = kind.min; value <= kind.max; ++value)
    limits.push_back({"index.kind", value == static_cast<int>(cmodel::IndexKind::Rlut) ? "" : kind.names[value],
                      [value](cmodel::Config& c) {
                        c.index_kind = value;
                        c.phases = 4;
                      }});
  for (const int segments : {512, 1024})  // of 2^10 sheet words
    limits.push_back({"opacity.segments", segments == 512 ? "" : "0", [segments](cmodel::Config& c) {
                        c.sheet_frac_bits = 8;
                        c.opacity_segments = segments;
                      }});
  for (const auto& [width, height, got] :
       {std::tuple{64, 16, ""}, {64, 17, "1088"}, {4, 3, ""}, {3, 4, "3"}, {1, 4, ""}})
    limits.push_back({"tile.width", got, [columns = width, rows = height](cmodel::Config& c) {
                        c.tile_width = columns * c.lanes;
                        c.tile_height = rows * c.lanes;
                      }});
  int refused = 0, taken = 0;
  for (const RtlLimit& limit : limits) {
    cmodel::Config config = named_config("small");
    limit.change(config);
    ASSERT_FALSE(cmodel::first_violation(config)) << one_line(*cmodel::first_violation(config));
    const auto violation = cmodel::rtl_violation(config);
    ASSERT_EQ(violation.has_value(), !limit.got.empty()) << limit.where << ", refused after " << refused;
    ++(violation ? refused : taken);
    if (!violation) continue;
    EXPECT_EQ(violation->where, limit.where) << one_line(*violation);
    EXPECT_EQ(violation->got, limit.got);
  }
  std::printf("[figure] configurations beyond the RTL's limits = %d, at them = %d\n", refused, taken);
  EXPECT_EQ(refused, 8);
}

// A block of densities is read for max(5, slices) cycles (M-density-10). Its last slice is in k0 5 + 23 + slices - 1
// cycles after the first (M-density-12, M-density-15).
TEST(Package, SaysWhenTheLastSliceOfABlockOfDensitiesComes) {
  cmodel::Config config = named_config("small");
  config.classify_segment_bits = 4;
  int checked = 0;
  const auto late = [&](int lanes, long expected) {
    config.composite_lanes = lanes;
    ASSERT_FALSE(cmodel::first_violation(config));
    EXPECT_EQ(constant_of(cmodel::sv_package(config), "DENSITY_LATE"), expected) << lanes;
    ++checked;
  };
  late(0, 28 - 4);  // a whole block at once: five cycles, the last slice 28 after the first of them
  late(4, 31 - 4);  // four slices
  late(2, 35 - 7);  // eight
  std::printf("[figure] numbers of lanes = %d\n", checked);
}

}  // namespace
}  // namespace fastsplat::test
