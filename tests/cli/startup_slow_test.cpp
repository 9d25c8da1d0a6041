// SPDX-License-Identifier: Apache-2.0
// The start-up cost of every run: OpenImageIO, with its hundreds of libraries, is loaded for TIFF and JPEG only.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/process/process_helper.hpp"

namespace fastsplat::cli_test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kModule = "fastsplat_openimageio.so";
constexpr const char* kTag = "fastsplat-codec ";

using Words = std::vector<std::string>;

/// Commands with minimal work that do not need OpenImageIO; pictures lie in `folder`.
std::vector<Words> without_library(const TempFolder& folder) {
  const std::string png = folder / "a.png", exr = folder / "a.exr";
  return {
    {"--version"},
    {"help"},
    {"cycles", "--volume", "shells:4", "--size", "8", "--config", "tiny"},
    {"verify", "--config", "tiny", "--volume", "shells:4", "--size", "8"},
    {"config", "list"},
    {"volume", "info", "shells:8"},
    {"render", "--volume", "shells:8", "--size", "8", "-o", png, "-o", exr},
    {"compare", exr, exr},
  };
}

Surroundings with_environment(const Words& settings) {
  Surroundings surroundings;
  surroundings.environment = settings;
  return surroundings;
}

/// The libraries that the loader brings into a run, by name.
Words libraries_of(const Words& arguments, const std::string& trace) {
  expect_success(fastsplat(arguments, with_environment({"LD_DEBUG=files", "LD_DEBUG_OUTPUT=" + trace})));
  Words names;
  for (const auto& entry : fs::directory_iterator(fs::path(trace).parent_path())) {
    if (entry.path().string().rfind(trace + ".", 0) != 0) continue;
    std::istringstream lines(read_bytes(entry.path()));
    for (std::string line; std::getline(lines, line);) {
      const auto at = line.find("calling init: ");
      if (at != std::string::npos) names.push_back(fs::path(line.substr(at + 14)).filename());
    }
  }
  EXPECT_FALSE(names.empty()) << "the loader printed nothing: nothing was checked";
  return names;
}

bool any_holds(const Words& names, const std::string& part) {
  return std::any_of(names.begin(), names.end(), [&](const auto& name) { return name.find(part) != name.npos; });
}

double cpu_seconds_of_children() {
  rusage usage{};
  ::getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& time) { return static_cast<double>(time.tv_sec) + time.tv_usec * 1e-6; };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

TEST(StartUp, OpenImageIoIsLoadedForTiffAlone) {
  const TempFolder folder;
  int run = 0;
  std::size_t most = 0;
  for (const auto& arguments : without_library(folder)) {
    SCOPED_TRACE(arguments[0]);
    const auto names = libraries_of(arguments, folder / ("trace" + std::to_string(++run)));
    EXPECT_FALSE(any_holds(names, "OpenImageIO"));
    EXPECT_FALSE(any_holds(names, kModule));
    most = std::max(most, names.size());
  }
  std::printf("[figure] libraries_without_openimageio = %zu (limit <= 40)\n", most);
  EXPECT_LE(most, 40u);

  const auto names =
      libraries_of({"render", "--volume", "shells:8", "--size", "8", "-o", folder / "a.tif"}, folder / "p");
  EXPECT_TRUE(any_holds(names, "libOpenImageIO.so"));
  EXPECT_TRUE(any_holds(names, kModule));
  EXPECT_TRUE(fs::exists(folder / "a.tif"));
  std::printf("[figure] libraries_with_openimageio = %zu (limit > %zu)\n", names.size(), most);
  EXPECT_GT(names.size(), most);
}

TEST(StartUp, TakesLessThanATwentiethOfASecond) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "the sanitizer's own start is longer";
#endif
  const TempFolder folder;
  constexpr int kMostRuns = 100;  // the minimum counts: other work on the machine only adds
  for (const auto& arguments : without_library(folder)) {
    const double limit = arguments[0] == "render" || arguments[0] == "compare" ? 0.06 : 0.05;
    double least = 1e9;
    for (int run = 0; run < kMostRuns && least >= limit; ++run) {
      const double before = cpu_seconds_of_children();
      expect_success(fastsplat(arguments));
      least = std::min(least, cpu_seconds_of_children() - before);
    }
    std::printf("[figure] cpu_seconds_%s = %.4f (limit < %.2f)\n", arguments[0].c_str(), least, limit);
    EXPECT_GT(least, 0.0) << "nothing was measured";
    EXPECT_LT(least, limit) << arguments[0];
  }
}

/// A program copied out of its build, with the files beside it.
class Copied {
 public:
  Copied() {
    fs::create_directory(folder_.path() / "bin");
    fs::copy_file(program(), bin("fastsplat"));
  }
  std::string bin(const std::string& name) const { return folder_ / ("bin/" + name); }
  std::string operator/(const std::string& name) const { return folder_ / name; }
  static fs::path module() { return fs::path(program()).parent_path() / kModule; }
  /// Golden takes minutes for this: a refusal after the work is a time-out.
  Result render_for_minutes(const Words& environment = {}) const {
    return run_words({bin("fastsplat"), "render", "--volume", "shells:256", "--size", "4096", "-o", folder_ / "a.tif"},
                     with_environment(environment));
  }
  Result render() const {
    return run_words({bin("fastsplat"), "render", "--volume", "shells:8", "--size", "8", "-o", folder_ / "a.tif"});
  }
  void expect_refused(const Result& result, const Words& words) const {
    expect_error(result, 3, words);
    EXPECT_FALSE(fs::exists(folder_ / "a.tif"));
  }

 private:
  TempFolder folder_;
};

TEST(StartUp, AMissingModuleIsReportedBeforeTheWork) {
  const Copied copied;
  copied.expect_refused(copied.render_for_minutes(), {kModule, "missing", "/lib/fastsplat/", "./run build"});
  // Other errors of a command come first: the library costs a quarter of a second.
  const std::string raw = copied / "a.exr", shown = copied / "a.tif";
  const std::vector<Words> wrong{
      {"render", "--volume", "shells:8", "--size", "0", "-o", shown},
      {"render", "--volume", "shells:8", "--config", "none", "--engine", "cmodel", "-o", shown},
      {"render", "--volume", "shells:8", "--orbit", "0", "--frames", "2", "-o", shown},
      {"render", "--gaussians", "shells:8", "--size", "0", "-o", shown},
      {"errors", "--volume", "shells:8", "--size", "0", "--maps", copied / "m"},
      {"errors", "bound", "--volume", "shells:8", "--size", "0", "--maps", copied / "m"},
      {"stream", "replay", raw, "--config", "none", "-o", raw},
      {"compare", raw, raw, "--max-lsb", "-1"}};
  for (auto words : wrong) {
    words.insert(words.begin(), copied.bin("fastsplat"));
    EXPECT_EQ(run_words(words).code, 2) << words[1] << ' ' << words[2];
  }
  std::printf("[figure] wrong commands refused without the library = %zu\n", wrong.size());
  const auto compared = run_words({copied.bin("fastsplat"), "compare", "a.exr", "b.exr"});
  EXPECT_EQ(compared.code, 3) << compared.err;
  expect_success(run_words({copied.bin("fastsplat"), "volume", "info", "shells:8"}));
  const auto doctor = run_words({copied.bin("fastsplat"), "doctor", "--json", "-"});
  expect_success(doctor);
  EXPECT_NE(nlohmann::json::parse(doctor.out)["missing"].dump().find(kModule), std::string::npos) << doctor.out;
}

TEST(StartUp, TheModuleIsFoundBesideTheProgramOrInItsLib) {
  {
    const Copied copied;
    fs::copy_file(Copied::module(), copied.bin(kModule));
    expect_success(copied.render());
    EXPECT_GT(fs::file_size(copied / "a.tif"), 0u);
  }
  const Copied copied;
  fs::create_directories(copied / "lib/fastsplat");
  fs::copy_file(Copied::module(), copied / ("lib/fastsplat/" + std::string(kModule)));
  expect_success(copied.render());
  EXPECT_GT(fs::file_size(copied / "a.tif"), 0u);
}

TEST(StartUp, AModuleOfAnotherBuildIsRefused) {
  const Copied copied;
  std::string bytes = read_bytes(Copied::module());
  const auto at = bytes.find(kTag);
  ASSERT_NE(at, std::string::npos);
  bytes[at + std::string(kTag).size()] = '9';  // of its version
  std::ofstream(copied.bin(kModule), std::ios::binary) << bytes;
  copied.expect_refused(copied.render_for_minutes(), {kModule, "another build", "got fastsplat-codec 9"});
}

TEST(StartUp, AModuleThatCannotBeLoadedIsRefused) {
  {
    const Copied copied;
    std::ofstream(copied.bin(kModule)) << "no library";
    copied.expect_refused(copied.render_for_minutes(), {kModule, "cannot be loaded", "tools/debian.txt"});
  }
  // A required library is broken.
  const Copied copied;
  fs::copy_file(Copied::module(), copied.bin(kModule));
  std::string needed;
  std::istringstream names(run_words({"ldd", Copied::module()}).out);
  for (std::string name; names >> name;) {
    if (name.rfind("libOpenImageIO.so", 0) == 0) needed = name;
  }
  ASSERT_FALSE(needed.empty());
  std::ofstream(copied / needed) << "no library";
  copied.expect_refused(copied.render_for_minutes({"LD_LIBRARY_PATH=" + (copied / "")}), {kModule, needed});
}

}  // namespace
}  // namespace fastsplat::cli_test
