// SPDX-License-Identifier: Apache-2.0
#include "base/nesting.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace fastsplat {
namespace {

/// The offset after the string that begins at `at`. An unclosed one-line string ends with its line.
std::size_t behind_toml_string(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const std::string_view three = quote == '"' ? R"(""")" : "'''";
  const bool tripled = text.substr(at).starts_with(three);
  for (at += tripled ? 3 : 1; at < text.size(); ++at) {
    if (quote == '"' && text[at] == '\\') {
      ++at;
    } else if (tripled && text.substr(at).starts_with(three)) {
      // One or two quotes before the closing three belong to the string.
      return std::min(text.find_first_not_of(quote, at), text.size());
    } else if (!tripled && text[at] == quote) {
      return at + 1;
    } else if (!tripled && text[at] == '\n') {
      return at;
    }
  }
  return text.size();
}

/// An array, an inline table or the file itself, open at a place in TOML.
struct TomlLevel {
  bool braces;              ///< an inline table, or the file itself: it has keys
  std::size_t dots = 0;     ///< dots in the key before the value
  bool in_value = !braces;  ///< dots belong to numbers and dates
};

}  // namespace

std::optional<std::size_t> json_too_deep(std::string_view json) {
  std::size_t depth = 0;
  for (std::size_t at = 0; at < json.size(); ++at) {
    const char c = json[at];
    if (c == '"') {
      for (++at; at < json.size() && json[at] != '"'; ++at) at += json[at] == '\\' ? 1 : 0;
    } else if (c == '[' || c == '{') {
      if (++depth > kDeepestNesting) return at;
    } else if (c == ']' || c == '}') {
      depth -= std::min<std::size_t>(depth, 1);
    }
  }
  return {};
}

std::optional<std::size_t> toml_too_deep(std::string_view toml) {
  std::vector<TomlLevel> open{{.braces = true}};
  std::size_t header = 0;  // parts of the [header] above
  bool in_header = false;  // inside the line of a header
  std::size_t dots = 0;    // in all open keys
  const auto forget_key = [&] { dots -= std::exchange(open.back().dots, 0); };
  for (std::size_t at = 0; at < toml.size();) {
    const char c = toml[at];
    if (c == '"' || c == '\'') {
      at = behind_toml_string(toml, at);
      continue;
    }
    if (c == '#') {
      at = std::min(toml.find('\n', at), toml.size());
      continue;
    }
    if (c == '\n' && open.size() == 1) {
      forget_key();
      open.back().in_value = in_header = false;
    } else if (in_header) {
      header += c == '.' ? 1 : 0;
    } else if (c == '[' && open.size() == 1 && !open.back().in_value) {
      in_header = true;
      header = 1;
    } else if (c == '.' && !open.back().in_value) {
      ++open.back().dots;
      ++dots;
    } else if (c == '=') {
      open.back().in_value = true;
    } else if (c == ',' && open.back().braces && open.size() > 1) {
      forget_key();
      open.back().in_value = false;
    } else if (c == '[' || c == '{') {
      open.push_back({.braces = c == '{'});
    } else if ((c == ']' || c == '}') && open.size() > 1) {
      forget_key();
      open.pop_back();
    }
    if (header + dots + open.size() > kDeepestNesting) return at;
    ++at;
  }
  return {};
}

}  // namespace fastsplat
