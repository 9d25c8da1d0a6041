// SPDX-License-Identifier: Apache-2.0
#include "scene/volume/nrrd_header.hpp"

#include <fmt/format.h>
#include <teem/nrrd.h>

#include <algorithm>
#include <array>

#include "base/suggest.hpp"
#include "scene/volume/detached_files.hpp"

namespace fastsplat::volume {
namespace {

constexpr std::array<int, 3> kNotFields{nrrdField_unknown, nrrdField_comment, nrrdField_keyvalue};

bool is_field(int field) { return std::find(kNotFields.begin(), kNotFields.end(), field) == kNotFields.end(); }

std::string suggested_field(const std::string& got) {
  std::vector<std::string> names;
  for (int field = nrrdField_unknown; field < nrrdField_last; ++field) {
    if (is_field(field)) names.emplace_back(airEnumStr(nrrdField, field));
  }
  return suggestion(got, names) + " (a key of your own is written 'key:=value')";
}

/// Adds "field: value" to the header. Ignores "key:=value" (the key may hold colons): it does not describe the data.
void take_line(TextHeader& header, int line, const std::string& text) {
  const auto colon = text.find(':');
  const bool binary = is_binary(text);
  if (colon == std::string::npos || binary) {
    header.refuse(line, "invalid line in an NRRD header", "'field: value', 'key:=value' or a comment",
                  binary ? "binary data" : text.substr(0, 40), "the header is damaged: copy the file again");
  }
  const std::string name = text.substr(0, colon);
  const int field = airEnumVal(nrrdField, name.c_str());
  const bool is_key = text.compare(colon, 2, ":=") == 0;
  if (is_field(field) && !is_key) {
    header.add(airEnumStr(nrrdField, field), trimmed(text.substr(colon + 1)), line);
  } else if (!is_key && text.find(":=") == std::string::npos) {
    const std::string shown = name.substr(0, 40);
    header.refuse(line, fmt::format("unknown field '{}'", shown), {}, {}, suggested_field(shown));
  }
}

}  // namespace

TextHeader read_nrrd_lines(const std::filesystem::path& path) {
  TextHeader header{.path = path, .format = "NRRD"};
  HeaderLines lines(path);
  std::string text;
  lines.next(text);
  static const std::vector<std::string> kVersions{"NRRD00.01", "NRRD0001", "NRRD0002",
                                                  "NRRD0003",  "NRRD0004", "NRRD0005"};
  if (std::find(kVersions.begin(), kVersions.end(), trimmed(text)) == kVersions.end()) {
    header.refuse(1, "unsupported NRRD version", "NRRD0001 to NRRD0005", text.substr(0, 20),
                  "convert the file with the program that wrote it, or copy it again");
  }
  bool listing = false;  // names of data files are the last lines
  while (!header.ended && lines.next(text)) {
    if (text.empty()) {
      header.ended = true;
    } else if (listing) {
      header.listed_files.push_back(trimmed(text));
    } else if (text[0] != '#') {
      take_line(header, lines.number(), text);
      const auto* const data = header.find({"data file"});
      listing = data != nullptr && says_list(data->value);
    }
  }
  header.end = lines.end();
  if (!header.ended && lines.cut())
    header.refuse(0, "the NRRD header does not end", "a blank line within the first MiB", {}, "copy the file again");
  return header;
}

}  // namespace fastsplat::volume
