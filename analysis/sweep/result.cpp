// SPDX-License-Identifier: Apache-2.0
#include "analysis/sweep/result.hpp"

#include <fmt/format.h>

#include "base/fnv1a.hpp"
#include "base/hash_text.hpp"
#include "base/json_file.hpp"
#include "base/json_text.hpp"

namespace fastsplat::plan {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kResultFormat = "fastsplat plan result 1";

Json to_json(const CaseResult& result) {
  Json json{{"format", kResultFormat},
            {"id", result.id},
            {"kind", result.kind},
            {"status", to_string(result.status)},
            {"exit_code", result.exit_code}};
  if (!result.message.empty()) json["message"] = result.message;
  json["program"] = result.program;
  json["config_hash"] = result.content.config_hash;
  json["scene_hash"] = result.content.scene_hash;
  json["results"] = result.results;
  if (!result.coverage.is_null()) json["coverage"] = result.coverage;
  return json;
}

std::string checksum(const Json& json) { return hash_text(fnv1a(kFnv1aStart, json_text(json, -1))); }

CaseResult result_from(Json json) {
  if (json.at("format") != kResultFormat) throw std::runtime_error("unknown format");
  const std::string written = json.at("checksum");
  json.erase("checksum");
  if (written != checksum(json)) throw std::runtime_error("wrong checksum");
  return {.id = json.at("id"),
          .kind = json.at("kind"),
          .status = status_from(json.at("status")),
          .exit_code = json.at("exit_code"),
          .message = json.value("message", ""),
          .program = json.at("program"),
          .content = {.config_hash = json.at("config_hash"), .scene_hash = json.at("scene_hash")},
          .results = json.at("results"),
          .coverage = json.value("coverage", Json())};
}

bool is_time(const std::string& key) { return key == "seconds" || key.ends_with("_seconds") || key == "vectors"; }

}  // namespace

Status status_from(const std::string& text) {
  for (const Status status : {Status::Pass, Status::Fail, Status::Error}) {
    if (text == to_string(status)) return status;
  }
  throw std::runtime_error("status '" + text + "'");
}

const char* to_string(Status status) {
  switch (status) {
    case Status::Pass:
      return "pass";
    case Status::Fail:
      return "fail";
    case Status::Error:
      break;
  }
  return "error";
}

std::filesystem::path result_path(const std::filesystem::path& folder, const std::string& id) {
  return folder / (id + ".json");
}

std::string to_text(const CaseResult& result) {
  Json json = to_json(result);
  json["checksum"] = checksum(json);
  return json_text(json, 1) + "\n";
}

CaseResult read_result(const std::filesystem::path& path) {
  return from_json_file<Json>(path,
                              {.what = "not a complete result of a case",
                               .expected = "a file written by `fastsplat plan run`",
                               .fix = "run the plan again, which repeats this case"},
                              result_from);
}

std::string foreign(const CaseResult& result, const Case& one, const std::string& program) {
  if (result.id != one.id) return "belongs to case " + result.id;
  if (result.kind != one.kind) return "belongs to kind " + result.kind;
  if (!(result.content == one.content)) return "belongs to another configuration or scene with these names";
  if (result.program != program) return "was made by another program, " + result.program;
  return {};
}

std::string forget_surroundings(std::string text, const std::vector<std::string>& folders) {
  for (const auto& folder : folders) {
    for (auto at = text.find(folder + "/"); at != std::string::npos; at = text.find(folder + "/"))
      text.erase(at, folder.size() + 1);
  }
  return text;
}

void forget_surroundings(Json& json, const std::vector<std::string>& folders) {
  if (json.is_string()) {
    json = forget_surroundings(json.get<std::string>(), folders);
  } else if (json.is_array()) {
    for (Json& element : json) forget_surroundings(element, folders);
  } else if (json.is_object()) {
    for (auto at = json.begin(); at != json.end();) {
      if (is_time(at.key())) {
        at = json.erase(at);
      } else {
        forget_surroundings(at.value(), folders);
        ++at;
      }
    }
  }
}

}  // namespace fastsplat::plan
