// SPDX-License-Identifier: Apache-2.0
// The vectors of a stream, read back by a small independent reader. The checksums hold, the beats equal the file's, hex
// and JSON agree, and the pixel beats hold the pixels.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cmodel/stream/beat.hpp"
#include "tests/capi/recorded_helper.hpp"

namespace fastsplat::test {
namespace {

using Json = nlohmann::json;
using Words = std::vector<std::uint32_t>;

std::uint32_t crc32_bit_by_bit(const std::string& bytes) {
  std::uint32_t state = ~0U;
  for (const char byte : bytes) {
    state ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) state = state >> 1 ^ ((state & 1) != 0 ? 0xEDB88320U : 0);
  }
  return ~state;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) out.push_back(line);
  return out;
}

std::uint32_t hex(const std::string& digits) { return static_cast<std::uint32_t>(std::stoul(digits, nullptr, 16)); }

struct Vectors {
  Json contents;
  std::map<std::string, std::vector<std::string>> files;
};

Vectors read(const std::string& folder) {
  Vectors out{.contents = Json::parse(cli_test::read_bytes(folder + "/vectors.json")), .files = {}};
  for (const auto& file : out.contents["files"]) {
    const std::string name = file["name"], bytes = cli_test::read_bytes(folder + "/" + name);
    EXPECT_EQ(bytes.size(), file["bytes"]) << name;
    EXPECT_EQ(crc32_bit_by_bit(bytes), hex(file["crc32"])) << name;
    out.files[name] = lines_of(bytes);
    EXPECT_EQ(out.files[name].size(), file["lines"]) << name;
  }
  return out;
}

TEST(CapiVectors, ReadBackByAnotherReader) {
  const Vectors vectors = read(recorded().vectors);
  EXPECT_EQ(vectors.contents["format"], "fastsplat-vectors");
  ASSERT_EQ(vectors.files.size(), 8u);

  // Beats: the bytes of the stream.
  const std::string stream = cli_test::read_bytes(recorded().stream);
  const auto& beats = vectors.files.at("beats.hex");
  ASSERT_EQ(beats.size() * cmodel::kBeatBytes, stream.size());
  std::vector<Words> beat_words;
  for (std::size_t i = 0; i < beats.size(); ++i) {
    ASSERT_EQ(beats[i].size(), 8 * cmodel::kBeatWords);
    Words words;
    for (std::size_t w = 0; w < cmodel::kBeatWords; ++w) {
      words.push_back(hex(beats[i].substr(8 * (cmodel::kBeatWords - 1 - w), 8)));
      for (std::size_t b = 0; b < 4; ++b)
        ASSERT_EQ(words[w] >> 8 * b & 0xff, static_cast<unsigned char>(stream[(i * cmodel::kBeatWords + w) * 4 + b]));
    }
    beat_words.push_back(words);
  }

  // Taps: hex and JSON agree, in order; JSON holds beats and tiles too.
  std::map<std::string, std::vector<Words>> from_hex, from_json;
  for (const char* kind : {"snap", "footprint", "sheet", "composite", "pixel"}) {
    for (const auto& line : vectors.files.at(std::string(kind) + ".hex")) {
      std::istringstream in(line);
      Words words;
      for (std::string word; in >> word;) words.push_back(hex(word));
      from_hex[kind].push_back(std::move(words));
    }
    EXPECT_EQ(from_hex[kind].size(), vectors.contents["taps"][kind]) << kind;
    EXPECT_FALSE(from_hex[kind].empty()) << kind;
  }
  std::string json;
  for (const auto& line : vectors.files.at("records.json")) json += line;
  std::size_t beat = 0;
  std::vector<Json> pictures;
  for (const auto& record : Json::parse(json)) {
    if (record.contains("beat")) {
      ASSERT_LT(beat, beat_words.size());
      EXPECT_EQ(record["beat"].get<Words>(), beat_words[beat++]);
    } else if (record.contains("picture")) {
      pictures.push_back(record);
    } else {
      Words words{record["tile"], record["sheet"], record["tag"], static_cast<std::uint32_t>(record["x"].get<int>()),
                  static_cast<std::uint32_t>(record["y"].get<int>())};
      for (const auto& word : record["words"]) words.push_back(word);
      from_json[record["tap"]].push_back(std::move(words));
    }
  }
  EXPECT_EQ(beat, beat_words.size());
  EXPECT_EQ(from_json, from_hex);

  // Pixel beats: the kept bytes are the tap's pixels, in order, and those of the pictures.
  const std::size_t lanes = vectors.contents["lanes"];
  std::size_t pixel = 0, last = 0;
  Words shown, drawn;
  for (const auto& line : vectors.files.at("output.hex")) {
    ASSERT_EQ(line.size(), 1 + 1 + (lanes + 3) / 4 + 1 + 32 * lanes);
    last += line[0] == '1' ? 1 : 0;
    const std::uint32_t keep = hex(line.substr(2, (lanes + 3) / 4));
    for (std::size_t g = 0; g < lanes; ++g) {
      if ((keep >> g & 1) == 0) continue;
      ASSERT_LT(pixel, from_hex["pixel"].size());
      for (std::size_t c = 0; c < 4; ++c) {
        const std::uint32_t word = hex(line.substr(line.size() - 8 * (4 * g + c + 1), 8));
        EXPECT_EQ(word, from_hex["pixel"][pixel][5 + c]);
        shown.push_back(word);
      }
      ++pixel;
    }
  }
  for (const auto& picture : pictures)
    for (const auto& word : picture["words"]) drawn.push_back(word);
  EXPECT_EQ(shown, drawn);
  EXPECT_EQ(pixel, from_hex["pixel"].size());
  EXPECT_EQ(last, pictures.size());
  EXPECT_EQ(last, vectors.contents["counters"]["tiles"]);
  EXPECT_EQ(from_hex["snap"].size(), vectors.contents["counters"]["splats"]);
  EXPECT_EQ(from_hex["footprint"].size(), vectors.contents["counters"]["windows"]);
  std::printf("[figure] vector_beats = %zu (limit > 100)\n[figure] vector_pixels = %zu (limit 1760)\n", beat, pixel);
  EXPECT_GT(beat, 100u);
  EXPECT_EQ(pixel, 44u * 40u);
}

TEST(CapiVectors, ABadStreamLeavesNothingBehind) {
  const cli_test::TempFolder folder;
  std::string bytes = cli_test::read_bytes(recorded().stream);
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  const std::string bad = folder.write("bad.fss", bytes), out = folder / "out";
  cli_test::expect_error(cli_test::fastsplat({"stream", "vectors", bad, "--config", "tiny", "-o", out}), 3,
                         {"bad.fss", "beat"});
  EXPECT_FALSE(std::filesystem::exists(out));
  const std::string file = folder.write("file", "x");
  cli_test::expect_error(cli_test::fastsplat({"stream", "vectors", recorded().stream, "--config", "tiny", "-o", file}),
                         3, {"file"});
  cli_test::expect_error(cli_test::fastsplat({"stream", "vectors", recorded().stream, "--config", "small", "-o", out}),
                         3, {"small"});
  // A stream of the user's under one of the names is not replaced.
  const std::string kept = folder.write("beats.hex", cli_test::read_bytes(recorded().stream));
  EXPECT_NE(cli_test::fastsplat({"stream", "vectors", kept, "--config", "tiny", "-o", folder.path().string()}).code, 0);
  EXPECT_EQ(folder.entries(), (std::vector<std::string>{"bad.fss", "beats.hex", "file"}));
}

}  // namespace
}  // namespace fastsplat::test
