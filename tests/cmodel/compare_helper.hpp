// SPDX-License-Identifier: Apache-2.0
// Model and oracle side by side: their outputs, and the differences.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cmodel/numbers/config.hpp"
#include "cmodel/stream/device.hpp"
#include "tests/cmodel/oracle/oracle.hpp"

namespace fastsplat::test {

enum class Taps { Off, On };

/// Converts pixels and taps of a device to the oracle's form.
class Collector final : public cmodel::PixelSink, public cmodel::TapSink {
 public:
  void on_tile(cmodel::TilePixels&& tile) override;
  void on_tap(const cmodel::TapRecord& record) override;
  oracle::Rendering rendering;
};

/// Runs the model on a whole stream. With `cuts`, consume() is called once per piece: cuts are rising beat numbers.
oracle::Rendering run_model(const cmodel::Config& config, std::span<const std::uint8_t> bytes, Taps taps = Taps::On,
                            const std::vector<std::size_t>& cuts = {});

struct Comparison {
  std::map<std::string, std::uint64_t> compared;  ///< words per tap, pixels, counters
  std::uint64_t mismatches = 0;
  std::string first;  ///< the first mismatch in words

  std::uint64_t total() const;
  Comparison& operator+=(const Comparison& other);
};
/// Word by word; an event or tile that only one side has is a mismatch.
Comparison compare(const oracle::Rendering& model, const oracle::Rendering& expected);

/// Prints one figure per tap.
void print(const char* name, const Comparison& comparison);

}  // namespace fastsplat::test
