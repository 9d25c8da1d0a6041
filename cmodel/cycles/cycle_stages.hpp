// SPDX-License-Identifier: Apache-2.0
// Distances in clock cycles between the boundaries of the device: the timing rules of docs/microarchitecture.md.
#pragma once

#include <algorithm>
#include <cstdint>

#include "cmodel/numbers/config.hpp"

namespace fastsplat::cmodel::stages {

// The two stages of check: from the cycle in which each takes a beat to the earliest in which it passes it on.
inline constexpr std::uint64_t kWeigh = 1;
inline constexpr std::uint64_t kResult = 1;

// Devices with ellipses: all windows are delayed until an ellipse's words are ready (M-ellipse-1).
inline constexpr std::uint64_t kEllipseDelay = 10;
inline std::uint64_t splat_delay(const Config& config) { return config.has_ellipses() ? kEllipseDelay : 0; }

// Devices that interpolate the radial table: two registers after the entries are read (M-weights-1).
inline constexpr std::uint64_t kInterpolation = 2;
inline std::uint64_t weight_delay(const Config& config) { return config.interpolates() ? kInterpolation : 0; }

// Devices that cull: registers between check and decode (M-cull-3).
inline constexpr std::size_t kCullStages = 4;  ///< t0 .. t3
/// A fetching source: from a verdict to the first beat that waits for it, without the memory's latency (M-fetch-8).
inline constexpr std::uint64_t kFetch = 6;

// Densities: a block is read in five cycles, or waits for its slices. Its words lie side by side five cycles after its
// first one. Then comes the pixel stage, before its first slice is in k1.
inline constexpr std::uint64_t kGather = 5;
inline constexpr std::uint64_t kPixelStage = 23;
/// From the last block copied, or end_tile's turn, to the first block read.
inline constexpr std::uint64_t kClassify = 2;
/// From a walk's last cycle to the next sheet's first copied block.
inline constexpr std::uint64_t kAfterClassify = 2;
/// Cycles per block.
inline std::uint64_t density_steps(const Config& config) {
  return std::max(kGather, static_cast<std::uint64_t>(config.slices()));
}
/// From the cycle in which a block is first read to that in which its last slice is in k0.
inline std::uint64_t density_pick(const Config& config) {
  return kGather + kPixelStage + static_cast<std::uint64_t>(config.slices()) - 1;
}
/// The same, counted from the last of the block's cycles.
inline std::uint64_t density_late(const Config& config) { return density_pick(config) + 1 - density_steps(config); }

// From the cycle in which decode issues a window.
inline constexpr std::uint64_t kSnap = 2;       ///< c1: the snapped origin
inline constexpr std::uint64_t kFootprint = 7;  ///< c6: weights and products
inline constexpr std::uint64_t kSheet = 10;     ///< W: sums written
inline constexpr std::uint64_t kSample = 12;    ///< k6: every sample composited, new state
/// Modes 4 and 5: least distance of two windows that lie over one another (M-hazard-1).
inline constexpr std::uint64_t kHazard = 2;

// From the cycle in which decode carries out end_sheet.
inline constexpr std::uint64_t kWalk = 12;  ///< first pick, if the compositor is idle

// From the last pick of a sheet: that of its last block's last slice.
inline constexpr std::uint64_t kFree = 1;            ///< begin_sheet may take the buffer
inline constexpr std::uint64_t kNextWalk = 4;        ///< first pick of the next sheet at the earliest
inline constexpr std::uint64_t kIdle = 7;            ///< the pipe is empty: begin_tile and end_tile may go on
inline constexpr std::uint64_t kIdleAfterEmpty = 3;  ///< the same if the sheet had no dirty block

inline constexpr std::uint64_t kComposite = 6;  ///< k6: from a slice's pick to its new state
inline constexpr std::uint64_t kPixel = 3;      ///< r2: from end_tile carried out to the first pixel beat

}  // namespace fastsplat::cmodel::stages
