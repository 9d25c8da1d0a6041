// SPDX-License-Identifier: Apache-2.0
#include "analysis/index_kinds/family_table.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "driver/config/config_file.hpp"

namespace fastsplat::analysis {
namespace {

using cmodel::IndexKind;

/// Bounds on the error of a field along the pixels, 1/255 of its mean; a and R are the kernel's, s is pixels per voxel.
struct AlignedBound {
  double steps = 0.0;  ///< table steps, all of one sign: aR^2/(2N) over the square, sqrt(pi a) R/(2N) over the distance
  double ripple =
      0.0;  ///< half a step of the grid on both axes, at the steepest of the field's ripple: 4 pi exp(-pi^2/a) / (s K)
  double rest =
      0.0;  ///< half a word in each of pi R^2 splats, of a mean of pi/a; and the edge weight of splats that lie on it
};
AlignedBound aligned_bound(const FamilyCell& cell, const scene::Kernel& kernel) {
  const double a = kernel.a(), R = kernel.radius(), pi = std::numbers::pi;
  const double N = cell.config.radial_entries, voxel = cell.radius / R;
  AlignedBound bound;
  if (cell.has_table)
    bound.steps = 255.0 * (cell.config.index() == IndexKind::Linear ? std::sqrt(pi * a) * R : a * R * R) / (2.0 * N);
  bound.ripple = 255.0 * 4.0 * pi * std::exp(-pi * pi / a) / (voxel * cell.config.grid());
  bound.rest = 255.0 * a * R * R * std::ldexp(0.5, -cell.config.radial_frac_bits) +
               255.0 * (a / pi) * 4.0 * R * std::exp(-a * R * R);
  return bound;
}

bool off(double measured, double predicted) { return measured > 2.0 * predicted || measured < predicted / 2.0; }

std::vector<Remark> remarks(const FamilyCell& cell, const scene::Kernel& kernel) {
  std::vector<Remark> out;
  const double turned = cell.turned.rms, aligned = cell.aligned.largest;
  if (off(turned, cell.snap_rms))
    out.push_back(off(turned, std::hypot(cell.snap_rms, cell.aligned.rms)) ? Remark::Unexplained : Remark::TableSteps);
  if (cell.has_table && off(aligned, cell.index_max)) {
    const AlignedBound bound = aligned_bound(cell, kernel);
    const bool explained = aligned > cell.index_max && aligned <= bound.steps + bound.ripple + bound.rest;
    out.push_back(!explained                                    ? Remark::Unexplained
                  : bound.ripple > bound.steps - cell.index_max ? Remark::Ripple
                                                                : Remark::Field);
  }
  if (off(static_cast<double>(cell.bits), cell.bits_predicted)) out.push_back(Remark::Padding);
  return out;
}

}  // namespace

FamilyRange whole_family() {
  return {.kinds = {IndexKind::Linear, IndexKind::Squared, IndexKind::SquaredElliptic, IndexKind::Blit2d,
                    IndexKind::Rlut, IndexKind::Separable},
          .grids = {4, 8, 16, 32, 64},
          .radii = {2, 4, 8},
          .entries = {64, 128, 256, 512, 1024, 2048},
          .timed = false};
}

cmodel::Config family_config(IndexKind kind, int grid, int radius, int entries) {
  cmodel::Config config = driver::load_config("base");
  config.index_kind = static_cast<int>(kind);
  config.phases = grid;
  if (!config.has_phases()) {
    config.position_frac_bits = cmodel::Config::log2_exact(grid);
    config.phases = 1;
  }
  config.rlut_columns = (2 * radius + config.lanes - 1) / config.lanes * config.lanes;
  config.radial_entries = entries;
  config.name = "base, " + name_of(kind);
  if (auto wrong = cmodel::first_violation(config)) throw_usage(*wrong);
  return config;
}

std::vector<FamilyCell> family_table(const FamilyRange& range) {
  const scene::Kernel kernel = scene::kernel_by_name("gauss2");
  std::map<int, std::pair<Lattice, Lattice>> lattices;
  for (const int radius : range.radii)
    lattices.try_emplace(radius, aligned_lattice(kernel, radius), turned_lattice(kernel, radius));
  std::vector<FamilyCell> cells;
  for (const IndexKind kind : range.kinds) {
    const bool has_table = has_radial_table(kind);
    for (const int radius : range.radii) {
      const auto& [aligned, turned] = lattices.at(radius);
      for (const int grid : range.grids) {
        for (const int entries : has_table ? range.entries : std::vector{range.entries.back()}) {
          FamilyCell cell;
          cell.config = family_config(kind, grid, radius, entries);
          cell.radius = radius;
          cell.has_table = has_table;
          cell.aligned = field_error(cell.config, kernel, aligned);
          cell.turned = field_error(cell.config, kernel, turned);
          cell.snap_rms = predicted_snap_rms(cell.config, radius / kernel.radius());
          cell.index_max = predicted_index_max(cell.config);
          cell.bits = storage_bits(cell.config, radius);
          cell.bits_predicted = predicted_bits(cell.config, radius);
          cell.operations = operations(cell.config, radius);
          cell.cycles = cycles_per_splat(cell.config, radius);
          if (range.timed) cell.nanoseconds = nanoseconds_per_splat(cell.config, kernel, turned);
          cell.remarks = remarks(cell, kernel);
          cells.push_back(std::move(cell));
        }
      }
    }
  }
  return cells;
}

char letter(Remark remark) {
  switch (remark) {
    case Remark::TableSteps:
      return 's';
    case Remark::Ripple:
      return 'r';
    case Remark::Field:
      return 'f';
    case Remark::Padding:
      return 'p';
    case Remark::Unexplained:
      break;
  }
  return '?';
}

std::string sentence(Remark remark) {
  switch (remark) {
    case Remark::TableSteps:
      return "the table's steps, which the snap's law leaves out, are larger than the grid's";
    case Remark::Ripple:
      return "the grid moves the whole lattice by up to half a step, and a field of Gaussians ripples: 4 pi "
             "exp(-pi^2/a) / (s K)";
    case Remark::Field:
      return "the index law bounds one splat; over a field the steps add up to sqrt(pi a) R / (2N) = 2.5/N";
    case Remark::Padding:
      return "footprints are padded to whole windows, and words have the device's widths";
    case Remark::Unexplained:
      break;
  }
  return "unexplained";
}

std::string name_of(IndexKind kind) { return cmodel::find_key("index.kind")->names[static_cast<std::size_t>(kind)]; }

IndexKind kind_of(const std::string& name) {
  cmodel::Config config;
  if (auto wrong = cmodel::set(config, "index.kind", name)) throw_usage(*wrong);
  return config.index();
}

}  // namespace fastsplat::analysis
