// SPDX-License-Identifier: Apache-2.0
#include "base/suggest.hpp"

#include <algorithm>
#include <vector>

namespace fastsplat {

int edit_distance(std::string_view a, std::string_view b) {
  // Rows of the table for the prefixes of `a` of i-2, i-1 and i characters.
  std::vector<int> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::swap(before, last);
    std::swap(last, row);
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      const bool exchanged = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (exchanged) row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[b.size()];
}

bool may_mean(std::string_view got, std::string_view name) {
  const auto letters = got.size() - std::min(got.find_first_not_of('-'), got.size());
  const int allowed = std::clamp(static_cast<int>(letters + 1) / 3, 1, 3);
  // The lengths alone exclude a word of a megabyte.
  const std::size_t apart = got.size() > name.size() ? got.size() - name.size() : name.size() - got.size();
  if (apart > static_cast<std::size_t>(allowed)) return false;
  const int distance = edit_distance(got, name);
  return distance <= allowed && distance < static_cast<int>(name.size());
}

std::string did_you_mean(std::string_view got, std::span<const std::string> known) {
  const std::string* best = nullptr;
  for (const auto& name : known) {
    if (may_mean(got, name) && (best == nullptr || edit_distance(got, name) < edit_distance(got, *best))) best = &name;
  }
  return best != nullptr ? "did you mean '" + *best + "'?" : std::string();
}

std::string suggestion(std::string_view got, std::span<const std::string> known) {
  if (const std::string meant = did_you_mean(got, known); !meant.empty()) return meant;
  std::string list;
  for (const auto& name : known) list += (list.empty() ? "" : ", ") + name;
  return "known: " + list;
}

}  // namespace fastsplat
