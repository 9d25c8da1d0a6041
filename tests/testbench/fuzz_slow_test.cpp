// SPDX-License-Identifier: Apache-2.0
// Files that users pass, mutated by the thousand: stream files, transfer functions, coverage books. Each is accepted,
// or refused in one line as a bad file; accepted ones must work.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>

#include "base/error.hpp"
#include "cmodel/cycles/cycle_model.hpp"
#include "driver/config/config_file.hpp"
#include "driver/files/stream_file.hpp"
#include "scene/transfer_function.hpp"
#include "scene/volume/volume_file.hpp"
#include "testbench/coverage/coverage_book.hpp"
#include "testbench/stimulus/stimulus.hpp"
#include "tests/cmodel/random_helper.hpp"
#include "tests/paths.hpp"

namespace fastsplat::testbench {
namespace {

using test::Random;

/// Seed of the mutations; a seed that once found an error stays in this list.
constexpr std::uint64_t kSeeds[] = {1, 2, 3, 4, 5};
constexpr int kStreams = 3000, kTransferFunctions = 6000, kBooks = 3000;  // a seed

std::string file_bytes(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::size_t place(Random& random, const std::string& bytes) {
  return static_cast<std::size_t>(random.between(0, static_cast<std::int64_t>(bytes.size()) - 1));
}

/// Damage by bad disks, bad copies and bad writers.
void mutate_bytes(std::string& bytes, Random& random) {
  const std::size_t at = place(random, bytes);
  const auto length = static_cast<std::size_t>(random.between(1, 64));
  switch (random.between(0, 6)) {
    case 0:
      bytes[at] = static_cast<char>(random.next());
      break;
    case 1:
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << random.between(0, 7)));
      break;
    case 2:
      bytes.resize(at + 1);
      break;
    case 3:
      bytes.insert(place(random, bytes), bytes.substr(at, length));
      break;
    case 4:
      if (bytes.size() > length + 1) bytes.erase(std::min(at, bytes.size() - length), length);
      break;
    case 5:
      for (std::size_t i = at; i < std::min(bytes.size(), at + 4); ++i)
        bytes[i] = static_cast<char>(random.one_of({0, 0x7f, 0x80, 0xff}));
      break;
    default:
      bytes.append(length, static_cast<char>(random.next()));
  }
}

/// Damage by an editor's hand: another number, another word, a line doubled or missing.
void mutate_text(std::string& text, Random& random) {
  static const char* const kWords[] = {"nan",  "-inf",      "1e999", "-0.0",  "0",  "1e-300", "99999999999999999999",
                                       "true", "\"x\"",     "[]",    "{}",    "[[", "]",      "}",
                                       "\xff", "\"\"",      "-1",    "0x1p3", "=",  "#",      "\n\n",
                                       ",",    "1.0000001", "null"};
  const char* word = kWords[random.between(0, static_cast<std::int64_t>(std::size(kWords)) - 1)];
  const std::size_t at = place(random, text);
  const auto line = text.rfind('\n', at), begin = line == std::string::npos ? 0 : line + 1;
  const auto end = std::min(text.find('\n', at), text.size());
  switch (random.between(0, 5)) {
    case 0: {  // the number or word here
      const auto first = text.find_first_of("0123456789", at);
      if (first == std::string::npos) break;
      text.replace(first, std::min(text.find_first_not_of("0123456789.eE+-", first), text.size()) - first, word);
      break;
    }
    case 1:
      text.insert(at, word);
      break;
    case 2:
      text.insert(begin, text.substr(begin, end - begin) + "\n");
      break;
    case 3:
      text.erase(begin, end - begin);
      break;
    case 4: {
      const char open = "[{\"("[random.between(0, 3)];
      text.insert(at, std::string(static_cast<std::size_t>(random.between(1, 3000)), open));
      break;
    }
    default:
      mutate_bytes(text, random);
  }
  if (text.empty()) text = "\n";
}

class Fuzz : public ::testing::TestWithParam<std::uint64_t> {
 protected:
  void TearDown() override { std::filesystem::remove(path_); }
  void write(const std::string& bytes) const { std::ofstream(path_, std::ios::binary) << bytes; }

  /// True if `action` accepted the file; any refusal other than that of a bad file fails, naming the case.
  template <class Action>
  bool taken(int number, Action action) {
    try {
      action();
      return true;
    } catch (const UserError& error) {
      const std::string what = error.what();
      EXPECT_TRUE(error.code() == ExitCode::Input || error.code() == ExitCode::NotComparable) << number << ": " << what;
      EXPECT_FALSE(what.empty() || what.find('\n') != std::string::npos) << number << ": " << what;
      return false;
    } catch (const std::exception& error) {
      ADD_FAILURE() << "seed " << GetParam() << ", case " << number << ": " << error.what();
      return false;
    }
  }
  void figure(const char* what, int cases, int accepted) const {
    std::printf("[figure] seed %llu: %s = %d, of which taken = %d\n", static_cast<unsigned long long>(GetParam()), what,
                cases, accepted);
    EXPECT_GT(accepted, 0) << "every mutation was refused: they go no deeper than the first check";
    EXPECT_LT(accepted, cases);
  }

  const std::filesystem::path path_ =
      std::filesystem::path(::testing::TempDir()) / ("fastsplat_fuzz_" + std::to_string(::getpid()) + ".toml");
};

TEST_P(Fuzz, StreamFiles) {
  Random random(GetParam());
  const auto config = driver::load_config("tiny");
  driver::write_beats(
      path_, write_document(config, arranged(make_stimulus(config, StimulusClass::Mixed, GetParam(), 40).document)));
  const std::string whole = file_bytes(path_);
  int accepted = 0;
  for (int number = 0; number < kStreams; ++number) {
    std::string bytes = whole;
    // One in eight is undamaged, so that the code after a valid stream is tested too.
    for (std::int64_t i = random.between(0, 7); i > 4; --i) mutate_bytes(bytes, random);
    if (random.once_in(2)) mutate_bytes(bytes, random);
    write(bytes);
    // The reader of each subcommand; a stream that one of them accepts, all accept.
    const bool replayed = taken(number, [&] { driver::replay_stream(path_, config); });
    const bool counted = taken(number, [&] {
      cmodel::CycleModel model(config, cmodel::StreamScope::Whole, {});
      driver::feed_stream(path_, model);
    });
    EXPECT_EQ(replayed, counted) << "case " << number;
    const bool dumped = taken(number, [&] { driver::dump_stream(path_, [](const std::string&) { return true; }); });
    EXPECT_TRUE(!replayed || dumped) << "case " << number;
    taken(number, [&] { driver::require_covered(path_); });
    accepted += replayed ? 1 : 0;
  }
  figure("streams", kStreams, accepted);
}

TEST_P(Fuzz, TransferFunctions) {
  Random random(GetParam());
  const auto volume = volume::load_volume("shells:4");
  std::vector<std::string> presets;
  for (const auto& entry : std::filesystem::directory_iterator(FASTSPLAT_SOURCE_DIR "/scene/presets"))
    presets.push_back(file_bytes(entry.path()));
  std::sort(presets.begin(), presets.end());
  int accepted = 0;
  for (int number = 0; number < kTransferFunctions; ++number) {
    std::string text = presets[static_cast<std::size_t>(number) % presets.size()];
    for (std::int64_t i = random.between(1, 3); i > 0; --i) mutate_text(text, random);
    write(text);
    accepted += taken(number, [&] {
      const auto tf = scene::load_transfer_function(path_.string());
      const scene::Classifier classify(tf, volume);
      // An accepted function gives finite numbers for every value.
      for (const float value : {volume.min, 0.5f * (volume.min + volume.max), volume.max}) {
        const auto material = classify(value);
        EXPECT_TRUE(std::isfinite(material.extinction) && material.extinction >= 0.0f) << "case " << number << "\n"
                                                                                       << text;
        for (int c = 0; c < 3; ++c) EXPECT_TRUE(std::isfinite(material.colour[c])) << "case " << number << "\n" << text;
      }
    });
  }
  figure("transfer functions", kTransferFunctions, accepted);
}

TEST_P(Fuzz, CoverageBooks) {
  Random random(GetParam());
  const auto config = driver::load_config("tiny");
  auto book = CoverageBook::of(config);
  book.streams = 3;
  for (const char* campaign : {"mixed", "scene"}) {
    for (const char* bin : {"splat", "end_tile", "cull_block"}) {
      auto& coverage = book.campaigns[campaign];
      coverage.hit(coverage.declare("record", bin), 7);
    }
  }
  write_book(path_, book);
  const std::string whole = file_bytes(path_);
  int accepted = 0;
  for (int number = 0; number < kBooks; ++number) {
    std::string text = whole;
    for (std::int64_t i = random.between(1, 2); i > 0; --i)
      random.once_in(3) ? mutate_bytes(text, random) : mutate_text(text, random);
    write(text);
    accepted += taken(number, [&] {
      // A file that was read is written and reads back the same.
      auto sum = CoverageBook::of(config);
      sum.merge(read_book(path_));
      write_book(path_, sum);
      const auto again = read_book(path_);
      EXPECT_EQ(again.streams, sum.streams) << "case " << number;
      EXPECT_EQ(again.campaigns.size(), sum.campaigns.size()) << "case " << number;
    });
  }
  figure("coverage books", kBooks, accepted);
}

INSTANTIATE_TEST_SUITE_P(Seeds, Fuzz, ::testing::ValuesIn(kSeeds));

}  // namespace
}  // namespace fastsplat::testbench
