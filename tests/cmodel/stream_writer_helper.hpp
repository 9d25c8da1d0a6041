// SPDX-License-Identifier: Apache-2.0
// Writes streams byte by byte from docs/stream.md, without the model's encoder. It also writes illegal streams, so that
// tests can break rules.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cmodel/stream/beat.hpp"
#include "tests/cmodel/oracle/ellipse.hpp"
#include "tests/cmodel/oracle/symbols.hpp"

namespace fastsplat::test {

class StreamWriter {
 public:
  explicit StreamWriter(const oracle::Symbols& symbols) : symbols_(symbols) {}

  void beat(const cmodel::Beat& words);
  void begin_frame(int width, int height, std::uint32_t tiles);
  /// Pads the last beat with zeros.
  void load_table(int table, std::uint32_t set, std::uint32_t rho, std::uint32_t base,
                  const std::vector<std::uint32_t>& words);
  void begin_tile(int mode, std::uint32_t tile, int x, int y, int width, int height);
  void begin_sheet(std::uint32_t sheet);
  void splat(int set, std::int32_t x, std::int32_t y, const std::array<std::uint32_t, 4>& colour);
  /// The tag is the next one, not e's; each field cut to its bits.
  void ellipse(const oracle::Ellipse& e);
  void cull_block(std::uint32_t tag, std::int32_t x, std::int32_t y, int width, int height, std::uint32_t splats);
  void end_sheet();
  void end_tile();
  void end_frame();

  const std::vector<std::uint8_t>& bytes() const { return bytes_; }
  std::size_t beats() const { return bytes_.size() / cmodel::kBeatBytes; }
  std::uint32_t next_tag() const { return tag_; }
  std::uint64_t total_splats() const { return total_splats_; }

 private:
  oracle::Symbols symbols_;
  std::vector<std::uint8_t> bytes_;
  std::uint32_t tile_ = 0, sheet_ = 0, tag_ = 0, splats_ = 0, sheets_ = 0;
  std::uint64_t total_splats_ = 0;
};

/// The same bytes as the model takes them.
std::vector<cmodel::Beat> to_beats(std::span<const std::uint8_t> bytes);
/// Number of the first beat after begin_frame and the tables: table words may look like records.
std::size_t first_tile_beat(std::span<const std::uint8_t> bytes);
/// Puts the right beat count and CRC into the last beat, which is an end_frame.
void seal(std::vector<std::uint8_t>& bytes);

}  // namespace fastsplat::test
