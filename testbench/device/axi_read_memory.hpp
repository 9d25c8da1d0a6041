// SPDX-License-Identifier: Apache-2.0
// A memory of beats behind an AXI4 read port, cycle by cycle: latency, pauses, a beat that cannot be read. It answers
// in order and reports the first rule that the master breaks.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "cmodel/stream/beat.hpp"
#include "testbench/device/pattern.hpp"

namespace fastsplat::testbench {

/// Without pauses it is regular: a burst's first beat comes `latency` cycles after its address was taken, or when the
/// burst before has been answered. Then a beat comes each cycle.
struct AxiTimings {
  unsigned latency = 1;       ///< cycles; 0 is taken for 1
  unsigned more_latency = 0;  ///< up to so many more for a burst, by seed
  Pattern takes = {};         ///< when it takes an address
  Pattern has = {};           ///< when it has a beat
  std::uint64_t seed = 1;
};

/// A master's address channel in a cycle.
struct AxiRequest {
  bool valid = false;
  std::uint64_t address = 0;
  unsigned len = 0, size = 0, burst = 0;
  bool operator==(const AxiRequest&) const = default;
};

/// The memory's data channel in a cycle.
struct AxiAnswer {
  bool valid = false, last = false;
  unsigned response = 0;  ///< 0 OKAY, 2 SLVERR
  cmodel::Beat data{};
};

class AxiReadMemory {
 public:
  /// `beats` lie from `address` on; nothing else may be read.
  AxiReadMemory(std::vector<cmodel::Beat> beats, std::uint64_t address, const AxiTimings& timings);

  // In the cycle that begins:
  bool ready() const { return ready_; }  ///< takes an address
  const AxiAnswer& answer() const { return answer_; }
  /// Ends the cycle. The arguments are the master's signals in it.
  void edge(const AxiRequest& request, bool answer_ready);

  /// Answers this beat with SLVERR and other words.
  void spoil(std::size_t beat) { spoiled_ = beat; }
  /// Beats requested in the last cycle, and how often each was requested in all.
  const std::vector<std::size_t>& asked_now() const { return asked_now_; }
  const std::vector<std::uint32_t>& asked() const { return asked_; }
  std::uint64_t bursts() const { return bursts_; }
  std::size_t most_under_way() const { return most_under_way_; }
  bool at_rest() const { return under_way_.empty() && !answer_.valid; }
  /// The first rule broken; empty: none.
  const std::string& broken() const { return broken_; }

 private:
  struct Burst {
    std::size_t beat = 0;
    unsigned left = 0;
    std::uint64_t from = 0;  ///< cycle of its first beat at the earliest
  };
  void take(const AxiRequest& request);
  void expect(bool holds, const char* rule);

  std::vector<cmodel::Beat> beats_;
  std::uint64_t address_;
  AxiTimings timings_;
  std::uint64_t cycle_ = 0, bursts_ = 0;
  std::size_t spoiled_ = ~std::size_t{0}, most_under_way_ = 0;
  bool ready_ = true;
  AxiAnswer answer_;
  AxiRequest waiting_;  ///< offered in the cycle before and not taken
  std::deque<Burst> under_way_;
  std::vector<std::size_t> asked_now_;
  std::vector<std::uint32_t> asked_;
  std::string broken_;
};

}  // namespace fastsplat::testbench
