// SPDX-License-Identifier: Apache-2.0
// Ready/valid patterns: in which cycles a side of a channel is ready. A pure function of the cycle number, so that the
// RTL, the cycle model and a replay see the same.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cmodel/cycles/ready_pattern.hpp"

namespace fastsplat::testbench {

/// `always`; `alternate-N` (N cycles on, N off); `every-N` (one cycle in N); `random-P` (P percent of the
/// cycles, by seed); `burst-N` (seeded runs of up to N cycles on and off).
class Pattern final : public cmodel::ReadyPattern {
 public:
  Pattern() = default;
  /// Throws UserError (Usage) for an unknown pattern.
  Pattern(const std::string& text, std::uint64_t seed);

  bool at(std::uint64_t cycle) const;
  std::uint64_t next(std::uint64_t cycle) const override;
  const std::string& text() const { return text_; }
  /// Most cycles from one ready cycle to the next; 0 for `always`, and for `random-P`, where it is soon.
  std::uint64_t longest_wait() const;
  static std::vector<std::string> examples();

 private:
  enum class Kind { Always, Alternate, Every, Random, Burst };
  Kind kind_ = Kind::Always;
  std::uint64_t number_ = 1;
  std::uint64_t seed_ = 0;
  std::string text_ = "always";
};

/// When the source offers beats and when the sink takes pixels, in one run.
struct Patterns {
  Pattern input, ready;
};

/// The run's seed decides both, the same wherever the run is made.
inline Patterns patterns_of(const std::string& input, const std::string& ready, std::uint64_t seed) {
  return {Pattern(input, 2 * seed), Pattern(ready, 2 * seed + 1)};
}

/// splitmix64: the one generator of the testbench; the same seed gives the same numbers everywhere.
constexpr std::uint64_t mix(std::uint64_t value) {
  value += 0x9e3779b97f4a7c15ULL;
  value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9ULL;
  value = (value ^ (value >> 27)) * 0x94d049bb133111ebULL;
  return value ^ (value >> 31);
}

}  // namespace fastsplat::testbench
