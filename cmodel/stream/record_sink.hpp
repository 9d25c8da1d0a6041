// Takes a tile record by record: what the driver hands on inside one process, where nobody needs beats.
#pragma once

#include <span>

#include "cmodel/stream/records.hpp"

namespace fastsplat::cmodel {

class RecordSink {
 public:
  virtual ~RecordSink() = default;
  virtual void begin_tile(const BeginTile& tile) = 0;
  virtual void begin_sheet(const BeginSheet& sheet) = 0;
  /// Of the open sheet, in order, some hundreds at a time.
  virtual void splats(std::span<const SplatRecord> records) = 0;
  /// Likewise; none from a configuration without ellipses.
  virtual void ellipses(std::span<const EllipseRecord> records) = 0;
  /// Likewise, in front of all splats they cover; none for a device that does not cull.
  virtual void cull_blocks(std::span<const CullBlock> records) = 0;
  /// Whether the device would hide the set if it came now, in the open sheet: then its splats may be left out, and it
  /// is handed on as a set of none. Nobody need know.
  virtual bool would_hide(const CullBlock& /*set*/) { return false; }
  virtual void end_sheet(const EndSheet& sheet) = 0;
  virtual void end_tile(const EndTile& tile) = 0;
};

}  // namespace fastsplat::cmodel
