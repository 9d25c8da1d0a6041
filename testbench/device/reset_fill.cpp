// SPDX-License-Identifier: Apache-2.0
#include "testbench/device/reset_fill.hpp"

#include "base/error.hpp"

namespace fastsplat::testbench {

ResetFill reset_fill_from(const std::string& name) {
  for (const ResetFill fill : {ResetFill::Zero, ResetFill::One, ResetFill::Random}) {
    if (name == to_string(fill)) return fill;
  }
  throw_usage({.where = "--fill",
               .what = "unknown reset fill '" + name + "'",
               .expected = "zero, one or random",
               .got = {},
               .fix = {}});
}

const char* to_string(ResetFill fill) {
  switch (fill) {
    case ResetFill::Zero:
      return "zero";
    case ResetFill::One:
      return "one";
    case ResetFill::Random:
      return "random";
  }
  return "?";
}

}  // namespace fastsplat::testbench
