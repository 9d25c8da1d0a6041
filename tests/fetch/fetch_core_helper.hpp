// SPDX-License-Identifier: Apache-2.0
// The device of configs/faults/cull.toml, Verilated and healthy, behind the fetch master.
#pragma once

#include <memory>

#include "cmodel/numbers/counters.hpp"
#include "cmodel/numbers/stall_counters.hpp"
#include "cmodel/stream/device.hpp"
#include "tests/fetch/fetch_bench_helper.hpp"

namespace fastsplat::test {

class CoreDevice : public FetchDevice {
 public:
  /// Its picture's tiles, as they come.
  virtual const std::vector<cmodel::TilePixels>& tiles() const = 0;
  /// Rule of the first beat that it refused; 0: none.
  virtual unsigned refused() = 0;
  /// Of the register bus, at rest.
  virtual cmodel::Counters counters() = 0;
  virtual cmodel::StallCounters stalls() = 0;
};

/// `output`: when its pixels are taken.
std::unique_ptr<CoreDevice> make_core(const cmodel::Config& config, const testbench::Pattern& output);

}  // namespace fastsplat::test
