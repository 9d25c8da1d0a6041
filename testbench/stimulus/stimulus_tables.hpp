// SPDX-License-Identifier: Apache-2.0
// Random tables, legal by docs/stream.md and as odd as that allows.
#pragma once

#include <cstdint>
#include <vector>

#include "cmodel/numbers/config.hpp"
#include "cmodel/stream/records.hpp"
#include "testbench/stimulus/random.hpp"

namespace fastsplat::testbench {

enum class TableStyle {
  Any,      ///< words of every size
  Corners,  ///< mostly ends of ranges
  Powers,   ///< powers of two: products tie
  Largest,  ///< the largest words
  Unit,     ///< one weight that takes colour words to sheet words as evenly as it can; factors of 1.0
};

/// Windows per axis: `least_windows` to `most_windows`, as far as the table holds them.
cmodel::LoadTable random_rlut(const cmodel::Config& config, Random& random, TableStyle style, std::uint32_t set,
                              int least_windows, int most_windows);
/// The weight of TableStyle::Unit: 1 in units of product per colour word, or the largest there is.
std::int64_t unit_weight(const cmodel::Config& config);
cmodel::LoadTable random_radial(const cmodel::Config& config, Random& random, TableStyle style);
cmodel::LoadTable random_factor(const cmodel::Config& config, Random& random, TableStyle style);

/// Of densities: one of CLASSIFY to SHEETS, which describes so many sheets.
constexpr std::uint32_t kScaledSheets = 300;
cmodel::LoadTable random_density_table(const cmodel::Config& config, Random& random, cmodel::Table table);

}  // namespace fastsplat::testbench
