// SPDX-License-Identifier: Apache-2.0
#include "cmodel/classify/classify_tables.hpp"

namespace fastsplat::cmodel {

using namespace classify;

std::int64_t classify_words(const Config& config, Table table) {
  switch (table) {
    case Table::Classify:
      return 4 * ((std::int64_t{1} << config.classify_segment_bits) + 1);
    case Table::Root:
      return 3 * (std::int64_t{1} << kRootBits) + 1;
    case Table::Glint:
      return (std::int64_t{1} << kGlintBits) + 1;
    case Table::Lighting:
      return kLightWords;
    default:
      return 0;
  }
}

WordRange classify_word_range(const Config& config, Table table, std::size_t word) {
  constexpr std::int64_t kAny = 0xFFFFFFFF;
  const auto within = [](const Format& format) { return WordRange{format.min, format.max}; };
  switch (table) {
    case Table::Classify:
      return within(word % 4 == 3 ? config.sheet_format() : unit_format(kColour));
    case Table::Root:
      return within(unit_format(kRoot));
    case Table::Glint:
      return within(unit_format(kPhong));
    case Table::Lighting:
      if (word < kAmbient) return {-(std::int64_t{1} << kLight), std::int64_t{1} << kLight};
      return word < kTilts ? within(unsigned_format(4, kPhong)) : within(signed_format(4, kTilt));
    default:
      return {0, kAny};
  }
}

}  // namespace fastsplat::cmodel
