// SPDX-License-Identifier: Apache-2.0
// Results as JUnit XML, CSV and Markdown have the values of the JSON.
#include "report/formats/output_formats.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <set>

#include "base/error.hpp"
#include "report/formats/output_format.hpp"
#include "tests/formats/results_helper.hpp"
#include "tests/paths.hpp"

namespace fastsplat::report {
namespace {

using Lines = std::vector<std::vector<std::string>>;

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t number = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != text.npos; at += part.size()) ++number;
  return number;
}

bool holds(const std::string& text, const std::string& part) { return text.find(part) != text.npos; }

/// As in RFC 4180; strict.
Lines csv_lines(const std::string& text) {
  Lines lines;
  std::vector<std::string> fields;
  std::string field;
  bool quoted = false, was_quoted = false;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    if (quoted) {
      if (c != '"') {
        field += c;
      } else if (at + 1 < text.size() && text[at + 1] == '"') {
        field += text[++at];
      } else {
        quoted = false;
      }
    } else if (c == '"') {
      EXPECT_TRUE(field.empty() && !was_quoted) << "a quote within a field that has none around it";
      quoted = was_quoted = true;
    } else if (c == ',' || c == '\r') {
      fields.push_back(field);
      field.clear();
      was_quoted = false;
      if (c == ',') continue;
      EXPECT_EQ(text[++at], '\n');
      lines.push_back(fields);
      fields.clear();
    } else {
      EXPECT_FALSE(was_quoted) << "text behind a quoted field";
      EXPECT_NE(c, '\n');
      field += c;
    }
  }
  EXPECT_TRUE(fields.empty() && field.empty() && !quoted) << "the last line has no end";
  return lines;
}

TEST(OutputFormats, HelperHasEveryVerbThatIsReported) {
  std::set<std::string> subcommands;
  for (const Result& result : all_kinds()) subcommands.insert(result.subcommand);
  for (const auto& subcommand : reported_subcommands())
    EXPECT_TRUE(subcommands.contains(subcommand)) << subcommand << " has no face here";
}

TEST(OutputFormats, JunitHasACasePerGate) {
  const std::string xml = to_junit(all_kinds());
  std::size_t gates = 0, failures = 0, errors = 0;
  for (const Result& result : all_kinds()) {
    for (const Gate& gate : gates_of(result)) {
      ++gates;
      failures += gate.status == Status::Fail ? 1 : 0;
      errors += gate.status == Status::Error ? 1 : 0;
    }
  }
  std::printf("[figure] gates = %zu, failures = %zu, errors = %zu (limit > 0)\n", gates, failures, errors);
  EXPECT_EQ(gates, 3u + 1 + 2 + 1 + 1 + 1 + 1 + 1 + 3 + 1 + 1 + 1 + 4 + 1 + 5);
  EXPECT_EQ(failures, 1u + 1 + 1 + 3 + 2);  // compare, propose, plan, verify, closure
  EXPECT_EQ(errors, 1u);                    // plan
  EXPECT_EQ(count(xml, "<testcase "), gates);
  EXPECT_EQ(count(xml, "<failure "), failures);
  EXPECT_EQ(count(xml, "<error "), errors);
  EXPECT_TRUE(holds(xml, "<testsuites name=\"fastsplat\" tests=\"27\" failures=\"8\" errors=\"1\" time=\"0.500\">"))
      << xml;
}

TEST(OutputFormats, JunitHasTheReasonAndTheCommand) {
  const std::string compare = to_junit({kind("compare")});
  EXPECT_TRUE(holds(compare, "message=\"min_psnr_db is 51.4384, required is at least 60\"")) << compare;
  EXPECT_TRUE(holds(compare, "&#10;reproduce: fastsplat compare a.exr 'b c.exr' --max-lsb 1</failure>")) << compare;
  const std::string verify = to_junit({kind("verify")});
  // The first failing seed was shrunk; the others are reproduced by the campaign.
  EXPECT_TRUE(holds(verify, "name=\"tiny seed 8\"")) << verify;
  EXPECT_TRUE(
      holds(verify, "tap sheet &lt;lane 3&gt; &amp; more&#10;reproduce: fastsplat verify --stream verify-failure.fss"));
  EXPECT_EQ(count(verify, "reproduce: fastsplat verify --random 20 --seed 7 --seeds 3 --config tiny"), 2u) << verify;
  EXPECT_TRUE(holds(verify, "90 cycles of the RTL, 91 of the model"));
  const std::string plan = to_junit({kind("plan")});
  EXPECT_TRUE(holds(plan, "classname=\"fastsplat.plan.words\" name=\"compare: lanes 4, method xray\"")) << plan;
  EXPECT_TRUE(
      holds(plan, "<error message=\"timeout\" type=\"error\">timeout&#10;after 5 s&#10;reproduce: fastsplat verify"));
}

// A build server shows its cases one by one: none of them may look like a defect of the device.
TEST(OutputFormats, JunitSaysOfEveryFailingCaseThatItsFaultWasPlanted) {
  Result planted = kind("verify");
  planted.json["planted_fault"] = {{"name", "PORT_SNAP"}, {"where", "ports"}, {"meaning", "centres"}};
  std::size_t failing = 0, named = 0;
  for (const Gate& gate : gates_of(planted)) {
    failing += gate.status == Status::Pass ? 0 : 1;
    named += gate.message.starts_with("planted fault PORT_SNAP (centres): ") ? 1 : 0;
  }
  std::printf("[figure] failing cases = %zu, named as planted = %zu (expected 3)\n", failing, named);
  EXPECT_EQ(failing, 3u);
  EXPECT_EQ(named, failing);
}

TEST(OutputFormats, JunitIsWhatBuildServersRead) {
  if (std::system("command -v xmllint > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "xmllint (libxml2-utils) is not installed";
  auto results = all_kinds();
  Json odd = results.front().json;
  odd["limits"][0]["name"] = "ctl \x01 & <tag> \"quoted\" \xEF\xBF\xBF \xC3\xA4";
  results.push_back({.file = "odd <&>.json", .subcommand = "compare", .json = odd});
  const std::string file = ::testing::TempDir() + "fastsplat-faces-junit-" + std::to_string(::getpid()) + ".xml";
  std::ofstream(file, std::ios::binary) << to_junit(results);
  const auto lint = [&] {
    return std::system(
        ("xmllint --noout --schema " FASTSPLAT_SOURCE_DIR "/tests/formats/junit.xsd " + file + " 2> " + file + ".log")
            .c_str());
  };
  EXPECT_EQ(lint(), 0) << std::ifstream(file + ".log").rdbuf();
  // The check notices errors.
  std::string broken = to_junit(results);
  broken.replace(broken.find("classname="), 10, "klassname=");
  std::ofstream(file, std::ios::binary) << broken;
  EXPECT_NE(lint(), 0);
  std::remove(file.c_str());
  std::remove((file + ".log").c_str());
}

TEST(OutputFormats, AResultThatFailsWithoutAGateThatDoesFails) {
  Result result = kind("errors bound");
  result.json["holds"] = false;  // but no value exceeds it
  const auto gates = gates_of(result);
  ASSERT_EQ(gates.size(), 2u);
  EXPECT_EQ(gates[1].status, Status::Fail);
}

TEST(OutputFormats, SumsThatDoNotAddUpFail) {
  const auto failed = [](const Result& result) {
    int number = 0;
    for (const Gate& gate : gates_of(result)) number += gate.status == Status::Fail ? 1 : 0;
    return number;
  };
  EXPECT_EQ(failed(kind("errors")), 0);
  EXPECT_EQ(failed(kind("cycles")), 0);
  Result errors = kind("errors");
  errors.json["steps"][0]["share"] = 0.7501;
  EXPECT_EQ(failed(errors), 1);
  errors.json["steps"][1]["increment"]["bias_lsb8"] = 0.2501;
  EXPECT_EQ(failed(errors), 2);
  Result cycles = kind("cycles");
  cycles.json["cycles"]["account"]["output"] = 1u;
  EXPECT_EQ(failed(cycles), 1);
}

TEST(OutputFormats, CsvIsTheRowsOfTheResult) {
  std::size_t cells = 0;
  for (const Result& result : all_kinds()) {
    SCOPED_TRACE(result.subcommand);
    const Table table = table_of(result);
    const Lines lines = csv_lines(to_csv({result}));
    ASSERT_EQ(lines.size(), table.rows.size() + 1);
    if (table.columns.empty()) continue;
    EXPECT_EQ(lines[0], table.columns);
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
      ASSERT_EQ(lines[r + 1].size(), table.columns.size());
      for (std::size_t c = 0; c < table.columns.size(); ++c) {
        const Json& value = table.rows[r][c];
        const std::string& text = lines[r + 1][c];
        // Numbers keep every bit.
        if (value.is_number()) {
          EXPECT_EQ(Json::parse(text), value);
        } else {
          EXPECT_EQ(text, value.is_null() ? "" : value.is_string() ? value.get<std::string>() : value.dump());
        }
        ++cells;
      }
    }
  }
  std::printf("[figure] csv_cells = %zu (limit > 100)\n", cells);
  EXPECT_GT(cells, 100u);
}

TEST(OutputFormats, CsvOfAPlan) {
  EXPECT_EQ(
      to_csv({kind("plan")}),
      "id,kind,status,axes.lanes,axes.method,metrics.psnr_db,config_hash,command,message\r\n"
      "a1,compare,pass,8,xray,50.5,c1,fastsplat compare a b,\r\n"
      "b2,compare,fail,4,xray,30.25,c2,\"fastsplat compare a 'c, d'\",\"max_abs_lsb is 9, no more than 3 allowed\"\r\n"
      "c3,verify,error,,,,c3,fastsplat verify --random 9,\"timeout\nafter 5 s\"\r\n");
}

TEST(OutputFormats, ClosureIsAGatePerTestpointThatWasLookedAt) {
  const std::string xml = to_junit({kind("closure")});
  EXPECT_TRUE(holds(xml, "name=\"hazards\"")) << xml;
  EXPECT_TRUE(holds(xml, "open: 2 of 3 bins hit, 0 tests")) << xml;
  EXPECT_TRUE(holds(xml, "hazards, tiny: hazard.distance_1 was never hit&#10;reproduce: tools/coverage")) << xml;
  EXPECT_FALSE(holds(xml, "name=\"proofs\"")) << "nobody ran its tests: neither held nor failed";
  EXPECT_EQ(to_csv({kind("closure")}),
            "testpoint,configuration,hit,bins,fewest_hits\r\nhazards,tiny,1,2,0\r\nhazards,base,1,1,5\r\n");
}

TEST(OutputFormats, CsvOfSeveralResultsSaysWhichARowIsOf) {
  const Lines lines = csv_lines(to_csv({kind("cycles"), kind("family")}));
  ASSERT_EQ(lines.size(), 1u + 4 + 2);
  EXPECT_EQ(lines[0], (std::vector<std::string>{"result", "verb", "cycles", "count", "share", "kind", "grid",
                                                "aligned.max", "remarks", "root_steps"}));
  for (const auto& line : lines) EXPECT_EQ(line.size(), lines[0].size());
  EXPECT_EQ(lines[5][1], "family");
  EXPECT_EQ(lines[5][8], R"(["one, and \"two\"","three"])");
  EXPECT_EQ(lines[5][2], "");
}

TEST(OutputFormats, MarkdownHasVerdictGatesAndTable) {
  const std::string text = to_markdown(all_kinds());
  EXPECT_EQ(count("\n" + text, "\n### "), all_kinds().size());
  EXPECT_TRUE(holds(text, "### compare `result-0.json`: **fail**\n")) << text;
  EXPECT_TRUE(holds(
      text, "| min\\_psnr\\_db | **fail** | min\\_psnr\\_db is 51.4384, required is at least 60 | fastsplat compare "));
  EXPECT_TRUE(holds(text, "| cycles | count | share |\n| --- | ---: | ---: |\n| ideal | 100 | 0.90909 |\n")) << text;
  // Every line of a table has as many bars as its head.
  std::istringstream lines(text);
  std::size_t bars = 0, rows = 0;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("|")) {
      bars = 0;
      continue;
    }
    const std::size_t here = count(line, "|") - count(line, "\\|");
    if (bars == 0) bars = here;
    EXPECT_EQ(here, bars) << line;
    ++rows;
  }
  std::printf("[figure] markdown_rows = %zu (limit > 30)\n", rows);
  EXPECT_GT(rows, 30u);
}

TEST(OutputFormats, MarkdownCutsLongTablesAndSaysSo) {
  Result plan = kind("plan");
  const Json row = plan.json["rows"][0];
  for (int more = 0; more < 2000; ++more) plan.json["rows"].push_back(row);
  const std::string text = to_markdown({plan});
  EXPECT_TRUE(holds(text, "50 of 2003 rows")) << text.substr(text.size() - 200);
  EXPECT_LT(count(text, "\n"), 80u);
  EXPECT_EQ(csv_lines(to_csv({plan})).size(), 2004u);
  EXPECT_EQ(count(to_junit({plan}), "<testcase "), 2003u);
}

// The page's rule; messages on the terminal keep the result's path.
TEST(OutputFormats, NameFilesWithoutTheirFolders) {
  std::vector<Result> results(2, kind("compare"));
  results[0].file = "/data/jane/a/compare.json", results[1].file = "/data/jane/b/compare.json";
  results[0].json["command"] = "fastsplat compare /data/jane/a/x.exr '/data/jane/b c/y.exr'";
  results[1].json["command"] = "fastsplat compare ../jane/x.exr /srv/jane/z.exr";
  std::size_t formats = 0;
  for (const auto& format : {to_junit, to_csv, to_markdown}) {
    const std::string text = format(results);
    EXPECT_FALSE(holds(text, "jane")) << text;
    EXPECT_TRUE(holds(text, "folder-3/compare.json")) << text;
    if (format != to_csv) {
      EXPECT_TRUE(holds(text, "fastsplat compare x.exr")) << text;
    }
    ++formats;
  }
  results[0].json["limits"] = Json::array({1});
  try {
    to_junit(results);
    ADD_FAILURE() << "is accepted";
  } catch (const UserError& error) {
    EXPECT_EQ(error.parts().where, "/data/jane/a/compare.json");
  }
  std::printf("[figure] output formats without folders = %zu (limit 3)\n", formats);
}

// With any part of a result removed or replaced, the outputs are made or one line gives the error.
TEST(OutputFormats, ADamagedResultIsOneLine) {
  int refused = 0, made = 0;
  const auto try_it = [&](const Result& result) {
    for (const auto& face : {to_junit, to_csv, to_markdown}) {
      try {
        face({result});
        ++made;
      } catch (const UserError& error) {
        ++refused;
        EXPECT_EQ(error.code(), ExitCode::Input);
        EXPECT_TRUE(holds(error.what(), result.file.string())) << error.what();
        EXPECT_FALSE(holds(error.what(), "\n"));
      }
    }
  };
  for (const Result& whole : all_kinds()) {
    SCOPED_TRACE(whole.subcommand);
    const Json flat = whole.json.flatten();
    for (const auto& [place, unused] : flat.items()) {
      if (place == "/verb") continue;
      for (const Json& other : {Json(), Json("text"), Json(-1), Json(0.5), Json::object(), Json::array(), Json(true)}) {
        Result result = whole;
        result.json[Json::json_pointer(place)] = other;
        try_it(result);
      }
      Result result = whole;
      Json& parent = result.json[Json::json_pointer(place).parent_pointer()];
      if (parent.is_object()) parent.erase(Json::json_pointer(place).back());
      try_it(result);
    }
  }
  std::printf("[figure] damaged results: refused = %d, made = %d (limit > 500 each)\n", refused, made);
  EXPECT_GT(refused, 500);
  EXPECT_GT(made, 500);
}

}  // namespace
}  // namespace fastsplat::report
