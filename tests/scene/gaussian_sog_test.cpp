// SPDX-License-Identifier: Apache-2.0
// SOG: packed here by an independent rule into WebP pictures, in an archive or a folder, and read to within its steps.
#include <gtest/gtest.h>
#include <webp/encode.h>
#include <zip.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "scene/gaussians/gaussian_file.hpp"
#include "scene/gaussians/harmonics.hpp"
#include "scene/gaussians/synthetic_gaussians.hpp"
#include "tests/scene/gaussian_helper.hpp"

namespace fastsplat::scene {
namespace {

using Json = nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

using Files = std::map<std::string, std::string>;

struct Picture {
  int width, height;
  std::string bytes;
  Picture(int w, int h) : width(w), height(h), bytes(static_cast<std::size_t>(4 * w * h), '\xFF') {}
  void set(std::size_t pixel, std::size_t channel, double value) {
    bytes[4 * pixel + channel] = static_cast<char>(static_cast<unsigned char>(std::lround(value)));
  }
  std::string webp() const {
    std::uint8_t* out = nullptr;
    const std::size_t size =
        WebPEncodeLosslessRGBA(reinterpret_cast<const std::uint8_t*>(bytes.data()), width, height, 4 * width, &out);
    std::string packed(reinterpret_cast<char*>(out), size);
    WebPFree(out);
    return packed;
  }
};

/// Equal steps from `low` to `high`.
Json codebook(double low, double high) {
  Json book = Json::array();
  for (int i = 0; i < 256; ++i) book.push_back(low + (high - low) * i / 255.0);
  return book;
}
double step(double value, double low, double high) {
  return std::clamp((value - low) / (high - low) * 255.0, 0.0, 255.0);
}
double folded(double x) { return std::copysign(std::log(std::abs(x) + 1.0), x); }

constexpr double kFold = 1.2, kScale[2]{-8.0, 1.0}, kColour[2]{-4.0, 4.0}, kRest[2]{-1.0, 1.0}, kLogit[2]{-6.0, 6.0};

/// Each Gaussian's harmonics are an entry of the palette of their own.
Files sog(const GaussianCloud& cloud, bool first_version = false) {
  const int width = 20, height = static_cast<int>((cloud.gaussians.size() + 19) / 20);
  const int rest = harmonic_count(cloud.degree) - 1;
  Picture low(width, height), high(width, height), quats(width, height), scales(width, height), sh0(width, height),
      labels(width, height), palette(64 * std::max(rest, 1), static_cast<int>((cloud.gaussians.size() + 63) / 64));
  for (std::size_t i = 0; i < cloud.gaussians.size(); ++i) {
    const Gaussian& one = cloud.gaussians[i];
    int largest = 0;
    for (int k = 1; k < 4; ++k)
      if (std::abs(one.rotation[k]) > std::abs(one.rotation[largest])) largest = k;
    std::size_t next = 0;
    for (int k = 0; k < 4; ++k)
      if (k != largest)
        quats.set(i, next++,
                  127.5 + 127.5 * M_SQRT2 * double(one.rotation[k]) * (one.rotation[largest] < 0.0F ? -1.0 : 1.0));
    quats.set(i, 3, 252 + largest);
    for (int axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<std::size_t>(axis);
      const auto place =
          static_cast<unsigned>(std::lround((folded(double(one.position[axis])) + kFold) / (2.0 * kFold) * 65535.0));
      low.set(i, k, place & 255U), high.set(i, k, place >> 8U);
      scales.set(i, k, step(std::log(double(one.scale[axis])), kScale[0], kScale[1]));
      sh0.set(i, k, step(double(cloud.harmonics_of(i)[0][axis]), kColour[0], kColour[1]));
      for (int h = 0; h < rest; ++h)
        palette.set(i * static_cast<std::size_t>(rest) + static_cast<std::size_t>(h), k,
                    step(double(cloud.harmonics_of(i)[static_cast<std::size_t>(h) + 1][axis]), kRest[0], kRest[1]));
    }
    const auto opacity = double(one.opacity);
    sh0.set(i, 3, first_version ? step(std::log(opacity / (1.0 - opacity)), kLogit[0], kLogit[1]) : 255.0 * opacity);
    labels.set(i, 0, static_cast<double>(i & 255U)), labels.set(i, 1, static_cast<double>(i >> 8U));
  }
  Json meta;
  meta["means"] = {
      {"mins", {-kFold, -kFold, -kFold}}, {"maxs", {kFold, kFold, kFold}}, {"files", {"l.webp", "u.webp"}}};
  meta["quats"]["files"] = {"quats.webp"};
  meta["scales"]["files"] = {"scales.webp"};
  meta["sh0"]["files"] = {"sh0.webp"};
  if (first_version) {
    meta["means"]["shape"] = {cloud.gaussians.size(), 3};
    const auto bounds = [](Json& part, const double(&of)[2]) {
      part["mins"] = {of[0], of[0], of[0]}, part["maxs"] = {of[1], of[1], of[1]};
    };
    bounds(meta["scales"], kScale), bounds(meta["sh0"], kColour);
    meta["sh0"]["mins"].push_back(kLogit[0]), meta["sh0"]["maxs"].push_back(kLogit[1]);
  } else {
    meta["version"] = 2, meta["count"] = cloud.gaussians.size();
    meta["scales"]["codebook"] = codebook(kScale[0], kScale[1]);
    meta["sh0"]["codebook"] = codebook(kColour[0], kColour[1]);
  }
  Files files{{"l.webp", low.webp()},
              {"u.webp", high.webp()},
              {"quats.webp", quats.webp()},
              {"scales.webp", scales.webp()},
              {"sh0.webp", sh0.webp()}};
  if (rest > 0) {
    meta["shN"]["files"] = {"centroids.webp", "labels.webp"};
    if (first_version)
      meta["shN"]["mins"] = kRest[0], meta["shN"]["maxs"] = kRest[1];
    else
      meta["shN"]["codebook"] = codebook(kRest[0], kRest[1]), meta["shN"]["count"] = 64 * palette.height;
    files["centroids.webp"] = palette.webp(), files["labels.webp"] = labels.webp();
  }
  files["meta.json"] = meta.dump();
  return files;
}

std::string archive(const Files& files, int level = 0) {
  const TestFile file(".zip", "");
  const zipFile zip = zipOpen(file.path().c_str(), APPEND_STATUS_CREATE);
  for (const auto& [name, bytes] : files) {
    zip_fileinfo info{};
    zipOpenNewFileInZip(zip, name.c_str(), &info, nullptr, 0, nullptr, 0, nullptr, level == 0 ? 0 : Z_DEFLATED, level);
    zipWriteInFileInZip(zip, bytes.data(), static_cast<unsigned>(bytes.size()));
    zipCloseFileInZip(zip);
  }
  zipClose(zip, nullptr);
  return bytes_of(file.path());
}

GaussianCloud read_sog(const std::string& bytes) {
  const TestFile file(".dat", bytes);  // by content
  return load_gaussians(file.path());
}

/// Half steps of what this file's packer chose. Bytes of three components: as SPZ's, with e of a byte over sqrt(2).
void expect_within_steps(const Apart& off, bool first_version) {
  constexpr double kFloat = 1e-6;
  const double e = 0.5 / 127.5 * M_SQRT1_2;
  EXPECT_LE(off.position, 0.5 * 2.0 * kFold / 65535.0 * std::exp(kFold) + kFloat);
  EXPECT_LE(off.scale, 0.5 * (kScale[1] - kScale[0]) / 255.0 + kFloat);
  EXPECT_LE(off.rotation, 6.0 * e * e);
  EXPECT_LE(off.opacity, first_version ? 0.25 * 0.5 * 12.0 / 255.0 + kFloat : 0.5 / 255.0 + kFloat);
  EXPECT_LE(off.colour, kConstantHarmonic * 0.5 * 8.0 / 255.0 + kFloat);
  EXPECT_LE(std::max(off.harmonic, off.harmonics), 0.5 * 2.0 / 255.0 + kFloat);
}

TEST(Sog, IsReadToWithinItsSteps) {
  for (const char* name : {"shells:150", "cloud:150"}) {
    for (const bool first_version : {false, true}) {
      const GaussianCloud cloud = make_synthetic_gaussians(name);
      const Files files = sog(cloud, first_version);
      for (const int level : {0, 6}) {
        const GaussianCloud again = read_sog(archive(files, level));
        EXPECT_THAT(again.remarks, ElementsAre());
        const Apart off = apart(cloud, again);
        if (level == 0) print(std::string(name) + (first_version ? ", version 1" : ", version 2"), off);
        expect_within_steps(off, first_version);
      }
    }
  }
}

class SogFolder : public ::testing::Test {
 protected:
  SogFolder() { std::filesystem::create_directories(folder_); }
  ~SogFolder() override { std::filesystem::remove_all(folder_); }
  void write(const Files& files) const {
    for (const auto& [name, bytes] : files) std::ofstream(folder_ / name, std::ios::binary) << bytes;
  }
  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() /
      ("sog-" +
       std::to_string(std::hash<std::string>{}(::testing::UnitTest::GetInstance()->current_test_info()->name())));
};

TEST_F(SogFolder, IsReadAndNamesNothingOutside) {
  const GaussianCloud cloud = make_synthetic_gaussians("cloud:40");
  Files files = sog(cloud);
  write(files);
  expect_within_steps(apart(cloud, load_gaussians(folder_ / "meta.json")), false);
  Json meta = Json::parse(files["meta.json"]);
  for (const char* elsewhere : {"../x.webp", "/etc/passwd", ""}) {
    meta["quats"]["files"][0] = elsewhere;
    write({{"meta.json", meta.dump()}});
    EXPECT_THAT([&] { load_gaussians(folder_ / "meta.json"); },
                ::testing::ThrowsMessage<UserError>(HasSubstr("in the header's folder")));
  }
  meta["quats"]["files"][0] = "none.webp";
  write({{"meta.json", meta.dump()}});
  EXPECT_THAT([&] { load_gaussians(folder_ / "meta.json"); },
              ::testing::ThrowsMessage<UserError>(HasSubstr("none.webp")));
}

TEST(Sog, CodesWithoutMeaningAreDropped) {
  const GaussianCloud cloud = make_synthetic_gaussians("cloud:40");
  Files files = sog(cloud);
  Json meta = Json::parse(files["meta.json"]);
  meta["shN"]["count"] = 30;
  Json& book = meta["scales"]["codebook"];
  book.erase(book.begin() + 150, book.end());
  files["meta.json"] = meta.dump();
  const GaussianCloud again = read_sog(archive(files));
  ASSERT_FALSE(again.dropped.empty());
  std::size_t dropped = 0;
  for (const DroppedGaussians& some : again.dropped) dropped += some.count;
  EXPECT_EQ(dropped + again.gaussians.size(), 40U);
  EXPECT_GE(dropped, 10U);
  EXPECT_THAT(again.remarks, ElementsAre(HasSubstr("causes")));
  std::printf("%s\n", again.remarks[0].c_str());
}

TEST(Sog, DamageIsNamed) {
  const GaussianCloud cloud = make_synthetic_gaussians("shells:100");
  const Files whole = sog(cloud);
  const auto with = [&](const std::string& name, const std::string& bytes) {
    Files files = whole;
    files[name] = bytes;
    return archive(files);
  };
  const auto changed = [&](const std::function<void(Json&)>& change) {
    Json meta = Json::parse(whole.at("meta.json"));
    change(meta);
    return with("meta.json", meta.dump());
  };
  const auto without = [&](const std::string& name) {
    Files files = whole;
    files.erase(name);
    return archive(files);
  };
  const std::string bytes = archive(whole), packed = archive(whole, 6);
  // Refused before its picture of 64 M pixels is decoded, which would fail.
  Files many = whole;
  Json counted = Json::parse(whole.at("meta.json"));
  counted["count"] = 64'000'000;
  many["meta.json"] = counted.dump(), many["l.webp"] = Picture(8000, 8000).webp().substr(0, 40);
  const std::string huge = archive(many);
  const struct {
    std::string bytes;
    const char* said;
  } files[] = {
      {bytes.substr(0, bytes.size() / 2), "no directory"},
      {without("meta.json"), "lacks a file (expected meta.json"},
      {without("quats.webp"), "lacks a file (expected quats.webp"},
      {with("meta.json", "{\"version\""), "not valid JSON"},
      {with("meta.json", std::string(100, '[')), "not valid JSON"},
      {with("meta.json", "[1e999]"), "number overflow"},
      {with("meta.json", "[]"), "an object"},
      {with("sh0.webp", "RIFF1234WEBPVP8L"), "not a WebP picture"},
      {with("sh0.webp", whole.at("sh0.webp").substr(0, whole.at("sh0.webp").size() / 2)), "does not decode"},
      {with("sh0.webp", Picture(4, 4).webp()), "wrong size"},
      // Bombs: a picture of 64 M pixels in some bytes, Gaussians that only such a picture could hold, zeros.
      {with("sh0.webp", Picture(8000, 8000).webp()), "wrong size"},
      {huge, "more Gaussians than it can hold"},
      {changed([](Json& meta) { meta["count"] = 101; }), "wrong size"},
      {changed([](Json& meta) { meta["count"] = 0; }), "number of Gaussians"},
      {changed([](Json& meta) { meta["count"] = -5; }), "number of Gaussians"},
      {changed([](Json& meta) { meta["count"] = 1e18; }), "number of Gaussians"},
      {changed([](Json& meta) { meta["count"] = ~std::uint64_t{0}; }), "too many Gaussians"},
      {changed([](Json& meta) { meta["version"] = 3; }), "unsupported version"},
      {changed([](Json& meta) {
         meta["means"]["mins"] = {1, 2};
       }),
       "no valid mins"},
      {changed([](Json& meta) { meta["scales"].erase("codebook"); }), "no valid codebook"},
      {changed([](Json& meta) { meta["means"]["files"] = {"l.webp"}; }), "too few files"},
      {changed([](Json& meta) { meta.erase("sh0"); }), "has no sh0"},
      {changed(
           [](Json& meta) { meta["scales"]["codebook"] = codebook(0, 1), meta["scales"]["codebook"].push_back(1); }),
       "no valid codebook"},
      {with("centroids.webp", Picture(100, 2).webp()), "unknown width"},
      {archive({{"meta.json", std::string(std::size_t{1} << 25U, ' ')}}, 9), "too large"},
      {archive({{"meta.json", std::string(std::size_t{1} << 23U, ' ')}}, 9), "more Gaussians than it can hold"},
      {patched(packed, packed.find("meta.json") + 40, std::string(40, '\xFF')), "damaged"},
  };
  for (const auto& one : files) EXPECT_THAT(refusal_of(".sog", one.bytes), HasSubstr(one.said));
}

}  // namespace
}  // namespace fastsplat::scene
