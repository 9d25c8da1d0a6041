// SPDX-License-Identifier: Apache-2.0
#include "testbench/coverage/coverage.hpp"

namespace fastsplat::testbench {

Coverage::Id Coverage::declare(const std::string& group, const std::string& name) {
  const auto [at, added] = index_.try_emplace(group + "." + name, bins_.size());
  if (added) bins_.push_back({at->first, 0});
  return at->second;
}

Coverage::Id Coverage::declare_range(const std::string& group, const std::string& prefix, std::size_t count) {
  const std::size_t digits = std::to_string(count - 1).size();
  Id first = bins_.size();
  for (std::size_t i = 0; i < count; ++i) {
    std::string number = std::to_string(i);
    number.insert(0, digits - number.size(), '0');
    declare(group, prefix + number);
  }
  return first;
}

std::uint64_t Coverage::hits(const std::string& name) const {
  const auto found = index_.find(name);
  return found == index_.end() ? 0 : bins_[found->second].hits;
}

void Coverage::merge(const Coverage& other) {
  for (const CoverBin& bin : other.bins_) {
    const auto [at, added] = index_.try_emplace(bin.name, bins_.size());
    if (added)
      bins_.push_back(bin);
    else
      bins_[at->second].hits += bin.hits;
  }
}

RoundingPoint::RoundingPoint(Coverage& coverage, const std::string& group, const std::string& prefix,
                             const cmodel::Narrowing& narrowing, std::int64_t largest)
    : narrowing_(narrowing), exact_(coverage.declare(group, prefix + "exact")) {
  if (narrowing.dropped_bits() >= 1) tie_ = coverage.declare(group, prefix + "tie");
  if (narrowing.dropped_bits() >= 2) {
    below_ = coverage.declare(group, prefix + "below");
    above_ = coverage.declare(group, prefix + "above");
  }
  if (narrowing(largest).overflow) saturated_ = coverage.declare(group, prefix + "saturated");
}

}  // namespace fastsplat::testbench
