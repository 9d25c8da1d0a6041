// SPDX-License-Identifier: Apache-2.0
#include "analysis/sweep/merged.hpp"

#include <algorithm>

#include "base/json_file.hpp"
#include "base/version.hpp"

namespace fastsplat::plan {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kSubcommand = "plan";
constexpr std::size_t kMostMergedBytes = std::size_t{1} << 30;

Json to_json(const Metric& metric) {
  Json json{{"name", metric.name}, {"title", metric.title}, {"unit", metric.unit}};
  json["better"] = metric.better == Better::Neither ? Json(nullptr) : Json(to_string(metric.better));
  return json;
}

Json to_json(const Row& row) {
  Json json{{"id", row.id}, {"kind", row.kind}, {"status", to_string(row.status)}};
  if (!row.message.empty()) json["message"] = row.message;
  json["axes"] = Json::object();
  for (const auto& [name, value] : row.axes) json["axes"][name] = plan::to_json(value);
  json["metrics"] = Json::object();
  for (const auto& [name, value] : row.metrics) {
    // Counts are written as integers.
    const auto whole = static_cast<std::int64_t>(value);
    json["metrics"][name] = static_cast<double>(whole) == value ? Json(whole) : Json(value);
  }
  json["config_hash"] = row.content.config_hash;
  json["scene_hash"] = row.content.scene_hash;
  json["program_hash"] = row.program;
  json["command"] = row.command;
  return json;
}

Row row_from(const Json& json) {
  Row row{.id = json.at("id"),
          .kind = json.at("kind"),
          .status = status_from(json.at("status")),
          .message = json.value("message", ""),
          .axes = {},
          .metrics = {},
          .content = {.config_hash = json.at("config_hash"), .scene_hash = json.at("scene_hash")},
          .program = json.at("program_hash"),
          .command = json.at("command")};
  for (const auto& [name, value] : json.at("axes").items()) row.axes.push_back({name, value_from(value)});
  for (const auto& [name, value] : json.at("metrics").items()) row.metrics.emplace_back(name, value.get<double>());
  return row;
}

Merged merged_from(const Json& json) {
  if (json.at("verb") != kSubcommand) throw std::runtime_error("written by another subcommand");
  Merged merged{.name = json.at("name"),
                .title = json.at("title"),
                .hash = json.at("hash"),
                .program = json.at("program"),
                .axes = {},
                .metrics = {},
                .rows = {},
                .missing = json.value("missing", std::vector<std::string>{}),
                .coverage = {}};
  for (const Json& axis : json.at("axes")) {
    merged.axes.push_back({.name = axis.at("name"), .values = {}});
    for (const Json& value : axis.at("values")) merged.axes.back().values.push_back(value_from(value));
  }
  for (const Json& metric : json.at("metrics")) {
    const std::string better = metric.at("better").is_null() ? "" : metric.at("better").get<std::string>();
    merged.metrics.push_back({.name = metric.at("name"),
                              .title = metric.at("title"),
                              .unit = metric.at("unit"),
                              .better = better == "less"   ? Better::Less
                                        : better == "more" ? Better::More
                                                           : Better::Neither,
                              .path = {}});
  }
  for (const Json& row : json.at("rows")) merged.rows.push_back(row_from(row));
  if (json.contains("coverage")) merged.coverage = json["coverage"].at("books").get<std::vector<Json>>();
  return merged;
}

}  // namespace

std::optional<double> Row::metric(const std::string& name) const {
  const auto found = std::ranges::find(metrics, name, &std::pair<std::string, double>::first);
  return found == metrics.end() ? std::nullopt : std::optional(found->second);
}

Json to_json(const Merged& merged) {
  Json json{{"verb", kSubcommand},   {"version", program_version()}, {"name", merged.name},
            {"title", merged.title}, {"hash", merged.hash},          {"program", merged.program}};
  json["axes"] = Json::array();
  for (const Axis& axis : merged.axes) {
    Json values = Json::array();
    for (const Value& value : axis.values) values.push_back(plan::to_json(value));
    json["axes"].push_back({{"name", axis.name}, {"values", std::move(values)}});
  }
  json["metrics"] = Json::array();
  for (const Metric& metric : merged.metrics) json["metrics"].push_back(to_json(metric));
  json["rows"] = Json::array();
  for (const Row& row : merged.rows) json["rows"].push_back(to_json(row));
  if (!merged.missing.empty()) json["missing"] = merged.missing;
  if (!merged.coverage.empty()) json["coverage"] = {{"books", merged.coverage}};
  return json;
}

Merged read_merged(const std::filesystem::path& path) {
  return from_json_file<Json>(path,
                              {.what = "not a file of merged results",
                               .expected = "a file written by `fastsplat plan merge`",
                               .fix = {},
                               .most_bytes = kMostMergedBytes},
                              merged_from);
}

}  // namespace fastsplat::plan
