// SPDX-License-Identifier: Apache-2.0
// Functional coverage: named bins and how often each was hit. A bin is `group.name`; only what is reachable in a
// configuration is declared for it, so every declared bin has to be hit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "cmodel/numbers/narrow.hpp"

namespace fastsplat::testbench {

struct CoverBin {
  std::string name;  ///< "group.name"
  std::uint64_t hits = 0;
};

class Coverage {
 public:
  using Id = std::size_t;

  /// The bin `group.name`; declaring it again gives the same one.
  Id declare(const std::string& group, const std::string& name);
  /// `count` bins of a group, named prefix0, prefix1, ... with equally many digits. Returns the first; the others
  /// follow.
  Id declare_range(const std::string& group, const std::string& prefix, std::size_t count);

  void hit(Id id, std::uint64_t times = 1) { bins_[id].hits += times; }
  std::uint64_t hits(const std::string& name) const;  ///< 0 for a bin that was not declared
  bool declared(const std::string& name) const { return index_.contains(name); }
  const std::vector<CoverBin>& bins() const { return bins_; }  ///< in the order of declaration

  /// Adds the other's hits. Bins that only the other declares are taken over.
  void merge(const Coverage& other);

 private:
  std::vector<CoverBin> bins_;
  std::map<std::string, Id> index_;
};

/// Bins of a narrowing: exact, below the half, a tie, above the half, saturated. Only bins that its dropped bits and a
/// largest value can reach are declared.
class RoundingPoint {
 public:
  RoundingPoint() = default;
  /// Bins group.PREFIXexact, ...tie and so on. `largest` is the largest value before narrowing.
  RoundingPoint(Coverage& coverage, const std::string& group, const std::string& prefix,
                const cmodel::Narrowing& narrowing, std::int64_t largest);

  /// Narrows the value and hits its bin.
  cmodel::Narrowed sample(Coverage& coverage, std::int64_t value) const {
    const cmodel::Narrowed narrowed = narrowing_(value);
    const std::int64_t twice = 2 * narrowing_.dropped(value), one = std::int64_t{1} << narrowing_.dropped_bits();
    coverage.hit(twice == 0 ? exact_ : twice == one ? tie_ : twice < one ? below_ : above_);
    if (narrowed.overflow) coverage.hit(saturated_);
    return narrowed;
  }

 private:
  cmodel::Narrowing narrowing_{cmodel::Rounding::TRN, cmodel::Overflow::SAT, 0, {}};
  Coverage::Id exact_ = 0, below_ = 0, tie_ = 0, above_ = 0, saturated_ = 0;
};

}  // namespace fastsplat::testbench
