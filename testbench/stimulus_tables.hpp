// Random tables, legal by docs/stream.md and as odd as that allows.
#pragma once

#include <vector>

#include "cmodel/config.hpp"
#include "cmodel/records.hpp"
#include "testbench/random.hpp"

namespace fastsplat::testbench {

enum class TableStyle {
  Any,      ///< words of every size
  Corners,  ///< mostly ends of ranges
  Powers,   ///< powers of two: products tie
  Largest,  ///< the largest words
  Unit,     ///< weights that keep a colour word as it is, factors of 1.0
};

/// At most `most_windows` windows per axis.
cmodel::LoadTable random_rlut(const cmodel::Config& config, Random& random, TableStyle style, std::uint32_t set,
                              int most_windows);
cmodel::LoadTable random_radial(const cmodel::Config& config, Random& random, TableStyle style);
cmodel::LoadTable random_factor(const cmodel::Config& config, Random& random, TableStyle style);

}  // namespace fastsplat::testbench
