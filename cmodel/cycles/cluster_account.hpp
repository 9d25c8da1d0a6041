// SPDX-License-Identifier: Apache-2.0
// Where the cycles of a frame on several devices go, and what bounds it: shares and roofline of docs/scaling.md.
#pragma once

#include <cstdint>

#include "cmodel/cycles/cycle_cluster.hpp"

namespace fastsplat::cmodel {

// clang-format off
#define FASTSPLAT_FRAME_SHARES(X)                                                  \
  X(work, "windows, and dirty blocks not hidden behind them: the account's ideal") \
  X(fill, "wipe, tables, records, pipelines: a device's overhead")                 \
  X(bandwidth, "no beat: the link or --input was late")                            \
  X(pixel_out, "the picture leaves and nothing is splatted")                       \
  X(tail, "a device has no more tiles while others work")

#define FASTSPLAT_ROOFLINE(X)             \
  X(lanes, "windows / devices")           \
  X(compositor, "dirty blocks / devices") \
  X(stream, "bytes in / bytes per cycle") \
  X(pixel_out, "pixel beats / devices")
// clang-format on

/// Cycles, summed over the devices; together devices * frame_cycles().
struct FrameShares {
#define X(name, meaning) std::uint64_t name = 0;
  FASTSPLAT_FRAME_SHARES(X)
#undef X
  /// visit(name, cycles, meaning) in the order above.
  template <class Visit>
  void for_each(Visit visit) const {
#define X(name, meaning) visit(#name, name, meaning);
    FASTSPLAT_FRAME_SHARES(X)
#undef X
  }
  bool operator==(const FrameShares&) const = default;
};

/// Lower bounds of a frame's cycles: each as if only this part took time, rounded up.
struct Roofline {
#define X(name, meaning) std::uint64_t name = 0;
  FASTSPLAT_ROOFLINE(X)
#undef X
  template <class Visit>
  void for_each(Visit visit) const {
#define X(name, meaning) visit(#name, name, meaning);
    FASTSPLAT_ROOFLINE(X)
#undef X
  }
  bool operator==(const Roofline&) const = default;
};

/// Requires a finished cluster.
FrameShares frame_shares(const Config& config, const CycleCluster& cluster);
/// `bytes_per_cycle` of the link; 0: no limit, and no bound from it.
Roofline roofline(const Config& config, const CycleCluster& cluster, std::uint64_t bytes_per_cycle);

}  // namespace fastsplat::cmodel
