// SPDX-License-Identifier: Apache-2.0
#include "testbench/stimulus/random_cull_blocks.hpp"

#include <algorithm>
#include <utility>

#include "cmodel/cull/cull_sets.hpp"
#include "cmodel/cull/cull_table.hpp"
#include "cmodel/numbers/window_geometry.hpp"
#include "cmodel/splat/ellipse_unit.hpp"
#include "cmodel/splat/snap.hpp"

namespace fastsplat::testbench {
namespace {

using cmodel::PixelBox;

/// All windows of the record.
PixelBox box_of(const cmodel::Config& config, const std::array<std::uint32_t, 256>& rho, const SheetRecord& record) {
  if (const auto* splat = std::get_if<cmodel::SplatRecord>(&record)) {
    const std::int64_t x = cmodel::snap(config, splat->x, rho[splat->set]).origin,
                       y = cmodel::snap(config, splat->y, rho[splat->set]).origin,
                       side = cmodel::window_geometry(config, rho[splat->set]).padded;
    return {x, y, x + side, y + side};
  }
  const auto& shaped = std::get<cmodel::EllipseRecord>(record);
  const std::int64_t x = cmodel::ellipse_axis(config, shaped.x, shaped.windows.left).origin,
                     y = cmodel::ellipse_axis(config, shaped.y, shaped.windows.top).origin;
  return {x, y, x + std::int64_t{shaped.windows.columns} * config.lanes,
          y + std::int64_t{shaped.windows.rows} * config.lanes};
}

PixelBox around(const PixelBox& a, const PixelBox& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  return {std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)};
}

}  // namespace

void add_cull_blocks(const cmodel::Config& config, Random& random, const cmodel::BeginTile& tile,
                     const std::array<std::uint32_t, 256>& rho, SheetDocument& sheet) {
  const std::vector<SheetRecord> splats = std::exchange(sheet.records, {});
  const bool in_front = random.chance(50);  // all that there is room for
  const auto room = static_cast<std::size_t>(cmodel::cull_sets(config));
  std::vector<std::size_t> ends;  // of sets with splats to come
  std::size_t promised = 0;
  for (std::size_t at = 0; at <= splats.size(); ++at) {
    std::erase_if(ends, [&](std::size_t end) { return end <= at; });
    promised = std::max(promised, at);
    while (ends.size() < room && random.chance(in_front && promised < splats.size() ? 95 : 10)) {
      const std::size_t count =
          std::min(splats.size() - promised, static_cast<std::size_t>(random.between(0, random.between(1, 12))));
      // A stream invariant covers pixels of the tile only; every third rectangle has the pixels outside, too.
      const bool across = (promised + count) % 3 == 0;
      PixelBox box;
      for (std::size_t i = promised; i < promised + count; ++i) {
        const PixelBox whole = box_of(config, rho, splats[i]), clipped = whole.clipped(tile.width, tile.height);
        if (!clipped.empty()) box = around(box, across ? whole : clipped);
      }
      if (random.chance(10)) box = around(box, {0, 0, tile.width, tile.height});
      if (box.empty()) box = {-5, 3, -4, 4};
      sheet.records.emplace_back(cmodel::CullBlock{.tag = 0,
                                                   .x = static_cast<std::int32_t>(box.x0),
                                                   .y = static_cast<std::int32_t>(box.y0),
                                                   .width = static_cast<int>(box.x1 - box.x0),
                                                   .height = static_cast<int>(box.y1 - box.y0),
                                                   .splats = static_cast<std::uint32_t>(count)});
      promised += count;
      if (count > 0) ends.push_back(promised);
    }
    if (at < splats.size()) sheet.records.push_back(splats[at]);
  }
}

}  // namespace fastsplat::testbench
