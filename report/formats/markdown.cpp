// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "base/json_text.hpp"
#include "base/printable.hpp"
#include "report/file_names.hpp"
#include "report/formats/output_format.hpp"
#include "report/formats/output_formats.hpp"

namespace fastsplat::report {
namespace {

/// Limits for a review; the CSV has everything.
constexpr std::size_t kMostRows = 50, kMostColumns = 12, kMostText = 100;

/// Escaped for a cell: no bars, line ends, or marks of Markdown or HTML.
std::string cell(const std::string& text) {
  std::string out;
  for (const char c : printable_lines(text)) {
    if (c == '\n' || c == '\r') {
      out += "<br>";
    } else if (c == '<') {
      out += "&lt;";
    } else {
      if (c == '|' || c == '*' || c == '_' || c == '`' || c == '[' || c == '\\') out += '\\';
      out += c;
    }
  }
  return out;
}

/// A code span of text that may contain backquotes. Not for table cells, which a bar would end.
std::string code(const std::string& text) {
  std::string marks = "`";
  while (text.find(marks) != text.npos) marks += "`";
  const std::string one = printable(text);
  return marks + (marks.size() > 1 ? " " + one + " " : one) + marks;
}

std::string shown(const Json& value) {
  if (value.is_null()) return "";
  if (value.is_number_float()) return fmt::format("{:.5g}", value.get<double>());
  const std::string text = value.is_string() ? value.get<std::string>() : json_text(value, -1);
  if (text.size() <= kMostText) return cell(text);
  std::size_t end = kMostText;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;  // not within a UTF-8 character
  return cell(text.substr(0, end)) + "...";
}

std::string row_text(const std::vector<std::string>& cells) { return fmt::format("| {} |\n", fmt::join(cells, " | ")); }

/// Columns that are not empty, numbers right-aligned; long tables are cut.
std::string table_text(const Table& table) {
  std::vector<std::size_t> columns;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const bool any =
        std::any_of(table.rows.begin(), table.rows.end(), [&](const auto& row) { return !row[c].is_null(); });
    if (any) columns.push_back(c);
  }
  const std::size_t all = columns.size();
  columns.resize(std::min(all, kMostColumns));
  if (columns.empty()) return {};
  std::vector<std::string> head, rule;
  for (const std::size_t c : columns) {
    const bool number = std::all_of(table.rows.begin(), table.rows.end(),
                                    [&](const auto& row) { return row[c].is_number() || row[c].is_null(); });
    head.push_back(cell(table.columns[c]));
    rule.emplace_back(number ? "---:" : "---");
  }
  std::string text = row_text(head) + row_text(rule);
  for (std::size_t r = 0; r < std::min(table.rows.size(), kMostRows); ++r) {
    std::vector<std::string> cells;
    for (const std::size_t c : columns) cells.push_back(shown(table.rows[r][c]));
    text += row_text(cells);
  }
  if (table.rows.size() > kMostRows || all > kMostColumns) {
    text += fmt::format("\n{} of {} rows, {} of {} columns; `--csv` writes all.\n",
                        std::min(table.rows.size(), kMostRows), table.rows.size(), columns.size(), all);
  }
  return text;
}

const char* mark(Status status) {
  return status == Status::Pass       ? "pass"
         : status == Status::Measured ? "measured"
         : status == Status::Fail     ? "**fail**"
                                      : "**error**";
}

/// A plan's gates are its rows, so only its failures are listed.
std::string gates_text(const Result& result) {
  std::string text;
  std::size_t listed = 0, left = 0;
  for (const Gate& gate : gates_of(result)) {
    if (result.subcommand == "plan" && gate.status == Status::Pass) continue;
    if (listed == kMostRows) {
      ++left;
      continue;
    }
    ++listed;
    text += row_text({cell(gate.name), mark(gate.status), cell(gate.message),
                      gate.status == Status::Pass ? "" : cell(gate.command)});
  }
  if (text.empty()) return {};
  text = row_text({"gate", "", "", "reproduce"}) + row_text({"---", "---", "---", "---"}) + text;
  return text + (left > 0 ? fmt::format("\nand {} more.\n", left) : "") + "\n";
}

std::string section(const Result& result) {
  const Verdict verdict = verdict_of(result);
  const std::string command = command_of(result);
  return fmt::format("### {} {}: {}\n\n{}\n\n", cell(result.subcommand), code(name_of(result)), mark(verdict.status),
                     cell(verdict.sentence)) +
         (command.empty() ? "" : code(command) + "\n\n") + gates_text(result) + table_text(table_of(result));
}

}  // namespace

std::string to_markdown(const std::vector<Result>& with_folders) {
  const auto results = without_folders(with_folders);
  std::string text;
  for (const Result& result : results) reading(result, [&] { text += (text.empty() ? "" : "\n") + section(result); });
  return text;
}

}  // namespace fastsplat::report
