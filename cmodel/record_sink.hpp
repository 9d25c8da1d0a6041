// Takes a tile record by record: what the driver hands on inside one process, where nobody needs beats.
#pragma once

#include <span>

#include "cmodel/records.hpp"

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
  virtual void end_sheet(const EndSheet& sheet) = 0;
  virtual void end_tile(const EndTile& tile) = 0;
};

}  // namespace fastsplat::cmodel
