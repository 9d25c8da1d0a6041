// SPDX-License-Identifier: Apache-2.0
#include "testbench/stimulus/stimulus_tables.hpp"

#include <algorithm>
#include <functional>

#include "cmodel/classify/classify_tables.hpp"

namespace fastsplat::testbench {
namespace {

constexpr std::int64_t kLooksLikeSheets =
                           static_cast<int>(cmodel::Opcode::LoadTable) | static_cast<int>(cmodel::Table::Sheets) << 8,
                       kLooksLikeFrame = static_cast<int>(cmodel::Opcode::BeginFrame);

std::uint32_t word(std::int64_t value) { return static_cast<std::uint32_t>(value); }

/// A word 0..most: uniform, near an end, or of any magnitude.
std::int64_t any_word(Random& random, std::int64_t most) {
  switch (random.between(0, 3)) {
    case 0:
      return random.between(0, most);
    case 1:
      return random.between(0, std::min<std::int64_t>(most, 3));
    case 2:
      return most - random.between(0, std::min<std::int64_t>(most, 3));
    default:
      return random.between(0, most) >> random.between(0, 20);
  }
}

std::int64_t power_below(Random& random, std::int64_t most) {
  std::int64_t power = 1;
  while (power * 2 <= most && !random.chance(12)) power *= 2;
  return power;
}

std::int64_t styled(Random& random, TableStyle style, std::int64_t most) {
  switch (style) {
    case TableStyle::Any:
      return any_word(random, most);
    case TableStyle::Corners:
      return random.chance(50) ? most - random.between(0, 1) : random.between(0, 1);
    case TableStyle::Powers:
      return power_below(random, most);
    case TableStyle::Largest:
      return random.chance(90) ? most : any_word(random, most);
    case TableStyle::Unit:
      return most;
  }
  return 0;
}

}  // namespace

cmodel::LoadTable random_rlut(const cmodel::Config& config, Random& random, TableStyle style, std::uint32_t set,
                              int least_windows, int most_windows) {
  const int lanes = config.lanes, k = config.phases;
  const int fitting = config.rlut_columns / lanes;
  const int windows =
      static_cast<int>(random.between(std::min(least_windows, fitting), std::min(most_windows, fitting)));
  const int columns = windows * lanes;
  // E = ceil(2 rho / k) in (columns - P, columns].
  const std::int64_t least = std::int64_t{columns - lanes} * k / 2 + 1, most = std::int64_t{columns} * k / 2;
  const std::int64_t base = random.between(0, (config.rlut_columns - columns) / lanes) * lanes;
  cmodel::LoadTable table{.table = cmodel::Table::Rlut,
                          .radius = {.set = set, .rho = word(random.between(least, most)), .base = word(base)},
                          .words = {}};
  const std::int64_t rim = config.rlut_rim(), step = std::int64_t{1} << config.rlut_guard_bits;
  for (int i = 0; i < k * columns; ++i) {
    std::int64_t value = 0;
    switch (style) {
      case TableStyle::Any:
        value = any_word(random, rim);
        break;
      case TableStyle::Corners: {
        // Sums of two fall on and beside the support's edge, the last entry and the first.
        const std::int64_t corners[] = {0, 1, step - 1, step, rim / 2 - 1, rim / 2, rim - step, rim - 1, rim};
        value = corners[random.between(0, 8)];
        break;
      }
      case TableStyle::Powers:
      case TableStyle::Largest:
      case TableStyle::Unit:
        value = random.between(0, rim / 2 - 1);
        break;
    }
    table.words.push_back(word(value));
  }
  return table;
}

std::int64_t unit_weight(const cmodel::Config& config) {
  const int shift = std::max(0, config.colour_frac_bits + config.radial_frac_bits - config.sheet_frac_bits);
  return std::min(std::int64_t{1} << shift, config.weight_format().max);
}

cmodel::LoadTable random_radial(const cmodel::Config& config, Random& random, TableStyle style) {
  cmodel::LoadTable table{.table = cmodel::Table::Radial, .radius = {}, .words = {}};
  const std::int64_t unit = unit_weight(config);
  for (int i = 0; i < config.radial_words(); ++i)
    table.words.push_back(word(style == TableStyle::Unit ? unit : styled(random, style, config.weight_format().max)));
  return table;
}

cmodel::LoadTable random_factor(const cmodel::Config& config, Random& random, TableStyle style) {
  cmodel::LoadTable table{.table = cmodel::Table::Factor, .radius = {}, .words = {}};
  const std::int64_t most = config.factor_format().max;
  for (int i = 0; i <= config.opacity_segments; ++i)
    table.words.push_back(word(styled(random, style, style == TableStyle::Any && random.chance(50) ? most / 2 : most)));
  std::sort(table.words.begin(), table.words.end(), std::greater<>());
  return table;
}

cmodel::LoadTable random_density_table(const cmodel::Config& config, Random& random, cmodel::Table table) {
  cmodel::LoadTable out{.table = table, .radius = {}, .words = {}};
  const bool sheets = table == cmodel::Table::Sheets;
  const std::int64_t count =
      sheets ? std::int64_t{cmodel::classify::kSheetWords} * kScaledSheets : cmodel::classify_words(config, table);
  const std::int64_t scale = std::int64_t{1} << cmodel::classify::kScale;
  const std::int64_t beat_words = cmodel::kBeatWords, last_beat = (count - 1) / beat_words * beat_words;
  for (std::int64_t i = 0; i < count; ++i) {
    const auto range = cmodel::classify_word_range(config, table, static_cast<std::size_t>(i));
    std::int64_t value = 0;
    if (sheets && i % 2 == 0) {
      value = any_word(random, scale);
      value |= any_word(random, scale) << 16;
    } else if (range.least < 0) {  // directions and tilts, mostly gentle
      value = random.between(range.least, range.most);
      if (i > 6 && random.chance(70)) value >>= 12;
      if (i < 6 && value % 4 == 0) value = range.most;  // the only value with this bit
    } else {
      value = any_word(random, range.most);
    }
    // A last beat that looks like a record, as it may still be there when the table has ended. In SHEETS it looks like
    // the header of a table without words, in other tables like begin_frame.
    if (value % 4 < 2 && i == last_beat && range.least >= 0) value = sheets ? kLooksLikeSheets : kLooksLikeFrame;
    if (sheets && i == last_beat + 3) value = 0;
    out.words.push_back(word(value));
  }
  return out;
}

}  // namespace fastsplat::testbench
