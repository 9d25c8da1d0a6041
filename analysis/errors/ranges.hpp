// What passed each narrowing site of whole frames, against what theory expects, and the format that would have done
// (docs/errors.md, "Ranges").
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

/// Mean and root mean square of word less value, in units of the word's last place.
struct Lost {
  double mean = 0.0, rms = 0.0;
};
/// Of values whose `dropped` lost bits are all equally likely.
Lost uniform_loss(cmodel::Rounding rounding, int dropped);

struct SiteRange {
  cmodel::Site site{};
  std::string format;  ///< "U 2.16"
  const char* rounding = "";
  int dropped_bits = 0;
  std::uint64_t values = 0, zeros = 0, inexact = 0, saturated = 0;
  double least = 0.0, greatest = 0.0;  ///< before narrowing
  Lost lost, theory;                   ///< lost: of values that were not saturated
  int head = 0;                        ///< integer bits never needed; negative: so many were missing
  int tail = 0;                        ///< last bits that were 0 in every word
  int missing = 0;                     ///< fraction bits more that would have lost nothing
  /// Magnitudes by the weight of their leading bit, from the largest down: {-3, 17} are 17 values in 2^-3..2^-2.
  std::vector<std::pair<int, std::uint64_t>> histogram;
};

/// A key of the configuration that decides a signal's width, and what these scenes needed of it.
struct Need {
  const char* key;
  int has = 0, needs = 0;
  int possible = 0;   ///< `needs`, or what comes nearest to it within the limits of a configuration
  std::string why;    ///< "the largest value is 1.37"
  std::string limit;  ///< which of the limits forbids `needs`, where one does
};

struct RangesReport {
  cmodel::Config config;
  std::vector<SiteRange> sites;  ///< those that any value passed
  std::vector<Need> needs;       ///< in the order of the keys
  cmodel::Counters counters;
  std::vector<driver::DriverReport> scenes;
  std::vector<std::string> names;  ///< of the scenes
};

/// Scenes are merged by adding their ranges. `wide`: the same, but scenes of which something was cut() drawn with
/// roomy(config): a sum that was cut does not tell how large it would have become. Counters, scenes and names are the
/// caller's to fill in.
RangesReport ranges_report(const cmodel::Config& config, const cmodel::Ranges& ranges, const cmodel::Ranges& wide);
/// Whether sheets or output words were cut, so that roomy(config) has to be looked at.
bool cut(const cmodel::Ranges& ranges);
/// With as many integer bits of sheets and output words as there can be.
cmodel::Config roomy(const cmodel::Config& config);

std::string to_text(const RangesReport& report);
nlohmann::ordered_json to_json(const RangesReport& report);

}  // namespace fastsplat::analysis
