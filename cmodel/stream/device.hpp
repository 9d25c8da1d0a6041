// SPDX-License-Identifier: Apache-2.0
// The device as driver and checker see it, model or RTL: beats in, pixels out, taps, counters.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "cmodel/numbers/counters.hpp"
#include "cmodel/stream/beat.hpp"
#include "cmodel/stream/taps.hpp"

namespace fastsplat::cmodel {

/// Receives beats in stream order, some thousands at a time.
using BeatSink = std::function<void(std::span<const Beat>)>;
/// Delivers a stream in pieces; each call delivers the same stream from the start. It may be larger than memory.
using BeatSource = std::function<void(const BeatSink&)>;

/// A finished tile: RGBA words, row by row.
struct TilePixels {
  std::uint32_t tile = 0;
  std::int32_t x = 0, y = 0;  ///< first pixel in the image
  int width = 0, height = 0;
  std::vector<std::uint32_t> words;  ///< width*height*4
};

class PixelSink {
 public:
  virtual ~PixelSink() = default;
  virtual void on_tile(TilePixels&& tile) = 0;
};

/// Discards all pixels.
struct NullPixels final : PixelSink {
  void on_tile(TilePixels&&) override {}
};

class Device {
 public:
  virtual ~Device() = default;
  /// Takes whole or partial streams. Throws UserError (Input) with beat and offset for a beat that breaks
  /// docs/stream.md.
  virtual void consume(std::span<const Beat> beats) = 0;
  /// Ends the stream: runs until all is delivered. Throws UserError (Input) if the stream is incomplete.
  virtual void finish() = 0;
  virtual const Counters& counters() const = 0;
};

}  // namespace fastsplat::cmodel
