// SPDX-License-Identifier: Apache-2.0
// Coverage of culling: results for cull groups, splats and windows, where groups lie, how a sheet changes the map, and
// splats that the source left out (docs/numerics.md, section 6.1; docs/microarchitecture.md, "Culling"). Only devices
// that cull have these bins.
#pragma once

#include <cstdint>

#include "cmodel/cull/cull_log.hpp"
#include "cmodel/cycles/cycle_account.hpp"
#include "cmodel/numbers/config.hpp"
#include "cmodel/stream/records.hpp"
#include "testbench/coverage/coverage.hpp"

namespace fastsplat::testbench {

class CullCoverage {
 public:
  CullCoverage(const cmodel::Config& config, Coverage& coverage);

  /// Call it after the model has carried out the record. `found`: counts so far; `log`: answers of the open tile.
  void after(const cmodel::Record& record, const cmodel::CullCounts& found, const cmodel::CullLog& log);
  /// Call it after the whole stream.
  void finish(const cmodel::CycleAccount& account);

 private:
  using Id = Coverage::Id;
  void set(const cmodel::CullBlock& set, bool hidden);
  /// `bins`: those of circles or of ellipses.
  void splat(Id bins, std::uint32_t tag, const cmodel::CullCounts& found);
  void sheet(const cmodel::CullAnswers& answers);

  Coverage& coverage_;
  int lanes_;
  cmodel::BeginTile tile_;
  std::size_t sheets_ = 0;      ///< of the tile, ended
  std::uint32_t next_tag_ = 0;  ///< behind the last splat
  cmodel::CullCounts before_;
  Id set_ = 0, splat_ = 0, ellipse_ = 0, window_ = 0, map_ = 0, jump_ = 0, waits_ = 0;
};

}  // namespace fastsplat::testbench
