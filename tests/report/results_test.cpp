// SPDX-License-Identifier: Apache-2.0
// Each subcommand's result gets its sentence; any other file gives one error line.
#include "report/results.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "base/error.hpp"
#include "report/report.hpp"
#include "tests/images/image_helper.hpp"

namespace fastsplat::report {
namespace {

const Json kCompare = Json::parse(R"({"schema":"fastsplat.compare/1","verdict":"fail","width":4,"height":4,"channels":4,
  "lsb_bits":8,"psnr_db":41.25,"identical":false,"max_abs_lsb":7.5,"percentiles_lsb":{"p50":0.1},"floor":{},
  "histogram":[],"clusters":[],"limits":[{"name":"min_psnr_db","limit":48.0,"got":41.25,"ok":false},
  {"name":"max_abs_lsb","limit":3.0,"got":7.5,"ok":false},{"name":"min_values","limit":1.0,"got":64.0,"ok":true}]})");

class Results : public ::testing::Test {
 protected:
  std::string write(const std::string& text) const {
    std::ofstream(folder_ / "r.json", std::ios::binary) << text;
    return (folder_ / "r.json").string();
  }
  Verdict verdict(const Json& json) const { return verdict_of(read_result(write(json.dump()))); }
  /// One line that names the file and holds the words.
  void expect_refused(const std::string& text, const std::vector<std::string>& words) const {
    const std::string file = write(text);
    try {
      read_result(file);
      ADD_FAILURE() << "taken: " << text;
    } catch (const UserError& error) {
      const std::string line = error.what();
      EXPECT_EQ(error.code(), ExitCode::Input);
      EXPECT_EQ(line.find('\n'), std::string::npos) << line;
      EXPECT_TRUE(line.starts_with(file + ": ")) << line;
      EXPECT_LT(line.size(), file.size() + 300) << line;
      for (const auto& word : words) EXPECT_NE(line.find(word), std::string::npos) << line;
    }
  }
  images::TempFolder folder_;
};

TEST_F(Results, AFailedCompareNamesItsLimits) {
  const Verdict verdict_got = verdict(kCompare);
  EXPECT_EQ(verdict_got.status, Status::Fail);
  EXPECT_EQ(verdict_got.sentence, "PSNR 41.25 dB (required: at least 48), worst error 7.5 LSB (required: at most 3)");
  Json passed = kCompare;
  passed["verdict"] = "pass";
  EXPECT_EQ(verdict(passed).sentence, "41.2 dB, worst error 7.5 LSB of 8 bits: within all limits");
  passed["identical"] = true;
  passed["psnr_db"] = nullptr;
  EXPECT_EQ(verdict(passed).sentence, "the pictures are identical");
}

TEST_F(Results, VerifyPrintsWhatWasCompared) {
  Json json{{"verb", "verify"}, {"verdict", "pass"}, {"comparisons", 1234567},
            {"mismatches", 0},  {"splats", 1},       {"config", "tiny"}};
  EXPECT_EQ(verdict(json).sentence,
            "RTL and model agree bit for bit: 1,234,567 comparisons of configuration tiny, 1 splat, no difference");
  json["verdict"] = "mismatch";
  json["mismatches"] = 12;
  EXPECT_EQ(verdict(json).status, Status::Fail);
  EXPECT_EQ(verdict(json).sentence, "RTL and model differ 12 times in 1,234,567 comparisons of configuration tiny");
  json["verdict"] = "nothing compared";
  EXPECT_EQ(verdict(json).status, Status::Fail);
  json["verdict"] = "simulation failed";
  EXPECT_EQ(verdict(json).status, Status::Error);
}

/// A result of 3-D Gaussians has no scene with a volume: it used to be refused as damaged.
TEST_F(Results, RendersOfVolumesAndOfGaussiansPrintTheirSize) {
  Json json{
      {"verb", "render"}, {"engine", "golden"}, {"scene", {{"volume", "shells:8"}, {"width", 64}, {"height", 48}}}};
  EXPECT_EQ(verdict(json).sentence, "64 x 48 pixels by the golden engine, shells:8");
  json.erase("scene");
  json["gaussians"] = {{"name", "cloud:50"}, {"width", 32}, {"height", 16}};
  EXPECT_EQ(verdict(json).sentence, "32 x 16 pixels by the golden engine, cloud:50");
}

TEST_F(Results, APlanIsAsGoodAsItsWorstCase) {
  Json plan{{"verb", "plan"}, {"name", "words"}, {"rows", Json::array({{{"status", "pass"}}, {{"status", "pass"}}})}};
  EXPECT_EQ(verdict(plan).sentence, "all 2 cases of plan words passed");
  plan["rows"].push_back({{"status", "fail"}});
  EXPECT_EQ(verdict(plan).sentence, "1 of 3 cases of plan words failed");
  plan["rows"].push_back({{"status", "error"}});
  EXPECT_EQ(verdict(plan).status, Status::Error);
  plan["rows"] = Json::array();
  EXPECT_EQ(verdict(plan).status, Status::Error) << "a plan that ran nothing proves nothing";
}

TEST_F(Results, ClosurePrintsHowMuchOrTheFirstOpenBin) {
  Json json{{"verb", "closure"},
            {"verdict", "closed"},
            {"bins", {{"hit", 1200}, {"all", 1200}}},
            {"lines", {{"reached", 70}, {"excused", 3}, {"all", 73}}},
            {"tests", {{"passed", 9}, {"failed", 0}, {"not_run", 1}}},
            {"open", {{"campaigns", Json::array()}, {"testpoints", Json::array()}, {"lines", Json::array()}}}};
  EXPECT_EQ(verdict(json).status, Status::Pass);
  EXPECT_EQ(verdict(json).sentence,
            "coverage is closed: 1,200 of 1,200 bins hit, 70 of 73 lines and branches reached, 3 excused, 9 tests of "
            "the plan passed");
  json["lines"] = {{"reached", 0}, {"excused", 0}, {"all", 0}};
  json["tests"]["passed"] = 0;
  EXPECT_EQ(verdict(json).sentence, "coverage is closed: 1,200 of 1,200 bins hit") << "nobody counted lines";
  json["verdict"] = "open";
  json["open"]["lines"] = {"a.sv:3 was never reached", "b.sv:9 was never reached"};
  EXPECT_EQ(verdict(json).status, Status::Fail);
  EXPECT_EQ(verdict(json).sentence, "coverage is open in 2 places: a.sv:3 was never reached");
  json["verdict"] = "ajar";
  expect_refused(json.dump(), {"damaged result of `closure`", "closed or open"});
}

TEST_F(Results, TheWorstIsTheReportsVerdict) {
  const std::vector<Verdict> all{
      {Status::Measured, "m"}, {Status::Pass, "p"}, {Status::Fail, "first"}, {Status::Fail, "second"}};
  EXPECT_EQ(verdict_of(all).sentence, "first");
  EXPECT_EQ(verdict_of(std::vector<Verdict>{all[0], all[1]}).sentence, "p");
  const Json data = page_data({read_result(write(kCompare.dump()))});
  EXPECT_EQ(data["verdict"]["status"], "fail");
  EXPECT_EQ(data["results"][0], kCompare) << "results go in as they are";
}

TEST_F(Results, FilesThatAreNotResultsAreRefusedInOneLine) {
  expect_refused("", {"empty"});
  expect_refused("{\"verb\": \"compare\", ", {"truncated"});
  expect_refused("not json", {"not a result", "invalid JSON at byte 2"});
  expect_refused("\x89PNG\r\n\x1a\n", {"invalid JSON", "--picture"});
  expect_refused("[1, 2]", {"not a result", "a JSON array"});
  expect_refused("{\"a\": 1}", {"without a \"verb\""});
  expect_refused("{\"verb\": 7}", {"without a \"verb\""});
  expect_refused("{\"verb\": \"frobnicate\"}", {"'frobnicate' is not supported", "known"});
  expect_refused("{\"verb\": \"comparee\"}", {"did you mean 'compare'"});
  expect_refused("{\"verb\": \"line\\nbreak\"}", {"is not supported"});
}

TEST_F(Results, DamageIsNamed) {
  Json damaged = kCompare;
  damaged.erase("limits");
  expect_refused(damaged.dump(), {"damaged result of `compare`", "limits", "a list", "nothing"});
  damaged = kCompare;
  damaged["width"] = "wide";
  expect_refused(damaged.dump(), {"width", "a count", "\"wide\""});
  damaged = kCompare;
  damaged["limits"] = Json::array({7});
  expect_refused(damaged.dump(), {"damaged result of `compare`"});
  for (const auto& subcommand : reported_subcommands())
    expect_refused(Json{{"verb", subcommand}}.dump(), {"damaged result of `" + subcommand});
  std::printf("[figure] verbs with a report = %zu (limit >= 14)\n", reported_subcommands().size());
  EXPECT_GE(reported_subcommands().size(), 14u);
}

}  // namespace
}  // namespace fastsplat::report
