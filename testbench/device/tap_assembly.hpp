// Turns what the RTL shows by bank into the tap records of the model: window order, tile and sheet numbers,
// tile-relative places. Knows no simulator type.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "cmodel/config.hpp"
#include "cmodel/device.hpp"
#include "cmodel/records.hpp"
#include "cmodel/taps.hpp"

namespace fastsplat::testbench {

class TapAssembly {
 public:
  /// `taps` may be null: then only pixels are assembled.
  TapAssembly(const cmodel::Config& config, cmodel::PixelSink& pixels, cmodel::TapSink* taps);

  /// A beat the device took: learns tiles and which tags belong to which sheet.
  void accept(const cmodel::Beat& beat);
  /// All accepted tiles were delivered.
  bool complete() const { return tiles_.empty(); }
  void reset();

  /// Sign-extends a Verilated ORG_BITS port.
  std::int32_t origin(std::uint32_t port) const;

  void snap(std::uint64_t cycle, std::uint32_t tag, std::int32_t x, std::int32_t y, std::uint32_t mx, std::uint32_t my);
  void window(std::uint64_t cycle, std::uint32_t tag, std::int32_t x, std::int32_t y, const std::uint32_t* weights);
  void sheet(std::uint64_t cycle, std::uint32_t tag, const std::uint32_t* sums);
  void composite(std::uint64_t cycle, std::uint32_t block, const std::uint32_t* state);
  /// Every cycle, after composite(): `done` when a sheet's walk picked its last block.
  void sheet_done(std::uint64_t cycle, bool done);
  /// A pixel beat was taken: P pixels of 4 words.
  void pixels(std::uint64_t cycle, const std::uint32_t* words, bool last);

 private:
  struct Sheet {
    std::uint32_t number = 0, first_tag = 0;
  };
  struct Tile {
    cmodel::BeginTile begin;
    std::vector<Sheet> sheets;
    std::size_t composited = 0;  ///< sheets whose blocks have all passed
    std::uint32_t tags = 0;
    cmodel::TilePixels out;
    std::size_t taken = 0;  ///< pixel beats
  };
  struct Place {
    std::int32_t x, y;
  };
  std::uint32_t sheet_of(const Tile& tile, std::uint32_t tag) const;
  void emit(cmodel::Tap tap, std::uint64_t cycle, std::uint32_t sheet, std::uint32_t tag, std::int32_t x,
            std::int32_t y);

  cmodel::Config config_;
  cmodel::PixelSink& pixels_;
  cmodel::TapSink* taps_;
  int sheet_bits_, weight_bits_, state_bits_;
  std::deque<Tile> tiles_;
  std::deque<Place> windows_;           ///< between the footprint and the sheet tap
  std::deque<std::uint64_t> finished_;  ///< cycles of sheet_done whose blocks are still in the pipe
  std::uint64_t payload_left_ = 0;      ///< table beats to pass over
  std::vector<std::uint32_t> payload_;
};

}  // namespace fastsplat::testbench
