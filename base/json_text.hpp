// JSON as text, in the one place that every file and every --json goes through.
#pragma once

#include <string>

namespace fastsplat {

/// The same JSON with U+007F to U+009F, which terminals obey, as "\\u009b".
std::string without_controls(std::string json);

/// `json` (an nlohmann::json) as lines indented by `indent`; -1: one line. Names of files and what pictures carry may
/// hold any bytes: those that are no UTF-8 become U+FFFD, for JSON has no other way to write them, and a result that
/// is there is never lost for its name.
template <class Json>
std::string json_text(const Json& json, int indent) {
  return without_controls(json.dump(indent, ' ', false, Json::error_handler_t::replace));
}

}  // namespace fastsplat
