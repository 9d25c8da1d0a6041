// SPDX-License-Identifier: Apache-2.0
// Formats the JSON of every file and every --json.
#pragma once

#include <string>

namespace fastsplat {

/// The same JSON with the terminal control characters U+007F to U+009F as "\\u009b".
std::string without_controls(std::string json);

/// `json` (an nlohmann::json) as lines indented by `indent`; -1: one line. File names and picture metadata may contain
/// any bytes. Invalid UTF-8 becomes U+FFFD, because JSON cannot represent it and a name must not lose a result.
template <class Json>
std::string json_text(const Json& json, int indent) {
  return without_controls(json.dump(indent, ' ', false, Json::error_handler_t::replace));
}

}  // namespace fastsplat
