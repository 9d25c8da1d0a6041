// SPDX-License-Identifier: Apache-2.0
#include "scene/gaussians/ply_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "base/error.hpp"
#include "base/number_text.hpp"

namespace fastsplat::scene {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";

template <class T>
double value_of(const char* bytes, bool swap) {
  std::array<char, sizeof(T)> own;
  std::memcpy(own.data(), bytes, sizeof(T));
  if (swap) std::ranges::reverse(own);
  return static_cast<double>(std::bit_cast<T>(own));
}

}  // namespace

void PlyRows::require(const PlyElement& element) const {
  const std::uint64_t left = text_.size() - at_;
  // Ascii needs at least a digit and a blank per number; the last blank may be missing.
  const bool ascii = header_.format == PlyFormat::Ascii;
  const std::uint64_t row = ascii ? 2 * element.properties.size() : element.row_bytes();
  if (row == 0 || element.count <= (left + (ascii ? 1 : 0)) / row) return;
  throw_input({.where = fmt::format("{}, byte {}", where_, at_),
               .what = "the file is shorter than its header declares",
               .expected = fmt::format("{}{} of '{}', {} bytes each", ascii ? "at least " : "", element.count,
                                       element.name, row),
               .got = fmt::format("{} bytes", left),
               .fix = "the file is truncated or its header is wrong: write or download it again"});
}

void PlyRows::skip(const PlyElement& element) {
  require(element);
  if (header_.format != PlyFormat::Ascii) {
    at_ += element.count * element.row_bytes();
    return;
  }
  std::vector<double> row(element.properties.size());
  if (row.empty()) return;  // rows without properties have no data
  for (std::uint64_t i = 0; i < element.count; ++i) read(element, i, row);
}

void PlyRows::read(const PlyElement& element, std::uint64_t number, std::span<double> row) {
  for (std::size_t i = 0; i < element.properties.size(); ++i)
    row[i] = header_.format == PlyFormat::Ascii ? word(element, number) : binary(element.properties[i].type);
}

double PlyRows::binary(PlyType type) {
  const bool swap = (header_.format == PlyFormat::BigEndian) == (std::endian::native == std::endian::little);
  const char* const bytes = text_.data() + at_;
  at_ += size_of(type);
  switch (type) {
    case PlyType::Int8:
      return value_of<std::int8_t>(bytes, swap);
    case PlyType::UInt8:
      return value_of<std::uint8_t>(bytes, swap);
    case PlyType::Int16:
      return value_of<std::int16_t>(bytes, swap);
    case PlyType::UInt16:
      return value_of<std::uint16_t>(bytes, swap);
    case PlyType::Int32:
      return value_of<std::int32_t>(bytes, swap);
    case PlyType::UInt32:
      return value_of<std::uint32_t>(bytes, swap);
    case PlyType::Float32:
      return value_of<float>(bytes, swap);
    case PlyType::Float64:
      break;
  }
  return value_of<double>(bytes, swap);
}

double PlyRows::word(const PlyElement& element, std::uint64_t number) {
  for (; at_ < text_.size() && kBlanks.find(text_[at_]) != kBlanks.npos; ++at_) line_ += text_[at_] == '\n' ? 1 : 0;
  const std::string here = fmt::format("{}:{}", where_, line_ + 1);
  if (at_ == text_.size()) {
    throw_input({.where = here,
                 .what = "the file is shorter than its header declares",
                 .expected = fmt::format("{} of '{}'", element.count, element.name),
                 .got = fmt::format("{} complete rows", number),
                 .fix = "the file is truncated or its header is wrong: write or download it again"});
  }
  const std::string_view text = text_.substr(at_, std::min(text_.find_first_of(kBlanks, at_), text_.size()) - at_);
  const auto value = double_from(text);
  if (!value) {
    constexpr std::size_t kShown = 40;
    throw_input({.where = here,
                 .what = "not a number",
                 .expected = fmt::format("{} numbers per row of '{}'", element.properties.size(), element.name),
                 .got = fmt::format("'{}'", text.substr(0, kShown)),
                 .fix = "the file is damaged: write or download it again"});
  }
  at_ += text.size();
  return *value;
}

std::size_t PlyRows::require_end() const {
  constexpr std::string_view kNothing(" \t\r\n\0", 5);
  const std::size_t end = std::min(text_.find_first_not_of(kNothing, at_), text_.size());
  if (end == text_.size()) return end - at_;
  throw_input({.where = fmt::format("{}, byte {}", where_, at_),
               .what = "the file is longer than its header declares",
               .expected = "end of file",
               .got = fmt::format("{} more bytes", text_.size() - at_),
               .fix = "the header is wrong: write or download the file again"});
}

}  // namespace fastsplat::scene
