// SPDX-License-Identifier: Apache-2.0
// The verification plan against the tree: bins, campaigns, tests, assertions and faults, each in both directions; and
// the closure itself, which must notice every omission.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <regex>
#include <set>

#include "base/error.hpp"
#include "base/read_file.hpp"
#include "driver/config/config_file.hpp"
#include "testbench/closure/closure_report.hpp"
#include "testbench/closure/coverage_campaigns.hpp"
#include "tests/paths.hpp"

namespace fastsplat::testbench {
namespace {

const std::filesystem::path kSource = FASTSPLAT_SOURCE_DIR;

VerificationPlan plan() { return read_plan(kSource / "docs" / "verification_plan.toml"); }

std::vector<std::string> all_matches(const std::filesystem::path& folder, const char* ending,
                                     const std::regex& expression) {
  std::vector<std::string> out;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (!entry.path().string().ends_with(ending)) continue;
    const std::string text = read_text_file(entry.path());
    for (std::sregex_iterator match(text.begin(), text.end(), expression), end; match != end; ++match)
      out.push_back(entry.path().parent_path().filename().string() + "." + (*match)[1].str() +
                    ((*match).size() > 2 ? "." + (*match)[2].str() : ""));
  }
  return out;
}

/// Every test of tests/ as named in the plan: folder.Suite.Name, and rtl.NAME.
std::set<std::string> tests_of_the_sources() {
  static const std::regex test(R"(\bTEST(?:_F|_P)?\(\s*(\w+),\s*(\w+)\))");
  std::set<std::string> out;
  for (const auto& entry : std::filesystem::directory_iterator(kSource / "tests")) {
    if (!entry.is_directory()) continue;
    for (auto& name : all_matches(entry.path(), "_test.cpp", test)) out.insert(name);
  }
  const std::string rtl = read_text_file(kSource / "tests" / "rtl" / "CMakeLists.txt");
  static const std::regex single(R"(\brtl_(?:test|proof)\((\w+) )"), loop(R"(foreach\(config ([\w ]+)\))");
  for (std::sregex_iterator match(rtl.begin(), rtl.end(), single), end; match != end; ++match)
    out.insert("rtl." + (*match)[1].str());
  for (std::sregex_iterator match(rtl.begin(), rtl.end(), loop), end; match != end; ++match) {
    std::istringstream configs((*match)[1].str());
    for (std::string config; configs >> config;) out.insert("rtl.read_" + config);
  }
  return out;
}

/// Names in the RTL of the device; the modules around it, in io/, are not in this plan.
std::set<std::string> names_in_rtl(const char* expression) {
  const std::regex name(expression);
  std::set<std::string> out;
  for (const auto& [file, path] : sources_in(kSource / "rtl")) {
    if (!file.ends_with(".sv") || path.parent_path().filename() == "io") continue;
    const std::string text = read_text_file(path);
    for (std::sregex_iterator match(text.begin(), text.end(), name), end; match != end; ++match)
      out.insert((*match)[1].str());
  }
  return out;
}

TEST(Plan, EveryTestIsThere) {
  const auto known = tests_of_the_sources();
  std::size_t named = 0;
  for (const Testpoint& point : plan().testpoints) {
    for (const auto& test : point.tests) {
      EXPECT_TRUE(known.contains(test)) << point.name << ": " << test;
      ++named;
    }
  }
  std::printf("[figure] tests named by the plan = %zu, tests there = %zu\n", named, known.size());
  EXPECT_GT(named, 0u);
}

TEST(Plan, NamesEveryAssertionAndEveryFault) {
  std::set<std::string> assertions, faults;
  for (const Testpoint& point : plan().testpoints) {
    assertions.insert(point.assertions.begin(), point.assertions.end());
    faults.insert(point.faults.begin(), point.faults.end());
  }
  EXPECT_EQ(assertions, names_in_rtl(R"(`FASTSPLAT_ASS(?:ERT|UME)(?:_NEXT|_HELD)?\((\w+),)"));
  std::set<std::string> defined;
  const std::string text = read_text_file(kSource / "testbench" / "faults" / "faults.def");
  static const std::regex fault(R"((?:^|\n)FAULT\((\w+),)");
  for (std::sregex_iterator match(text.begin(), text.end(), fault), end; match != end; ++match)
    defined.insert((*match)[1]);
  EXPECT_EQ(faults, defined);
  std::printf("[figure] assertions = %zu, faults = %zu\n", assertions.size(), faults.size());
  EXPECT_GT(assertions.size(), 0u);
  EXPECT_GT(faults.size(), 0u);
}

TEST(Plan, NamesEveryCoverPoint) {
  auto points = names_in_rtl(R"(`FASTSPLAT_COVER\((\w+),)");
  for (const auto& name : names_in_rtl(R"(`FASTSPLAT_ASS(?:ERT|UME)_(?:NEXT|HELD)\((\w+),)"))
    points.insert(name + "_met");
  EXPECT_GT(points.size(), 0u);
  const auto testpoints = plan().testpoints;
  for (const auto& name : points) {
    EXPECT_TRUE(std::any_of(testpoints.begin(), testpoints.end(), [&](const Testpoint& point) {
      return std::any_of(point.bins.begin(), point.bins.end(),
                         [&](const auto& bin) { return matches(bin, "cover." + name); });
    })) << name;
  }
}

ClosureInput nothing_run(const std::string& config) {
  const auto loaded = driver::load_config(config);
  ClosureInput input{CoverageBook::of(loaded), planned_bins(loaded)};
  input.book.campaigns["mixed"];
  return input;
}

TEST(Plan, MapsEveryBinOfEveryConfigurationAndNoOther) {
  const auto closure =
      close_coverage(plan(),
                     {nothing_run("tiny"), nothing_run("mustfail"), nothing_run("westover"), nothing_run("cull"),
                      nothing_run("post"), nothing_run("small"), nothing_run("base")},
                     {});
  std::size_t unhit = 0;
  for (const auto& finding : closure.findings) {
    if (finding.ends_with("was never hit"))
      ++unhit;
    else
      ADD_FAILURE() << finding;
  }
  EXPECT_EQ(unhit, closure.bins) << "nothing ran, so nothing is hit";
  EXPECT_EQ(closure.hit, 0u);
  std::printf("[figure] bins in the plan = %zu over 7 configurations\n", closure.bins);
  EXPECT_GT(closure.bins, 0u);
}

TEST(Plan, RefusesUnknownPlans) {
  const auto path = std::filesystem::temp_directory_path() / ("fastsplat-plan-" + std::to_string(::getpid()) + ".toml");
  const auto refused = [&](const std::string& text) {
    std::ofstream(path) << text;
    try {
      read_plan(path);
    } catch (const UserError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string point = "[[testpoint]]\nname = \"a\"\nproves = \"b\"\n";
  EXPECT_NE(refused(point + "bin = [\"x\"]\n").find(":4:1: unknown key 'bin'"), std::string::npos);
  EXPECT_NE(refused(point + "bins = [\"x\"]\n").find("require each other"), std::string::npos);
  EXPECT_NE(refused(point).find("neither bins nor tests"), std::string::npos);
  EXPECT_NE(refused(point + "tests = [3]\n").find(":4:10: tests contains a value that is not a string"),
            std::string::npos);
  EXPECT_NE(refused(point + "tests = [\"t\"]\n" + point + "tests = [\"t\"]\n").find("duplicate testpoint"),
            std::string::npos);
  EXPECT_NE(refused("").find("empty"), std::string::npos);
  EXPECT_EQ(refused(point + "tests = [\"t\"]\n"), "");
  std::filesystem::remove(path);
}

Testpoint testpoint_of(const std::string& name, std::vector<std::string> campaigns, std::vector<std::string> bins) {
  return {.name = name,
          .proves = "x",
          .campaigns = std::move(campaigns),
          .tests = {},
          .bins = std::move(bins),
          .configs = {},
          .assertions = {},
          .faults = {}};
}

TEST(Closure, CountsATestpointsOwnCampaignsOnly) {
  ClosureInput input;
  input.book.config = "c";
  input.planned.declare("g", "x");
  Coverage& other = input.book.campaigns["hazards"];
  other.hit(other.declare("g", "x"));
  EXPECT_FALSE(close_coverage({{testpoint_of("p", {"bubbles"}, {"g.x"})}}, {input}, {}).findings.empty());
  EXPECT_TRUE(close_coverage({{testpoint_of("p", {"hazards"}, {"g.x"})}}, {input}, {}).findings.empty());
  EXPECT_TRUE(close_coverage({{testpoint_of("p", {"all"}, {"g.*"})}}, {input}, {}).findings.empty());
}

TEST(Closure, IsRedForEveryKindOfGap) {
  ClosureInput input;
  input.book.config = "c";
  input.planned.declare("g", "x");
  Coverage& run = input.book.campaigns["hazards"];
  run.hit(run.declare("g", "x"));
  const auto findings = [&](const Testpoint& point, const std::map<std::string, bool>& results = {}) {
    std::string text;
    for (const auto& finding : close_coverage({{point}}, {input}, results).findings) text += finding + "\n";
    return text;
  };
  EXPECT_EQ(findings(testpoint_of("p", {"hazards"}, {"g.x"})), "");
  EXPECT_EQ(findings(testpoint_of("p", {"hazard"}, {"g.x"})), "p: unknown campaign hazard\np, c: g.x was never hit\n");
  EXPECT_EQ(findings(testpoint_of("p", {"hazards"}, {"g.x", "g.y"})), "p: unknown bin g.y\n");
  EXPECT_EQ(findings(testpoint_of("p", {"hazards"}, {"h.*"})),
            "c: bin g.x belongs to no testpoint\np: unknown bin h.*\nno bins were checked\n");
  run.declare("g", "z");
  EXPECT_EQ(findings(testpoint_of("p", {"hazards"}, {"g.*"})), "c, hazards: bin g.z is not declared\n");
  input.planned.declare("g", "z");
  Testpoint tested = testpoint_of("p", {"hazards"}, {"g.*"});
  tested.tests = {"testbench.Suite.Name"};
  EXPECT_EQ(findings(tested, {{"testbench.Instance/Suite.Name/3", false}}),
            "p, c: g.z was never hit\np: test testbench.Suite.Name fails\n");
}

TEST(Closure, NeedsATestWhereThereAreNoBins) {
  ClosureInput input;
  input.book.config = "c";
  input.planned.declare("g", "x");
  Coverage& run = input.book.campaigns["hazards"];
  run.hit(run.declare("g", "x"));
  Testpoint tested = testpoint_of("t", {}, {});
  tested.tests = {"testbench.Suite.Name"};
  const VerificationPlan both{{testpoint_of("p", {"hazards"}, {"g.x"}), tested}};
  const auto findings = [&](const std::map<std::string, bool>& results) {
    return close_coverage(both, {input}, results).findings;
  };
  EXPECT_EQ(findings({{"testbench.Suite.Name", true}}), std::vector<std::string>{});
  EXPECT_EQ(findings({{"testbench.Suite.Other", true}}),
            (std::vector<std::string>{"t: no test passed, and there are no bins"}));
  EXPECT_EQ(findings({}), std::vector<std::string>{}) << "tests were not looked at";
}

TEST(Closure, KnowsTestsByTheirNames) {
  EXPECT_TRUE(is_test("a.S.N", "a.S.N"));
  EXPECT_TRUE(is_test("a.S.N", "a.I/S.N/0"));
  EXPECT_TRUE(is_test("rtl.proofs", "rtl.proofs"));
  EXPECT_FALSE(is_test("a.S.N", "a.S.Nn"));
  EXPECT_FALSE(is_test("a.S.N", "a.XS.N"));
  EXPECT_FALSE(is_test("a.S.N", "b.S.N"));
  const std::regex expression(tests_expression(plan()));
  EXPECT_TRUE(std::regex_search(std::string("mustfail.Fault/MustFail.IsCaughtByItsDetector/ROUND_TRN"), expression));
  EXPECT_TRUE(std::regex_search(std::string("rtl.proofs"), expression));
  EXPECT_FALSE(std::regex_search(std::string("mustfail.Fault/MustFail.IsCaught"), expression));
  EXPECT_EQ(tests_expression(plan()).find('('), std::string::npos) << "ctest refuses more than 32";
}

const std::string kDat =
    "# SystemC::Coverage-3\n"
    "C '\1f\2rtl/m.sv\1l\0022\1n\0023\1page\2v_line/m\1o\2block\1S\0022-3\1h\2TOP.a' 4\n"
    "C '\1f\2rtl/m.sv\1l\0022\1n\0023\1page\2v_line/m\1o\2block\1S\0022-3\1h\2TOP.b' 5\n"
    "C '\1f\2rtl/m.sv\1l\0024\1n\0021\1page\2v_branch/m\1o\2else\1S\1h\2TOP.a' 0\n"
    "C '\1f\2rtl/m.sv\1l\0025\1n\0021\1page\2v_user/m\1o\2some_point\1S\0025\1h\2TOP.a' 7\n";

class Lines : public ::testing::Test {
 protected:
  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("fastsplat-lines-" + std::to_string(::getpid()));
  void SetUp() override {
    std::filesystem::create_directories(folder_);
    std::ofstream(folder_ / "m.sv") << "module m;\n  begin\n  end\n  if (never) x;\nendmodule\n";
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
};

TEST_F(Lines, AddUpOverInstancesAndRuns) {
  LineCoverage coverage;
  coverage.add(kDat);
  coverage.add(kDat);
  ASSERT_EQ(coverage.points().size(), 2u);
  EXPECT_EQ(coverage.points()[0].hits, 18u);
  EXPECT_EQ(coverage.points()[0].lines, (std::vector<int>{2, 3}));
  EXPECT_EQ(coverage.cover_points().at("some_point"), 14u);
  EXPECT_THROW(coverage.add("nonsense\n"), UserError);
}

TEST_F(Lines, AreRedUnreachedAndWithWrongExclusions) {
  LineCoverage coverage;
  coverage.add(kDat);
  const auto findings = [&](const std::vector<LineExclusion>& exclusions) {
    return close_lines(coverage, folder_, exclusions).findings;
  };
  EXPECT_EQ(findings({}), (std::vector<std::string>{"never reached: m.sv:4 (else): if (never) x;"}));
  EXPECT_EQ(findings({{"m.sv", "if (never) x;", "else", "because"}}), std::vector<std::string>{});
  EXPECT_EQ(findings({{"m.sv", "if (never) x;", "else", "because"}, {"m.sv", "begin", "line", "why"}}),
            (std::vector<std::string>{"excluded, but reached: m.sv:2 (line): begin"}));
  EXPECT_EQ(findings({{"m.sv", "if (never) x;", "else", "because"}, {"m.sv", "gone", "line", "why"}}),
            (std::vector<std::string>{"excluded, but missing: m.sv: gone"}));
  EXPECT_EQ(close_lines({}, folder_, {}).findings, (std::vector<std::string>{"no lines of rtl/ were checked"}));
}

TEST(Exclusions, NameLinesThatAreThere) {
  const auto sources = sources_in(kSource / "rtl");
  std::size_t count = 0;
  for (const auto& exclusion : read_exclusions(kSource / "docs" / "coverage_exclusions.toml")) {
    const auto source = sources.find(exclusion.file);
    ASSERT_NE(source, sources.end()) << exclusion.file;
    EXPECT_NE(read_text_file(source->second).find(exclusion.line), std::string::npos) << exclusion.line;
    ++count;
  }
  std::printf("[figure] exclusions = %zu\n", count);
}

}  // namespace
}  // namespace fastsplat::testbench
