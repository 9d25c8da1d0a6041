// SPDX-License-Identifier: Apache-2.0
#include "cmodel/classify/pattern_tables.hpp"

namespace fastsplat::cmodel {

using namespace pattern;

std::int64_t pattern_words(const Config& config, Table table) {
  if (table == Table::Pattern) return kPatternWords;
  return std::int64_t{kNodeWords} << (3 * config.pattern_node_bits);
}

WordRange pattern_word_range(Table table, std::size_t word) {
  constexpr std::int64_t kAny = 0xFFFFFFFF;
  if (table == Table::Nodes) return {0, kAny};
  if (word < kSteps) return {0, kFar};
  if (word < kLow) return {0, kAny};
  const Format format = word < kA ? unit_format(kTint) : unsigned_format(kAmountInt, kAmount);
  return {format.min, format.max};
}

}  // namespace fastsplat::cmodel
