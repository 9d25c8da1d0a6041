// SPDX-License-Identifier: Apache-2.0
#include "scene/sequence.hpp"

#include <fmt/format.h>

#include <cassert>
#include <cmath>
#include <optional>
#include <string_view>

#include "base/error.hpp"
#include "scene/open_scene.hpp"
#include "scene/sequence_table.hpp"
#include "scene/settings.hpp"

namespace fastsplat::scene {
namespace {

struct Limits {
  double low, high;
};

/// nullopt unless the setting is numeric: names and switches cannot be interpolated.
std::optional<Limits> limits_of(const Setting& setting) {
  if (const auto* real = std::get_if<Real>(&setting.value)) return Limits{real->low, real->high};
  if (const auto* whole = std::get_if<Integer>(&setting.value))
    return Limits{static_cast<double>(whole->low), static_cast<double>(whole->high)};
  return std::nullopt;
}

/// Replaces a kernel's name by its numbers, so that they can change.
void spell_out_kernel(SceneDescription& description) {
  if (description.kernel.empty()) return;
  const Kernel named = kernel_by_name(description.kernel);
  description.kernel_a = named.a();
  description.kernel_radius = named.radius();
  description.kernel.clear();
}

void set_number(const Setting& setting, double value, SceneDescription& description) {
  if (setting.table == std::string_view("kernel")) spell_out_kernel(description);
  if (const auto* real = std::get_if<Real>(&setting.value)) real->of(description) = value;
  if (const auto* whole = std::get_if<Integer>(&setting.value))
    whole->of(description) = static_cast<int>(std::lround(value));
}

/// Value at `step` of `steps`, where the keys are spread over 0..steps. Exact at every key, and at every step between
/// whole keys that differ by as much as they are steps apart.
double between(const std::vector<double>& keys, std::int64_t step, std::int64_t steps) {
  if (keys.size() == 1 || steps == 0) return keys.front();
  const std::int64_t place = step * static_cast<std::int64_t>(keys.size() - 1);
  const auto key = static_cast<std::size_t>(place / steps);
  const std::int64_t rest = place % steps;
  if (rest == 0) return keys[key];
  return keys[key] + (keys[key + 1] - keys[key]) * static_cast<double>(rest) / static_cast<double>(steps);
}

}  // namespace

Sequence orbit(double from, double to, int frames) {
  if (from == to) {
    throw_usage({.where = "--orbit",
                 .what = "start and end are the same angle",
                 .expected = "two different angles",
                 .got = fmt::format("{}..{}", from, to),
                 .fix = "for example 0..360 for a whole turn"});
  }
  return {.frames = frames,
          .loop = std::fmod(to - from, 360.0) == 0.0,
          .tracks = {{.setting = "camera.azimuth", .keys = {from, to}}}};
}

Sequence read_sequence(TomlTable& table, std::vector<Given>& given) {
  Sequence sequence;
  const auto frames = table.integer("frames", 1, kMaxFrames);
  if (!frames) table.refuse("frames", "missing", "the number of frames", {}, "write for example frames = 48");
  sequence.frames = *frames;
  sequence.loop = table.flag("loop").value_or(false);

  for (const std::string& name : setting_tables()) {
    auto inner = name.empty() ? std::nullopt : table.table(name);
    if (!name.empty() && !inner) continue;
    TomlTable& place = inner ? *inner : table;
    for (const Setting& setting : settings()) {
      const auto limits = limits_of(setting);
      if (name != setting.table || !limits) continue;
      auto keys = place.numbers(setting.key, 1, limits->low, limits->high);
      if (!keys) continue;
      sequence.tracks.push_back({.setting = dotted(setting), .keys = std::move(*keys)});
      given.push_back({&setting, place.where(setting.key)});
    }
    if (inner) inner->finish();
  }
  table.finish();
  if (sequence.tracks.empty()) {
    table.refuse("", "the sequence changes no setting", "at least one setting with values", {},
                 "write for example camera.azimuth = [0, 90]");
  }
  return sequence;
}

Sequence load_sequence(const std::filesystem::path& scene_file) {
  TomlTable root = open_scene(scene_file);
  auto table = root.table("sequence");
  if (!table)
    root.refuse("", "the table [sequence] is missing", {}, {},
                "add [sequence] with frames = N and a setting that changes");
  std::vector<Given> checked_with_the_scene;
  return read_sequence(*table, checked_with_the_scene);
}

SceneDescription at_frame(const Sequence& sequence, const SceneDescription& still, int frame) {
  assert(frame >= 0 && frame < sequence.frames);
  const int steps = sequence.loop ? sequence.frames : sequence.frames - 1;
  SceneDescription now = still;
  for (const auto& track : sequence.tracks) {
    const double value = between(track.keys, frame, steps);
    for (const Setting& setting : settings()) {
      if (track.setting == dotted(setting)) set_number(setting, value, now);
    }
  }
  return now;
}

std::vector<Given> idle_of(std::vector<Given> given, const Sequence& sequence, const SceneDescription& still) {
  for (int frame = 0; frame < sequence.frames && !given.empty(); ++frame)
    given = idle_of(given, at_frame(sequence, still, frame));
  return given;
}

}  // namespace fastsplat::scene
