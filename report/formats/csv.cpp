// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "base/json_text.hpp"
#include "base/printable.hpp"
#include "report/file_names.hpp"
#include "report/formats/output_format.hpp"
#include "report/formats/output_formats.hpp"

namespace fastsplat::report {
namespace {

/// RFC 4180: quoted if it contains a delimiter or quote; quotes are doubled.
std::string field(const std::string& raw) {
  const std::string text = printable_lines(raw);
  if (text.find_first_of("\",\r\n") == text.npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

std::string text_of(const Json& value) {
  if (value.is_null()) return {};
  return value.is_string() ? value.get<std::string>() : json_text(value, -1);
}

std::string line(const std::vector<std::string>& fields) {
  std::string text;
  for (std::size_t at = 0; at < fields.size(); ++at) text += (at ? "," : "") + field(fields[at]);
  // Some readers ignore empty lines, so a single empty field is quoted.
  return (text.empty() ? "\"\"" : text) + "\r\n";
}

}  // namespace

std::string to_csv(const std::vector<Result>& with_folders) {
  const auto results = without_folders(with_folders);
  const bool several = results.size() > 1;
  std::vector<std::string> columns;
  if (several) columns = {"result", "verb"};
  const std::size_t own = columns.size();
  std::vector<Table> tables;
  for (const Result& result : results) {
    reading(result, [&] { tables.push_back(table_of(result)); });
    for (const auto& column : tables.back().columns) {
      const auto begin = columns.begin() + static_cast<std::ptrdiff_t>(own);
      if (std::find(begin, columns.end(), column) == columns.end()) columns.push_back(column);
    }
  }
  std::string text = line(columns);
  for (std::size_t r = 0; r < results.size(); ++r) {
    for (const auto& row : tables[r].rows) {
      std::vector<std::string> fields(columns.size());
      if (several) {
        fields[0] = name_of(results[r]);
        fields[1] = results[r].subcommand;
      }
      for (std::size_t c = 0; c < row.size(); ++c) {
        const auto begin = columns.begin() + static_cast<std::ptrdiff_t>(own);
        fields[static_cast<std::size_t>(std::find(begin, columns.end(), tables[r].columns[c]) - columns.begin())] =
            text_of(row[c]);
      }
      text += line(fields);
    }
  }
  return text;
}

}  // namespace fastsplat::report
