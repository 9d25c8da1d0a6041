// SPDX-License-Identifier: Apache-2.0
#include "golden/depth_of_field_sheets.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.hpp"

namespace fastsplat::golden {
namespace {

void add(Layer& to, const Layer& layer, double weight) {
  to.red += weight * layer.red;
  to.green += weight * layer.green;
  to.blue += weight * layer.blue;
  to.alpha += weight * layer.alpha;
}

}  // namespace

DepthOfFieldSheets::DepthOfFieldSheets(const scene::Lens& lens, const SheetGeometry& geometry) {
  for (int sheet = 0; sheet < geometry.sheets(); ++sheet) {
    const double diameter = scene::circle_of_confusion(geometry.camera(), lens, geometry.depth_mm(sheet));
    if (!(diameter > 0.0)) continue;
    // The table of weights grows with the disc. Under a disc wider than the picture nothing is recognisable.
    const int side = std::max(geometry.camera().width(), geometry.camera().height());
    if (!(diameter <= side)) {
      throw_usage({.where = "lens.aperture",
                   .what = "circles of confusion are wider than the picture",
                   .expected = fmt::format("at most {} pixels", side),
                   .got = fmt::format("{:.6g}", diameter),
                   .fix = "lower --aperture, or use --depth-of-field splats"});
    }
    margin_ = std::max(margin_, discs_.emplace(sheet, DiscFilter(diameter)).first->second.reach());
  }
}

Run DepthOfFieldSheets::extent(int sheet, const LayerFrame& in, int y) const {
  const DiscFilter& disc = discs_.at(sheet);
  Run run{in.width, 0};
  const int rows = static_cast<int>(in.runs.size());
  for (int from = std::max(y - disc.reach(), 0); from <= std::min(y + disc.reach(), rows - 1); ++from) {
    if (in.runs[from].empty()) continue;
    const int reach = disc.row_reach(from - y);
    run = {std::min(run.begin, in.runs[from].begin - reach), std::max(run.end, in.runs[from].end + reach)};
  }
  return {std::max(run.begin, 0), std::min(run.end, in.width)};
}

void DepthOfFieldSheets::row(int sheet, const LayerFrame& in, int y, int begin, std::span<Layer> out) const {
  const DiscFilter& disc = discs_.at(sheet);
  const int rows = static_cast<int>(in.runs.size());
  const int end = begin + static_cast<int>(out.size());
  std::fill(out.begin(), out.end(), Layer{});
  for (int from = std::max(y - disc.reach(), 0); from <= std::min(y + disc.reach(), rows - 1); ++from) {
    const double* weights = disc.half_row(from - y);
    const int reach = disc.row_reach(from - y);
    for (int x = in.runs[from].begin; x < in.runs[from].end; ++x) {
      const Layer& layer = in.row(from)[x];
      if (!(layer.alpha > 0.0)) continue;
      const int first = std::max(x - reach, begin), last = std::min(x + reach, end - 1);
      for (int to = first; to <= last; ++to) add(out[to - begin], layer, weights[std::abs(to - x)]);
    }
  }
}

}  // namespace fastsplat::golden
