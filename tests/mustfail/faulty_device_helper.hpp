// An assertion of the RTL fired.
#pragma once

#include <stdexcept>

namespace fastsplat::test {

class AssertionFired : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace fastsplat::test
