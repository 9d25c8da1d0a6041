// SPDX-License-Identifier: Apache-2.0
#include "tools/pages/family/family_plots.hpp"

#include <algorithm>

#include "tools/pages/family/plot.hpp"

namespace fastsplat::analysis {
namespace {

constexpr int kPlotRadius = 4, kPlotEntries = 1024;

/// Cells of one kind at one radius.
std::vector<const FamilyCell*> of_kind(const std::vector<FamilyCell>& cells, cmodel::IndexKind kind) {
  std::vector<const FamilyCell*> out;
  for (const FamilyCell& cell : cells) {
    if (cell.config.index() == kind && cell.radius == kPlotRadius) out.push_back(&cell);
  }
  return out;
}

/// By increasing bits, the cells with a smaller error than all cells of fewer bits.
PlotSeries front(cmodel::IndexKind kind, std::vector<const FamilyCell*> cells) {
  std::ranges::sort(cells, [](const FamilyCell* a, const FamilyCell* b) {
    return a->bits != b->bits ? a->bits < b->bits : a->turned.rms < b->turned.rms;
  });
  PlotSeries series{.name = name_of(kind), .points = {}};
  double best = 1e300;
  for (const FamilyCell* cell : cells) {
    if (cell->turned.rms >= best) continue;
    best = cell->turned.rms;
    series.points.emplace_back(static_cast<double>(cell->bits), best);
  }
  return series;
}

PlotSeries over_grids(cmodel::IndexKind kind, const std::vector<const FamilyCell*>& cells) {
  PlotSeries series{.name = name_of(kind), .points = {}};
  for (const FamilyCell* cell : cells) {
    if (!cell->has_table || cell->config.radial_entries == kPlotEntries)
      series.points.emplace_back(cell->config.grid(), cell->turned.rms);
  }
  return series;
}

}  // namespace

std::vector<NamedPicture> family_plots(const std::vector<FamilyCell>& cells) {
  Plot bits{.title = "Least error with so many bits or fewer (r = 4, any K and N)",
            .x_axis = "storage of one radius set and the radial table, bits",
            .y_axis = "error of the turned field, rms, 1/255 of its mean",
            .series = {}};
  Plot grids{.title = "Error over the grid of the centres (r = 4, N = 1024)",
             .x_axis = "K, steps a pixel",
             .y_axis = "error of the turned field, rms, 1/255 of its mean",
             .x_ticks = {4, 8, 16, 32, 64},
             .series = {}};
  for (const cmodel::IndexKind kind : whole_family().kinds) {
    const auto own = of_kind(cells, kind);
    bits.series.push_back(front(kind, own));
    grids.series.push_back(over_grids(kind, own));
  }
  return {{kFamilyPictures[0], to_svg(bits)}, {kFamilyPictures[1], to_svg(grids)}};
}

}  // namespace fastsplat::analysis
