// SPDX-License-Identifier: Apache-2.0
#include "scene/toml_reader.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include "base/error.hpp"
#include "base/read_file.hpp"
#include "base/suggest.hpp"
#include "base/toml/toml_text.hpp"

namespace fastsplat::scene {
namespace {

const toml::table& as_table(const void* table) { return *static_cast<const toml::table*>(table); }
const toml::node& as_node(const void* node) { return *static_cast<const toml::node*>(node); }

/// The value as the user wrote it, shortened.
std::string shown(const toml::node& node) {
  if (node.is_table()) return "a table";
  if (node.is_array()) return fmt::format("an array of {}", node.as_array()->size());
  if (const auto integer = node.value_exact<std::int64_t>()) return fmt::format("{}", *integer);
  if (const auto number = node.value_exact<double>()) return fmt::format("{}", *number);
  if (const auto flag = node.value_exact<bool>()) return *flag ? "true" : "false";
  const auto text = node.value_exact<std::string>();
  if (!text) return "a date or time";
  return text->size() > 60 ? fmt::format("\"{}...\"", text->substr(0, 57)) : fmt::format("\"{}\"", *text);
}

}  // namespace

struct TomlTable::Document {
  std::string source;
  toml::table root;
};

TomlTable::TomlTable(std::shared_ptr<const Document> document, const void* table, std::string path)
    : document_(std::move(document)), table_(table), path_(std::move(path)) {}

TomlTable TomlTable::parse(const std::string& text, const std::string& source, TomlKind kind) {
  auto document = std::make_shared<Document>();
  document->source = source;
  document->root = parse_toml(text, source, kind);
  const void* root = &document->root;
  return TomlTable(std::move(document), root, {});
}

TomlTable TomlTable::parse_file(const std::filesystem::path& path, TomlKind kind) {
  return parse(read_text_file(path), path.string(), kind);
}

const void* TomlTable::find(const std::string& key) {
  known_.insert(key);
  return as_table(table_).get(key);
}

bool TomlTable::has(const std::string& key) const { return as_table(table_).contains(key); }

std::optional<double> TomlTable::number(const std::string& key, double low, double high) {
  const void* found = find(key);
  if (found == nullptr) return std::nullopt;
  const auto& node = as_node(found);
  const auto value = node.is_number() ? node.value<double>() : std::nullopt;
  if (!value || !(*value >= low && *value <= high)) {
    refuse(key, value ? "value out of range" : "wrong type", fmt::format("a number in {}..{}", low, high), shown(node),
           "change it");
  }
  return value;
}

std::optional<int> TomlTable::integer(const std::string& key, int low, int high) {
  const void* found = find(key);
  if (found == nullptr) return std::nullopt;
  const auto& node = as_node(found);
  const auto value = node.value_exact<std::int64_t>();
  if (!value || *value < low || *value > high) {
    refuse(key, value ? "value out of range" : "wrong type", fmt::format("a whole number in {}..{}", low, high),
           shown(node), "change it");
  }
  return static_cast<int>(*value);
}

std::optional<bool> TomlTable::flag(const std::string& key) {
  const void* found = find(key);
  if (found == nullptr) return std::nullopt;
  const auto value = as_node(found).value_exact<bool>();
  if (!value) refuse(key, "wrong type", "true or false", shown(as_node(found)), "write it without quotes");
  return value;
}

std::optional<std::string> TomlTable::text(const std::string& key) {
  const void* found = find(key);
  if (found == nullptr) return std::nullopt;
  const auto value = as_node(found).value_exact<std::string>();
  if (!value) refuse(key, "wrong type", "text in quotes", shown(as_node(found)), "put it in quotes");
  return value;
}

std::optional<std::vector<double>> TomlTable::numbers(const std::string& key, std::size_t least, double low,
                                                      double high) {
  const void* found = find(key);
  if (found == nullptr) return std::nullopt;
  const auto* list = as_node(found).as_array();
  if (list == nullptr || list->size() < least) {
    refuse(key, "wrong type", fmt::format("an array of {} or more numbers", least), shown(as_node(found)),
           "write for example [0, 90]");
  }
  std::vector<double> values;
  for (const toml::node& node : *list) {
    const auto value = node.is_number() ? node.value<double>() : std::nullopt;
    if (!value || !(*value >= low && *value <= high)) {
      refuse(key, value ? "value out of range" : "wrong type", fmt::format("numbers in {}..{}", low, high), shown(node),
             "change it");
    }
    values.push_back(*value);
  }
  return values;
}

std::optional<std::array<double, 3>> TomlTable::triple(const std::string& key, double low, double high) {
  if (const void* found = find(key)) {
    const auto* list = as_node(found).as_array();
    if (list == nullptr || list->size() != 3) {
      refuse(key, "wrong type", fmt::format("three numbers in {}..{}", low, high), shown(as_node(found)),
             "write for example [1, 0.5, 0]");
    }
  }
  const auto values = numbers(key, 3, low, high);
  if (!values) return std::nullopt;
  return std::array<double, 3>{(*values)[0], (*values)[1], (*values)[2]};
}

std::optional<TomlTable> TomlTable::table(const std::string& key) {
  const void* found = find(key);
  if (found == nullptr) return std::nullopt;
  const auto* table = as_node(found).as_table();
  if (table == nullptr)
    refuse(key, "wrong type", "a table", shown(as_node(found)), fmt::format("write [{}] on a line of its own", key));
  return TomlTable(document_, table, path_.empty() ? key : path_ + "." + key);
}

std::vector<TomlTable> TomlTable::tables(const std::string& key) {
  const void* found = find(key);
  if (found == nullptr) return {};
  const auto* list = as_node(found).as_array();
  if (list == nullptr)
    refuse(key, "wrong type", "an array of tables", shown(as_node(found)), fmt::format("write [[{}]] for each", key));
  std::vector<TomlTable> result;
  for (const auto& element : *list) {
    if (!element.is_table())
      refuse(key, "wrong type", "an array of tables", shown(element), fmt::format("write [[{}]] for each", key));
    const std::string name = fmt::format("{}[{}]", path_.empty() ? key : path_ + "." + key, result.size());
    result.push_back(TomlTable(document_, element.as_table(), name));
  }
  return result;
}

std::string TomlTable::where(const std::string& key) const {
  const auto& table = as_table(table_);
  const toml::node* node = table.get(key);
  const auto at = node != nullptr ? node->source().begin : table.source().begin;
  return at.line == 0 ? document_->source : place_in(document_->source, at);
}

void TomlTable::refuse(const std::string& key, const std::string& what, const std::string& expected,
                       const std::string& got, const std::string& fix) const {
  const std::string name = path_.empty() ? key : key.empty() ? path_ : path_ + "." + key;
  throw_input({.where = where(key),
               .what = name.empty() ? what : name + ": " + what,
               .expected = expected,
               .got = got,
               .fix = fix});
}

void TomlTable::finish() const {
  const std::vector<std::string> known(known_.begin(), known_.end());
  for (const auto& [key, node] : as_table(table_)) {
    const std::string name(key.str());
    if (known_.contains(name)) continue;
    throw_input({.where = place_in(document_->source, key.source().begin),
                 .what = fmt::format("unknown key '{}'{}", name, path_.empty() ? "" : " in [" + path_ + "]"),
                 .expected = {},
                 .got = {},
                 .fix = suggestion(name, known)});
  }
}

}  // namespace fastsplat::scene
