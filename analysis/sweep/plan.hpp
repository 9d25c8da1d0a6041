// A plan: cases with the commands that they are, each named by the hash of what it is (docs/plan.md, "The plan").
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

/// What is behind the names in a case's words, as hashes; empty where a case has none.
struct Content {
  std::string config_hash, scene_hash;
  bool operator==(const Content&) const = default;
};

/// A run of this program. Words in braces, "{model.exr}", are files of the case: they lie where the run puts them.
struct Step {
  Words words{};          ///< from the verb on; neither --json nor --threads, which the run adds
  std::string result{};   ///< the verb, where its JSON is part of the case's result; else empty
  std::string shared{};   ///< the file it makes, where cases share that: "golden-HASH.exr"; else empty
  bool coverage = false;  ///< it writes a book of coverage, "{coverage.json}"
  bool operator==(const Step&) const = default;
};

struct Case {
  std::string id;     ///< 16 hex digits
  Settings axes;      ///< its place in the plan
  std::string kind;   ///< "compare", "compare+cycles"
  Settings settings;  ///< everything set, for what is behind the names
  Content content;
  std::vector<Step> steps;
};

struct Plan {
  std::string name, title, hash;
  std::vector<Axis> axes;
  std::vector<Metric> metrics;  ///< of the specification; the known ones come before
  std::vector<Case> cases;
};

/// The file of a case's words in braces; nothing for any other word.
std::optional<std::string> file_of(const std::string& word);

/// The commands that make a case again, to be pasted into a shell: its files lie in the folder where that is.
std::string command_of(const Case& one);

/// Of everything that makes a case what it is.
std::string id_of(const Case& one);

nlohmann::ordered_json to_json(const Plan& plan);
/// Throws UserError (Input) for an invalid or changed plan: every hash is computed again.
Plan read_plan(const std::filesystem::path& path);

/// A part of a plan: every `of`-th case, from the `index`-th (1 the first) on.
struct Shard {
  std::size_t index = 1, of = 1;
  bool has(std::size_t at) const { return at % of == index - 1; }
};
/// "2/5"; throws UserError (Usage) for anything else.
Shard shard_from(const std::string& text);

}  // namespace fastsplat::plan
