// A file that holds JSON, read and refused in the one place where every such file is.
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

/// What a file ought to be, for the line that refuses it.
struct JsonKind {
  std::string what;      ///< "is no plan"
  std::string expected;  ///< "what `fastsplat plan make` writes"
  std::string fix;
  std::size_t most_bytes = std::size_t{1} << 28;
};

/// `text` as JSON. Throws std::runtime_error when it nests too deeply for what recurses over it, and as Json::parse()
/// does.
template <class Json>
Json parse_json(const std::string& text) {
  if (const auto deep = json_too_deep(text)) {
    throw std::runtime_error("JSON nested more than " + std::to_string(kDeepestNesting) + " levels deep at byte " +
                             std::to_string(*deep));
  }
  return Json::parse(text);
}

/// What `make` makes of the JSON in `path` (a `Json`, some nlohmann::json). UserError (Input) in one line that names
/// the file: it cannot be read, is too large, is cut off or no JSON, or `make` threw, whatever that was.
template <class Json, class Make>
auto from_json_file(const std::filesystem::path& path, const JsonKind& kind, const Make& make) {
  const std::string text = read_text_file(path, kind.most_bytes);
  std::string got;
  try {
    return make(parse_json<Json>(text));
  } catch (const typename Json::parse_error& error) {
    // Its message quotes the file and is long; the place is what helps.
    got = error.byte > text.size() ? "truncated JSON, " + std::to_string(text.size()) + " bytes"
                                   : "invalid JSON at byte " + std::to_string(error.byte);
  } catch (const std::exception& error) {
    got = error.what();
  }
  throw_input({.where = path.string(), .what = kind.what, .expected = kind.expected, .got = got, .fix = kind.fix});
}

}  // namespace fastsplat
