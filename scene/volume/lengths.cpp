// SPDX-License-Identifier: Apache-2.0
#include "scene/volume/lengths.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/lower_case.hpp"

namespace fastsplat::volume {

std::optional<double> mm_per_unit(std::string_view unit) {
  // Names without the plural's s. The micro sign has two code points.
  static constexpr std::array<std::pair<std::string_view, double>, 26> kUnits{
      {{"mm", 1.0},          {"millimeter", 1.0},  {"millimetre", 1.0},  {"um", 1e-3},     {"\u00b5m", 1e-3},
       {"\u03bcm", 1e-3},    {"micrometer", 1e-3}, {"micrometre", 1e-3}, {"micron", 1e-3}, {"nm", 1e-6},
       {"nanometer", 1e-6},  {"nanometre", 1e-6},  {"angstrom", 1e-7},   {"cm", 10.0},     {"centimeter", 10.0},
       {"centimetre", 10.0}, {"m", 1e3},           {"meter", 1e3},       {"metre", 1e3},   {"dm", 100.0},
       {"km", 1e6},          {"kilometer", 1e6},   {"kilometre", 1e6},   {"in", 25.4},     {"inch", 25.4},
       {"inche", 25.4}}};
  std::string name = lower_case(std::string(unit));
  if (name.size() > 3 && name.back() == 's') name.pop_back();
  const auto* const found =
      std::find_if(kUnits.begin(), kUnits.end(), [&name](const auto& row) { return row.first == name; });
  if (found == kUnits.end()) return std::nullopt;
  return found->second;
}

double usable_length(double declared) { return std::isfinite(declared) && declared != 0.0 ? std::abs(declared) : 1.0; }

void note_unusable_length(const std::string& name, double declared, double used, std::vector<std::string>& remarks) {
  if (declared > 0.0 && std::isfinite(declared)) return;
  remarks.push_back(fmt::format("the header's {} is {}, which is not a length: {} mm is used", name, declared, used));
}

}  // namespace fastsplat::volume
