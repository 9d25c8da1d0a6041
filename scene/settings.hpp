// SPDX-License-Identifier: Apache-2.0
// The settings of a scene in one list: each with its key in scene.toml, its flag on the command line, its limits and
// its meaning. Reading, writing, checking and the flags are derived from this list; a new technique adds its entries
// here.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "scene/capability.hpp"
#include "scene/scene.hpp"
#include "scene/toml_reader.hpp"

namespace fastsplat::scene {

inline constexpr int kMaxImageSide = 16384;      ///< pixels
inline constexpr double kLargestVoxel = 3.4e38;  ///< limit of a float

// The kinds of settings. Limits are inclusive; `of` returns the value in a description.
struct Real {
  double low, high;
  double& (*of)(SceneDescription&);
};
struct Integer {
  int low, high;
  int& (*of)(SceneDescription&);
};
struct Triple {
  double low, high;  ///< of each component
  glm::dvec3& (*of)(SceneDescription&);
};
/// "A..B,C..D,E..F", voxels, both ends included; "" is everything.
struct Box {
  VoxelBox& (*of)(SceneDescription&);
};
struct Switch {
  bool& (*of)(SceneDescription&);
};
/// A choice of names; get and set use positions in names().
struct Choice {
  const std::vector<std::string>& (*names)();
  int (*get)(const SceneDescription&);
  void (*set)(SceneDescription&, int);
};

struct Setting {
  const char* table;  ///< table in scene.toml, "" for the top level
  const char* key;
  const char* flag;   ///< "--slab-width"; "" if the command line has special flags for it
  const char* group;  ///< of the flag, in the help
  const char* unit;   ///< of the flag's value, in the help
  const char* help;
  std::variant<Real, Integer, Triple, Box, Switch, Choice> value;
  Capability capability;  ///< where it has an effect
};

/// Its name as in scene.toml: "camera.azimuth", "opacity_scale".
std::string dotted(const Setting& setting);
/// Whether it has its default value.
bool at_default(const Setting& setting, const SceneDescription& description);

/// All settings, table by table, in the order in which scene.toml is written.
std::span<const Setting> settings();
/// The tables in the order of the list, "" first.
std::vector<std::string> setting_tables();

/// The problem with a flag's text ("expected a number in 0.01..64, got '0'"), empty if valid. Numbers are
/// locale-free; a triple is "X,Y,Z"; a switch is on or off.
std::string problem_with(const Setting& setting, const std::string& text);
/// Sets the value from a flag's text, which must be valid.
void set_from_text(const Setting& setting, const std::string& text, SceneDescription& description);

/// Reads the settings of table `name` from `table`; bad values are refused with line and column. Adds the settings
/// found to `given`, except values that are the default.
void read_settings(TomlTable& table, const std::string& name, SceneDescription& description, std::vector<Given>& given);
/// The setting's value as TOML.
std::string value_as_toml(const Setting& setting, const SceneDescription& description);

/// A number that TOML reads back as a float.
std::string number_as_toml(double value);

/// Throws UserError (Usage) that names the first setting out of its limits. Camera and kernel check combinations.
void check_limits(const SceneDescription& description);

}  // namespace fastsplat::scene
