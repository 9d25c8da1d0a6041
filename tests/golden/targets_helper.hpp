// SPDX-License-Identifier: Apache-2.0
// Every kind of vector instruction that the processor has, one after the other.
#pragma once

#include <cstdint>
#include <vector>

namespace fastsplat::golden::testing {

/// The processor's own choice again at the end.
class Targets {
 public:
  Targets();
  ~Targets() { choose(0); }
  void choose(std::uint64_t target);
  const std::vector<std::uint64_t>& all() const { return all_; }

 private:
  std::vector<std::uint64_t> all_;
};

}  // namespace fastsplat::golden::testing
