// SPDX-License-Identifier: Apache-2.0
// The fuzz targets without libFuzzer and sanitizers, in every test run: all seeds, then thousands of changed ones,
// always the same. A finding ends the test with its input in a file; `tools/fuzz` runs longer and finds more.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "tests/fuzz/mutate.hpp"
#include "tests/paths.hpp"

#define FASTSPLAT_FUZZ_TARGET(name, folder, runs) extern "C" int fuzz_##name(const std::uint8_t*, std::size_t);
#include "tests/fuzz/targets.def"
#undef FASTSPLAT_FUZZ_TARGET

namespace fastsplat::fuzz {
namespace {

namespace fs = std::filesystem;

struct Target {
  const char* name;
  int (*run)(const std::uint8_t*, std::size_t);
  const char* seeds;
  std::uint64_t runs;
};
constexpr Target kTargets[] = {
#define FASTSPLAT_FUZZ_TARGET(name, folder, runs) {#name, fuzz_##name, folder, runs},
#include "tests/fuzz/targets.def"
#undef FASTSPLAT_FUZZ_TARGET
};
void PrintTo(const Target& target, std::ostream* out) { *out << target.name; }

const Input* running = nullptr;  ///< for the handler below
std::string kept;                ///< where it goes

/// The input of a crash, then the crash.
void keep_input(int signal) {
  if (FILE* file = running == nullptr ? nullptr : std::fopen(kept.c_str(), "wb")) {
    std::fwrite(running->data(), 1, running->size(), file);
    std::fclose(file);
    std::fprintf(stderr, "its input: %s\n", kept.c_str());
  }
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

/// The targets' input file during this process: they request it once.
class Scratch : public ::testing::Environment {
 public:
  Scratch() {
    fs::create_directories(folder_);
    ::setenv("TMPDIR", folder_.c_str(), 1);
  }
  ~Scratch() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }

 private:
  fs::path folder_ = fs::temp_directory_path() / ("fastsplat-standing-" + std::to_string(::getpid()));
};
[[maybe_unused]] const auto* const scratch = ::testing::AddGlobalTestEnvironment(new Scratch);

class Standing : public ::testing::TestWithParam<Target> {
 protected:
  void SetUp() override {
    // Readers that recurse over an input fail early.
    constexpr rlimit kStack{1 << 20, RLIM_INFINITY};
    ::setrlimit(RLIMIT_STACK, &kStack);
    kept = (fs::path(FASTSPLAT_BINARY_DIR) / ("finding-" + std::string(GetParam().name))).string();
    for (const int signal : {SIGABRT, SIGSEGV, SIGFPE, SIGBUS, SIGILL}) std::signal(signal, keep_input);
  }
  void TearDown() override {
    for (const int signal : {SIGABRT, SIGSEGV, SIGFPE, SIGBUS, SIGILL}) std::signal(signal, SIG_DFL);
  }
};

TEST_P(Standing, FindsNothing) {
  const Target& target = GetParam();
  const auto seeds = inputs_in(fs::path(FASTSPLAT_SOURCE_DIR) / target.seeds);
  ASSERT_FALSE(seeds.empty()) << target.seeds;
  const auto run = [&](const Input& input) {
    running = &input;
    try {
      target.run(input.data(), input.size());
    } catch (const std::exception& error) {
      std::fprintf(stderr, "finding: an exception of its own: %s\n", error.what());
      std::abort();
    }
    running = nullptr;
  };
  const auto hard = hard_texts();
  for (const auto* inputs : {&seeds, &hard})
    for (const Input& input : *inputs) run(input);
  for (std::uint64_t number = 0; number < target.runs; ++number) run(mutated(seeds, number));
  std::printf("[figure] %s: seeds = %zu (limit > 0), hard texts = %zu, changed ones = %llu, no finding\n", target.name,
              seeds.size(), hard.size(), static_cast<unsigned long long>(target.runs));
}

INSTANTIATE_TEST_SUITE_P(Target, Standing, ::testing::ValuesIn(kTargets),
                         [](const auto& target) { return std::string(target.param.name); });

TEST(StandingInputs, AreAlwaysTheSameAndAllDifferent) {
  const std::vector<Input> seeds{Input(100, 'a'), Input{1, 2, 3, 4, 5, 6, 7, 8, 9}};
  std::set<Input> seen;
  for (std::uint64_t number = 0; number < 1000; ++number) {
    EXPECT_EQ(mutated(seeds, number), mutated(seeds, number));
    seen.insert(mutated(seeds, number));
  }
  std::printf("[figure] different inputs of 1000 = %zu (limit > 800)\n", seen.size());
  EXPECT_GT(seen.size(), 800u);
}

/// Every target of `tools/fuzz` stands here.
TEST(StandingInputs, HaveEveryTarget) {
  std::set<std::string> files, listed;
  for (const auto& entry : fs::directory_iterator(fs::path(FASTSPLAT_SOURCE_DIR) / "tests/fuzz")) {
    const std::string name = entry.path().filename().string();
    if (name.ends_with("_fuzz.cpp")) files.insert(name.substr(0, name.size() - std::string("_fuzz.cpp").size()));
  }
  for (const Target& target : kTargets) listed.insert(target.name);
  EXPECT_EQ(files, listed);
  EXPECT_GE(files.size(), 10u);
}

}  // namespace
}  // namespace fastsplat::fuzz
