// SPDX-License-Identifier: Apache-2.0
#include "cmodel/fast/weight_memo.hpp"

#include <algorithm>

#include "cmodel/numbers/window_geometry.hpp"

namespace fastsplat::cmodel::fast {
namespace {

int rounded_up(int value, int step) { return (value + step - 1) / step * step; }

/// The RLUT word of a set's column along one axis, in any window.
std::uint32_t word(const Rlut& rlut, std::uint32_t set, std::uint32_t phase, int column, int lanes) {
  const int window = column / lanes * lanes;
  return rlut.read(set, phase, static_cast<std::uint32_t>(window))[static_cast<std::size_t>(column - window)];
}

}  // namespace

WeightMemo::WeightMemo(const Config& config, WeightUnit& unit, std::uint32_t sets, int weight_shift)
    : phases_(config.grid()),
      phase_bits_(config.grid_bits()),
      lanes_(config.lanes),
      shapes_(sets),
      weighted_((static_cast<std::size_t>(sets) << (2 * phase_bits_)), 0) {
  for (std::uint32_t set = 0; set < sets; ++set)
    std::visit([&](auto& kind) { fill(config, kind, set, weight_shift); }, unit);
}

std::size_t WeightMemo::bytes(const Config& config, std::uint32_t rho) {
  const std::size_t padded = window_geometry(config, rho).padded;
  return static_cast<std::size_t>(config.grid()) * static_cast<std::size_t>(config.grid()) * padded *
         ((padded + 7) / 8 * 8) * sizeof(std::uint16_t);
}

/// For any unit: window by window, with all columns.
template <class Unit>
void WeightMemo::fill(const Config& config, Unit& unit, std::uint32_t set, int weight_shift) {
  Shape& shape = shapes_[set];
  shape.rho = unit.rho(set);
  const auto side = unit.extent(set), lanes = static_cast<std::uint32_t>(config.lanes);
  shape.padded = shape.extent = static_cast<int>(side);
  shape.windows = (side / lanes) * (side / lanes);
  shape.pitch = rounded_up(std::max(shape.extent, 1), 8);
  shape.first = words_.size();
  const auto phases = static_cast<std::uint32_t>(phases_);
  const std::size_t pitch = static_cast<std::size_t>(shape.pitch), footprint = side * pitch;
  words_.resize(shape.first + static_cast<std::size_t>(phases) * phases * footprint, 0);
  std::vector<std::uint32_t> weights(static_cast<std::size_t>(lanes) * lanes);
  Nothing nobody;
  for (std::uint32_t my = 0; my < phases; ++my) {
    for (std::uint32_t mx = 0; mx < phases; ++mx) {
      std::uint16_t* out = words_.data() + shape.first + number(mx, my) * footprint;
      std::uint32_t weighted = 0;
      unit.place(set, {.origin = 0, .phase = mx}, {.origin = 0, .phase = my});
      for (std::uint32_t row = 0; row < side; row += lanes) {
        for (std::uint32_t column = 0; column < side; column += lanes) {
          unit.window(column, row, weights, nobody);
          for (std::size_t lane = 0; lane < weights.size(); ++lane) {
            weighted += weights[lane] != 0 ? 1 : 0;
            shape.heaviest = std::max(shape.heaviest, weights[lane]);
            out[(row + lane / lanes) * pitch + column + lane % lanes] =
                static_cast<std::uint16_t>(weights[lane] << weight_shift);
          }
        }
      }
      weighted_[(static_cast<std::size_t>(set) << (2 * phase_bits_)) + number(mx, my)] =
          static_cast<std::uint16_t>(weighted);
    }
  }
}

void WeightMemo::fill(const Config& config, RlutUnit& unit, std::uint32_t set, int weight_shift) {
  const Rlut& rlut = unit.rlut();
  const RadialTable& radial = unit.radial();
  Nothing nobody;
  Shape& shape = shapes_[set];
  shape.rho = rlut.rho(set);
  shape.padded = static_cast<int>(rlut.extent(set));
  shape.windows = static_cast<std::uint32_t>((shape.padded / lanes_) * (shape.padded / lanes_));
  const auto phases = static_cast<std::uint32_t>(phases_);
  // A column that is outside the rim at every phase has no weight in any row.
  std::vector<std::uint32_t> nearest(static_cast<std::size_t>(shape.padded), ~std::uint32_t{0});
  for (int i = 0; i < shape.padded; ++i) {
    for (std::uint32_t m = 0; m < phases; ++m)
      nearest[static_cast<std::size_t>(i)] =
          std::min(nearest[static_cast<std::size_t>(i)], word(rlut, set, m, i, lanes_));
  }
  for (int i = 0; i < shape.padded; ++i) {
    for (int j = 0; j < shape.padded; ++j) {
      const std::uint32_t q = nearest[static_cast<std::size_t>(i)] + nearest[static_cast<std::size_t>(j)];
      if (radial_index(q, config.rlut_guard_bits) < static_cast<std::uint32_t>(config.radial_entries))
        shape.extent = std::max({shape.extent, i + 1, j + 1});
    }
  }
  shape.pitch = rounded_up(std::max(shape.extent, 1), 8);
  shape.first = words_.size();
  const std::size_t footprints = static_cast<std::size_t>(phases) * phases;
  words_.resize(shape.first + footprints * static_cast<std::size_t>(shape.extent) * shape.pitch, 0);
  std::uint16_t* out = words_.data() + shape.first;
  for (std::uint32_t my = 0; my < phases; ++my) {
    for (std::uint32_t mx = 0; mx < phases; ++mx) {
      std::uint32_t weighted = 0;
      for (int j = 0; j < shape.extent; ++j, out += shape.pitch) {
        const std::uint32_t row = word(rlut, set, my, j, lanes_);
        for (int i = 0; i < shape.extent; ++i) {
          const std::uint32_t weight = radial.weight(row + word(rlut, set, mx, i, lanes_), nobody);
          weighted += weight != 0 ? 1 : 0;
          shape.heaviest = std::max(shape.heaviest, weight);
          out[i] = static_cast<std::uint16_t>(weight << weight_shift);
        }
      }
      weighted_[(static_cast<std::size_t>(set) << (2 * phase_bits_)) + number(mx, my)] =
          static_cast<std::uint16_t>(weighted);
    }
  }
}

}  // namespace fastsplat::cmodel::fast
