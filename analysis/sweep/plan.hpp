// SPDX-License-Identifier: Apache-2.0
// A plan: cases with their commands, each named by a hash of its content (docs/plan.md, "The plan").
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "analysis/sweep/metric.hpp"
#include "analysis/sweep/spec.hpp"
#include "analysis/sweep/value.hpp"

namespace fastsplat::plan {

/// Hashes of the content behind the names in a case's words; empty if it has none.
struct Content {
  std::string config_hash, scene_hash;
  bool operator==(const Content&) const = default;
};

/// A run of this program. Words in braces, "{model.exr}", are files of the case, which lie where the run puts them.
struct Step {
  Words words{};          ///< from the subcommand on, without --json and --threads, which the run adds
  std::string result{};   ///< the subcommand if its JSON is part of the case's result; else empty
  std::string shared{};   ///< the file that it makes for several cases: "golden-HASH.exr"; else empty
  bool coverage = false;  ///< it writes a book of coverage, "{coverage.json}"
  bool operator==(const Step&) const = default;
};

struct Case {
  std::string id;     ///< 16 hex digits
  Settings axes;      ///< its place in the plan
  std::string kind;   ///< "compare", "compare+cycles"
  Settings settings;  ///< all settings, which give the names for `content`
  Content content;
  std::vector<Step> steps;
};

struct Plan {
  std::string name, title, hash;
  std::vector<Axis> axes;
  std::vector<Metric> metrics;  ///< of the specification; the known ones come first
  std::vector<Case> cases;
};

/// The file that a word in braces names; nullopt for any other word.
std::optional<std::string> file_of(const std::string& word);

/// The commands that repeat a case, to be pasted into a shell; its files go to the shell's folder.
std::string command_of(const Case& one);

/// Hash of a case's kind, content and steps.
std::string id_of(const Case& one);

nlohmann::ordered_json to_json(const Plan& plan);
/// Throws UserError (Input) for an invalid or changed plan: every hash is recomputed.
Plan read_plan(const std::filesystem::path& path);

/// A part of a plan: every `of`-th case, from the `index`-th (1 the first) on.
struct Shard {
  std::size_t index = 1, of = 1;
  bool has(std::size_t at) const { return at % of == index - 1; }
};
/// "2/5"; throws UserError (Usage) for anything else.
Shard shard_from(const std::string& text);

}  // namespace fastsplat::plan
