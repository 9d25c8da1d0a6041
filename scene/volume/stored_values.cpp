// SPDX-License-Identifier: Apache-2.0
#include "scene/volume/stored_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "base/error.hpp"
#include "base/number_text.hpp"

namespace fastsplat::volume {
namespace {

constexpr std::size_t kValuesChunk = std::size_t{1} << 16;
constexpr std::size_t kLongestWord = 512;  // a double printed in full has 325 characters

template <typename T>
double load(const unsigned char* bytes, bool swap) {
  std::array<unsigned char, sizeof(T)> ordered;
  std::copy_n(bytes, sizeof(T), ordered.begin());
  if (swap) std::reverse(ordered.begin(), ordered.end());
  return static_cast<double>(std::bit_cast<T>(ordered));
}

template <typename T>
void load_all(std::span<const unsigned char> bytes, bool swap, std::vector<double>& out) {
  for (std::size_t at = 0; at + sizeof(T) <= bytes.size(); at += sizeof(T)) out.push_back(load<T>(&bytes[at], swap));
}

template <typename T>
bool fits(double value) {
  return value == std::floor(value) && value >= static_cast<double>(std::numeric_limits<T>::min()) &&
         value <= static_cast<double>(std::numeric_limits<T>::max());
}

/// Calls `what` with a value of the component's type.
template <typename What>
auto with_type(Component component, What&& what) {
  switch (component) {
    case Component::U8:
      return what(std::uint8_t{});
    case Component::I8:
      return what(std::int8_t{});
    case Component::U16:
      return what(std::uint16_t{});
    case Component::I16:
      return what(std::int16_t{});
    case Component::U32:
      return what(std::uint32_t{});
    case Component::I32:
      return what(std::int32_t{});
    case Component::U64:
      return what(std::uint64_t{});
    case Component::I64:
      return what(std::int64_t{});
    case Component::F32:
      return what(float{});
    case Component::F64:
      break;
  }
  return what(double{});
}

bool is_blank(unsigned char c) { return c == ' ' || c == ',' || (c >= '\t' && c <= '\r'); }

}  // namespace

std::size_t size_of(Component component) {
  return with_type(component, [](auto type) { return sizeof(type); });
}

StoredValues::StoredValues(const std::filesystem::path& path, std::uint64_t offset, std::uint64_t skip, Packing packing,
                           Component component, std::endian order)
    : path_(path),
      reader_(path, offset, packing),
      packing_(packing),
      component_(component),
      swap_(order != std::endian::native),
      chunk_(kValuesChunk) {
  for (std::uint64_t skipped = 0; skipped < skip;) {
    const std::size_t got =
        reader_.read(chunk_.data(), static_cast<std::size_t>(std::min<std::uint64_t>(chunk_.size(), skip - skipped)));
    if (got == 0) {
      throw_input({.where = path_.string(),
                   .what = "the data ends before the first voxel",
                   .expected = {},
                   .got = {},
                   .fix = "download or copy the file again"});
    }
    skipped += got;
  }
}

std::span<const double> StoredValues::next(std::uint64_t most) {
  values_.clear();
  const auto found = packing_ == Packing::Text ? next_words(most) : next_bytes(most);
  count_ += found.size();
  return found;
}

std::span<const double> StoredValues::next_bytes(std::uint64_t most) {
  const std::size_t width = size_of(component_);
  const std::size_t got =
      reader_.read(chunk_.data(), static_cast<std::size_t>(std::min<std::uint64_t>(chunk_.size(), most * width)));
  const std::span<const unsigned char> bytes(chunk_.data(), got);
  with_type(component_, [&](auto type) { load_all<decltype(type)>(bytes, swap_, values_); });
  rest_ = got % width;
  return values_;
}

std::span<const double> StoredValues::next_words(std::uint64_t most) {
  while (values_.size() < most && values_.size() < kValuesChunk) {
    while (at_ < end_ && is_blank(chunk_[at_])) ++at_;
    auto* const begin = chunk_.data() + at_;
    auto* const stop = chunk_.data() + end_;
    auto* const after = std::find_if(begin, stop, is_blank);
    if (after == stop) {  // a word may continue in the next chunk
      std::memmove(chunk_.data(), begin, static_cast<std::size_t>(stop - begin));
      end_ -= at_;
      at_ = 0;
      const std::size_t got = end_ > kLongestWord ? 0 : reader_.read(chunk_.data() + end_, chunk_.size() - end_);
      if (got > 0) {
        end_ += got;
        continue;
      }
      if (end_ == 0) break;
      values_.push_back(number_from({reinterpret_cast<const char*>(chunk_.data()), end_}));
      end_ = 0;
      break;
    }
    values_.push_back(number_from({reinterpret_cast<const char*>(begin), static_cast<std::size_t>(after - begin)}));
    at_ = static_cast<std::size_t>(after - chunk_.data());
  }
  return values_;
}

double StoredValues::number_from(std::string_view word) const {
  const auto value = double_from(word);
  const bool right = value && with_type(component_, [value](auto type) {
                       using T = decltype(type);
                       if constexpr (std::is_floating_point_v<T>) return true;
                       return fits<T>(*value);
                     });
  if (!right) {
    throw_input({.where = path_.string(),
                 .what = fmt::format("voxel {} of the text is {}", count_ + values_.size(),
                                     value ? "not a value of the header's type" : "not a number"),
                 .expected = {},
                 .got = fmt::format("'{}'", word.substr(0, 40)),
                 .fix = value ? "correct the header's type" : "correct the text, or copy the file again"});
  }
  return *value;
}

}  // namespace fastsplat::volume
