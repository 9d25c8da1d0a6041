// SPDX-License-Identifier: Apache-2.0
#include "base/images/openimageio/attributes.hpp"

#include <algorithm>
#include <cassert>
#include <string_view>

namespace fastsplat::images {
namespace {

constexpr std::string_view kPrefix = "fastsplat:";
constexpr const char* kDescription = "ImageDescription";

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

void read_lines(std::string_view description, Metadata& metadata) {
  while (!description.empty()) {
    const std::size_t end = std::min(description.find('\n'), description.size());
    std::string_view line = description.substr(0, end);
    description.remove_prefix(std::min(end + 1, description.size()));
    if (!line.starts_with(kPrefix)) continue;
    line.remove_prefix(kPrefix.size());
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos || !is_key(line.substr(0, equals))) continue;
    metadata[std::string(line.substr(0, equals))] = unescape(line.substr(equals + 1));
  }
}

}  // namespace

void set_metadata(OIIO::ImageSpec& spec, const std::string& format_name, const Metadata& metadata) {
  std::string lines;
  for (const auto& [key, value] : metadata) {
    assert(is_key(key) && value.find('\0') == std::string::npos);
    const std::string name = std::string(kPrefix) + key;
    // PNG ends a line with LF alone and readers may rewrite CR; the escaped line keeps it.
    const bool as_line = format_name == "tiff" || value.empty() || value.find('\r') != std::string::npos;
    if (as_line) {
      lines += name + "=" + escape(value) + "\n";
    } else {
      spec.attribute(name, value);
    }
  }
  if (!lines.empty()) spec.attribute(kDescription, lines);
}

Metadata get_metadata(const OIIO::ImageSpec& spec) {
  Metadata metadata;
  read_lines(std::string(spec.get_string_attribute(kDescription)), metadata);
  for (const auto& attribute : spec.extra_attribs) {
    const std::string_view name(attribute.name().data(), attribute.name().size());
    if (!name.starts_with(kPrefix) || !is_key(name.substr(kPrefix.size()))) continue;
    metadata[std::string(name.substr(kPrefix.size()))] = attribute.get_string();
  }
  return metadata;
}

}  // namespace fastsplat::images
