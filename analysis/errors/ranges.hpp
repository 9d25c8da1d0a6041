// SPDX-License-Identifier: Apache-2.0
// Values at each narrowing site over whole frames, compared with theory, and the formats that they need
// (docs/errors.md, section 4).
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "cmodel/numbers/config.hpp"
#include "cmodel/numbers/observers.hpp"
#include "driver/tiles/frame_ranges.hpp"

namespace fastsplat::analysis {

/// Mean and root mean square of (word - value), in units of the word's last place.
struct Lost {
  double mean = 0.0, rms = 0.0;
};
/// Theory for values whose `dropped` lost bits are all equally likely.
Lost uniform_loss(cmodel::Rounding rounding, int dropped);

struct SiteRange {
  cmodel::Site site{};
  std::string format;  ///< "U 2.16"
  const char* rounding = "";
  int dropped_bits = 0;
  std::uint64_t values = 0, zeros = 0, inexact = 0, saturated = 0;
  double least = 0.0, greatest = 0.0;  ///< before narrowing
  Lost lost, theory;                   ///< lost: of values that were not saturated
  int head = 0;                        ///< integer bits never needed; negative: missing ones
  int tail = 0;                        ///< last bits that were 0 in every word
  int missing = 0;                     ///< additional fraction bits that would have lost nothing
  /// Magnitudes by the weight of their leading bit, from the largest down: {-3, 17} are 17 values in 2^-3..2^-2.
  std::vector<std::pair<int, std::uint64_t>> histogram;
};

/// A key of the configuration that decides a signal's width, and what these scenes needed of it.
struct Need {
  const char* key;
  int has = 0, needs = 0;
  int possible = 0;   ///< `needs`, or the nearest value within the limits of a configuration
  std::string why;    ///< "the largest value is 1.37"
  std::string limit;  ///< the limit that forbids `needs`, if any
};

struct RangesReport {
  cmodel::Config config;
  std::vector<SiteRange> sites;  ///< sites that any value passed
  std::vector<Need> needs;       ///< in the order of the keys
  cmodel::Counters counters;
  std::vector<driver::DriverReport> scenes;
  std::vector<std::string> names;  ///< of the scenes
};

/// Scenes are merged by adding their ranges. `wide`: the same, but scenes that are cut() are drawn with roomy(config),
/// because a saturated sum does not show its true size. The caller fills in counters, scenes and names.
RangesReport ranges_report(const cmodel::Config& config, const cmodel::Ranges& ranges, const cmodel::Ranges& wide);
/// Whether sheets or output words saturated, so that roomy(config) has to be drawn.
bool cut(const cmodel::Ranges& ranges);
/// `config` with the most integer bits possible for sheets and output words.
cmodel::Config roomy(const cmodel::Config& config);

std::string to_text(const RangesReport& report);
nlohmann::ordered_json to_json(const RangesReport& report);

}  // namespace fastsplat::analysis
