// SPDX-License-Identifier: Apache-2.0
// Converts the RTL's values by bank into the tap records of the model: window order, tile and sheet numbers,
// tile-relative places. Knows no simulator type.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "cmodel/numbers/config.hpp"
#include "cmodel/stream/device.hpp"
#include "cmodel/stream/taps.hpp"
#include "testbench/device/port_fields.hpp"
#include "testbench/device/raw_taps.hpp"
#include "testbench/device/tile_assembly.hpp"

namespace fastsplat::testbench {

/// Tile of a record outside tiles: the device showed it before its first tile or after its last.
constexpr std::uint32_t kNoTile = ~std::uint32_t{0};

class TapAssembly final : public RawTapSink {
 public:
  /// Both sinks outlive it.
  TapAssembly(const cmodel::Config& config, cmodel::PixelSink& pixels, cmodel::TapSink& taps);

  void accept(const cmodel::Beat& beat) override;
  void on_raw(const RawTap& tap) override;

 private:
  struct Sheet {
    std::uint32_t number = 0, first_tag = 0;
  };
  /// State of a tile that has not come out, in the order of tiles_.
  struct Sheets {
    std::vector<Sheet> begun;
    std::size_t composited = 0;  ///< number of sheets whose blocks have all passed
    std::uint32_t tags = 0;      ///< tag behind the last splat
  };
  struct Place {
    std::int32_t x = 0, y = 0;
  };
  struct Window {
    Place at;
    std::uint32_t tag = 0;
  };
  /// The tile whose events come now, or null.
  const cmodel::BeginTile* open_tile() const;
  /// *open_tile(), or an empty tile if that is null.
  const cmodel::BeginTile& tile() const;
  void snap(const RawTap& tap);
  void window(const RawTap& tap);
  void sheet(const RawTap& tap);
  void composite(const RawTap& tap);
  void pixels(const RawTap& tap);
  std::int32_t origin(std::uint32_t port) const;
  std::uint32_t sheet_of(std::uint32_t tag) const;
  /// All events of the tile but its pixels have come.
  void tile_left(std::uint64_t cycle);
  /// Counts the sheets whose blocks have all been shown before the cycle.
  void pass_sheets(std::uint64_t cycle);
  std::uint32_t composited_sheet() const;
  /// The earliest window that passed the footprint tap but no later tap, or {}.
  Window next_window();
  /// The banks of a window at `at`, their four words each, in the order of its pixels; 0 for those outside of the tile
  /// and its halo of so many pixels.
  void arrange(Place at, const cmodel::BeginTile& begin, int shown = 0);
  void emit(cmodel::Tap tap, std::uint64_t cycle, std::uint32_t sheet, std::uint32_t tag, Place at,
            std::span<const std::uint32_t> payload);

  cmodel::TapSink& taps_;
  int lanes_, origin_bits_;
  std::uint32_t columns_;  ///< of blocks, in a tile of full width
  std::size_t banks_;
  PortFields sheet_fields_, weight_fields_, state_fields_;
  TileAssembly tiles_;
  std::deque<Sheets> sheets_;
  std::size_t left_ = 0;                     ///< tiles that have left the core and are not out yet
  std::optional<std::uint32_t> shown_tile_;  ///< of the current event
  std::deque<Window> windows_;               ///< between the footprint and the sheet tap, or composite of every sample
  std::deque<std::uint64_t> finished_;       ///< cycles of sheet_done whose blocks are still in the pipe
  std::vector<std::uint32_t> banked_;        ///< of a port, by bank: one word or four of each
  std::vector<std::uint32_t> payload_;       ///< the same by pixel
};

}  // namespace fastsplat::testbench
