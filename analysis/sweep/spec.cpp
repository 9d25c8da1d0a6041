// SPDX-License-Identifier: Apache-2.0
#include "analysis/sweep/spec.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <set>

#include "analysis/sweep/columns.hpp"
#include "base/error.hpp"
#include "base/read_file.hpp"
#include "base/suggest.hpp"
#include "base/toml/toml_text.hpp"

namespace fastsplat::plan {
namespace {

constexpr std::size_t kMostValues = 1'000'000;
constexpr const char* kKeys[] = {"name", "title", "kind", "refused", "constants", "axes", "zip", "metrics"};

/// A name with its value; nested tables give dotted names: snap.phases = 64.
struct Entry {
  std::string name;
  const toml::node* node;
};

class Reader {
 public:
  explicit Reader(std::filesystem::path path) : path_(std::move(path)) {}

  Spec read() {
    const toml::table root = parse_toml(read_text_file(path_), path_.string(), TomlKind::Plan);
    for (const auto& [key, node] : root) {
      const std::string name(key.str());
      if (std::ranges::find(kKeys, name) != std::end(kKeys)) continue;
      const std::vector<std::string> known(std::begin(kKeys), std::end(kKeys));
      refuse(node, fmt::format("unknown key '{}'", name), "", suggestion(name, known));
    }
    Spec spec;
    spec.file = path_;
    spec.name = text_of(root, "name").value_or(path_.stem().string());
    spec.title = text_of(root, "title").value_or(spec.name);
    spec.kinds = kinds(root);
    spec.leave_out_refused = leaves_out(root);
    if (const auto* node = root.get("constants")) {
      for (const Entry& entry : entries(*node, "constants"))
        spec.constants.push_back({taken(entry), value(*entry.node, entry.name)});
    }
    spec.axes = axes(root);
    if (const auto* node = root.get("metrics")) {
      for (const toml::table* table : tables(*node, "metrics")) spec.metrics.push_back(metric(*table));
    }
    return spec;
  }

 private:
  [[noreturn]] void refuse_at(const toml::source_region& at, std::string what, std::string expected,
                              std::string fix) const {
    throw_input({.where = place_in(path_.string(), at.begin),
                 .what = std::move(what),
                 .expected = std::move(expected),
                 .got = {},
                 .fix = std::move(fix)});
  }
  [[noreturn]] void refuse(const toml::node& node, std::string what, std::string expected = {},
                           std::string fix = {}) const {
    refuse_at(node.source(), std::move(what), std::move(expected), std::move(fix));
  }

  std::optional<std::string> text_of(const toml::table& table, const char* key) const {
    const toml::node* node = table.get(key);
    if (node == nullptr) return std::nullopt;
    if (const auto text = node->value_exact<std::string>()) return *text;
    refuse(*node, fmt::format("{} has the wrong type", key), "a string");
  }

  std::vector<std::string> kinds(const toml::table& root) const {
    const toml::node* node = root.get("kind");
    if (node == nullptr) {
      throw_input({.where = path_.string(),
                   .what = "the key 'kind' is missing",
                   .expected = "kind = \"compare\" or another subcommand with a JSON result",
                   .got = {},
                   .fix = "add a kind listed in docs/plan.md"});
    }
    std::vector<std::string> out;
    for (const Value& kind : list(*node, "kind")) {
      const auto* text = std::get_if<std::string>(&kind);
      if (text == nullptr || text->empty())
        refuse(*node, "kind has the wrong type", "\"compare\" or [\"compare\", \"cycles\"]");
      if (std::ranges::find(out, *text) != out.end()) refuse(*node, fmt::format("kind {} occurs twice", *text));
      out.push_back(*text);
    }
    return out;
  }

  bool leaves_out(const toml::table& root) const {
    const auto word = text_of(root, "refused");
    if (word && *word != "error" && *word != "leave out")
      refuse(*root.get("refused"), fmt::format("invalid value '{}' of refused", *word), "\"error\" or \"leave out\"",
             suggestion(*word, std::vector<std::string>{"error", "leave out"}));
    return word == "leave out";
  }

  Value value(const toml::node& node, const std::string& name) const {
    if (const auto flag = node.value_exact<bool>()) return *flag;
    if (const auto whole = node.value_exact<std::int64_t>()) return *whole;
    if (const auto real = node.value_exact<double>()) return *real;
    if (const auto text = node.value_exact<std::string>()) return *text;
    refuse(node, name + " is not a single value", "a number, text, true or false");
  }

  /// A list, one value, or a range {from, to} with `step` or `times`.
  std::vector<Value> list(const toml::node& node, const std::string& name) const {
    if (const auto* table = node.as_table()) return range(*table, name);
    const auto* array = node.as_array();
    if (array == nullptr) return {value(node, name)};
    if (array->empty()) refuse(node, name + " has no values", "at least one");
    std::vector<Value> values;
    for (const auto& element : *array) {
      values.push_back(value(element, name));
      if (std::ranges::count(values, values.back()) > 1)
        refuse(element, fmt::format("{} has the value {} twice", name, to_text(values.back())), "each once");
    }
    return values;
  }

  std::vector<Value> range(const toml::table& table, const std::string& name) const {
    const auto number = [&](const char* key, std::optional<std::int64_t> otherwise) {
      const toml::node* node = table.get(key);
      if (node == nullptr && otherwise) return *otherwise;
      if (const auto whole = node == nullptr ? std::nullopt : node->value_exact<std::int64_t>()) return *whole;
      refuse(node == nullptr ? table : *node, fmt::format("the range of {} needs a whole number '{}'", name, key),
             "{from = 1, to = 20}, with step = 5 or times = 2");
    };
    for (const auto& [key, node] : table) {
      if (!is_range_key(key.str()))
        refuse(node, fmt::format("unknown key '{}' of a range", key.str()), "from, to, step, times");
    }
    const auto from = number("from", {}), to = number("to", {}), step = number("step", 1), times = number("times", 1);
    const bool both = table.contains("step") && table.contains("times");
    if (to < from || step < 1 || times < 1 || both || (table.contains("times") && (times < 2 || from < 1)))
      refuse(table, fmt::format("the range of {} is empty or invalid", name), "from <= to, and step >= 1 or times >= 2",
             "");
    std::vector<Value> values;
    for (std::int64_t at = from; at <= to && values.size() <= kMostValues;) {
      values.emplace_back(at);
      if (times > 1 ? at > to / times : at > to - step) break;
      at = times > 1 ? at * times : at + step;
    }
    if (values.size() > kMostValues)
      refuse(table, fmt::format("the range of {} is too long", name), fmt::format("at most {} values", kMostValues));
    return values;
  }

  static bool is_range_key(std::string_view key) {
    return key == "from" || key == "to" || key == "step" || key == "times";
  }
  static bool is_range(const toml::table& table) {
    return !table.empty() &&
           std::all_of(table.begin(), table.end(), [](const auto& entry) { return is_range_key(entry.first.str()); });
  }

  void flatten(const toml::table& table, const std::string& before, std::vector<Entry>& to) const {
    for (const auto& [key, node] : table) {
      const std::string name = before + std::string(key.str());
      const auto* inner = node.as_table();
      if (inner != nullptr && !is_range(*inner)) {
        flatten(*inner, name + ".", to);
      } else {
        to.push_back({name, &node});
      }
    }
  }

  /// All entries of a table, in the order of the file.
  std::vector<Entry> entries(const toml::node& node, const char* what) const {
    const auto* table = node.as_table();
    if (table == nullptr) refuse(node, fmt::format("{} is not a table", what), fmt::format("[{}]", what));
    std::vector<Entry> out;
    flatten(*table, "", out);
    std::ranges::sort(out, {}, [](const Entry& entry) {
      const auto& at = entry.node->source().begin;
      return std::pair(at.line, at.column);
    });
    return out;
  }

  std::vector<const toml::table*> tables(const toml::node& node, const char* what) const {
    const auto* array = node.as_array();
    std::vector<const toml::table*> out;
    for (std::size_t at = 0; array != nullptr && at < array->size(); ++at) {
      if ((*array)[at].is_table()) out.push_back((*array)[at].as_table());
    }
    if (out.empty()) refuse(node, fmt::format("{} is not an array of tables", what), fmt::format("[[{}]]", what));
    return out;
  }

  /// Registers the name; refuses one that is already set.
  std::string taken(const Entry& entry) {
    if (!names_.insert(entry.name).second)
      refuse(*entry.node, fmt::format("{} is set twice", entry.name), "", "make it a constant, or put it on one axis");
    return entry.name;
  }

  std::vector<Zip> axes(const toml::table& root) {
    std::vector<std::pair<toml::source_position, Zip>> found;
    if (const auto* node = root.get("axes")) {
      for (const Entry& entry : entries(*node, "axes"))
        found.emplace_back(entry.node->source().begin,
                           Zip{{.name = taken(entry), .values = list(*entry.node, entry.name)}});
    }
    if (const auto* node = root.get("zip")) {
      for (const toml::table* table : tables(*node, "zip")) found.emplace_back(table->source().begin, zip(*table));
    }
    std::ranges::sort(found, {}, [](const auto& one) { return std::pair(one.first.line, one.first.column); });
    std::vector<Zip> out;
    for (auto& [at, zip] : found) out.push_back(std::move(zip));
    if (out.empty()) {
      throw_input({.where = path_.string(),
                   .what = "the specification has no axis",
                   .expected = "[axes] or [[zip]] with at least one name",
                   .got = {},
                   .fix = "for example [axes] followed by snap.phases = [16, 32, 64]"});
    }
    return out;
  }

  /// `label` names the values for the reader; `axis` names its column.
  Zip zip(const toml::table& table) {
    const std::string label = text_of(table, "axis").value_or("label");
    if (const auto* axis = table.get("axis"); axis != nullptr && (table.contains(label) || names_.contains(label))) {
      refuse(*axis, fmt::format("axis = \"{}\" names the label column, but {} is also a setting", label, label),
             "a name different from all settings", "for example axis = \"view\"");
    }
    refuse_column(table.contains("axis") ? *table.get("axis") : static_cast<const toml::node&>(table), label);
    Zip out;
    for (const Entry& entry : entries(table, "zip")) {
      if (entry.name == "axis") continue;
      const bool is_label = entry.name == "label";
      out.push_back({.name = taken({is_label ? label : entry.name, entry.node}),
                     .values = list_of_zip(*entry.node, entry.name),
                     .is_label = is_label});
      if (out.front().values.size() != out.back().values.size()) {
        refuse(*entry.node, fmt::format("{} has {} values", entry.name, out.back().values.size()),
               fmt::format("{}, as many as {}", out.front().values.size(), out.front().name));
      }
    }
    if (out.empty()) refuse(table, "[[zip]] is empty", "names with lists of the same length");
    return out;
  }

  /// Values of a zip may repeat: only its rows matter.
  std::vector<Value> list_of_zip(const toml::node& node, const std::string& name) const {
    const auto* array = node.as_array();
    if (array == nullptr || array->empty()) return list(node, name);
    std::vector<Value> values;
    for (const auto& element : *array) values.push_back(value(element, name));
    return values;
  }

  /// Whether the program's metric has this name; `*` in its own stands for any text.
  static bool names(const Metric& metric, std::string_view name) {
    const auto star = metric.name.find('*');
    if (star == std::string::npos) return metric.name == name;
    const std::string_view own = metric.name, before = own.substr(0, star), after = own.substr(star + 1);
    return name.size() > before.size() + after.size() && name.starts_with(before) && name.ends_with(after);
  }

  /// Refuses a label or metric that would hide a column of the program's own.
  void refuse_column(const toml::node& node, const std::string& name) const {
    const bool known = std::ranges::any_of(known_metrics(), [&](const Metric& metric) { return names(metric, name); });
    if (!known && !is_fixed_column(name)) return;
    refuse(node, fmt::format("'{}' is the name of a built-in column", name), "another name",
           fmt::format("for example \"my_{}\"", name));
  }

  Metric metric(const toml::table& table) {
    for (const auto& [key, node] : table) {
      const std::vector<std::string> known{"name", "title", "unit", "better", "path"};
      if (std::ranges::find(known, key.str()) == known.end())
        refuse(node, fmt::format("unknown key '{}' of a metric", key.str()), "", suggestion(key.str(), known));
    }
    Metric out;
    const auto path = text_of(table, "path"), name = text_of(table, "name");
    if (!path || path->empty() || !name || name->empty())
      refuse(table, "a metric needs a name and a path", "name = \"entries\", path = \"errors ranges/needs/...\"");
    refuse_column(*table.get("name"), *name);
    out.name = taken({*name, table.get("name")});
    out.path = *path;
    out.title = text_of(table, "title").value_or(out.name);
    out.unit = text_of(table, "unit").value_or("");
    const auto better = text_of(table, "better").value_or("");
    if (better != "" && better != "less" && better != "more")
      refuse(*table.get("better"), fmt::format("invalid value '{}' of better", better), "\"less\" or \"more\"",
             suggestion(better, std::vector<std::string>{"less", "more"}));
    out.better = better == "less" ? Better::Less : better == "more" ? Better::More : Better::Neither;
    return out;
  }

  std::filesystem::path path_;
  std::set<std::string> names_;
};

}  // namespace

Spec read_spec(const std::filesystem::path& path) { return Reader(path).read(); }

}  // namespace fastsplat::plan
