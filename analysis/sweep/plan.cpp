// SPDX-License-Identifier: Apache-2.0
#include "analysis/sweep/plan.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <set>

#include "base/error.hpp"
#include "base/fnv1a.hpp"
#include "base/hash_text.hpp"
#include "base/json_file.hpp"
#include "base/json_text.hpp"
#include "base/number_text.hpp"
#include "base/version.hpp"

namespace fastsplat::plan {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kMakeSubcommand = "plan make";
constexpr std::size_t kMostPlanBytes = std::size_t{1} << 30;

Json to_json(const Settings& settings) {
  Json json = Json::object();
  for (const auto& [name, value] : settings) json[name] = plan::to_json(value);
  return json;
}

Settings settings_from(const Json& json) {
  Settings out;
  for (const auto& [name, value] : json.items()) out.push_back({name, value_from(value)});
  return out;
}

Json to_json(const Axis& axis) {
  Json values = Json::array();
  for (const Value& value : axis.values) values.push_back(plan::to_json(value));
  return {{"name", axis.name}, {"values", std::move(values)}};
}

Json to_json(const Step& step) {
  Json json{{"argv", step.words}};
  if (!step.result.empty()) json["result"] = step.result;
  if (!step.shared.empty()) json["shared"] = step.shared;
  if (step.coverage) json["coverage"] = true;
  return json;
}

Step step_from(const Json& json) {
  return {.words = json.at("argv").get<Words>(),
          .result = json.value("result", ""),
          .shared = json.value("shared", ""),
          .coverage = json.value("coverage", false)};
}

Json to_json(const Case& one) {
  Json json{{"id", one.id}, {"kind", one.kind}, {"axes", to_json(one.axes)}, {"settings", to_json(one.settings)}};
  json["config_hash"] = one.content.config_hash;
  json["scene_hash"] = one.content.scene_hash;
  json["steps"] = Json::array();
  for (const Step& step : one.steps) json["steps"].push_back(to_json(step));
  return json;
}

/// Refuses files outside the case's folder.
void require_own_file(const Case& one, const std::string& name) {
  if (name.find('/') == std::string::npos && name != "." && name != ".." && !name.empty()) return;
  throw std::runtime_error(fmt::format("case {}: the file '{}' is outside its folder", one.id, name));
}

Case case_from(const Json& json) {
  Case one{.id = json.at("id"),
           .axes = settings_from(json.at("axes")),
           .kind = json.at("kind"),
           .settings = settings_from(json.at("settings")),
           .content = {.config_hash = json.at("config_hash"), .scene_hash = json.at("scene_hash")},
           .steps = {}};
  for (const Json& step : json.at("steps")) {
    one.steps.push_back(step_from(step));
    for (const auto& word : one.steps.back().words) require_own_file(one, file_of(word).value_or("file"));
    if (!one.steps.back().shared.empty()) require_own_file(one, one.steps.back().shared);
  }
  return one;
}

Json with_path(const Metric& metric) {
  return {{"name", metric.name},
          {"title", metric.title},
          {"unit", metric.unit},
          {"better", to_string(metric.better)},
          {"path", metric.path}};
}

Metric metric_from(const Json& json) {
  const std::string better = json.at("better");
  return {.name = json.at("name"),
          .title = json.at("title"),
          .unit = json.at("unit"),
          .better = better == "less"   ? Better::Less
                    : better == "more" ? Better::More
                                       : Better::Neither,
          .path = json.at("path")};
}

/// Hash of everything but the hash itself and the version, which changes nothing.
std::string hash_of(const Json& json) {
  Json rest = json;
  rest.erase("hash");
  rest.erase("version");
  return hash_text(fnv1a(kFnv1aStart, json_text(rest, -1)));
}

Plan plan_from(const Json& json) {
  if (json.at("verb") != kMakeSubcommand) throw std::runtime_error("written by another subcommand");
  Plan plan{.name = json.at("name"),
            .title = json.at("title"),
            .hash = json.at("hash"),
            .axes = {},
            .metrics = {},
            .cases = {}};
  for (const Json& axis : json.at("axes")) {
    plan.axes.push_back({.name = axis.at("name"), .values = {}});
    for (const Json& value : axis.at("values")) plan.axes.back().values.push_back(value_from(value));
  }
  for (const Json& metric : json.at("metrics")) plan.metrics.push_back(metric_from(metric));
  std::set<std::string> ids;
  for (const Json& one : json.at("cases")) {
    plan.cases.push_back(case_from(one));
    const auto& id = plan.cases.back().id;
    if (id != id_of(plan.cases.back())) throw std::runtime_error("case " + id + " was changed");
    if (!ids.insert(id).second) throw std::runtime_error("case " + id + " occurs twice");
  }
  if (plan.cases.empty()) throw std::runtime_error("no cases");
  if (plan.hash != hash_of(json)) throw std::runtime_error("the plan was changed: wrong hash");
  return plan;
}

}  // namespace

std::optional<std::string> file_of(const std::string& word) {
  if (word.size() < 3 || word.front() != '{' || word.back() != '}') return std::nullopt;
  return word.substr(1, word.size() - 2);
}

std::string command_of(const Case& one) {
  std::string text;
  for (const Step& step : one.steps) {
    Words words{"fastsplat"};
    for (const auto& word : step.words) words.push_back(file_of(word).value_or(word));
    text += (text.empty() ? "" : " && ") + shell_line(words);
  }
  return text;
}

std::string id_of(const Case& one) {
  // Without its place: the same command with the same content is the same case in any plan.
  Json json{{"case", 1},
            {"kind", one.kind},
            {"config", one.content.config_hash},
            {"scene", one.content.scene_hash},
            {"steps", Json::array()}};
  for (const Step& step : one.steps) json["steps"].push_back(to_json(step));
  return hash_text(fnv1a(kFnv1aStart, json_text(json, -1)));
}

Json to_json(const Plan& plan) {
  Json json{{"verb", kMakeSubcommand},
            {"version", program_version()},
            {"name", plan.name},
            {"title", plan.title},
            {"hash", ""}};
  json["axes"] = Json::array();
  for (const Axis& axis : plan.axes) json["axes"].push_back(to_json(axis));
  json["metrics"] = Json::array();
  for (const Metric& metric : plan.metrics) json["metrics"].push_back(with_path(metric));
  json["cases"] = Json::array();
  for (const Case& one : plan.cases) json["cases"].push_back(to_json(one));
  json["hash"] = hash_of(json);
  return json;
}

Plan read_plan(const std::filesystem::path& path) {
  return from_json_file<Json>(path,
                              {.what = "not a plan",
                               .expected = "a file written by `fastsplat plan make`",
                               .fix = path.extension() == ".toml" ? "make a plan of it with 'fastsplat plan make'"
                                                                  : "make the plan again from its specification",
                               .most_bytes = kMostPlanBytes},
                              plan_from);
}

Shard shard_from(const std::string& text) {
  const auto slash = text.find('/');
  const auto index = integer_from<std::size_t>(std::string_view(text).substr(0, slash));
  const auto of =
      slash == std::string::npos ? std::nullopt : integer_from<std::size_t>(std::string_view(text).substr(slash + 1));
  if (!index || !of || *index < 1 || *index > *of) {
    throw_usage({.where = "--shard",
                 .what = "invalid shard",
                 .expected = "I/N, I from 1 to N",
                 .got = "'" + text + "'",
                 .fix = "for example --shard 2/5"});
  }
  return {*index, *of};
}

}  // namespace fastsplat::plan
