// JSON as text, in the one place that every file and every --json goes through.
#pragma once

#include <string>

namespace fastsplat {

/// `json` (an nlohmann::json) as lines indented by `indent`; -1: one line. Names of files and what pictures carry may
/// hold any bytes: those that are no UTF-8 become U+FFFD, for JSON has no other way to write them, and a result that
/// is there is never lost for its name.
template <class Json>
std::string json_text(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace fastsplat
