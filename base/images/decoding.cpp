// SPDX-License-Identifier: Apache-2.0
#include "base/images/decoding.hpp"

#include <algorithm>
#include <charconv>
#include <string_view>

namespace fastsplat::images {

void check_size(std::int64_t width, std::int64_t height, std::int64_t channels) {
  constexpr std::int64_t kLargestSide = 1 << 16, kMostValues = std::int64_t{1} << 31;
  const std::string got = std::to_string(width) + " x " + std::to_string(height) + " x " + std::to_string(channels);
  if (width < 1 || height < 1 || width > kLargestSide || height > kLargestSide)
    throw Refused("unsupported image size", "sides of 1 to " + std::to_string(kLargestSide), got);
  if (width * height * channels > kMostValues) throw Refused("image too large", "at most 2^31 values", got);
}

void check_upright(int orientation) {
  if (orientation == 1) return;
  throw Refused("the image is stored rotated or mirrored: orientation " + std::to_string(orientation), "1", {},
                "write it upright with oiiotool --reorient");
}

std::vector<std::size_t> channel_order(const std::vector<std::string>& names) {
  if (names.size() == 1) return {0};
  std::string_view prefix = names.empty() ? std::string_view() : names[0];
  for (const std::string_view name : names) {
    while (!name.starts_with(prefix)) prefix.remove_suffix(1);
  }
  for (const std::string_view wanted : {"RGB", "RGBA", "YA"}) {
    if (wanted.size() != names.size()) continue;
    std::vector<std::size_t> order;
    for (const char letter : wanted) {
      const auto found = std::find(names.begin(), names.end(), std::string(prefix) + letter);
      if (found == names.end()) break;
      order.push_back(static_cast<std::size_t>(found - names.begin()));
    }
    if (order.size() == names.size()) return order;
  }
  std::string all;
  for (const auto& name : names) all += (all.empty() ? "" : ", ") + name;
  throw Refused(names.size() == 4 ? "four channels, but the fourth is not alpha" : "unsupported channels",
                "channels named Y, YA, RGB or RGBA, or a single channel", all,
                "select or name channels with oiiotool --ch");
}

int frac_bits_of(const Metadata& metadata) {
  const auto found = metadata.find("frac_bits");
  if (found == metadata.end())
    throw Refused("integer words of unknown scale", "metadata fastsplat:frac_bits", "none", "write it with this program");
  const std::string& text = found->second;
  int bits = -1;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), bits);
  if (status != std::errc{} || end != text.data() + text.size() || bits < 0 || bits > 32)
    throw Refused("bad metadata fastsplat:frac_bits", "0 to 32", text);
  return bits;
}

}  // namespace fastsplat::images
