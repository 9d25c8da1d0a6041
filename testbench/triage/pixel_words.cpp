// SPDX-License-Identifier: Apache-2.0
#include "testbench/triage/pixel_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "cmodel/decode/stream_decode.hpp"
#include "cmodel/model.hpp"
#include "cmodel/numbers/observers.hpp"
#include "cmodel/splat/lane.hpp"

namespace fastsplat::testbench {
namespace {

/// Follows the pixel through records and taps.
class Follow final : public cmodel::TapSink {
 public:
  Follow(const cmodel::Config& config, const TilePixel& at, bool in_picture, cmodel::StreamScope scope)
      : config_(config),
        in_picture_(in_picture),
        asked_(at),
        decode_(config, scope),
        lane_(config),
        model_(config, scope, nowhere_, this) {
    words_.at = at;
  }

  void feed(std::span<const cmodel::Beat> beats) {
    for (const cmodel::Beat& beat : beats) {
      if (const cmodel::Record* record = decode_.feed(beat)) take(*record);
      model_.consume({&beat, 1});
    }
  }

  PixelWords finish() {
    model_.finish();
    if (found_) return std::move(words_);
    throw_usage({.where = "pixel",
                 .what = in_picture_ ? "outside the picture" : "outside the stream's tiles",
                 .expected = in_picture_ ? fmt::format("0,0 to {},{}", width_ - 1, height_ - 1)
                                         : "a tile of the stream and a pixel in it",
                 .got = in_picture_ ? fmt::format("{},{}", asked_.x, asked_.y)
                                    : fmt::format("tile {}, {},{}", asked_.tile, asked_.x, asked_.y),
                 .fix = "`fastsplat stream dump` lists the tiles"});
  }

  void on_tap(const cmodel::TapRecord& record) override {
    if (!inside_) return;
    const int i = words_.at.x - record.x, j = words_.at.y - record.y;
    if (record.tap == cmodel::Tap::Pixel) {
      if (i == 0 && j == 0) std::copy_n(record.payload.begin(), 4, words_.out.begin());
      return;
    }
    if (record.tap == cmodel::Tap::Snap || i < 0 || j < 0 || i >= config_.lanes || j >= config_.lanes) return;
    const auto lane = static_cast<std::size_t>(j * config_.lanes + i);
    if (record.tap == cmodel::Tap::Footprint) {
      if (record.payload[lane] != 0) add(record, record.payload[lane]);
      return;
    }
    if (words_.sheets.empty() || words_.sheets.back().number != record.sheet || words_.sheets.back().splats.empty())
      return;
    PixelWords::Sheet& sheet = words_.sheets.back();
    if (samples_ && sheet.splats.back().tag != record.tag) return;
    FourWords four;
    std::copy_n(record.payload.begin() + static_cast<std::ptrdiff_t>(4 * lane), 4, four.begin());
    (record.tap == cmodel::Tap::Sheet ? sheet.sums : sheet.after.emplace()) = four;
  }

 private:
  void take(const cmodel::Record& record) {
    if (const auto* frame = std::get_if<cmodel::BeginFrame>(&record)) {
      width_ = frame->width, height_ = frame->height;
    } else if (const auto* tile = std::get_if<cmodel::BeginTile>(&record)) {
      begin(*tile);
    } else if (const auto* splat = std::get_if<cmodel::SplatRecord>(&record)) {
      see(splat->colour);
    } else if (const auto* ellipse = std::get_if<cmodel::EllipseRecord>(&record)) {
      see(ellipse->colour);
    }
  }

  void begin(const cmodel::BeginTile& tile) {
    const TilePixel at{tile.tile, in_picture_ ? asked_.x - tile.x : asked_.x,
                       in_picture_ ? asked_.y - tile.y : asked_.y};
    inside_ = !found_ && (in_picture_ || tile.tile == asked_.tile) && at.x >= 0 && at.y >= 0 && at.x < tile.width &&
              at.y < tile.height;
    if (!inside_) return;
    if (cmodel::holds_densities(tile.mode)) {
      throw_usage({.where = "pixel",
                   .what = "does not follow densities: each pixel depends on its neighbours",
                   .expected = {},
                   .got = {},
                   .fix = "record the stream with --classify pre"});
    }
    found_ = true;
    samples_ = cmodel::every_sample(tile.mode);
    words_.at = at;
  }

  void see(const FourWords& colour) {
    colour_ = colour;
    words_.splats_of_tile += inside_ ? 1 : 0;
  }

  void add(const cmodel::TapRecord& record, std::uint32_t weight) {
    if (words_.sheets.empty() || samples_ || words_.sheets.back().number != record.sheet)
      words_.sheets.push_back({.number = record.sheet, .splats = {}, .sums = {}, .after = {}});
    PixelWords::Splat splat{.tag = record.tag, .weight = weight, .colour = colour_, .product = {}};
    for (std::size_t c = 0; c < 4; ++c) splat.product[c] = lane_.product(colour_[c], weight, nobody_);
    PixelWords::Sheet& sheet = words_.sheets.back();
    if (samples_) sheet.sums = splat.product;
    sheet.splats.push_back(splat);
  }

  const cmodel::Config& config_;
  bool in_picture_;
  TilePixel asked_;
  cmodel::StreamDecode decode_;
  cmodel::Lane lane_;
  cmodel::NullPixels nowhere_;
  cmodel::Model model_;
  cmodel::Nothing nobody_;
  int width_ = 0, height_ = 0;
  FourWords colour_{};  ///< of the splat whose windows the model computes
  PixelWords words_;
  bool inside_ = false, found_ = false, samples_ = false;
};

std::string four(const FourWords& words) {
  std::string text;
  for (const std::uint32_t word : words) text += fmt::format(" {:>10}", fmt::format("0x{:X}", word));
  return text + "\n";
}

}  // namespace

std::optional<TilePixel> pixel_of(const cmodel::Config& config, const Divergence& divergence) {
  if (!divergence.model || divergence.header || divergence.model->tap == cmodel::Tap::Snap) return std::nullopt;
  const TapCopy& at = *divergence.model;
  if (at.tap == cmodel::Tap::Pixel) return TilePixel{at.tile, at.x, at.y};
  const auto lane = static_cast<std::int32_t>(at.tap == cmodel::Tap::Footprint ? divergence.word : divergence.word / 4);
  return TilePixel{at.tile, at.x + lane % config.lanes, at.y + lane / config.lanes};
}

PixelWords words_of_pixel(const BeatSource& source, const cmodel::Config& config, const TilePixel& at, bool in_picture,
                          cmodel::StreamScope scope) {
  Follow follow(config, at, in_picture, scope);
  source([&](std::span<const cmodel::Beat> beats) { follow.feed(beats); });
  return follow.finish();
}

std::string to_text(const PixelWords& words) {
  std::size_t splats = 0;
  for (const auto& sheet : words.sheets) splats += sheet.splats.size();
  std::string text = fmt::format("tile {}, pixel {},{}: {} of the tile's {} splats have a weight here\n", words.at.tile,
                                 words.at.x, words.at.y, splats, words.splats_of_tile);
  text += fmt::format("{:<24} {:>10} {:>10} {:>10} {:>10}\n", "", "R", "G", "B", "tau, T, A");
  for (const auto& sheet : words.sheets) {
    text += fmt::format("sheet {}\n", sheet.number);
    for (const auto& splat : sheet.splats) {
      text += fmt::format("  splat {:<16}", splat.tag) + four(splat.colour);
      text += fmt::format("    {:<20}", fmt::format("x weight 0x{:X} =", splat.weight)) + four(splat.product);
    }
    if (sheet.splats.size() > 1) text += fmt::format("  {:<22}", "sum") + four(sheet.sums);
    text += sheet.after ? fmt::format("  {:<22}", "behind it") + four(*sheet.after) : "  not composited\n";
  }
  return text + fmt::format("{:<24}", "output") + four(words.out);
}

nlohmann::ordered_json to_json(const PixelWords& words) {
  using Json = nlohmann::ordered_json;
  Json json{{"schema", "fastsplat.pixel.words/1"}, {"tile", words.at.tile}, {"x", words.at.x}, {"y", words.at.y}};
  json["splats_of_tile"] = words.splats_of_tile;
  json["sheets"] = Json::array();
  for (const auto& sheet : words.sheets) {
    Json splats = Json::array();
    for (const auto& splat : sheet.splats)
      splats.push_back(
          {{"tag", splat.tag}, {"weight", splat.weight}, {"colour", splat.colour}, {"product", splat.product}});
    json["sheets"].push_back({{"sheet", sheet.number},
                              {"splats", splats},
                              {"sums", sheet.sums},
                              {"after", sheet.after ? Json(*sheet.after) : Json(nullptr)}});
  }
  json["out"] = words.out;
  return json;
}

}  // namespace fastsplat::testbench
