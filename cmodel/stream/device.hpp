// What driver and checker know of a device, whether it is this model or the RTL: beats in, pixels out, taps, counters.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "cmodel/numbers/counters.hpp"
#include "cmodel/stream/beat.hpp"
#include "cmodel/stream/taps.hpp"

namespace fastsplat::cmodel {

/// Takes beats in stream order, some thousands at a time.
using BeatSink = std::function<void(std::span<const Beat>)>;
/// Delivers a stream in pieces; each call the same one from the start. It may be longer than memory.
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

/// For runs whose pixels nobody looks at.
struct NullPixels final : PixelSink {
  void on_tile(TilePixels&&) override {}
};

class Device {
 public:
  virtual ~Device() = default;
  /// Takes whole or partial streams; a beat that breaks docs/stream.md is a UserError (Input) naming beat and offset.
  virtual void consume(std::span<const Beat> beats) = 0;
  /// No more beats: runs until all is delivered. Throws UserError (Input) if the stream ended where it may not.
  virtual void finish() = 0;
  virtual const Counters& counters() const = 0;
};

}  // namespace fastsplat::cmodel
