// SPDX-License-Identifier: Apache-2.0
#include "analysis/sweep/columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/error.hpp"
#include "base/printable.hpp"
#include "base/suggest.hpp"

namespace fastsplat::plan {
namespace {

constexpr const char* kFixed[] = {"id",          "kind",       "status",       "message",
                                  "config_hash", "scene_hash", "program_hash", "command"};

}  // namespace

bool is_fixed_column(const std::string& name) { return std::ranges::find(kFixed, name) != std::end(kFixed); }

std::string fixed_column(const Merged& merged, const std::string& name) {
  return std::ranges::find(merged.axes, name, &Axis::name) == merged.axes.end() ? name : "case." + name;
}

namespace {

std::vector<std::string> known_columns(const Merged& merged) {
  std::vector<std::string> names;
  for (const char* name : kFixed) names.push_back(fixed_column(merged, name));
  for (const Axis& axis : merged.axes) names.push_back(axis.name);
  for (const Metric& metric : merged.metrics) names.push_back(metric.name);
  return names;
}

void check(const Merged& merged, const std::string& column, const char* flag) {
  const auto known = known_columns(merged);
  if (std::ranges::find(known, column) != known.end()) return;
  throw_usage({.where = flag,
               .what = "unknown column '" + column + "'",
               .expected = {},
               .got = {},
               .fix = suggestion(column, known)});
}

std::string fixed(const Row& row, const std::string& column) {
  if (column == "id") return row.id;
  if (column == "kind") return row.kind;
  if (column == "status") return to_string(row.status);
  if (column == "message") return row.message;
  if (column == "config_hash") return row.content.config_hash;
  if (column == "scene_hash") return row.content.scene_hash;
  if (column == "program_hash") return row.program;
  return row.command;
}

Cell number_cell(double number) { return {to_text(Value(number)), number}; }

struct ValueCell {
  Cell operator()(bool value) const { return {to_text(Value(value)), {}}; }
  Cell operator()(std::int64_t value) const { return {to_text(Value(value)), static_cast<double>(value)}; }
  Cell operator()(double value) const { return number_cell(value); }
  Cell operator()(const std::string& value) const { return {value, {}}; }
};

std::vector<std::string> usual_columns(const Merged& merged, const std::vector<const Row*>& rows) {
  std::vector<std::string> out;
  const auto varies = [&](const std::string& name) {
    return std::ranges::any_of(rows, [&](const Row* row) {
      return cell_of(merged, *row, name).text != cell_of(merged, *rows.front(), name).text;
    });
  };
  for (const Axis& axis : merged.axes) {
    if (rows.empty() || varies(axis.name)) out.push_back(axis.name);
  }
  if (std::ranges::any_of(rows, [](const Row* row) { return row->status != Status::Pass; }))
    out.push_back(fixed_column(merged, "status"));
  for (const Metric& metric : merged.metrics) {
    if (rows.size() < 2 || varies(metric.name)) out.push_back(metric.name);
  }
  out.push_back(fixed_column(merged, "config_hash"));
  return out;
}

std::string title_of(const Merged& merged, const std::string& column) {
  const auto metric = std::ranges::find(merged.metrics, column, &Metric::name);
  if (metric == merged.metrics.end() || metric->unit.empty()) return printable(column);
  return printable(fmt::format("{} [{}]", column, metric->unit));
}

/// Numbers come before texts and missing values.
bool before(const Cell& a, const Cell& b) {
  if (a.number && b.number) return *a.number < *b.number;
  if (a.number.has_value() != b.number.has_value()) return a.number.has_value();
  return a.text < b.text;
}

std::string short_text(const Cell& cell) {
  if (!cell.number) return cell.text.empty() ? "-" : printable(cell.text);
  return fmt::format("{:.6g}", *cell.number);
}

std::string csv_word(const std::string& raw) {
  const std::string text = printable_lines(raw);
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

std::string markdown_word(std::string text) {
  for (auto at = text.find('|'); at != std::string::npos; at = text.find('|', at + 2)) text.insert(at, "\\");
  return text;
}

std::string left_out_text(const Table& table) {
  return table.left_out == 0 ? "" : fmt::format("... and {} more rows\n", table.left_out);
}

}  // namespace

Cell cell_of(const Merged& merged, const Row& row, const std::string& column) {
  for (const char* name : kFixed) {
    if (column == fixed_column(merged, name)) return {fixed(row, name), {}};
  }
  if (const auto axis = std::ranges::find(row.axes, column, &Setting::name); axis != row.axes.end())
    return std::visit(ValueCell{}, axis->value);
  if (const auto number = row.metric(column)) return number_cell(*number);
  check(merged, column, "column");
  return {};
}

std::vector<const Row*> chosen_rows(const Merged& merged, const TableOptions& options) {
  std::vector<std::pair<std::string, std::string>> wanted;
  for (const auto& text : options.where) {
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0) {
      throw_usage({.where = "--where",
                   .what = "not a condition",
                   .expected = "NAME=VALUE",
                   .got = "'" + text + "'",
                   .fix = "for example --where config=base"});
    }
    wanted.emplace_back(text.substr(0, equals), text.substr(equals + 1));
    check(merged, wanted.back().first, "--where");
  }
  std::vector<const Row*> rows;
  for (const Row& row : merged.rows) {
    const auto reads = [&](const auto& want) {
      const Cell cell = cell_of(merged, row, want.first);
      return cell.text == want.second || short_text(cell) == want.second;
    };
    if (std::ranges::all_of(wanted, reads)) rows.push_back(&row);
  }
  for (auto sort = options.sort.rbegin(); sort != options.sort.rend(); ++sort) {
    const bool down = sort->starts_with('-');
    const std::string column = down ? sort->substr(1) : *sort;
    check(merged, column, "--sort");
    std::ranges::stable_sort(rows, [&](const Row* a, const Row* b) {
      const Cell left = cell_of(merged, *a, column), right = cell_of(merged, *b, column);
      return down && left.number && right.number     ? *left.number > *right.number
             : down && !left.number && !right.number ? left.text > right.text
                                                     : before(left, right);
    });
  }
  return rows;
}

Table table_of(const Merged& merged, const TableOptions& options) {
  auto rows = chosen_rows(merged, options);
  Table table{
      .columns = options.columns.empty() ? usual_columns(merged, rows) : options.columns, .titles = {}, .rows = {}};
  for (const auto& column : table.columns) {
    check(merged, column, "--columns");
    table.titles.push_back(title_of(merged, column));
  }
  if (options.most > 0 && rows.size() > options.most) {
    table.left_out = rows.size() - options.most;
    rows.resize(options.most);
  }
  for (const Row* row : rows) {
    auto& cells = table.rows.emplace_back();
    for (const auto& column : table.columns) cells.push_back(cell_of(merged, *row, column));
  }
  return table;
}

std::string to_text(const Table& table) {
  std::vector<std::size_t> widths;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    std::size_t width = table.titles[c].size();
    for (const auto& row : table.rows) width = std::max(width, short_text(row[c]).size());
    widths.push_back(width);
  }
  const auto line = [&](const auto& text_at) {
    std::string out;
    for (std::size_t c = 0; c < widths.size(); ++c) {
      const auto [text, right] = text_at(c);
      out += c == 0 ? "" : "  ";
      out += right ? fmt::format("{:>{}}", text, widths[c]) : fmt::format("{:<{}}", text, widths[c]);
    }
    out.erase(out.find_last_not_of(' ') + 1);
    return out + "\n";
  };
  const auto is_number = [&](std::size_t c) {
    return std::ranges::any_of(table.rows, [&](const auto& row) { return row[c].number.has_value(); });
  };
  std::string text = line([&](std::size_t c) { return std::pair(table.titles[c], is_number(c)); });
  for (const auto& row : table.rows)
    text += line([&](std::size_t c) { return std::pair(short_text(row[c]), is_number(c)); });
  return text + left_out_text(table);
}

std::string to_markdown(const Table& table) {
  std::string text = "|", rule = "|";
  for (const auto& title : table.titles) {
    text += " " + markdown_word(title) + " |";
    rule += "---|";
  }
  text += "\n" + rule + "\n";
  for (const auto& row : table.rows) {
    text += "|";
    for (const Cell& cell : row) text += " " + markdown_word(short_text(cell)) + " |";
    text += "\n";
  }
  return text + (table.left_out == 0 ? "" : "\n" + left_out_text(table));
}

std::string to_csv(const Table& table) {
  std::string text;
  for (const auto& column : table.columns) text += (text.empty() ? "" : ",") + csv_word(column);
  text += "\r\n";
  for (const auto& row : table.rows) {
    std::string line;
    for (std::size_t c = 0; c < row.size(); ++c) line += (c == 0 ? "" : ",") + csv_word(row[c].text);
    text += line + "\r\n";
  }
  return text;
}

}  // namespace fastsplat::plan
