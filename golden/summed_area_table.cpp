// SPDX-License-Identifier: Apache-2.0
#include "golden/summed_area_table.hpp"

#include <cassert>

namespace fastsplat::golden {

SummedAreaTable::SummedAreaTable(int width, int height)
    : stride_(static_cast<std::size_t>(width) + 1), height_(height), sums_(stride_ * (height + 1)) {}

void SummedAreaTable::rebuild(std::span<const std::uint8_t> values, int first_row) {
  const std::size_t width = stride_ - 1;
  assert(values.size() == width * height_);
  for (int y = first_row; y < height_; ++y) {
    const std::uint8_t* value = &values[y * width];
    const std::uint32_t* above = &sums_[y * stride_ + 1];
    std::uint32_t* here = &sums_[(y + 1) * stride_ + 1];
    std::uint32_t row = 0;
    for (std::size_t x = 0; x < width; ++x) {
      row += value[x];
      here[x] = above[x] + row;
    }
  }
}

}  // namespace fastsplat::golden
