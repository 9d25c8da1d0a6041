// SPDX-License-Identifier: Apache-2.0
// The installed package, moved to another folder: an otherwise unprepared project finds and links it, in C and in
// Python, and gets the program's words.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/capi/recorded_helper.hpp"
#include "tests/paths.hpp"

namespace fastsplat::test {
namespace {

namespace fs = std::filesystem;

/// The package in a user's folder, not where it was installed.
const fs::path& installed() {
  static const fs::path kept = [] {
    const fs::path first = recorded().folder / "first", then = recorded().folder / "kept";
    const auto result = cli_test::run_words(
        {"cmake", "--install", FASTSPLAT_BINARY_DIR, "--component", "capi", "--prefix", first.string()});
    EXPECT_EQ(result.code, 0) << result.out << result.err;
    fs::rename(first, then);
    return then;
  }();
  return kept;
}

std::map<std::string, std::uint64_t> pairs_of(const std::string& text) {
  std::map<std::string, std::uint64_t> out;
  std::istringstream lines(text);
  std::string name;
  std::uint64_t value = 0;
  while (lines >> name >> value) out[name] = value;
  return out;
}

/// The program's output for the stream: counters, and all words of its pixels.
std::map<std::string, std::uint64_t> truth() {
  std::map<std::string, std::uint64_t> out;
  std::ifstream in(recorded().vectors + "/vectors.json");
  const auto json = nlohmann::json::parse(in);
  for (const auto& [name, value] : json["counters"].items()) out[name] = value;
  const auto replayed = cli_test::fastsplat({"stream", "replay", recorded().stream, "--config", "tiny", "--json", "-"});
  EXPECT_EQ(nlohmann::json::parse(replayed.out)["counters"]["windows"], out["windows"]);
  std::ifstream pixels(recorded().vectors + "/pixel.hex");
  std::string word;
  for (std::uint64_t at = 0; pixels >> word; ++at)
    if (at % 9 >= 5) out["pixels"] += std::stoul(word, nullptr, 16);
  return out;
}

TEST(CapiPackage, AnotherProjectLinksItAndGetsTheProgramsWords) {
  const std::string build = recorded().folder / "consumer";
  for (const auto& command :
       std::vector<std::vector<std::string>>{{"cmake", "-G", "Ninja", "-S", FASTSPLAT_SOURCE_DIR "/tests/capi/consumer",
                                              "-B", build, "-DCMAKE_PREFIX_PATH=" + installed().string()},
                                             {"cmake", "--build", build}}) {
    const auto result = cli_test::run_words(command);
    ASSERT_EQ(result.code, 0) << result.out << result.err;
  }
  const auto result = cli_test::run_words({build + "/consumer", "tiny", recorded().stream});
  ASSERT_EQ(result.code, 0) << result.err;
  const auto got = pairs_of(result.out);
  std::printf("[figure] consumer_splats = %llu (limit > 0)\n[figure] consumer_pixels = %llu (limit > 0)\n",
              static_cast<unsigned long long>(got.at("splats")), static_cast<unsigned long long>(got.at("pixels")));
  EXPECT_GT(got.at("pixels"), 0u);
  EXPECT_EQ(got, truth());
  EXPECT_EQ(cli_test::run_words({build + "/consumer", "small", recorded().stream}).code, 3);
}

TEST(CapiPackage, PythonGetsTheProgramsWords) {
  const std::string python = python_with("numpy");
  if (python.empty()) GTEST_SKIP() << "python3-numpy is not installed";
  cli_test::Surroundings here;
  here.environment = {"PYTHONPATH=" + (installed() / "share/fastsplat/python").string(), "PYTHONDONTWRITEBYTECODE=1"};
  const auto result = cli_test::run_words(
      {python, FASTSPLAT_SOURCE_DIR "/tests/capi/python_words.py", recorded().stream, recorded().vectors}, here);
  std::printf("%s", result.out.c_str());
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.out.find("[figure] python_records ="), std::string::npos);
  // If a library is named, no other takes its place.
  here.environment.push_back("FASTSPLAT_LIBRARY=/proc/libfastsplat.so.3");
  const auto elsewhere = cli_test::run_words({python, "-c", "import fastsplat"}, here);
  EXPECT_NE(elsewhere.code, 0);
  EXPECT_NE(elsewhere.err.find("ImportError: /proc/libfastsplat.so.3: "), std::string::npos) << elsewhere.err;
}

}  // namespace
}  // namespace fastsplat::test
