// SPDX-License-Identifier: Apache-2.0
#include "analysis/pipeline/float_format.hpp"

#include <algorithm>

#include "base/error.hpp"

namespace fastsplat::stages {

double FloatFormat::greatest() const {
  const double ulp = std::ldexp(1.0, -fraction_bits);
  return infinite ? std::ldexp(2.0 - ulp, bias()) : std::ldexp(2.0 - 2.0 * ulp, bias() + 1);
}

const std::vector<FloatFormat>& float_formats() {
  static const std::vector<FloatFormat> all{{"fp16", 5, 10, true}, {"bf16", 8, 7, true},  {"tf19", 8, 10, true},
                                            {"e5m2", 5, 2, true},  {"e4m3", 4, 3, false}, {"fp32", 8, 23, true}};
  return all;
}

const FloatFormat& float_format(std::string_view name, const std::string& where) {
  const auto found =
      std::find_if(float_formats().begin(), float_formats().end(), [&](const auto& one) { return one.name == name; });
  if (found != float_formats().end()) return *found;
  std::string names;
  for (const FloatFormat& one : float_formats()) names += (names.empty() ? "" : ", ") + std::string(one.name);
  throw_usage({.where = where,
               .what = "no such floating-point format",
               .expected = names,
               .got = "'" + std::string(name) + "'",
               .fix = "use one of these"});
}

}  // namespace fastsplat::stages
