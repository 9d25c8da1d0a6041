// SPDX-License-Identifier: Apache-2.0
#include "tools/pages/family/family_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "analysis/index_kinds/ellipses.hpp"
#include "analysis/index_kinds/family_text.hpp"
#include "tools/pages/family/deck_claims.hpp"

namespace fastsplat::analysis {
namespace {

using cmodel::IndexKind;

constexpr const char* kPreface = R"(# The family of FastSplats

What each of the six footprint evaluation methods costs and how far it errs: for architects who
choose a kind of index. They are defined in [numerics.md](numerics.md), section 4. Conclusions are
[at the end](#what-follows).

`tools/family` makes this page and its pictures in a minute. `fastsplat family` prints every cell,
also with nanoseconds; `--json` is for programs.

Errors compare the weights of the model's units and the driver's tables with golden's exact
footprint: kernel gauss2 (a = R = 2), words U 1.14, g = 6, 8 x 8 lanes. A field of constant value is
splatted in two ways:

- **aligned**: on a lattice along the pixels at 61 x 61 offsets. All splats lie alike on the grid,
  so the table's steps show.
- **turned**: on a lattice turned by 0.4 radians. Each splat lies elsewhere on the grid.

Errors are of the field's mean, in 1/255: the largest, the root mean square and the bias. K is the
grid of the centres, steps a pixel: that of the snap, or of positions where nothing is snapped. r is
the support radius, pixels; a voxel is s = r/2 pixels.

Predictions stand beside the measurements:

- rms of the snap: 0.27/(s K);
- largest error of the table: 4/N over the squared distance and 1.213/N over the distance;
- bits: T b, k E w + T b, k^2 E^2 b.

A figure that is off by more than a factor of two has a letter, explained below the table. Products,
sheets and compositing are the same for all kinds and not in these figures.

)";

cmodel::Config eightfold(cmodel::Config config) {
  config.index_symmetry = static_cast<int>(cmodel::IndexSymmetry::Eightfold);
  return config;
}

std::string cost_table() {
  std::string text =
      "## What a pixel costs\n\nA device of the kind, r = 8, K = 64, N = 1024, with the product and its sum. Setup "
      "per splat is not counted. E is the extent, 2r.\n\n"
      "| kind | adds | multiplies | reads | root steps | bits | cycles a splat |  "
      "|\n|---|---|---|---|---|---|---|---|\n";
  for (const IndexKind kind : whole_family().kinds) {
    const auto config = family_config(kind, 64, 8, 1024);
    const Operations o = operations(config, 8);
    text += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} |\n", name_of(kind), o.adds, o.multiplies, o.reads,
                        o.root_steps, storage_bits(config, 8), cycles_per_splat(config, 8), o.formula);
  }
  const auto once = eightfold(family_config(IndexKind::Blit2d, 64, 8, 1024));
  return text + fmt::format("\nblit2d with index.symmetry eightfold holds {} bits.\n\n", storage_bits(once, 8));
}

std::string errors(const char* title, const std::vector<FamilyCell>& cells, bool (*wanted)(const FamilyCell&)) {
  std::vector<FamilyCell> some;
  for (const FamilyCell& cell : cells) {
    if (wanted(cell)) some.push_back(cell);
  }
  return std::string("## ") + title + "\n\n" + family_text(some) + "\n";
}

constexpr int kPageEntries = 1024, kPageRadius = 4, kPageGrid = 64;

bool of_the_grids(const FamilyCell& cell) { return !cell.has_table || cell.config.radial_entries == kPageEntries; }
bool of_the_lengths(const FamilyCell& cell) {
  return cell.has_table && cell.radius == kPageRadius && cell.config.grid() == kPageGrid &&
         cell.config.index() != IndexKind::SquaredElliptic;
}

/// Storage of blit2d relative to rlut, as text.
std::string what_blit_costs() {
  const auto times = [rlut =
                          storage_bits(family_config(IndexKind::Rlut, 64, 8, 1024), 8)](const cmodel::Config& config) {
    return static_cast<double>(storage_bits(config, 8)) / static_cast<double>(rlut);
  };
  const auto blit = family_config(IndexKind::Blit2d, 64, 8, 1024);
  return fmt::format(
      "- blit2d has the least error, because it has no index. At r = 8 and K = 64 it holds {:.0f} times as many bits "
      "as\n"
      "  rlut, {:.0f} times with symmetry.\n"
      "- separable has nearly that error for fewer bits than rlut, as long as kernels are Gaussians. Its bias is the\n"
      "  square's corners.\n",
      times(blit), times(eightfold(blit)));
}

constexpr const char* kPictures = R"(## Pictures

![The least error that each kind has with so many bits or fewer](images/family-bits.svg)

![The error of each kind over the grid of the centres](images/family-grid.svg)

)";

std::string ellipse_row(const std::string& what, const EllipseErrors& e, bool circles) {
  return fmt::format("| {} | {} | {:.2f} | {:.1f} | {} | {} | {:.4f} | {:.4f} |\n", what, e.splats, e.aspect, e.longest,
                     error_cells(e.ellipse), circles ? error_cells(e.circle) : "- | - | -", e.entries_off,
                     e.entries_bound);
}

std::string ellipse_section(const EllipseErrors& flat) {
  std::string text =
      R"(## Ellipses

squared_elliptic draws golden's elliptical footprints as words ([numerics.md](numerics.md), section
4.3), by the model's own unit, each splat elsewhere on the 1/64 pixel grid. Every weight is compared
with golden's, N = 1024, in 1/255 of the splat's peak. The columns of circles replace the same
splats by a circle of the nearest of 16 radius sets, with their energy.

The splats are voxels of shells:32 at 128 x 128 in perspective (about 500 of them), and 500 ellipses
spread over long half axes of 2 to 32 pixels, ratios to 16 and all angles. Off: furthest that the
words take q from the ellipse's own, in table entries; law: the limit of section 4.3. q is never
negative.

| ellipses | splats | aspect to | half axes to | ellipse max | rms | bias | circle max | rms | bias | off | law |
|---|---|---|---|---|---|---|---|---|---|---|---|
)";
  for (const double fov : {30.0, 60.0, 90.0, 120.0})
    text += ellipse_row(fmt::format("perspective, {:.0f} degrees", fov), perspective_ellipses(fov), true);
  return text + ellipse_row("spread", flat, false) + "\n";
}

}  // namespace

std::vector<FamilyCell> page_cells() {
  FamilyRange grids = whole_family(), lengths = grids;
  grids.entries = {kPageEntries};
  std::erase(lengths.entries, kPageEntries);
  lengths.kinds = {IndexKind::Linear, IndexKind::Squared, IndexKind::SquaredElliptic, IndexKind::Rlut};
  lengths.radii = {kPageRadius};
  auto cells = family_table(grids);
  const auto more = family_table(lengths);
  cells.insert(cells.end(), more.begin(), more.end());
  // Sorted by kind, radius, grid and length, like a single table.
  std::ranges::stable_sort(cells, [](const FamilyCell& a, const FamilyCell& b) {
    return std::tuple(a.config.index_kind, a.radius, a.config.grid(), a.config.radial_entries) <
           std::tuple(b.config.index_kind, b.radius, b.config.grid(), b.config.radial_entries);
  });
  return cells;
}

std::string family_page(const std::vector<FamilyCell>& cells, const std::string& head) {
  const EllipseErrors flat = spread_ellipses(16.0);
  return kPreface + cost_table() + kPictures + claims_section(deck_claims(cells, flat)) +
         errors("Grids and radii", cells, of_the_grids) + errors("Lengths of the table", cells, of_the_lengths) +
         ellipse_section(flat) + head +
         R"(## What follows

- The grid of the centres matters before anything else: less than 1/255 rms needs s K of about 70,
  whatever the kind.
- A table over the distance is as good as one 1.6 times as long over its square. (2.5/N against 4/N
  over a field; for a single splat 1.2/N against 4/N.) It costs a root and a multiplication a pixel.
- squared, and rlut with as many phases as positions have, make the same errors. rlut has all pixels
  at once for k E words; squared needs none.
- On a coarse grid exact squared distances fall on the very edges of table steps, half a step from
  the sample: squared and rlut are then biased, by up to 4/N.
)" + what_blit_costs() +
         R"(- In the head, too, the places cause nearly all of the error up to K = 64. All kinds' pictures err
  alike, and 256 table entries are always enough.
- Ellipses cost squared two words a set more than circles, and no accuracy: their weights are wrong
  by the table's steps. Circles in their place are wrong by more the wider the view.
)";
}

}  // namespace fastsplat::analysis
