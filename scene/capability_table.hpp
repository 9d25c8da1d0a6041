// SPDX-License-Identifier: Apache-2.0
// Rows of the capability table.
#pragma once

#include <span>

#include "scene/capability.hpp"

namespace fastsplat::scene {

/// Another row that must be on, or must be off. `why` may hold one {}: the key of that row.
struct Link {
  Technique other;
  const char* why;
  const char* fix = nullptr;  ///< absent: the way to turn on the other row
};

struct TechniqueRow {
  Technique technique;
  const char* key;      ///< setting that turns it on
  const char* name;     ///< "... means nothing without NAME"
  const char* turn_on;  ///< how to turn it on
  bool (*on)(const SceneDescription&);
  Methods methods = kAllMethods;
  const char* no_method = "";   ///< why other methods lack it; {} stands for the method
  const char* method_fix = "";  ///< what to do then
  Feature feature = Feature::None;
  std::span<const Link> needs{}, excludes{};
};

/// In the order of Technique.
std::span<const TechniqueRow> technique_rows();
const TechniqueRow& row_of(Technique technique);

}  // namespace fastsplat::scene
