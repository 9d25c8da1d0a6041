// SPDX-License-Identifier: Apache-2.0
// The plan closes for `tiny` in a small run of the ordinary build (no line counts), and opens if a stimulus class is
// omitted.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/read_file.hpp"
#include "driver/config/config_file.hpp"
#include "testbench/closure/closure_report.hpp"
#include "testbench/closure/coverage_campaigns.hpp"
#include "tests/paths.hpp"
#include "tests/testbench/scene_beats_helper.hpp"

namespace fastsplat::testbench {
namespace {

VerificationPlan plan() {
  return read_plan(std::filesystem::path(FASTSPLAT_SOURCE_DIR) / "docs" / "verification_plan.toml");
}

CoverageOrder tiny() {
  CoverageOrder order{.config = driver::load_config("tiny"),
                      .volume = {.splats = 36000, .seeds = 12, .resets = 480},
                      .scenes = {},
                      .device = {},
                      .threads = 2,
                      .progress = {}};
  for (const auto method : {scene::Method::ImageAligned, scene::Method::AxisAligned, scene::Method::XRay}) {
    scene::SceneDescription description;
    description.volume = "shells:24";
    description.width = 72;
    description.height = 40;
    description.method = method;
    description.slab_opacity =
        method == scene::Method::AxisAligned ? scene::SlabOpacity::Additive : scene::SlabOpacity::Exponential;
    order.scenes.emplace_back(scene::to_string(method), source_of(test::scene_beats(description, order.config)));
  }
  return order;
}

/// Without bins that only other configurations have.
std::vector<std::string> open_bins(const ClosureInput& input) {
  auto findings = close_coverage(plan(), {input}, {}).findings;
  const auto missing = classes_without_streams(input.book);
  findings.insert(findings.end(), missing.begin(), missing.end());
  std::erase_if(findings,
                [](const std::string& finding) { return finding.find(": unknown bin ") != std::string::npos; });
  return findings;
}

TEST(Closure, OfTinyCloses) {
  const auto order = tiny();
  const auto runs = run_coverage(order);
  EXPECT_EQ(runs.failures, std::vector<std::string>{});
  const ClosureInput input{runs.book, planned_bins(order.config)};
  for (const auto& finding : open_bins(input)) ADD_FAILURE() << finding;
  const auto closure = close_coverage(plan(), {input}, {});
  std::printf("[figure] bins hit = %zu of %zu, splats = %llu, comparisons = %llu\n", closure.hit, closure.bins,
              static_cast<unsigned long long>(runs.book.splats),
              static_cast<unsigned long long>(runs.book.comparisons));
  EXPECT_GT(closure.hit, 0u);

  // Each class is needed: without it, the coverage is open.
  int needed = 0;
  for (const StimulusClass which : stimulus_classes()) {
    ClosureInput without = input;
    without.book.campaigns.erase(to_string(which));
    const auto findings = open_bins(without);
    EXPECT_FALSE(findings.empty()) << to_string(which) << " is in nobody's plan";
    needed += findings.empty() ? 0 : 1;
  }
  std::printf("[figure] classes that the closure misses when they are left out = %d of %zu\n", needed,
              stimulus_classes().size());

  // Saved and read again it is the same.
  const auto path = std::filesystem::temp_directory_path() / ("fastsplat-book-" + std::to_string(::getpid()) + ".json");
  write_book(path, runs.book);
  const ClosureInput again{read_book(path), input.planned};
  std::filesystem::remove(path);
  EXPECT_EQ(close_coverage(plan(), {again}, {}).hit, closure.hit);
  EXPECT_EQ(again.book.config_hash, runs.book.config_hash);

  const ClosureReport report{.version = "test",
                             .command = "tools/coverage",
                             .plan = plan(),
                             .inputs = {input},
                             .closure = closure,
                             .lines = {},
                             .failures = {}};
  EXPECT_NE(closure_markdown(report).find("| hazards | tiny | "), std::string::npos);
  const auto json = nlohmann::ordered_json::parse(closure_json(report));
  ASSERT_EQ(json["testpoints"].size(), report.plan.testpoints.size());
  std::size_t found = 0;
  for (const ClosureRow& row : closure.rows) {
    for (const auto& point : json["testpoints"]) {
      if (point["name"] != row.testpoint) continue;
      for (const ClosureBin& bin : row.bins) found += point["configurations"][0]["hits"].at(bin.name) == bin.hits;
    }
  }
  EXPECT_EQ(found, closure.bins) << "bins with their hits in the JSON";
}

TEST(Closure, WithoutAClassRunIsOpen) {
  // Not run at all, rather than removed afterwards.
  CoverageOrder order = tiny();
  order.scenes.clear();
  order.volume = {.splats = 1700, .seeds = 6, .resets = 3};
  std::erase(order.classes, StimulusClass::Hazards);
  const auto runs = run_coverage(order);
  EXPECT_EQ(runs.failures, std::vector<std::string>{});
  const auto findings = open_bins({runs.book, planned_bins(order.config)});
  EXPECT_NE(std::find(findings.begin(), findings.end(), "hazards, tiny: hazard.distance_1 was never hit"),
            findings.end());
}

}  // namespace
}  // namespace fastsplat::testbench
