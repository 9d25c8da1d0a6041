// SPDX-License-Identifier: Apache-2.0
// Receives a tile record by record, from the driver in the same process, without beats.
#pragma once

#include <span>

#include "cmodel/stream/records.hpp"

namespace fastsplat::cmodel {

class RecordSink {
 public:
  virtual ~RecordSink() = default;
  virtual void begin_tile(const BeginTile& tile) = 0;
  virtual void begin_sheet(const BeginSheet& sheet) = 0;
  /// Splats of the open sheet, in order, some hundreds at a time.
  virtual void splats(std::span<const SplatRecord> records) = 0;
  /// Likewise; only if the configuration has ellipses.
  virtual void ellipses(std::span<const EllipseRecord> records) = 0;
  /// Likewise, before all splats that they cover; only for a device that culls.
  virtual void cull_blocks(std::span<const CullBlock> records) = 0;
  /// Whether the device would hide the cull group if it came now, in the open sheet. Then its splats may be left out
  /// and its cull_block announces none (N-8-60). May always return false.
  virtual bool would_hide(const CullBlock& /*set*/) { return false; }
  virtual void end_sheet(const EndSheet& sheet) = 0;
  virtual void end_tile(const EndTile& tile) = 0;
};

}  // namespace fastsplat::cmodel
