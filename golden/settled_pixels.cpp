// SPDX-License-Identifier: Apache-2.0
#include "golden/settled_pixels.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace fastsplat::golden {

bool never_brighter_than_opaque(const std::vector<scene::Splat>& splats) {
  // Far below overflow of any sum or product; the comparison also rejects NaN.
  constexpr float kLargest = 1e30f;
  return std::ranges::all_of(splats, [](const scene::Splat& splat) {
    const float most = splat.extinction;
    return most <= kLargest && splat.emission.x >= 0.0f && splat.emission.x <= most && splat.emission.y >= 0.0f &&
           splat.emission.y <= most && splat.emission.z >= 0.0f && splat.emission.z <= most;
  });
}

SettledPixels::SettledPixels(Rows rows, int width)
    : rows_(rows),
      width_(width),
      words_((static_cast<std::size_t>(width) + 63) / 64),
      bits_(static_cast<std::size_t>(rows.end - rows.first) * words_) {}

void SettledPixels::settle(int x, int y) {
  bits_[static_cast<std::size_t>(y - rows_.first) * words_ + static_cast<std::size_t>(x >> 6)] |= std::uint64_t{1}
                                                                                                  << (x & 63);
  any_ = true;
}

int SettledPixels::next(int begin, int end, int y, std::uint64_t flip) const {
  if (begin >= end) return end;
  const std::uint64_t* words = row(y);
  int at = begin >> 6;
  // Matching bits are 1.
  std::uint64_t found = ~(words[at] ^ flip) & (~std::uint64_t{0} << (begin & 63));
  while (found == 0) {
    if (++at * 64 >= end) return end;
    found = ~(words[at] ^ flip);
  }
  return std::min(end, at * 64 + std::countr_zero(found));
}

// The window holds every pixel of the footprint: Footprint::rasterise rounds a row's ends towards its middle, starting
// at most reach_x away. Only the rounding of its square root may exceed that; hence the slack.
Rows SettledPixels::open_rows(const ProjectedSplat& splat, Rows rows) const {
  if (!any_) return rows;
  constexpr double kSlack = 1e-6;
  const auto clip = [](double at, double low, double high) { return static_cast<int>(std::clamp(at, low, high)); };
  const double reach = splat.reach_x + kSlack;
  const int begin = clip(std::ceil(splat.x - reach), 0.0, width_);
  const int end = clip(std::floor(splat.x + reach) + 1.0, 0.0, width_);
  Rows open{clip(std::ceil(splat.y - splat.reach_y), rows.first, rows.end),
            clip(std::floor(splat.y + splat.reach_y) + 1.0, rows.first, rows.end)};
  while (open.first < open.end && next_open(begin, end, open.first) == end) ++open.first;
  while (open.first < open.end && next_open(begin, end, open.end - 1) == end) --open.end;
  return open;
}

}  // namespace fastsplat::golden
