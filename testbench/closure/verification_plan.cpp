// SPDX-License-Identifier: Apache-2.0
#include "testbench/closure/verification_plan.hpp"

#include <toml++/toml.h>

#include <algorithm>

#include "base/error.hpp"
#include "base/read_file.hpp"
#include "base/toml/toml_text.hpp"

namespace fastsplat::testbench {
namespace {

class Reader {
 public:
  Reader(const std::filesystem::path& path, TomlKind kind)
      : path_(path), root_(parse_toml(read_text_file(path), path.string(), kind)) {}

  /// The tables of the file's only key, an array of tables.
  std::vector<const toml::table*> tables(const char* name) const {
    std::vector<const toml::table*> out;
    for (const auto& [key, node] : root_) {
      if (key.str() != name || !node.is_array_of_tables())
        refuse(node.source().begin, "unexpected '" + std::string(key.str()) + "'", std::string("[[") + name + "]]");
      for (const auto& entry : *node.as_array()) out.push_back(entry.as_table());
    }
    if (out.empty()) refuse({1, 1}, "the file is empty", std::string("[[") + name + "]]");
    return out;
  }

  std::string text(const toml::table& table, const char* key) const {
    const auto* node = table.get(key);
    if (node == nullptr || !node->is_string() || node->as_string()->get().empty())
      refuse(node == nullptr ? table.source().begin : node->source().begin,
             std::string(key) + " is missing or not a string", "text");
    return node->as_string()->get();
  }

  std::vector<std::string> texts(const toml::table& table, const char* key) const {
    std::vector<std::string> out;
    const auto* node = table.get(key);
    if (node == nullptr) return out;
    if (!node->is_array()) refuse(node->source().begin, std::string(key) + " is not a list", "a list of strings");
    for (const auto& entry : *node->as_array()) {
      if (!entry.is_string())
        refuse(entry.source().begin, std::string(key) + " contains a value that is not a string", "texts");
      out.push_back(entry.as_string()->get());
    }
    return out;
  }

  void only(const toml::table& table, std::initializer_list<const char*> keys) const {
    for (const auto& [key, node] : table) {
      if (std::find(keys.begin(), keys.end(), key.str()) == keys.end())
        refuse(key.source().begin, "unknown key '" + std::string(key.str()) + "'", "one of the plan's keys");
    }
  }

  [[noreturn]] void refuse(const toml::source_position& at, const std::string& what,
                           const std::string& expected) const {
    throw_input({.where = place_in(path_.string(), at), .what = what, .expected = expected, .got = {}, .fix = {}});
  }

 private:
  std::filesystem::path path_;
  toml::table root_;
};

}  // namespace

VerificationPlan read_plan(const std::filesystem::path& path) {
  const Reader reader(path, TomlKind::VerificationPlan);
  VerificationPlan plan;
  for (const toml::table* table : reader.tables("testpoint")) {
    reader.only(*table, {"name", "proves", "campaigns", "tests", "bins", "configs", "assertions", "faults"});
    Testpoint point{.name = reader.text(*table, "name"),
                    .proves = reader.text(*table, "proves"),
                    .campaigns = reader.texts(*table, "campaigns"),
                    .tests = reader.texts(*table, "tests"),
                    .bins = reader.texts(*table, "bins"),
                    .configs = reader.texts(*table, "configs"),
                    .assertions = reader.texts(*table, "assertions"),
                    .faults = reader.texts(*table, "faults")};
    const auto& at = table->source().begin;
    if (point.bins.empty() != point.campaigns.empty())
      reader.refuse(at, point.name + ": bins and campaigns require each other", "both, or neither");
    if (point.bins.empty() && point.tests.empty())
      reader.refuse(at, point.name + ": neither bins nor tests", "bins or tests");
    for (const auto& other : plan.testpoints) {
      if (other.name == point.name) reader.refuse(at, point.name + ": duplicate testpoint name", {});
    }
    plan.testpoints.push_back(std::move(point));
  }
  return plan;
}

bool matches(const std::string& pattern, const std::string& text) {
  const auto star = pattern.find('*');
  if (star == std::string::npos) return pattern == text;
  if (text.compare(0, star, pattern, 0, star) != 0) return false;
  const std::string rest = pattern.substr(star + 1);
  for (std::size_t from = star; from <= text.size(); ++from) {
    if (matches(rest, text.substr(from))) return true;
  }
  return false;
}

std::vector<LineExclusion> read_exclusions(const std::filesystem::path& path) {
  const Reader reader(path, TomlKind::Exclusions);
  std::vector<LineExclusion> out;
  for (const toml::table* table : reader.tables("exclusion")) {
    reader.only(*table, {"file", "line", "kind", "reason"});
    out.push_back({.file = reader.text(*table, "file"),
                   .line = reader.text(*table, "line"),
                   .kind = reader.text(*table, "kind"),
                   .reason = reader.text(*table, "reason")});
  }
  return out;
}

}  // namespace fastsplat::testbench
