// SPDX-License-Identifier: Apache-2.0
// A stream as a tree of tables, tiles, sheets and splats, to generate, cut and put together again. A written stream is
// always whole and legal: tile numbers, tags, counts, beats and checksum are made when it is written.
#pragma once

#include <cstdint>
#include <span>
#include <variant>
#include <vector>

#include "cmodel/numbers/config.hpp"
#include "cmodel/stream/records.hpp"

namespace fastsplat::testbench {

using SheetRecord = std::variant<cmodel::SplatRecord, cmodel::EllipseRecord, cmodel::CullBlock>;

struct SheetDocument {
  std::uint32_t number = 0;
  std::vector<SheetRecord> records;
};

struct TileDocument {
  cmodel::BeginTile begin;
  std::vector<SheetDocument> sheets;
};

struct StreamDocument {
  int width = 0, height = 0;  ///< image
  std::vector<cmodel::LoadTable> tables;
  std::vector<TileDocument> tiles;

  std::uint64_t splats() const;  ///< and ellipses
};

/// Reads any legal subset of a stream. Throws UserError (Input) for an illegal one.
StreamDocument read_document(const cmodel::Config& config, std::span<const cmodel::Beat> beats);

/// The same tiles in an image that they cover, as a stream in a file must (docs/stream.md). They lie one above the
/// other, with empty tiles beside narrow ones. Tiles too large for any image stay unchanged.
StreamDocument arranged(StreamDocument document);

/// The whole stream, begin_frame to end_frame.
std::vector<cmodel::Beat> write_document(const cmodel::Config& config, const StreamDocument& document);

}  // namespace fastsplat::testbench
