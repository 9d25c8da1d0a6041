// SPDX-License-Identifier: Apache-2.0
#include "scene/gaussians/ply_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "base/error.hpp"
#include "base/number_text.hpp"

namespace fastsplat::scene {
namespace {

constexpr std::array<std::pair<std::string_view, PlyType>, 16> kTypes{{{"char", PlyType::Int8},
                                                                       {"int8", PlyType::Int8},
                                                                       {"uchar", PlyType::UInt8},
                                                                       {"uint8", PlyType::UInt8},
                                                                       {"short", PlyType::Int16},
                                                                       {"int16", PlyType::Int16},
                                                                       {"ushort", PlyType::UInt16},
                                                                       {"uint16", PlyType::UInt16},
                                                                       {"int", PlyType::Int32},
                                                                       {"int32", PlyType::Int32},
                                                                       {"uint", PlyType::UInt32},
                                                                       {"uint32", PlyType::UInt32},
                                                                       {"float", PlyType::Float32},
                                                                       {"float32", PlyType::Float32},
                                                                       {"double", PlyType::Float64},
                                                                       {"float64", PlyType::Float64}}};

std::optional<PlyType> type_named(std::string_view word) {
  const auto* const found = std::ranges::find(kTypes, word, &std::pair<std::string_view, PlyType>::first);
  return found == kTypes.end() ? std::nullopt : std::optional(found->second);
}

std::vector<std::string> words_of(std::string_view line) {
  std::vector<std::string> words;
  for (std::size_t at = 0; at < line.size();) {
    const std::size_t begin = std::min(line.find_first_not_of(" \t", at), line.size());
    at = std::min(line.find_first_of(" \t", begin), line.size());
    if (at > begin) words.emplace_back(line.substr(begin, at - begin));
  }
  return words;
}

/// Reads a header line by line.
class Lines {
 public:
  Lines(std::string_view text, const std::string& where) : text_(text), where_(where) {}
  std::size_t at() const { return at_; }
  std::size_t number() const { return number_; }
  std::string here() const { return fmt::format("{}:{}", where_, number_); }

  /// The words of the next line. Collects comments separately.
  std::vector<std::string> next() {
    while (true) {
      const std::string_view line = next_line();
      std::vector<std::string> words = words_of(line);
      if (words.empty()) continue;
      if (words[0] != "comment" && words[0] != "obj_info") return words;
      const std::size_t text = line.find_first_not_of(" \t", line.find(words[0]) + words[0].size());
      comments_.emplace_back(line.substr(std::min(text, line.size())));
    }
  }
  std::vector<std::string> comments() { return std::move(comments_); }
  [[noreturn]] void refuse(const std::string& what, const std::string& expected, const std::string& got,
                           const std::string& fix) const {
    throw_input({.where = here(), .what = what, .expected = expected, .got = got, .fix = fix});
  }

 private:
  std::string_view next_line() {
    constexpr std::size_t kLongest = 1 << 20;  // comments may hold whole camera files; other files may have no line end
    ++number_;
    const std::size_t end = text_.substr(0, std::min(text_.size(), at_ + kLongest)).find('\n', at_);
    if (end == std::string_view::npos) {
      refuse("the header has no end", "a line end_header",
             at_ == text_.size() ? "the end of the file" : "a line without end",
             "the file is truncated or not a PLY file: write or download it again");
    }
    std::string_view line = text_.substr(at_, end - at_);
    at_ = end + 1;
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
  }

  std::string_view text_;
  const std::string& where_;
  std::vector<std::string> comments_;
  std::size_t at_ = 0, number_ = 0;
};

PlyFormat format_of(const Lines& lines, const std::vector<std::string>& words) {
  const std::string known = "ascii, binary_little_endian or binary_big_endian, and 1.0";
  if (words.size() == 3 && words[0] == "format" && words[2] == "1.0") {
    if (words[1] == "ascii") return PlyFormat::Ascii;
    if (words[1] == "binary_little_endian") return PlyFormat::LittleEndian;
    if (words[1] == "binary_big_endian") return PlyFormat::BigEndian;
  }
  lines.refuse("unknown PLY format", "format " + known, fmt::format("'{}'", fmt::join(words, " ")),
               "save the file in one of these formats");
}

PlyElement element_of(const Lines& lines, const std::vector<std::string>& words) {
  const auto count = words.size() == 3 ? integer_from<std::uint64_t>(words[2]) : std::nullopt;
  if (!count) {
    lines.refuse("invalid element", "element NAME COUNT", fmt::format("'{}'", fmt::join(words, " ")),
                 "the header is damaged: write or download the file again");
  }
  return {.name = words[1], .count = *count, .properties = {}};
}

/// Trained scenes have about 60 properties.
void check_count(const Lines& lines, std::size_t count, const char* what) {
  constexpr std::size_t kMost = 4096;
  if (count >= kMost)
    lines.refuse(fmt::format("too many {}", what), fmt::format("at most {}", kMost), "more",
                 "the header is damaged: write or download the file again");
}

void add_property(const Lines& lines, const std::vector<std::string>& words, PlyElement& to) {
  const bool list = words.size() == 5 && words[1] == "list" && type_named(words[2]) && type_named(words[3]);
  if (list) {
    to.has_list = true;
    return;
  }
  const auto type = words.size() == 3 ? type_named(words[1]) : std::nullopt;
  if (!type) {
    lines.refuse("invalid property", "property TYPE NAME with a type such as float",
                 fmt::format("'{}'", fmt::join(words, " ")), "the header is damaged: write or download the file again");
  }
  for (const PlyProperty& other : to.properties) {
    if (other.name == words[2])
      lines.refuse(fmt::format("the property {} is given twice", other.name), {}, {}, "remove one of them");
  }
  check_count(lines, to.properties.size(), "properties");
  to.properties.push_back({words[2], *type});
}

}  // namespace

std::size_t size_of(PlyType type) {
  constexpr std::array<std::size_t, 8> kSizes{1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

std::size_t PlyElement::row_bytes() const {
  std::size_t bytes = 0;
  for (const PlyProperty& property : properties) bytes += size_of(property.type);
  return bytes;
}

std::optional<std::size_t> PlyElement::find(std::string_view property) const {
  const auto found = std::ranges::find(properties, property, &PlyProperty::name);
  if (found == properties.end()) return std::nullopt;
  return static_cast<std::size_t>(found - properties.begin());
}

const PlyElement* PlyHeader::find(std::string_view element) const {
  const auto found = std::ranges::find(elements, element, &PlyElement::name);
  return found == elements.end() ? nullptr : &*found;
}

PlyHeader read_ply_header(std::string_view text, const std::string& where) {
  Lines lines(text, where);
  if (lines.next() != std::vector<std::string>{"ply"})
    lines.refuse("not a PLY file", "a first line 'ply'", "another", "check that this is the right file");
  PlyHeader header;
  header.format = format_of(lines, lines.next());
  while (true) {
    const std::vector<std::string> words = lines.next();
    if (words[0] == "end_header") break;
    if (words[0] == "element") {
      PlyElement element = element_of(lines, words);
      if (header.find(element.name) != nullptr)
        lines.refuse(fmt::format("the element {} is given twice", element.name), {}, {}, "remove one of them");
      check_count(lines, header.elements.size(), "elements");
      header.elements.push_back(std::move(element));
    } else if (words[0] == "property" && !header.elements.empty()) {
      add_property(lines, words, header.elements.back());
    } else {
      lines.refuse("unknown line in a PLY header", "comment, element, property or end_header", "'" + words[0] + "'",
                   "the header is damaged: write or download the file again");
    }
  }
  header.comments = lines.comments();
  header.size = lines.at();
  header.lines = lines.number();
  return header;
}

}  // namespace fastsplat::scene
