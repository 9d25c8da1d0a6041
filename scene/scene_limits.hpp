// The numbers of a scene description, each with its name in scene.toml and its limits: one list for reading, writing
// and checking.
#pragma once

#include <span>

#include "scene/scene.hpp"

namespace fastsplat::scene {

inline constexpr int kMaxImageSide = 16384;  ///< pixels

struct RealSetting {
  const char* table;  ///< table in scene.toml, "" for the top level
  const char* key;
  double low, high;
  double& (*field)(SceneDescription&);
};

struct IntegerSetting {
  const char* table;
  const char* key;
  int low, high;
  int& (*field)(SceneDescription&);
};

std::span<const RealSetting> real_settings();
std::span<const IntegerSetting> integer_settings();

/// UserError (Usage) that names the setting, its limits and the value. Camera and kernel check what depends on more.
void check_limits(const SceneDescription& description);

}  // namespace fastsplat::scene
