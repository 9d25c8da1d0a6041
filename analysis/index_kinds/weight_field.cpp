// SPDX-License-Identifier: Apache-2.0
#include "analysis/index_kinds/weight_field.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "cmodel/splat/weight_unit.hpp"
#include "driver/tables/index_tables.hpp"
#include "driver/tables/quantise.hpp"
#include "driver/tables/tables.hpp"

namespace fastsplat::analysis {
namespace {

constexpr int kOffsets = 61;     // a prime: no grid of 2^n steps meets it but at 0
constexpr double kTurn = 0.4;    // radians
constexpr int kTurnedSide = 64;  // pixels
constexpr int kAway = 64;        // pixels; a single splat lies far from the field's edge

/// Index of the pixel in the lattice's field, or -1. Single centres count modulo the voxel.
int place(const Lattice& lattice, std::size_t centre, int x, int y) {
  if (lattice.wrapped > 0) {
    const int cell = lattice.wrapped;
    return static_cast<int>(centre) * cell * cell + (y % cell) * cell + x % cell;
  }
  const bool inside = x >= 0 && y >= 0 && x < lattice.side && y < lattice.side;
  return inside ? y * lattice.side + x : -1;
}

void fill_exact(const scene::Kernel& kernel, Lattice& lattice, std::size_t pixels) {
  lattice.exact.assign(pixels, 0.0);
  const double unit = kernel.radius() / lattice.radius;
  for (std::size_t n = 0; n < lattice.centres.size(); ++n) {
    const auto [cx, cy] = lattice.centres[n];
    for (int y = static_cast<int>(std::floor(cy - lattice.radius)); y <= cy + lattice.radius; ++y) {
      for (int x = static_cast<int>(std::floor(cx - lattice.radius)); x <= cx + lattice.radius; ++x) {
        const int at = place(lattice, n, x, y);
        const double dx = (x - cx) * unit, dy = (y - cy) * unit;
        if (at >= 0) lattice.exact[static_cast<std::size_t>(at)] += kernel.footprint(dx * dx + dy * dy) / kernel.peak();
      }
    }
  }
  for (const double value : lattice.exact) lattice.mean += value / static_cast<double>(pixels);
}

/// The model's unit with the driver's tables.
struct Loaded {
  cmodel::WeightUnit unit;
  driver::Target position;
  cmodel::Snap snap;

  Loaded(const cmodel::Config& config, const scene::Kernel& kernel, double radius)
      : unit(cmodel::weight_unit(config)), position(driver::target(driver::Site::Position, config)), snap(config) {
    std::visit(
        [&](auto& kind) {
          kind.load_radial(driver::radial_table(config, kernel).words);
          kind.load(driver::set_table(config, kernel, 0, radius, 0));
        },
        unit);
  }
  template <class Unit>
  std::pair<cmodel::SnappedAxis, cmodel::SnappedAxis> put(Unit& kind, Lattice::Centre centre) const {
    cmodel::Nothing nobody;
    const auto x = snap(driver::quantise_to<std::int32_t>(centre.x, position), kind.rho(0), nobody);
    const auto y = snap(driver::quantise_to<std::int32_t>(centre.y, position), kind.rho(0), nobody);
    kind.place(0, x, y);
    return {x, y};
  }
};

}  // namespace

Lattice aligned_lattice(const scene::Kernel& kernel, int radius) {
  Lattice lattice;
  lattice.radius = radius;
  lattice.wrapped = static_cast<int>(std::lround(radius / kernel.radius()));
  for (int j = 0; j < kOffsets; ++j) {
    for (int i = 0; i < kOffsets; ++i)
      lattice.centres.push_back({kAway + static_cast<double>(i) / kOffsets, kAway + static_cast<double>(j) / kOffsets});
  }
  fill_exact(kernel, lattice, lattice.centres.size() * static_cast<std::size_t>(lattice.wrapped * lattice.wrapped));
  return lattice;
}

Lattice turned_lattice(const scene::Kernel& kernel, int radius) {
  Lattice lattice;
  lattice.radius = radius;
  lattice.side = kTurnedSide;
  const double voxel = radius / kernel.radius(), middle = kTurnedSide / 2.0;
  const int reach = static_cast<int>(kTurnedSide / voxel) + 4;
  for (int j = -reach; j <= reach; ++j) {
    for (int i = -reach; i <= reach; ++i) {
      const double x = middle + voxel * (i * std::cos(kTurn) - j * std::sin(kTurn));
      const double y = middle + voxel * (i * std::sin(kTurn) + j * std::cos(kTurn));
      if (std::min(x, y) > -radius - 1.0 && std::max(x, y) < kTurnedSide + radius + 1.0)
        lattice.centres.push_back({x, y});
    }
  }
  fill_exact(kernel, lattice, static_cast<std::size_t>(kTurnedSide) * kTurnedSide);
  return lattice;
}

FieldError field_error(const cmodel::Config& config, const scene::Kernel& kernel, const Lattice& lattice) {
  Loaded loaded(config, kernel, lattice.radius);
  std::vector<double> field(lattice.exact.size(), 0.0);
  const auto lanes = static_cast<std::uint32_t>(config.lanes);
  std::vector<std::uint32_t> weights(static_cast<std::size_t>(lanes) * lanes);
  const double ulp = std::ldexp(1.0, -config.radial_frac_bits);
  std::visit(
      [&](auto& kind) {
        cmodel::Nothing nobody;
        for (std::size_t n = 0; n < lattice.centres.size(); ++n) {
          const auto [x, y] = loaded.put(kind, lattice.centres[n]);
          for (std::uint32_t row = 0; row < kind.extent(0); row += lanes) {
            for (std::uint32_t column = 0; column < kind.extent(0); column += lanes) {
              kind.window(column, row, weights, nobody);
              for (std::size_t lane = 0; lane < weights.size(); ++lane) {
                if (weights[lane] == 0) continue;
                const int at = place(lattice, n, x.origin + static_cast<int>(column + lane % lanes),
                                     y.origin + static_cast<int>(row + lane / lanes));
                if (at >= 0) field[static_cast<std::size_t>(at)] += weights[lane] * ulp;
              }
            }
          }
        }
      },
      loaded.unit);
  FieldError error;
  const double scale = 255.0 / lattice.mean, share = 1.0 / static_cast<double>(field.size());
  for (std::size_t i = 0; i < field.size(); ++i) {
    const double apart = (field[i] - lattice.exact[i]) * scale;
    error.largest = std::max(error.largest, std::abs(apart));
    error.rms += apart * apart * share;
    error.bias += apart * share;
  }
  error.rms = std::sqrt(error.rms);
  return error;
}

double nanoseconds_per_splat(const cmodel::Config& config, const scene::Kernel& kernel, const Lattice& lattice) {
  Loaded loaded(config, kernel, lattice.radius);
  const auto lanes = static_cast<std::uint32_t>(config.lanes);
  std::vector<std::uint32_t> weights(static_cast<std::size_t>(lanes) * lanes);
  const auto start = std::chrono::steady_clock::now();
  std::visit(
      [&](auto& kind) {
        cmodel::Nothing nobody;
        for (const auto& centre : lattice.centres) {
          loaded.put(kind, centre);
          for (std::uint32_t row = 0; row < kind.extent(0); row += lanes) {
            for (std::uint32_t column = 0; column < kind.extent(0); column += lanes)
              kind.window(column, row, weights, nobody);
          }
        }
      },
      loaded.unit);
  const std::chrono::duration<double, std::nano> taken = std::chrono::steady_clock::now() - start;
  return taken.count() / static_cast<double>(lattice.centres.size());
}

}  // namespace fastsplat::analysis
