// SPDX-License-Identifier: Apache-2.0
// The RTL's port values, unchanged: words by bank, places in the port's width. Plain data, so that any simulator
// can provide it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "cmodel/stream/beat.hpp"

namespace fastsplat::testbench {

/// The tap ports of rtl/fastsplat_core.sv, its pixel output and its verdicts, where they are valid.
enum class RawPort : std::uint8_t {
  Snap,       ///< tag, x, y, mx, my
  Sheet,      ///< tag; BANKS x 4 sums of the earliest window that had none yet
  Window,     ///< tag, x, y; BANKS weights
  Composite,  ///< block; BANKS x 4 words
  SheetDone,  ///< the walk of a sheet picked its last block
  Pixels,     ///< a pixel beat was taken: P pixels of 4 words of 32 bits; last
  Verdict,    ///< the verdict on a cull_block: tag; hidden
  TileLeft,   ///< a tile's last pixels left the core for the register slice; only where there is one
};

struct RawTap {
  RawPort port = RawPort::Snap;
  std::uint64_t cycle = 0;  ///< since reset
  std::uint32_t tag = 0;
  std::uint32_t x = 0, y = 0;  ///< first pixel of the window, two's complement in the port's ORG_BITS
  std::uint32_t mx = 0, my = 0;
  std::uint32_t block = 0;  ///< number in the tile, row by row
  bool last = false;        ///< ends the tile
  bool cut = false;         ///< marked as of a tile that was cut short, although none was
  bool hidden = false;      ///< of a verdict
  /// Of a pixel beat: which of its pixels lie in the tile, the first in bit 0. Absent where a bench does not show it.
  std::optional<std::uint32_t> keep = std::nullopt;
  std::optional<std::uint32_t> tile = std::nullopt;  ///< number of the current tile; absent if not shown
  /// A vector port in words of 32 bits, the least significant first; valid during the call.
  std::span<const std::uint32_t> words;
};

/// Receives events in the order of the cycles; within a cycle the taps in the order of RawPort, then the beat.
class RawTapSink {
 public:
  virtual ~RawTapSink() = default;
  virtual void on_raw(const RawTap& tap) = 0;
  /// A beat of the stream was taken; its effects come in later cycles.
  virtual void accept(const cmodel::Beat& beat) = 0;
};

}  // namespace fastsplat::testbench
