// SPDX-License-Identifier: Apache-2.0
// The values that each narrowing site can see in any stream, derived from the configuration alone by interval
// arithmetic on exact integers (docs/errors.md, section 4).
#pragma once

#include <string>
#include <vector>

#include "cmodel/numbers/config.hpp"
#include "cmodel/numbers/sites.hpp"

namespace fastsplat::analysis {

enum class Width {
  Tight,      ///< no stream saturates; one bit less could
  Wasteful,   ///< no stream saturates; leading bits are never used
  Saturates,  ///< some stream saturates; a wider word would not
  Unbounded,  ///< a running sum: enough splats or sheets saturate any word
};
const char* to_string(Width width);

struct DerivedRange {
  cmodel::Site site{};
  /// Before narrowing, with the narrowing's from_frac() fraction bits. A stream reaches either end.
  std::int64_t least = 0, greatest = 0;
  const char* formula = "";  ///< of the value `greatest`, in the symbols of docs/errors.md
  Width width{};
  int spare = 0;  ///< integer bits that no stream uses; negative: missing ones, of a running sum those of `greatest`
  bool saturates() const { return width == Width::Saturates || width == Width::Unbounded; }
};

/// All sites that the configuration has.
std::vector<DerivedRange> derived_ranges(const cmodel::Config& config);

/// "U 2.16", as in docs/numerics.md.
std::string format_text(const cmodel::Format& format);
/// "0..1.99988": both ends with `frac_bits` fraction bits.
std::string interval_text(std::int64_t least, std::int64_t greatest, int frac_bits);
/// "tight", "1 unused", "saturates", "unbounded".
std::string verdict(const DerivedRange& range);

}  // namespace fastsplat::analysis
