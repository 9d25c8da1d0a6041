// Coverage of culling: what tests of sets, splats and windows find, where sets lie, what a sheet does to the map,
// splats that the source left out (docs/numerics.md, section 6.1; docs/microarchitecture.md, "Culling"). Bins of
// devices that cull only.
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

  /// A record that the model has carried out; what it had found until then, and the answers of the open tile.
  void after(const cmodel::Record& record, const cmodel::CullCounts& found, const cmodel::CullLog& log);
  /// Of the whole stream.
  void finish(const cmodel::CycleAccount& account);

 private:
  using Id = Coverage::Id;
  void set(const cmodel::CullBlock& set, bool hidden);
  void splat(std::uint32_t tag, const cmodel::CullCounts& found);
  void sheet(const cmodel::CullAnswers& answers);

  Coverage& coverage_;
  int lanes_;
  cmodel::BeginTile tile_;
  std::size_t sheets_ = 0;      ///< of the tile, carried out whole
  std::uint32_t next_tag_ = 0;  ///< behind the splat before
  cmodel::CullCounts before_;
  Id set_ = 0, splat_ = 0, window_ = 0, map_ = 0, jump_ = 0, waits_ = 0;
};

}  // namespace fastsplat::testbench
