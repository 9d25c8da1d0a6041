// SPDX-License-Identifier: Apache-2.0
#include "base/images/encoding.hpp"

#include <cmath>
#include <cstdio>

namespace fastsplat::images {

std::string with_primaries(const std::string& transfer, const Primaries& primaries) {
  constexpr double kStep = 1e-3;  // writers store three digits
  std::string text;
  bool differ = false;
  for (std::size_t i = 0; i < primaries.size(); ++i) {
    differ |= !(std::abs(primaries[i] - kSrgbPrimaries[i]) <= kStep);
    std::array<char, 32> number{};
    std::snprintf(number.data(), number.size(), "%s%.4g", i == 0 ? "" : " ", primaries[i]);
    text += number.data();
  }
  return differ ? transfer + " with primaries " + text : transfer;
}

std::string interop_encoding(const std::string& id) {
  if (id == "lin_rec709_scene") return kLinear;
  return id == "srgb_rec709_scene" || id == "srgb_rec709_display" ? kSrgb : "colour space '" + id + "'";
}

std::string profile_encoding(const std::string& name) {
  return name.starts_with("sRGB") ? kSrgb : "ICC profile '" + name + "'";
}

}  // namespace fastsplat::images
