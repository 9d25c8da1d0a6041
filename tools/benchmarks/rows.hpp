// SPDX-License-Identifier: Apache-2.0
// A tile full of splats of one size, for timing kernels.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "cmodel/numbers/config.hpp"
#include "cmodel/stream/beat.hpp"
#include "cmodel/stream/records.hpp"
#include "driver/config/config_file.hpp"
#include "driver/tables/tables.hpp"

namespace fastsplat::bench {

inline constexpr std::uint32_t kRowsSplats = 20000;

/// Order of the splats' positions.
enum class Order {
  Anywhere,  ///< random: rows of the sheet come from the second-level cache
  Slice,     ///< traversal of a volume's slice, rotated by 0.3 rad: neighbours overlap
};

/// A rotated grid of splats, `spacing` pixels apart, in a square of `side` pixels; row by row, then from the start
/// again.
class TurnedGrid {
 public:
  TurnedGrid(double side, double spacing) : side_(side), spacing_(spacing) {}
  /// The next splat's place in the square.
  std::pair<double, double> next() {
    const auto last = static_cast<int>(1.5 * side_ / spacing_);
    for (;;) {
      if (++column_ > last) column_ = -last, ++row_;
      if (row_ > last) row_ = -last;
      const double x = spacing_ * (std::cos(0.3) * column_ - std::sin(0.3) * row_);
      const double y = spacing_ * (std::sin(0.3) * column_ + std::cos(0.3) * row_);
      if (x >= 0.0 && x < side_ && y >= 0.0 && y < side_) return {x, y};
    }
  }

 private:
  double side_, spacing_;
  int row_ = 0, column_ = 0;
};

struct Rows {
  cmodel::Config config;
  std::vector<cmodel::Beat> preamble, tile;
  std::vector<cmodel::SplatRecord> records;

  /// Splats `extent` pixels wide, inside the tile, with colours up to 1/`dimmed`; at 512 no sum saturates.
  Rows(const std::string& name, int extent, Order order = Order::Anywhere, std::uint32_t splats = kRowsSplats,
       std::uint32_t dimmed = 512)
      : config(driver::load_config(name)) {
    append(preamble, cmodel::BeginFrame{config_hash(config), config.tile_width, config.tile_height, 1});
    append(preamble, driver::rlut_table(config, 0, extent / 2.0, 0));
    append(preamble, driver::radial_table(config, scene::kernel_by_name("smooth")));
    append(preamble, driver::factor_table(config));
    std::uint64_t state = 1;
    const auto below = [&state](std::uint32_t n) {
      state = state * 6364136223846793005U + 1442695040888963407U;
      return static_cast<std::uint32_t>((state >> 33) % n);
    };
    append(tile, cmodel::BeginTile{.width = config.tile_width, .height = config.tile_height});
    append(tile, cmodel::BeginSheet{0});
    const auto side = static_cast<std::uint32_t>(config.tile_width - extent) << config.position_frac_bits;
    const std::int32_t first = (extent / 2) << config.position_frac_bits;
    const auto brightest = static_cast<std::uint32_t>(config.colour_format().max);
    // Four splats per footprint width, as for a kernel of radius 2.
    TurnedGrid grid(config.tile_width - extent, (extent - 1) / 4.0);
    for (std::uint32_t i = 0; i < splats; ++i) {
      cmodel::SplatRecord splat{.tag = i, .x = first, .y = first};
      if (order == Order::Slice) {
        const auto [x, y] = grid.next();
        splat.x += static_cast<std::int32_t>(std::ldexp(x, config.position_frac_bits));
        splat.y += static_cast<std::int32_t>(std::ldexp(y, config.position_frac_bits));
      } else {
        splat.x += static_cast<std::int32_t>(below(side));
        splat.y += static_cast<std::int32_t>(below(side));
      }
      for (std::uint32_t& channel : splat.colour) channel = 1 + below(brightest / dimmed);
      records.push_back(splat);
      tile.push_back(to_beat(splat));
    }
  }
};

}  // namespace fastsplat::bench
