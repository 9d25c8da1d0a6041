// SPDX-License-Identifier: Apache-2.0
// Subcommands that read streams and configurations, on invalid ones: the message has file and place, and comes after
// the valid part was printed.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <nlohmann/json.hpp>

#include "driver/config/config_file.hpp"
#include "driver/files/stream_file.hpp"
#include "testbench/stimulus/stream_document.hpp"
#include "tests/process/process_helper.hpp"

namespace fastsplat::cli_test {
namespace {

class StreamSubcommands : public ::testing::Test {
 protected:
  void SetUp() override {
    expect_success(
        fastsplat({"stream", "record", "--volume", "shells:8", "--size", "48", "--config", "tiny", "-o", stream_}));
  }
  TempFolder folder_;
  const std::string stream_ = folder_ / "s.fss";
};

// No writer: opening it for reading would block for ever.
TEST_F(StreamSubcommands, PipesAreNotFiles) {
  const std::string pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const std::vector<std::vector<std::string>> commands{
      {"stream", "dump", pipe},
      {"stream", "replay", pipe, "--config", "tiny"},
      {"cycles", "--stream", pipe, "--config", "tiny"},
      {"verify", "--stream", pipe, "--config", "tiny"},
      {"config", "check", pipe},
      {"config", "show", pipe},
      {"config", "diff", "base", pipe},
      {"render", "--volume", "shells:8", "--size", "8", "--engine", "cmodel", "--config", pipe, "-o",
       folder_ / "a.exr"},
      {"render", "--volume", "shells:8", "--size", "8", "--tf", pipe, "-o", folder_ / "a.exr"},
      {"render", "--scene", pipe, "-o", folder_ / "a.exr"},
      {"volume", "info", pipe},
      {"compare", pipe, pipe}};
  for (const auto& command : commands) {
    SCOPED_TRACE(command[0] + " " + command[1]);
    // A hanging process is ended by the signal, long before the helper times out.
    std::vector<std::string> words{"timeout", "10", program()};
    words.insert(words.end(), command.begin(), command.end());
    const auto run = run_words(words);
    ASSERT_NE(run.code, 124) << "waits for ever";
    if (command[0] == "verify") {  // whose seed comes first
      EXPECT_EQ(run.code, 3);
      EXPECT_NE(run.err.find("regular file"), std::string::npos) << run.err;
    } else {
      expect_error(run, 3, {pipe, "regular file"});
    }
  }
  std::printf("[figure] commands that refuse a pipe = %zu\n", commands.size());
}

// S-reader-3.
TEST_F(StreamSubcommands, ADumpPrintsTheBeatsAndThenTheError) {
  const auto whole = read_bytes(stream_);
  const auto good = fastsplat({"stream", "dump", stream_});
  expect_success(good);
  EXPECT_NE(good.out.find(" hash="), std::string::npos) << "as everywhere";
  EXPECT_NE(good.out.find(" magic=0x31535346"), std::string::npos);

  const std::string cut_beat = std::to_string(cmodel::kBeatBytes - 7) + " bytes";
  const std::pair<std::string, const char*> damages[] = {
      {whole.substr(0, whole.size() - cmodel::kBeatBytes), "end_frame"},
      {whole.substr(0, whole.size() - 7), cut_beat.c_str()},
      {whole + std::string(cmodel::kBeatBytes, '\0'), "opcode"}};
  for (const auto& [bytes, message] : damages) {
    const auto run = fastsplat({"stream", "dump", folder_.write("d.fss", bytes), "--json", folder_ / "d.json"});
    EXPECT_EQ(run.code, 3) << message;
    EXPECT_NE(run.err.find("d.fss: beat "), std::string::npos) << run.err;
    EXPECT_NE(run.err.find(message), std::string::npos) << run.err;
    EXPECT_NE(run.out.find("begin_tile"), std::string::npos) << "nothing of it is printed";
    const auto json = nlohmann::json::parse(read_bytes(folder_ / "d.json"));
    EXPECT_GT(json.at("records").size(), 10u);
    EXPECT_TRUE(json.contains("error"));
  }
  // A limit of four records prints four.
  expect_success(fastsplat({"stream", "dump", folder_ / "d.fss", "--limit", "4"}));
}

// A text file is reported as "no stream", not as a stream that ends too early (S-reader-1, S-reader-3).
TEST_F(StreamSubcommands, FilesThatAreNotStreamsAreRefused) {
  const auto whole = read_bytes(stream_);
  std::string other_magic = whole;
  other_magic[4] = 'X';
  int refused = 0;
  for (const auto& path :
       {folder_.write("short.txt", "a text of more than one beat, then"),
        folder_.write("long.txt", std::string(100000, 'x')), folder_.write("magic.fss", other_magic)}) {
    for (const std::vector<std::string>& command : {std::vector<std::string>{"stream", "dump", path},
                                                    {"stream", "replay", path, "--config", "tiny"},
                                                    {"cycles", "--stream", path, "--config", "tiny"},
                                                    {"verify", "--stream", path, "--config", "tiny"}}) {
      const auto run = fastsplat(command);
      EXPECT_EQ(run.code, 3) << command[0] << " " << path;
      EXPECT_NE(run.err.find(path + ": beat 0 (byte offset 0): not a FastSplat stream"), std::string::npos) << run.err;
      ++refused;
    }
  }
  std::printf("[figure] times refused as not a stream = %d\n", refused);
}

TEST_F(StreamSubcommands, VerifyNamesTheFile) {
  auto bytes = read_bytes(stream_);
  const auto cut = folder_.write("cut.fss", bytes.substr(0, bytes.size() - cmodel::kBeatBytes));
  bytes[cmodel::kBeatBytes * 2] = '\x7f';
  bytes[cmodel::kBeatBytes * 2 + 3] = '\x7f';
  const auto bent = folder_.write("bent.fss", bytes);
  for (const auto& path : {cut, bent}) {
    const auto run = fastsplat({"verify", "--stream", path, "--config", "tiny"});
    EXPECT_EQ(run.code, 3);
    EXPECT_NE(run.err.find(path + ": beat "), std::string::npos) << run.err;
  }
}

// A hole in the picture is one to every subcommand that reads a stream file (S-file-1); as tiles alone the device takes
// it.
TEST_F(StreamSubcommands, TilesCoverTheImageForEverySubcommand) {
  const auto config = driver::load_config("tiny");
  std::vector<cmodel::Beat> beats;
  driver::read_beats(stream_, [&](auto part) { beats.insert(beats.end(), part.begin(), part.end()); });
  auto document = testbench::read_document(config, beats);
  ASSERT_GT(document.tiles.size(), 1u);
  document.tiles.pop_back();
  const auto hole = folder_ / "hole.fss";
  beats = testbench::write_document(config, document);
  driver::write_beats(hole, beats);
  const auto place = hole + ": beat " + std::to_string(beats.size() - 1) + " (byte offset ";
  for (const std::vector<std::string>& subcommand :
       {std::vector<std::string>{"stream", "replay", hole, "-o", folder_ / "a.exr"},
        {"cycles", "--stream", hole},
        {"verify", "--stream", hole}}) {
    auto words = subcommand;
    words.insert(words.end(), {"--config", "tiny"});
    const auto run = fastsplat(words);
    EXPECT_EQ(run.code, 3) << subcommand[0];
    EXPECT_NE(run.err.find(place), std::string::npos) << run.err;
    EXPECT_NE(run.err.find("tiles do not cover the image"), std::string::npos) << run.err;
  }
}

// That of its hash, here tiny.
TEST_F(StreamSubcommands, EachFindsTheStreamsConfiguration) {
  for (const std::vector<std::string>& command :
       std::vector<std::vector<std::string>>{{"stream", "replay", stream_, "-o", folder_ / "a.exr"},
                                             {"stream", "vectors", stream_, "-o", folder_ / "vectors"},
                                             {"cycles", "--stream", stream_},
                                             {"verify", "--stream", stream_},
                                             {"pixel", "3,0", "--tile", "0", "--stream", stream_}}) {
    auto given = command;
    given.insert(given.end(), {"--config", "tiny"});
    const auto found = fastsplat(command), named = fastsplat(given);
    expect_success(found);
    EXPECT_EQ(found.out, named.out) << command[0];
  }
  // Also with a fault at the ports, which fails the comparison.
  const auto faulty = fastsplat({"verify", "--stream", stream_, "--fault", "PORT_PIXEL"});
  EXPECT_EQ(faulty.code, 1) << faulty.out << faulty.err;
}

TEST_F(StreamSubcommands, AResetBehindTheEndIsRefused) {
  const auto run = fastsplat({"verify", "--stream", stream_, "--config", "tiny", "--reset-after", "1000000"});
  EXPECT_EQ(run.code, 2) << run.out << run.err;
  EXPECT_NE(run.err.find("the stream ends before this beat"), std::string::npos) << run.err;
  const auto beats = std::to_string(read_bytes(stream_).size() / cmodel::kBeatBytes);
  EXPECT_NE(run.err.find("at most " + beats), std::string::npos) << run.err;
  EXPECT_EQ(fastsplat({"verify", "--stream", stream_, "--config", "tiny", "--reset-after", beats}).code, 0);
  // Random streams have many lengths: shorter ones are counted.
  const auto random = fastsplat({"verify", "--random", "50", "--config", "tiny", "--reset-after", "1000000"});
  EXPECT_EQ(random.code, 0);
  EXPECT_NE(random.err.find("streams are shorter, and were reset after their last beat"), std::string::npos)
      << random.err;
}

// S-file-3.
TEST_F(StreamSubcommands, TheLimitOfARecordingIsReportedBeforeTheWork) {
  expect_error(
      fastsplat({"stream", "record", "--volume", "/nonexistent.nrrd", "--size", "9000", "-o", folder_ / "b.fss"}), 2,
      {"--size", "67108864", "smaller"});
}

TEST_F(StreamSubcommands, AConfigurationWithoutRtlIsRefused) {
  const auto check = [&](const std::vector<std::string>& changes) {
    std::vector<std::string> words{"config", "check", "tiny", "--json", folder_ / "c.json"};
    words.insert(words.end(), changes.begin(), changes.end());
    const auto run = fastsplat(words);
    EXPECT_EQ(run.code, 0) << run.err;
    return run.out;
  };
  EXPECT_EQ(check({}).find("no RTL"), std::string::npos);
  EXPECT_TRUE(nlohmann::json::parse(read_bytes(folder_ / "c.json")).at("rtl").get<bool>());
  const auto many = check({"--set", "tile.width=128", "--set", "tile.height=128", "--set", "position.int_bits=10"});
  EXPECT_NE(many.find("no RTL can be built"), std::string::npos) << many;
  EXPECT_NE(many.find("at most 1024 blocks"), std::string::npos) << many;  // N-2-8
  EXPECT_FALSE(nlohmann::json::parse(read_bytes(folder_ / "c.json")).at("rtl").get<bool>());
}

TEST_F(StreamSubcommands, VerifyAdvisesNoFlagThatItHasNot) {
  const auto run = fastsplat({"verify", "--random", "9", "--config", "tiny", "--set", "snap.phases=1"});
  EXPECT_EQ(run.code, 2);
  EXPECT_NE(run.err.find("the RTL needs a phase bit"), std::string::npos) << run.err;
  EXPECT_EQ(run.err.find("--engine"), std::string::npos) << run.err;
}

TEST_F(StreamSubcommands, ThePatternIsCalledWhatItDoes) {
  expect_error(fastsplat({"cycles", "--stream", stream_, "--config", "tiny", "--ready", "never-5"}), 2,
               {"never-5", "alternate-5"});
  expect_success(fastsplat({"cycles", "--stream", stream_, "--config", "tiny", "--ready", "alternate-5"}));
  expect_error(fastsplat({"cycles", "--stream", stream_, "--config", "tiny", "--ready", "random-101"}), 2, {"1..100"});
}

}  // namespace
}  // namespace fastsplat::cli_test
