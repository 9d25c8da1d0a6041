// SPDX-License-Identifier: Apache-2.0
#include "cli/frame_names.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "base/error.hpp"

namespace fastsplat::cli {
namespace {

std::string without_percent(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '%' ? std::string("%%") : std::string(1, c);
  return out;
}

}  // namespace

void check_still_name(const std::string& path) {
  if (std::filesystem::path(path).filename().string().find('#') == std::string::npos) return;
  throw_usage({.where = path,
               .what = "# stands for the frame number, which a still does not have",
               .expected = {},
               .got = {},
               .fix = "add --orbit A..B --frames N or --sequence, or remove the #"});
}

FrameNames::FrameNames(const std::string& pattern, int frames, const std::string& of) {
  const auto folder = pattern.size() - std::filesystem::path(pattern).filename().string().size();
  const auto first = pattern.find('#', folder);
  const auto end = first == std::string::npos ? first : pattern.find_first_not_of('#', first);
  const auto extension = std::filesystem::path(pattern).extension().string();
  if (first == std::string::npos || (end != std::string::npos && pattern.find('#', end) != std::string::npos)) {
    throw_usage({.where = pattern,
                 .what = fmt::format("the name has {} for the {} number",
                                     first == std::string::npos ? "no place" : "two places", of),
                 .expected = "one group of # in the file name",
                 .got = {},
                 .fix = fmt::format("for example {}.####{}", of, of == "frame" ? ".png" : extension)});
  }
  before_ = pattern.substr(0, first);
  after_ = end == std::string::npos ? "" : pattern.substr(end);
  digits_ = static_cast<int>(pattern.size() - before_.size() - after_.size());
  const auto last = fmt::format("{}", frames - 1);
  if (static_cast<int>(last.size()) > digits_) {
    throw_usage({.where = pattern,
                 .what = fmt::format("{} # cannot number {} {}s", digits_, frames, of),
                 .expected = {},
                 .got = {},
                 .fix = fmt::format("write {}", std::string(last.size(), '#'))});
  }
}

std::string FrameNames::operator()(int frame) const {
  return fmt::format("{}{:0{}}{}", before_, frame, digits_, after_);
}

std::string FrameNames::format() const {
  return fmt::format("{}%0{}d{}", without_percent(before_), digits_, without_percent(after_));
}

}  // namespace fastsplat::cli
