// SPDX-License-Identifier: Apache-2.0
// The example bench in its simulation: passes the healthy device and names the first difference of a faulty one.
#include <gtest/gtest.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "tests/capi/recorded_helper.hpp"

namespace fastsplat::test {
namespace {

cli_test::Result bench(const std::vector<std::string>& arguments) {
  std::vector<std::string> words{FASTSPLAT_CAPI_BENCH, "+beats=" + recorded().vectors + "/beats.hex"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  auto result = cli_test::run_words(words);
  std::printf("%s", result.out.c_str());
  return result;
}

/// The number before `what` in the text, or -1.
long number_before(const std::string& text, const std::string& what) {
  const auto at = text.find(what);
  if (at == std::string::npos) return -1;
  const auto begin = text.find_last_not_of("0123456789", at - 1) + 1;
  return std::stol(text.substr(begin, at - begin));
}

TEST(CapiBench, PassesTheDeviceAsItIs) {
  const std::vector<std::vector<std::string>> runs{
      {}, {"+input=random-60", "+output=burst-16", "+seed=5"}, {"+output=every-3", "+seed=7"}};
  for (const auto& run : runs) {
    const auto result = bench(run);
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_NE(result.out.find("PASS: pass: configuration tiny"), std::string::npos);
    const long comparisons = number_before(result.out, " comparisons");
    std::printf("[figure] bench_comparisons = %ld (limit > 10000)\n", comparisons);
    EXPECT_GT(comparisons, 10000);
    EXPECT_NE(result.out.find(", 0 mismatches, busy cycles"), std::string::npos);
  }
}

TEST(CapiBench, FailsWithAFaultPlantedAndNamesItsFirstMismatch) {
  struct Case {
    const char *fault, *first;
  };
  // Lines of testbench/faults/faults.def: ROUND_TRN, SNAP_OFF_BY_ONE, MISSED_DIRTY.
  for (const Case one :
       {Case{"1", "stage sheet"}, Case{"4", "expected stage snap"}, Case{"15", "expected stage composite"}}) {
    const auto result = bench({std::string("+fault=") + one.fault});
    EXPECT_NE(result.code, 0) << one.fault;
    EXPECT_NE(result.out.find("FAIL: mismatch: configuration tiny"), std::string::npos) << one.fault;
    EXPECT_NE(result.out.find(std::string("first mismatch: ") + one.first), std::string::npos) << one.fault;
    std::printf("[figure] bench_mismatches_%s = %ld (limit > 0)\n", one.fault,
                number_before(result.out, " mismatches"));
    EXPECT_GT(number_before(result.out, " mismatches"), 0);
  }
}

/// Unknown faults, and faults of other devices: a pass would be of another device than the one requested.
TEST(CapiBench, RefusesUnknownFaults) {
  for (const auto& [fault, why] : {std::pair{"999", "FAIL: no fault 999: 1 to "},
                                   {"abc", "FAIL: +fault: no number: abc"},
                                   {"1 2", "FAIL: +fault: no number: 1 2"},
                                   {"40", "FAIL: fault 40 was not seen"}}) {
    const auto result = bench({std::string("+fault=") + fault});
    EXPECT_NE(result.code, 0) << fault;
    EXPECT_EQ(result.out.find("PASS"), std::string::npos) << fault;
    EXPECT_NE(result.out.find(why), std::string::npos) << fault;
  }
  EXPECT_NE(bench({"+seed=abc"}).out.find("FAIL: +seed: no number: abc"), std::string::npos);
}

/// Lines that are not beats are reported; the lines after them are not silently left out.
TEST(CapiBench, RefusesLinesThatAreNotBeats) {
  const cli_test::TempFolder folder;
  const std::string whole = cli_test::read_bytes(recorded().vectors + "/beats.hex");
  const std::string beat = whole.substr(0, 64);
  for (const std::string& last :
       {std::string("this is not hex\n"), beat + "00\n", beat.substr(0, 63) + "\n", beat + " 0\n", std::string("\n")}) {
    const auto result =
        cli_test::run_words({FASTSPLAT_CAPI_BENCH, "+beats=" + folder.write("damaged.hex", whole + last)});
    EXPECT_NE(result.code, 0) << last;
    EXPECT_NE(result.out.find(": no beat of 64 hex digits"), std::string::npos) << last << result.out;
  }
  const auto plain = cli_test::run_words({FASTSPLAT_CAPI_BENCH, "+beats=" + folder.write("dos.hex", beat + "\r\n")});
  EXPECT_EQ(plain.out.find("no beat of"), std::string::npos) << plain.out;
}

/// Verdicts are reported and compared: if a corner is read wrongly, a wrong verdict is the first difference.
TEST(CapiBench, ChecksTheVerdictsOfADeviceThatCulls) {
  const auto culling = [](const std::string& fault) {
    auto result = cli_test::run_words(
        {FASTSPLAT_CAPI_BENCH_CULL, "+beats=" + recorded_that_culls().vectors + "/beats.hex",
         std::string("+config=") + kCulling, "+input=every-6", "+output=every-3", "+fault=" + fault});
    std::printf("%s", result.out.c_str());
    return result;
  };
  const auto right = culling("0");
  EXPECT_EQ(right.code, 0) << right.err;
  EXPECT_NE(right.out.find("PASS: pass: configuration cull"), std::string::npos);
  // Its counters have 16 bits and have wrapped; the message prints the expected value modulo 2^16, as the device does.
  const auto busy = right.out.find("busy cycles ");
  ASSERT_NE(busy, std::string::npos);
  const auto cycles = right.out.substr(busy + 12, right.out.find(',', busy) - busy - 12);
  EXPECT_NE(right.out.find(", expected " + cycles + "\n"), std::string::npos);
  EXPECT_LT(std::stol(cycles), 65536);
  const auto contents = nlohmann::json::parse(cli_test::read_bytes(recorded_that_culls().vectors + "/vectors.json"));
  EXPECT_GT(contents.at("beats").get<long>() * 6, 65536);
  const int sets = contents.at("counters").at("cull_blocks");
  std::printf("[figure] bench_verdicts = %d (limit > 0)\n", sets);
  EXPECT_GT(sets, 0);
  // The line of CULL_CORNER in testbench/faults/faults.def.
  const auto wrong = culling("40");
  EXPECT_NE(wrong.code, 0);
  EXPECT_NE(wrong.out.find("first mismatch: verdict: expected tag"), std::string::npos);
}

TEST(CapiBench, PrintsThePagesOutput) {
  const std::string page = cli_test::read_bytes(FASTSPLAT_SOURCE_DIR "/docs/capi.md");
  ASSERT_NE(page.find("stream record --volume shells:20 --size 44x40 --config tiny -o"), std::string::npos)
      << "recorded() is another scene's";
  ASSERT_NE(page.find("+input=random-60 +output=burst-16 +seed=5"), std::string::npos);
  const auto said = bench({"+input=random-60", "+output=burst-16", "+seed=5"});
  const auto broken = bench({"+fault=1"});
  int lines = 0;
  for (const auto* result : {&said, &broken}) {
    std::istringstream out(result->out);
    for (std::string line; std::getline(out, line);) {
      if (!line.starts_with("PASS") && !line.starts_with("FAIL") && !line.starts_with("first mismatch")) continue;
      EXPECT_NE(page.find("    " + line + "\n"), std::string::npos) << "docs/capi.md has not: " << line;
      ++lines;
    }
  }
  std::printf("[figure] bench_lines_on_the_page = %d (limit 3)\n", lines);
  EXPECT_EQ(lines, 3);
}

TEST(CapiBench, PrintsWhyTheVerdictIsMissing) {
  const cli_test::TempFolder folder;
  const std::string whole = cli_test::read_bytes(recorded().vectors + "/beats.hex");
  const std::string cut = folder.write("cut.hex", whole.substr(0, 20 * 65));  // 20 lines of 64 digits
  const auto result = cli_test::run_words({FASTSPLAT_CAPI_BENCH, "+beats=" + cut});
  EXPECT_NE(result.code, 0);
  EXPECT_NE(result.out.find("first mismatch: beat 20 (byte offset 640): stream ends too early"), std::string::npos)
      << result.out;
  EXPECT_NE(result.out.find("FAIL: not finished: configuration tiny"), std::string::npos) << result.out;
}

TEST(CapiBench, RefusesWhatItCannotCheck) {
  EXPECT_NE(bench({"+config=small"}).out.find("the device was built for another configuration"), std::string::npos);
  EXPECT_NE(bench({"+output=never-3"}).out.find("unknown ready/valid pattern"), std::string::npos);
  const auto none = cli_test::run_words({FASTSPLAT_CAPI_BENCH});
  EXPECT_NE(none.code, 0);
  EXPECT_NE(none.out.find("FAIL: no +beats=FILE"), std::string::npos) << none.out;
}

}  // namespace
}  // namespace fastsplat::test
