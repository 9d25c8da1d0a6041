// SPDX-License-Identifier: Apache-2.0
#include "testbench/stimulus/stream_document.hpp"

#include <algorithm>

#include "cmodel/decode/stream_decode.hpp"
#include "cmodel/stream/crc32.hpp"

namespace fastsplat::testbench {

std::uint64_t StreamDocument::splats() const {
  std::uint64_t count = 0;
  for (const auto& tile : tiles) {
    for (const auto& sheet : tile.sheets) {
      for (const auto& record : sheet.records) count += std::holds_alternative<cmodel::CullBlock>(record) ? 0 : 1;
    }
  }
  return count;
}

StreamDocument read_document(const cmodel::Config& config, std::span<const cmodel::Beat> beats) {
  cmodel::StreamDecode decode(config, cmodel::StreamScope::Subset);
  StreamDocument document;
  for (const auto& beat : beats) {
    const cmodel::Record* record = decode.feed(beat);
    if (record == nullptr) continue;
    if (const auto* frame = std::get_if<cmodel::BeginFrame>(record)) {
      document.width = frame->width;
      document.height = frame->height;
    } else if (const auto* table = std::get_if<cmodel::LoadTable>(record)) {
      document.tables.push_back(*table);
    } else if (const auto* tile = std::get_if<cmodel::BeginTile>(record)) {
      document.tiles.push_back({*tile, {}});
    } else if (const auto* sheet = std::get_if<cmodel::BeginSheet>(record)) {
      document.tiles.back().sheets.push_back({sheet->sheet, {}});
    } else if (const auto* splat = std::get_if<cmodel::SplatRecord>(record)) {
      document.tiles.back().sheets.back().records.emplace_back(*splat);
    } else if (const auto* ellipse = std::get_if<cmodel::EllipseRecord>(record)) {
      document.tiles.back().sheets.back().records.emplace_back(*ellipse);
    } else if (const auto* cull = std::get_if<cmodel::CullBlock>(record)) {
      document.tiles.back().sheets.back().records.emplace_back(*cull);
    }
  }
  decode.finish();
  return document;
}

StreamDocument arranged(StreamDocument document) {
  constexpr int kLargestSide = 65535;
  if (document.tiles.empty()) return document;
  int width = 0, height = 0;
  for (const auto& tile : document.tiles) {
    width = std::max(width, static_cast<int>(tile.begin.width));
    height += static_cast<int>(tile.begin.height);
  }
  if (height > kLargestSide) return document;
  document.width = width;
  document.height = height;
  std::vector<TileDocument> fillers;
  std::int32_t y = 0;
  for (auto& tile : document.tiles) {
    tile.begin.x = 0;
    tile.begin.y = y;
    if (const int left = width - static_cast<int>(tile.begin.width); left > 0) {
      // Never wider than a tile: the image is as wide as its widest tile.
      TileDocument filler{tile.begin, {}};
      filler.begin.x = static_cast<std::int32_t>(tile.begin.width);
      filler.begin.width = static_cast<decltype(filler.begin.width)>(left);
      fillers.push_back(filler);
    }
    y += static_cast<std::int32_t>(tile.begin.height);
  }
  document.tiles.insert(document.tiles.end(), fillers.begin(), fillers.end());
  return document;
}

std::vector<cmodel::Beat> write_document(const cmodel::Config& config, const StreamDocument& document) {
  std::vector<cmodel::Beat> beats;
  append(beats, cmodel::BeginFrame{.config_hash = config_hash(config),
                                   .width = document.width,
                                   .height = document.height,
                                   .tiles = static_cast<std::uint32_t>(document.tiles.size())});
  for (const auto& table : document.tables) append(beats, table);
  std::uint32_t number = 0;
  for (const auto& tile : document.tiles) {
    cmodel::BeginTile begin = tile.begin;
    begin.tile = number;
    append(beats, begin);
    std::uint32_t tag = 0;
    for (const auto& sheet : tile.sheets) {
      append(beats, cmodel::BeginSheet{sheet.number});
      const std::uint32_t first = tag;
      std::uint32_t promised = tag;  // the first splat that no cull_block covers
      for (const auto& record : sheet.records) {
        if (const auto* splat = std::get_if<cmodel::SplatRecord>(&record)) {
          cmodel::SplatRecord numbered = *splat;
          numbered.tag = tag++;
          beats.push_back(to_beat(numbered));
        } else if (const auto* ellipse = std::get_if<cmodel::EllipseRecord>(&record)) {
          cmodel::EllipseRecord numbered = *ellipse;
          numbered.tag = tag++;
          beats.push_back(to_beat(numbered));
        } else {
          cmodel::CullBlock set = std::get<cmodel::CullBlock>(record);
          if (config.culls()) {
            set.tag = std::max(promised, tag);
            promised = set.tag + set.splats;
          }
          append(beats, set);
        }
      }
      append(beats, cmodel::EndSheet{sheet.number, tag - first});
    }
    append(beats, cmodel::EndTile{number++, static_cast<std::uint32_t>(tile.sheets.size())});
  }
  cmodel::Crc32 crc;
  for (const auto& beat : beats) crc.add(beat);
  append(beats, cmodel::EndFrame{beats.size(), crc.value()});
  return beats;
}

}  // namespace fastsplat::testbench
