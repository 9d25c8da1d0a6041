#include "analysis/family/family_page.hpp"

#include <fmt/format.h>

#include <set>

namespace fastsplat::analysis {
namespace {

using cmodel::IndexKind;

std::string letters(const FamilyCell& cell) {
  std::string text;
  for (const Remark remark : cell.remarks) text += letter(remark);
  return text;
}

std::string error(const FieldError& e) { return fmt::format("{:.2f} | {:.2f} | {:+.2f}", e.largest, e.rms, e.bias); }

constexpr const char* kPreface = R"(# The family of FastSplats

A splat's weight at a pixel can be found in six ways ([numerics.md](numerics.md), section 4). What each costs and what it gets
wrong, by the weights of the model's units and the driver's tables against golden's exact footprint; kernel gauss2 (a = R = 2), words U 1.14, g = 6,
8 x 8 lanes. `fastsplat family --page` makes this page; `fastsplat family` has every cell, also with nanoseconds, `--json` for programs.

A field of constant value is splatted: on a lattice along the pixels at 61 x 61 offsets (**aligned**: all splats lie alike on the grid, so what shows are the table's
steps), and on one turned by 0.4 radians (**turned**: each splat lies elsewhere on the grid). Errors are of the field's mean, in 1/255: the largest, the root mean
square and the bias. K is the grid of the centres, steps a pixel: that of the snap, or of positions where nothing is snapped. r is the
support radius, pixels; a voxel is s = r/2 pixels. Beside the measurement stands what was predicted: rms of the snap 0.27/(s K), largest error of the table 4/N over
the squared distance and 1.213/N over the distance, bits T b, k E w + T b, k^2 E^2 b. What is off by more than a factor of two has a letter, explained below
the table. Products, sheets and compositing are the same for all kinds and not in these figures.

)";

std::string cost_table() {
  std::string text =
      "## What a pixel costs\n\nBy a device of the kind, r = 8, K = 64, N = 1024; with the product and its sum. Setup "
      "per splat is not "
      "counted. E is the extent, 2r.\n\n"
      "| kind | adds | multiplies | reads | root steps | bits | cycles a splat |  "
      "|\n|---|---|---|---|---|---|---|---|\n";
  for (const IndexKind kind : whole_family().kinds) {
    const auto config = family_config(kind, 64, 8, 1024);
    const Operations o = operations(config, 8);
    text += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} |\n", name_of(kind), o.adds, o.multiplies, o.reads,
                        o.root_steps, storage_bits(config, 8), cycles_per_splat(config, 8), o.formula);
  }
  auto once = family_config(IndexKind::Blit2d, 64, 8, 1024);
  once.index_symmetry = static_cast<int>(cmodel::IndexSymmetry::Eightfold);
  return text + fmt::format("\nblit2d with index.symmetry eightfold holds {} bits.\n\n", storage_bits(once, 8));
}

std::string errors(const char* title, FamilyRange range) {
  range.timed = false;
  return std::string("## ") + title + "\n\n" + family_text(family_table(range)) + "\n";
}

}  // namespace

std::string family_text(const std::vector<FamilyCell>& cells) {
  bool timed = false;
  for (const FamilyCell& cell : cells) timed = timed || cell.nanoseconds > 0.0;
  std::string text =
      "| kind | r | K | N | aligned max | rms | bias | index law | turned max | rms | bias | snap law | bits | "
      "predicted | cycles |  |";
  text += timed ? " ns |\n" : "\n";
  text += "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|";
  text += timed ? "---|\n" : "\n";
  std::set<Remark> met;
  for (const FamilyCell& cell : cells) {
    const cmodel::Config& config = cell.config;
    text +=
        fmt::format("| {} | {} | {} | {} | {} | {} | {} | {:.2f} | {} | {:.0f} | {} | {} |", name_of(config.index()),
                    cell.radius, config.grid(), cell.has_table ? std::to_string(config.radial_entries) : "-",
                    error(cell.aligned), cell.has_table ? fmt::format("{:.2f}", cell.index_max) : "-",
                    error(cell.turned), cell.snap_rms, cell.bits, cell.bits_predicted, cell.cycles, letters(cell));
    text += timed ? fmt::format(" {:.0f} |\n", cell.nanoseconds) : "\n";
    met.insert(cell.remarks.begin(), cell.remarks.end());
  }
  if (!met.empty()) text += "\n";
  for (const Remark remark : met) text += fmt::format("- {}: {}\n", letter(remark), sentence(remark));
  return text;
}

std::string family_page() {
  FamilyRange grids = whole_family(), lengths = grids;
  grids.entries = {1024};
  lengths.kinds = {IndexKind::Linear, IndexKind::Squared, IndexKind::Rlut};
  lengths.radii = {4};
  lengths.grids = {64};
  return kPreface + cost_table() + errors("Grids and radii", grids) + errors("Lengths of the table", lengths) +
         R"(## What follows

- Where centres lie matters before anything else: for less than 1/255 rms, s K of about 70, whatever the kind.
- A table over the distance is as good as one 1.6 times as long over its square (2.5/N against 4/N over a field; of a single splat 1.2/N against
  4/N), and costs a root and a multiplication a pixel.
- squared and rlut with as many phases as positions have make the same errors; rlut has all pixels at once for k E words, squared needs none.
- On a coarse grid exact squared distances fall on the very edges of table steps, half a step from the sample: squared and rlut are then
  biased, by up to 4/N.
- blit2d has the least error, for it has no index, and at r = 8 and K = 64 holds 480 times what rlut holds, 66 times with symmetry. separable has
  nearly that error for less than rlut holds, as long as kernels are Gaussians; its bias is the square's corners.
)";
}

}  // namespace fastsplat::analysis
