// SPDX-License-Identifier: Apache-2.0
// The closure as JSON has the closure's own figures. The JSON made here is checked in, for the browser's test.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/read_file.hpp"
#include "testbench/closure/closure_lcov.hpp"
#include "testbench/closure/closure_report.hpp"
#include "tests/paths.hpp"

namespace fastsplat::testbench {
namespace {

using Json = nlohmann::ordered_json;

const std::filesystem::path kSample =
    std::filesystem::path(FASTSPLAT_SOURCE_DIR) / "report" / "web" / "test" / "samples" / "closure.json";

/// Hits of the campaign "hazards", in bins that are all planned.
ClosureInput input_of(const std::string& config, std::uint64_t hash,
                      const std::vector<std::pair<const char*, std::uint64_t>>& hits) {
  ClosureInput input{
      {.config = config, .config_hash = hash, .streams = 12, .splats = 34567, .comparisons = 8901234, .cycles = 56789},
      {}};
  Coverage& run = input.book.campaigns["hazards"];
  for (const auto& [name, count] : hits) {
    input.planned.declare("hazard", name);
    run.hit(run.declare("hazard", name), count);
  }
  return input;
}

Testpoint point_of(const std::string& name, const std::string& proves, std::vector<std::string> bins,
                   std::vector<std::string> tests) {
  Testpoint point{.name = name,
                  .proves = proves,
                  .campaigns = {},
                  .tests = std::move(tests),
                  .bins = std::move(bins),
                  .configs = {},
                  .assertions = {},
                  .faults = {}};
  if (!point.bins.empty()) {
    point.campaigns = {"hazards"};
    point.assertions = {"sheet_has_one_owner"};
  }
  return point;
}

/// One of each: hit and open bins, tests that passed, failed and never ran, lines reached, excused and open.
ClosureReport made() {
  ClosureReport report{
      .version = "0.1.0",
      .command = "tools/coverage 'more of it.json'",
      .plan = {{point_of("hazards", "words come back as they were written <soon & late>", {"hazard.distance_*"},
                         {"testbench.Hazards.All"}),
                point_of("swap", "sheets swap", {"hazard.swap"}, {"mustfail.Swap.IsSeen"}),
                point_of("registers", "registers answer", {}, {"cmodel.Registers.Answer"}),
                point_of("proofs", "never a dead end", {}, {"rtl.proofs"})}},
      .inputs = {input_of("tiny", 0xa33e5f212e8fb405, {{"distance_1", 0}, {"distance_2", 1234567}, {"swap", 3}}),
                 input_of("base", 0x1f, {{"distance_1", 4}, {"distance_2", 5}, {"swap", 6}})},
      .closure = {},
      .lines = {},
      .failures = {"tiny: bubbles: seed 7 differs"}};
  report.closure = close_coverage(report.plan, report.inputs,
                                  {{"testbench.I/Hazards.All/0", true},
                                   {"testbench.I/Hazards.All/1", true},
                                   {"mustfail.Swap.IsSeen", false},
                                   {"cmodel.Registers.Answer", true}});
  const auto folder = std::filesystem::temp_directory_path() / ("fastsplat-closure-" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "m.sv")
      << "module m;\n  always_comb begin\n    a = b;\n  end\n  if (never) x;\n  if (idle) y;\nendmodule\n";
  std::ofstream(folder / "n.sv") << "module n;\n  assign c = d;\nendmodule\n";
  LineCoverage lines;
  lines.add(
      "# SystemC::Coverage-3\n"
      "C '\1f\2rtl/m.sv\1l\0022\1n\0023\1page\2v_line/m\1o\2block\1S\0022-3\1h\2TOP.a' 40000\n"
      "C '\1f\2rtl/m.sv\1l\0025\1n\0023\1page\2v_branch/m\1o\2if\1S\0025\1h\2TOP.a' 0\n"
      "C '\1f\2rtl/m.sv\1l\0025\1n\0023\1page\2v_branch/m\1o\2else\1S\1h\2TOP.a' 9\n"
      "C '\1f\2rtl/m.sv\1l\0026\1n\0023\1page\2v_branch/m\1o\2else\1S\1h\2TOP.a' 0\n"
      "C '\1f\2rtl/n.sv\1l\0022\1n\0023\1page\2v_line/n\1o\2block\1S\0022\1h\2TOP.b' 7\n");
  report.lines = close_lines(lines, folder, {{"m.sv", "if (never) x;", "if", "it is never <so>"}});
  std::filesystem::remove_all(folder);
  return report;
}

TEST(ClosureJson, HasEveryFigureOfTheClosure) {
  const ClosureReport report = made();
  const Json json = Json::parse(closure_json(report));
  EXPECT_EQ(json["verb"], "closure");
  EXPECT_EQ(json["verdict"], "open");
  EXPECT_EQ(json["command"], report.command);
  EXPECT_EQ(json["bins"], (Json{{"hit", 5}, {"all", 6}}));
  EXPECT_EQ(json["lines"], (Json{{"reached", 3}, {"excused", 1}, {"all", 5}}));
  EXPECT_EQ(json["tests"], (Json{{"passed", 2}, {"failed", 1}, {"not_run", 1}}));
  EXPECT_EQ(json["splats"], 2 * 34567);
  EXPECT_EQ(json["configurations"][0]["config_hash"], "a33e5f212e8fb405");
  EXPECT_EQ(json["open"]["campaigns"], report.failures);
  EXPECT_EQ(json["open"]["testpoints"], report.closure.findings);
  EXPECT_EQ(json["open"]["lines"], report.lines.findings);
  std::vector<std::string> states;
  for (const Json& point : json["testpoints"]) states.push_back(point["status"]);
  EXPECT_EQ(states, (std::vector<std::string>{"open", "open", "closed", "not run"}));
  EXPECT_EQ(json["testpoints"][0]["configurations"][0]["hits"],
            (Json{{"hazard.distance_1", 0}, {"hazard.distance_2", 1234567}}));
  EXPECT_EQ(json["files"][0]["points"][2]["excused"], "it is never <so>");
  EXPECT_FALSE(json["files"][0]["points"][3].contains("excused")) << "never reached, and no one says why";
  EXPECT_EQ(json["files"][0]["source"].size(), 7u);

  ClosureReport closed = report;
  closed.failures.clear();
  closed.closure.findings.clear();
  closed.lines.findings.clear();
  EXPECT_EQ(Json::parse(closure_json(closed))["verdict"], "closed");
}

TEST(ClosureJson, OtherViewersGetTheSameHits) {
  const ClosureReport report = made();
  const auto source = std::filesystem::temp_directory_path() / ("fastsplat-lcov-" + std::to_string(::getpid()));
  std::filesystem::create_directories(source / "rtl" / "sub");
  std::filesystem::create_directories(source / "docs");
  std::ofstream(source / "rtl" / "m.sv") << "module m;\n";
  std::ofstream(source / "rtl" / "sub" / "n.sv") << "module n;\n";
  std::ofstream(source / "docs" / "verification_plan.toml")
      << "# plan\n[[testpoint]]\nname = \"hazards\"\n\nname = \"swap\"\n";
  // Line 5's `if` is excused and left out; its `else` is not.
  EXPECT_EQ(closure_info(report, source),
            "TN:fastsplat\n"
            "SF:rtl/m.sv\nBRDA:5,3,0,9\nBRDA:6,3,0,0\nDA:2,40000\nDA:3,40000\nend_of_record\n"
            "SF:rtl/sub/n.sv\nDA:2,7\nend_of_record\n");
  const auto files = coverview_files(report, source);
  std::filesystem::remove_all(source);
  EXPECT_EQ(files.at("branches.info"),
            "TN:fastsplat\nSF:rtl/m.sv\nBRDA:5,3,else,9\nBRDA:6,3,else,0\nend_of_record\n"
            "SF:rtl/sub/n.sv\nend_of_record\n");
  EXPECT_EQ(files.at("bins.info"),
            "TN:fastsplat\nSF:docs/verification_plan.toml\n"
            "BRDA:3,0,tiny hazard.distance_1,0\nBRDA:3,0,tiny hazard.distance_2,1234567\n"
            "BRDA:3,1,base hazard.distance_1,4\nBRDA:3,1,base hazard.distance_2,5\n"
            "BRDA:5,0,tiny hazard.swap,3\nBRDA:5,1,base hazard.swap,6\nend_of_record\n");
  EXPECT_NE(files.at("sources.txt").find("### FILE: rtl/sub/n.sv\nmodule n;\n"), std::string::npos);
  // Every file that the archive's description names is in it.
  std::size_t named = 0;
  const Json config = Json::parse(files.at("config.json"));
  for (const Json& set : config["datasets"]) {
    for (const Json& file : set) named += files.contains(file.get<std::string>());
  }
  EXPECT_EQ(named, 3u);
}

TEST(ClosureJson, IsTheSampleOfTheBrowsersTest) {
  const std::string text = closure_json(made());
  if (std::filesystem::exists(kSample) && read_text_file(kSample) == text) return;
  const auto made_now = std::filesystem::path(FASTSPLAT_BINARY_DIR) / "closure-sample.json";
  std::ofstream(made_now, std::ios::binary) << text;
  FAIL() << "cp " << made_now.string() << " " << kSample.string() << ", then look at it";
}

}  // namespace
}  // namespace fastsplat::testbench
