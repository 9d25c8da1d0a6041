// SPDX-License-Identifier: Apache-2.0
// Overloads for std::visit.
#pragma once

namespace fastsplat {

/// Calls the function for the variant's kind.
template <class... Functions>
struct Each : Functions... {
  using Functions::operator()...;
};
// Clang before 17 does not deduce it by itself.
template <class... Functions>
Each(Functions...) -> Each<Functions...>;

}  // namespace fastsplat
