// SPDX-License-Identifier: Apache-2.0
#include "base/toml/toml_text.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "base/nesting.hpp"

namespace fastsplat {
namespace {

struct KindOfFile {
  const char* name;
  const char* use;                     ///< how such a file is given to the program
  const char* error;                   ///< what to do about a syntax error
  std::vector<std::string_view> keys;  ///< top-level keys of this kind only
};

/// In the order of TomlKind.
const std::array<KindOfFile, 6>& kinds() {
  static const std::array<KindOfFile, 6> all{
      {{"a configuration",
        "use it with --config",
        "compare with the output of 'fastsplat config show base'",
        {"verified", "array", "colour", "composite", "counters", "cull", "ellipse", "index", "opacity", "pattern",
         "pixel", "position", "radial", "rlut", "rounding", "sheet", "slices", "snap", "tile"}},
       {"a scene",
        "use it with --scene",
        "correct this line",
        {"volume",    "transfer_function", "nan_as",  "method",  "crop", "opacity_scale", "bump",
         "camera",    "culling",           "display", "image",   "lens", "kernel",        "motion",
         "footprint", "raycast",           "slabs",   "texture", "xray", "sequence",      "splat_texture"}},
       {"a transfer function",
        "use it with --tf",
        "correct this line",
        {"domain", "points", "reference_length", "reference_length_mm"}},
       {"a plan",
        "use it with 'fastsplat plan make'",
        "see docs/plan.md and the examples in configs/plans/",
        {"axes", "constants", "kind", "metrics", "refused", "zip"}},
       {"a verification plan", "tools/coverage reads it", "correct this line", {"testpoint"}},
       {"a list of coverage exclusions", "tools/coverage reads it", "correct this line", {"exclusion"}}}};
  return all;
}

void refuse_other_kind(const toml::table& root, const std::string& file, const KindOfFile& expected) {
  const auto keys_of = [&](const KindOfFile& kind) {
    return std::ranges::count_if(kind.keys, [&](std::string_view key) { return root.contains(key); });
  };
  if (keys_of(expected) > 0) return;
  const auto& found = *std::ranges::max_element(kinds(), {}, keys_of);
  if (keys_of(found) == 0) return;
  throw_input(
      {.where = file, .what = "wrong kind of file", .expected = expected.name, .got = found.name, .fix = found.use});
}

}  // namespace

std::string place_in(const std::string& file, const toml::source_position& at) {
  return file + ":" + std::to_string(at.line) + ":" + std::to_string(at.column);
}

toml::table parse_toml(const std::string& text, const std::string& file, TomlKind kind) {
  const KindOfFile& expected = kinds().at(static_cast<std::size_t>(kind));
  if (const auto deep = toml_too_deep(text)) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(*deep);
    const auto line = 1 + std::count(text.begin(), end, '\n');
    throw_input({.where = file + ":" + std::to_string(line),
                 .what = "tables and arrays are nested too deeply",
                 .expected = "at most " + std::to_string(kDeepestNesting) + " levels",
                 .got = {},
                 .fix = expected.error});
  }
  toml::table root;
  try {
    root = toml::parse(text, file);
  } catch (const toml::parse_error& error) {
    throw_input({.where = place_in(file, error.source().begin),
                 .what = "not valid TOML: " + std::string(error.description()),
                 .expected = {},
                 .got = {},
                 .fix = expected.error});
  }
  refuse_other_kind(root, file, expected);
  return root;
}

}  // namespace fastsplat
