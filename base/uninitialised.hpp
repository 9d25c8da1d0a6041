// Memory for results that several threads write: resize() leaves it as it is, so that its pages are first touched by
// those who fill them, not all by one thread.
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

/// Of plain data. Whoever resizes it writes every element before one is read.
template <class T>
using Uninitialised = std::vector<T, LeftAsIs<T>>;

}  // namespace fastsplat
