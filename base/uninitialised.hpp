// SPDX-License-Identifier: Apache-2.0
// Memory for results that several threads write. resize() does not initialise it, so that each page is first touched by
// the thread that fills it.
#pragma once

#include <memory>
#include <utility>
#include <vector>

namespace fastsplat {

template <class T>
struct LeftAsIs : std::allocator<T> {
  template <class U>
  struct rebind {
    using other = LeftAsIs<U>;
  };
  template <class U>
  void construct(U* /*at*/) noexcept {}
  template <class U, class... Args>
  void construct(U* at, Args&&... args) {
    std::construct_at(at, std::forward<Args>(args)...);
  }
};

/// A vector of plain data. After resize(), write every element before reading it.
template <class T>
using Uninitialised = std::vector<T, LeftAsIs<T>>;

}  // namespace fastsplat
