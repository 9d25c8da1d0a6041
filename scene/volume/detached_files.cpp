// SPDX-License-Identifier: Apache-2.0
#include "scene/volume/detached_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string_view>

#include "base/file_beside.hpp"
#include "base/lower_case.hpp"
#include "base/number_text.hpp"

namespace fastsplat::volume {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxFiles = 65535;

/// The parts of `before%05dafter`. No std::regex: it recurses per character, and a line has up to a megabyte.
struct Numbered {
  std::string_view before, after;
  int width = 0;
  bool zeros = false;
};

std::optional<Numbered> numbered_name(std::string_view name) {
  const std::size_t percent = name.rfind('%');
  if (percent == std::string_view::npos) return std::nullopt;
  Numbered parts{.before = name.substr(0, percent), .after = name.substr(percent + 1)};
  const auto take = [&parts](char first, char last) {
    const bool there = !parts.after.empty() && parts.after[0] >= first && parts.after[0] <= last;
    const char taken = there ? parts.after[0] : '\0';
    if (there) parts.after.remove_prefix(1);
    return taken;
  };
  parts.zeros = take('0', '0') != '\0';
  if (const char digit = take('1', '9')) parts.width = digit - '0';
  if (take('d', 'd') == '\0') return std::nullopt;
  return parts;
}

/// The names that `PATTERN MIN MAX STEP [DIMENSION]` stands for; nullopt if `text` is not of that form.
std::optional<std::vector<std::string>> names_of_pattern(const TextHeader& header, int line, const std::string& text) {
  const std::vector<std::string> words = words_of(text);
  if (words.size() != 4 && words.size() != 5) return std::nullopt;
  const auto parts = numbered_name(words[0]);
  const auto first = integer_from<int>(words[1]), last = integer_from<int>(words[2]),
             step = integer_from<int>(words[3]);
  if (!parts || !first || !last || !step) return std::nullopt;
  const std::int64_t way = std::int64_t{*last} - *first;
  const bool leads = *step != 0 && (way == 0 || (way < 0) == (*step < 0));
  const std::int64_t steps = leads ? way / *step : 0;
  if (!leads || steps >= std::int64_t{kMaxFiles}) {
    header.refuse(line, "the numbers of the data files describe no files", fmt::format("1 to {} files", kMaxFiles),
                  text.substr(0, 120), "correct the first number, the last one and the step");
  }
  std::vector<std::string> names;
  for (std::int64_t i = 0; i <= steps; ++i) {
    const std::int64_t number = *first + i * *step;
    names.push_back(fmt::format(
        "{}{}{}", parts->before,
        parts->zeros ? fmt::format("{:0{}}", number, parts->width) : fmt::format("{:{}}", number, parts->width),
        parts->after));
  }
  return names;
}

/// How many files the field must name for the sizes; 0: any number that divides the last one.
std::uint64_t pieces(const TextHeader& header, const TextHeader::Field& field,
                     const std::vector<std::uint64_t>& sizes) {
  const std::vector<std::string> words = words_of(field.value);
  std::size_t axes = sizes.size() - 1;
  if (words.size() == 2 || words.size() == 5) {
    const std::string& number = words.back();  // MetaIO writes "LIST 2D"
    axes = header.count(field, number.substr(0, number.find_first_of("dD")));
    if (axes < 1 || axes > sizes.size()) {
      header.refuse(field.line, "the data files have an invalid dimension", fmt::format("1 to {}", sizes.size()),
                    words.back().substr(0, 40), "correct the header");
    }
  }
  if (axes == sizes.size()) return 0;
  std::uint64_t count = 1;
  for (std::size_t a = axes; a < sizes.size(); ++a) count *= sizes[a];
  return count;
}

void check_count(const TextHeader& header, const TextHeader::Field& field, const std::vector<std::uint64_t>& sizes,
                 std::size_t files) {
  if (files == 1) return;  // all of it
  const std::uint64_t count = pieces(header, field, sizes);
  if (count == 0 ? sizes.back() % files == 0 : count == files) return;
  header.refuse(field.line, "the number of data files does not match the sizes",
                count == 0 ? fmt::format("a divisor of {}", sizes.back()) : fmt::format("{} files", count),
                fmt::format("{}", files), "name each file once, or correct the sizes");
}

}  // namespace

bool says_list(const std::string& value) {
  const auto words = words_of(value);
  return (words.size() == 1 || words.size() == 2) && lower_case(words[0]) == "list";
}

std::vector<fs::path> detached_files(const TextHeader& header, const TextHeader::Field& field,
                                     const std::vector<std::uint64_t>& sizes) {
  std::vector<std::string> names{field.value};
  int line = field.line;
  int lines_each = 0;
  std::error_code error;
  if (const bool exists = fs::exists(header.path.parent_path() / field.value, error); exists && !error) {
  } else if (says_list(field.value)) {
    names = header.listed_files;
    lines_each = 1;
    if (names.empty() || names.size() > kMaxFiles) {
      header.refuse(field.line, "the list of data files has an invalid length", fmt::format("1 to {}", kMaxFiles),
                    fmt::format("{}", names.size()), "write one name a line after this field");
    }
  } else if (auto numbered = names_of_pattern(header, field.line, field.value)) {
    names = std::move(*numbered);
  }
  check_count(header, field, sizes, names.size());
  std::vector<fs::path> files;
  for (const auto& name : names) files.push_back(file_beside(header.path, name, header.place(line += lines_each)));
  return files;
}

}  // namespace fastsplat::volume
