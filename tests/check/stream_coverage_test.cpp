// Bins of what a stream says, by hand: where culling hints lie between circles and ellipses, sets of circles, weights
// between entries.
#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <vector>

#include "testbench/coverage/coverage_interpolation.hpp"
#include "testbench/coverage/coverage_stream.hpp"
#include "tests/cmodel/configs_helper.hpp"

namespace fastsplat::testbench {
namespace {

using Records = std::vector<cmodel::Record>;

cmodel::Record sheet(std::uint32_t number) {
  cmodel::BeginSheet out{};
  out.sheet = number;
  return out;
}
cmodel::Record circle(std::uint32_t set) {
  cmodel::SplatRecord out{};
  out.set = set;
  return out;
}
const cmodel::Record kEllipse = cmodel::EllipseRecord{}, kCull = cmodel::CullBlock{}, kEnd = cmodel::EndSheet{};

/// Bins of a group that were hit, with commas between.
std::string hit(const Coverage& coverage, const std::string& group) {
  std::string out;
  for (const auto& bin : coverage.bins())
    if (bin.hits > 0 && bin.name.starts_with(group)) out += (out.empty() ? "" : ", ") + bin.name;
  return out;
}

std::string hit(const std::string& group, const Records& records) {
  Coverage coverage;
  StreamCoverage stream(test::named_config("faults/mustfail"), coverage);
  for (const auto& record : records) stream.on_record(record);
  return hit(coverage, group);
}

TEST(StreamCoverage, EllipsesAreSplatsToCullingHints) {
  EXPECT_EQ(hit("cull.", {sheet(0), kCull, kEllipse, circle(0), kEnd}), "cull.before_all_splats");
  EXPECT_EQ(hit("cull.", {sheet(0), circle(0), kCull, kEllipse, kEnd}), "cull.between_splats");
  EXPECT_EQ(hit("cull.", {sheet(0), kEllipse, kCull, kEllipse, kEnd}), "cull.between_splats");
  EXPECT_EQ(hit("cull.", {sheet(0), kEllipse, kCull, kEnd}), "cull.after_all_splats");
}

TEST(StreamCoverage, SetsAreThoseOfTheSheetsCircles) {
  const std::string other = "set.another_than_before";
  EXPECT_EQ(hit(other, {sheet(0), circle(0), kEllipse, circle(1), kEnd}), other);
  EXPECT_EQ(hit(other, {sheet(0), circle(0), circle(0), kEnd}), "");
  EXPECT_EQ(hit(other, {sheet(0), circle(1), kEnd, sheet(1), kEllipse, circle(0), kEnd}), "");
}

/// 16 entries and the word behind them, four steps from one to the next; the fall is rounded by two bits.
TEST(InterpolationCoverage, PlacesAndRoundings) {
  const auto config = test::named_config("faults/post");
  cmodel::LoadTable table{.table = cmodel::Table::Radial, .radius = {}, .words = {}};
  for (std::uint32_t i = 0; i <= 16; ++i) table.words.push_back(100 - i);
  const auto at = [&](InterpolationCoverage::Kind kind, std::uint64_t steps) {
    Coverage coverage;
    InterpolationCoverage of(config, coverage);
    of.load(table);
    of.weight(kind, steps);
    return hit(coverage, "");
  };
  constexpr auto kCircle = InterpolationCoverage::Circle, kOval = InterpolationCoverage::Ellipse;
  EXPECT_EQ(at(kCircle, 0), "interpolation.circle_on_an_entry");
  EXPECT_EQ(at(kCircle, 60), "interpolation.circle_on_an_entry");
  EXPECT_EQ(at(kCircle, 1), "interpolation.circle_between_entries, fall.below");
  EXPECT_EQ(at(kOval, 6), "interpolation.ellipse_between_entries, fall.tie");
  EXPECT_EQ(at(kOval, 63), "interpolation.ellipse_behind_the_last_entry, fall.above");
  EXPECT_EQ(at(kCircle, 64), "");
  table.words[1] = 96;
  EXPECT_EQ(at(kCircle, 2), "interpolation.circle_between_entries, fall.exact");
}

}  // namespace
}  // namespace fastsplat::testbench
