// SPDX-License-Identifier: Apache-2.0
// A setting, with the further settings that it needs to have an effect, found as a user would: by following the
// refusals' fixes.
#pragma once

#include <optional>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include "scene/settings.hpp"

namespace fastsplat::scene {

inline const Setting& setting_of(const std::string& flag_or_key) {
  for (const Setting& setting : settings()) {
    if (flag_or_key == setting.flag || flag_or_key == dotted(setting)) return setting;
  }
  throw std::runtime_error("no setting " + flag_or_key);
}

/// Sets it as its flag does; a kernel's numbers take over from its name.
inline void apply(const Setting& setting, const std::string& text, SceneDescription& description) {
  if (setting.table == std::string_view("kernel")) description.kernel.clear();
  set_from_text(setting, text, description);
}

/// The first fix of a refusal: a setting and its value. The engine does not change; the method may be fixed too.
inline std::optional<std::pair<const Setting*, std::string>> fix_of(const ErrorParts& refused, bool method_stays) {
  if (refused.fix.find("--perspective") != std::string::npos)
    return {{&setting_of("camera.projection"), "perspective"}};
  static const std::regex flag("(--[a-z-]+) ([^ ,:-][^ ,:]*)");
  for (std::sregex_iterator at(refused.fix.begin(), refused.fix.end(), flag), end; at != end; ++at) {
    const std::string name = (*at)[1];
    if (name != "--engine" && !(method_stays && name == "--method")) return {{&setting_of(name), (*at)[2]}};
  }
  return std::nullopt;
}

/// A scene in which the setting, at its probe value, is accepted; or the refusal without a fix.
struct Followed {
  SceneDescription with, without;
  std::vector<std::string> refusals;  ///< on the way
  bool accepted = false;
};

/// Follows the refusals' suggestions until the last one is gone, but keeps the method with `method_stays`.
inline Followed follow_fixes(const Setting& setting, const SceneDescription& start, const Offers& offers,
                             bool method_stays) {
  Followed way{.with = start, .without = start, .refusals = {}, .accepted = false};
  apply(setting, setting.capability.probe, way.with);
  for (int step = 0; step < 6; ++step) {
    auto refused = refusal(Given{&setting}, way.with);
    if (!refused) refused = refusal(way.with, offers);
    if (!refused) {
      way.accepted = true;
      return way;
    }
    way.refusals.push_back(one_line(*refused));
    const auto fix = fix_of(*refused, method_stays);
    if (!fix || fix->first == &setting) return way;
    apply(*fix->first, fix->second, way.with);
    apply(*fix->first, fix->second, way.without);
  }
  return way;
}

}  // namespace fastsplat::scene
