// SPDX-License-Identifier: Apache-2.0
#include "base/images/metadata_text.hpp"

#include <algorithm>
#include <cassert>

namespace fastsplat::images {
namespace {

bool is_key(std::string_view key) {
  constexpr std::size_t kLongest = 60;  // PNG allows 79 characters, prefix included
  return !key.empty() && key.size() <= kLongest && std::all_of(key.begin(), key.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  });
}

// One line per entry, so line breaks inside a value are written as \n and \r, and a backslash as two.
std::string escape(const std::string& value) {
  std::string out;
  for (const char c : value) {
    if (c == '\n') {
      out += "\\n";
    } else if (c == '\r') {
      out += "\\r";
    } else if (c == '\\') {
      out += "\\\\";
    } else {
      out += c;
    }
  }
  return out;
}

std::string unescape(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\\' || i + 1 == text.size()) {
      out += text[i];
      continue;
    }
    const char next = text[++i];
    out += next == 'n' ? '\n' : next == 'r' ? '\r' : next;
  }
  return out;
}

}  // namespace

std::optional<std::string> metadata_key(std::string_view name) {
  if (!name.starts_with(kEntryPrefix) || !is_key(name.substr(kEntryPrefix.size()))) return std::nullopt;
  return std::string(name.substr(kEntryPrefix.size()));
}

std::string metadata_lines(const Metadata& metadata) {
  std::string lines;
  for (const auto& [key, value] : metadata) {
    assert(is_key(key) && value.find('\0') == std::string::npos);
    lines += std::string(kEntryPrefix) + key + "=" + escape(value) + "\n";
  }
  return lines;
}

void read_metadata_lines(std::string_view description, Metadata& metadata) {
  while (!description.empty()) {
    const std::size_t end = std::min(description.find('\n'), description.size());
    const std::string_view line = description.substr(0, end);
    description.remove_prefix(std::min(end + 1, description.size()));
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos) continue;
    if (auto key = metadata_key(line.substr(0, equals))) metadata[*key] = unescape(line.substr(equals + 1));
  }
}

Metadata only_as_lines(const Metadata& metadata) {
  Metadata out;
  for (const auto& [key, value] : metadata)
    if (value.empty() || value.find('\r') != std::string::npos) out.emplace(key, value);
  return out;
}

}  // namespace fastsplat::images
