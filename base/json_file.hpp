// SPDX-License-Identifier: Apache-2.0
// Reads every JSON file, and reports its errors, in one place.
#pragma once

#include <cstddef>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "base/error.hpp"
#include "base/nesting.hpp"
#include "base/read_file.hpp"

namespace fastsplat {

/// The expected content of a file, for error messages.
struct JsonKind {
  std::string what;      ///< "not a result"
  std::string expected;  ///< "a file written by fastsplat with --json"
  std::string fix;
  std::size_t most_bytes = std::size_t{1} << 28;
};

/// Parses `text` as JSON. Throws std::runtime_error if it nests too deeply for recursive functions, and the exceptions
/// of Json::parse().
template <class Json>
Json parse_json(const std::string& text) {
  if (const auto deep = json_too_deep(text)) {
    throw std::runtime_error("JSON nested more than " + std::to_string(kDeepestNesting) + " levels deep at byte " +
                             std::to_string(*deep));
  }
  return Json::parse(text);
}

/// Returns make(json), json being the content of `path` (a `Json`, some nlohmann::json). Throws UserError (Input) in
/// one line that names the file if it cannot be read, is too large, truncated or invalid JSON, or if `make` throws
/// anything.
template <class Json, class Make>
auto from_json_file(const std::filesystem::path& path, const JsonKind& kind, const Make& make) {
  const std::string text = read_text_file(path, kind.most_bytes);
  std::string got;
  try {
    return make(parse_json<Json>(text));
  } catch (const typename Json::parse_error& error) {
    // The parser's message is long and quotes the file; the place is enough.
    got = error.byte > text.size() ? "truncated JSON, " + std::to_string(text.size()) + " bytes"
                                   : "invalid JSON at byte " + std::to_string(error.byte);
  } catch (const std::exception& error) {
    got = error.what();
  }
  throw_input({.where = path.string(), .what = kind.what, .expected = kind.expected, .got = got, .fix = kind.fix});
}

}  // namespace fastsplat
