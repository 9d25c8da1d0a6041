// SPDX-License-Identifier: Apache-2.0
// What a frame's tiles take on one device: an estimate of its cycles on any number of devices, with any number of
// pixels composited at once (docs/errors.md, section 6). It only selects what is worth counting.
#pragma once

#include <cstdint>
#include <vector>

#include "cmodel/cycles/cycle_model.hpp"

namespace fastsplat::analysis {

/// Listens to a frame of one device.
class FrameWork final : public cmodel::CycleSink {
 public:
  /// Of a device that composites blocks in `slices`.
  explicit FrameWork(int slices) : slices_(slices) {}
  std::uint64_t splats = 0;  ///< of the frame's records

  void on_sheet(const cmodel::SheetCycles& sheet) override;
  void on_tile(const cmodel::TileCycles& tile) override;

  /// On `devices` devices that composite blocks in `slices`.
  double cycles(int devices, int slices) const;
  /// Ideal cycles of all tiles; its windows for 0 slices.
  double work(int slices) const;

 private:
  struct Sheet {
    std::uint64_t windows, blocks;
  };
  struct Tile {
    std::size_t first, last;  ///< its sheets
    std::uint64_t begun;
  };
  /// docs/microarchitecture.md, "Account".
  std::uint64_t ideal(const Tile& tile, int slices) const;

  int slices_;
  std::vector<Sheet> sheets_;
  std::vector<Tile> tiles_;
  std::uint64_t end_ = 0;
};

}  // namespace fastsplat::analysis
