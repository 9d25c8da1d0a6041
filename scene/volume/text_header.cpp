// SPDX-License-Identifier: Apache-2.0
#include "scene/volume/text_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <sstream>

#include "base/error.hpp"
#include "base/number_text.hpp"
#include "base/read_file.hpp"

namespace fastsplat::volume {
namespace {

constexpr std::size_t kMaxHeader = std::size_t{1} << 20;

}  // namespace

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream words(text);
  return {std::istream_iterator<std::string>(words), {}};
}

bool is_binary(const std::string& line) {
  return std::any_of(line.begin(), line.end(),
                     [](unsigned char c) { return c == 0x7f || (c < 0x20 && c != '\t' && c != '\r'); });
}

std::string TextHeader::place(int line) const {
  return line > 0 ? fmt::format("{}:{}", path.string(), line) : path.string();
}

void TextHeader::refuse(int line, std::string what, std::string expected, std::string got, std::string fix) const {
  throw_input({.where = place(line),
               .what = std::move(what),
               .expected = std::move(expected),
               .got = std::move(got),
               .fix = std::move(fix)});
}

const TextHeader::Field* TextHeader::find(std::initializer_list<const char*> names) const {
  for (const char* name : names) {
    if (const auto found = fields.find(name); found != fields.end()) return &found->second;
  }
  return nullptr;
}

const TextHeader::Field& TextHeader::need(const char* name) const {
  const Field* field = find({name});
  if (field == nullptr)
    refuse(0, fmt::format("the {} header has no '{}'", format, name), {}, {}, "add the line to the header");
  return *field;
}

void TextHeader::add(const std::string& name, std::string value, int line) {
  if (!fields.emplace(name, Field{std::move(value), line}).second)
    refuse(line, fmt::format("'{}' is given twice", name.substr(0, 40)), {}, {}, "remove one of the lines");
}

std::uint64_t TextHeader::count(const Field& field, const std::string& word) const {
  const auto number = integer_from<std::uint64_t>(word);
  if (!number) refuse(field.line, "invalid size", "a whole number", word.substr(0, 80), "correct the header");
  return *number;
}

std::vector<double> TextHeader::numbers(const Field& field, std::size_t many) const {
  const auto words = words_of(field.value);
  if (words.size() != many) {
    refuse(field.line, "the number of values differs from the number of axes", fmt::format("{}", many),
           fmt::format("{}", words.size()), "correct the header");
  }
  std::vector<double> numbers;
  for (const auto& word : words) {
    const auto number = double_from(word);
    if (!number) refuse(field.line, "invalid number", "a number", word.substr(0, 40), "correct the header");
    numbers.push_back(*number);
  }
  return numbers;
}

HeaderLines::HeaderLines(const std::filesystem::path& path) : head_(start_of(path, kMaxHeader)) {}

bool HeaderLines::cut() const { return at_ == head_.size() && head_.size() == kMaxHeader; }

bool HeaderLines::next(std::string& line) {
  if (at_ >= head_.size()) return false;
  const std::size_t end = std::min(head_.find('\n', at_), head_.size());
  line = head_.substr(at_, end - at_);
  at_ = std::min(end + 1, head_.size());
  if (!line.empty() && line.back() == '\r') line.pop_back();
  ++number_;
  return true;
}

}  // namespace fastsplat::volume
