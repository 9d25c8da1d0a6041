// SPDX-License-Identifier: Apache-2.0
#include "tools/pages/family/deck_claims.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.hpp"
#include "cmodel/numbers/index_set.hpp"
#include "cmodel/numbers/window_geometry.hpp"

namespace fastsplat::analysis {
namespace {

using cmodel::IndexKind;

constexpr int kClaimEntries = 1024, kFine = 64, kCoarse = 4;

class Cells {
 public:
  explicit Cells(const std::vector<FamilyCell>& cells) : cells_(cells) {}
  const FamilyCell& operator()(IndexKind kind, int radius = 4, int grid = kFine, int entries = kClaimEntries) const {
    for (const FamilyCell& cell : cells_) {
      if (cell.config.index() == kind && cell.radius == radius && cell.config.grid() == grid &&
          (!cell.has_table || cell.config.radial_entries == entries))
        return cell;
    }
    throw_usage({.where = "the family", .what = "unknown cell", .expected = {}, .got = name_of(kind), .fix = {}});
  }
  /// The kind's cell with the least error of the turned field at r = 4 within `bits` bits; null if all need more.
  const FamilyCell* best_within(IndexKind kind, std::uint64_t bits) const {
    const FamilyCell* best = nullptr;
    for (const FamilyCell& cell : cells_) {
      if (cell.config.index() != kind || cell.radius != 4 || cell.bits > bits) continue;
      if (best == nullptr || cell.turned.rms < best->turned.rms) best = &cell;
    }
    return best;
  }

 private:
  const std::vector<FamilyCell>& cells_;
};

/// Holds, InPart or Fails if all, some or none of `parts` hold.
Verdict verdict_of(std::initializer_list<bool> parts) {
  const auto held = std::count(parts.begin(), parts.end(), true);
  return held == static_cast<long>(parts.size()) ? Verdict::Holds : held > 0 ? Verdict::InPart : Verdict::Fails;
}

Claim controllable(const Cells& at) {
  const auto &coarse = at(IndexKind::Rlut, 4, kCoarse), &fine = at(IndexKind::Rlut);
  const auto &few = at(IndexKind::Squared, 4, kFine, 64), &many = at(IndexKind::Squared, 4, kFine, 2048);
  return {.slide = 51,
          .sentence = "We desire [...] minimum or controllable errors",
          .figures = fmt::format("places: rms {:.2f} at K = {}, {:.2f} at K = {} (rlut, turned); table: max {:.2f} at "
                                 "N = 64, {:.2f} at N = 2048 (squared, aligned); both as predicted",
                                 coarse.turned.rms, kCoarse, fine.turned.rms, kFine, few.aligned.largest,
                                 many.aligned.largest),
          .verdict = verdict_of(
              {fine.turned.rms < coarse.turned.rms / 8.0, many.aligned.largest < few.aligned.largest / 16.0})};
}

Claim ellipse_cost(const Cells& at, const EllipseErrors& ellipses) {
  const auto &circle = at(IndexKind::Squared), &ellipse = at(IndexKind::SquaredElliptic);
  const Operations &a = circle.operations, &b = ellipse.operations;
  return {
      .slide = 54,
      .sentence =
          "For elliptical kernels, if we define a canonical radius, the incremental scan-conversion still "
          "works at the same low cost",
      .figures = fmt::format("a pixel: {} adds and {} multiply for circles, {} and {} for ellipses; {} and {} cycles "
                             "a splat (r = 4), {} bits more. Weights of ellipses to 1 : {:.0f} are off by {:.2f} "
                             "at most. Half a step of the table is {:.2f}",
                             a.adds, a.multiplies, b.adds, b.multiplies, circle.cycles, ellipse.cycles,
                             ellipse.bits - circle.bits, ellipses.aspect, ellipses.ellipse.largest, circle.index_max),
      .verdict = verdict_of({a.adds == b.adds && a.multiplies == b.multiplies, circle.cycles == ellipse.cycles,
                             ellipses.ellipse.largest < 1.1 * circle.index_max, ellipses.least_q >= 0})};
}

Claim no_computation(const Cells& at) {
  const auto& blit = at(IndexKind::Blit2d);
  return {.slide = 56,
          .sentence = "No run-time computation",
          .figures = fmt::format("{} add and {} multiply a pixel: those of the product and its sum, which all kinds "
                                 "have; {} read",
                                 blit.operations.adds, blit.operations.multiplies, blit.operations.reads),
          .verdict = verdict_of({blit.operations.adds == 1 && blit.operations.multiplies == 1})};
}

Claim limited_storage(const Cells& at) {
  constexpr std::uint64_t kBits = 1 << 16;
  const FamilyCell *blit = at.best_within(IndexKind::Blit2d, kBits), *rlut = at.best_within(IndexKind::Rlut, kBits);
  const FamilyCell* axis = at.best_within(IndexKind::Separable, kBits);
  const bool all = blit != nullptr && rlut != nullptr && axis != nullptr;
  return {.slide = 58,
          .sentence = "When storage is limited, the quality is limited too",
          .figures = all ? fmt::format("with at most {} bits (r = 4, turned rms): blit2d {:.2f} (K = {}), rlut {:.2f} "
                                       "(K = {}), separable {:.2f} (K = {})",
                                       kBits, blit->turned.rms, blit->config.grid(), rlut->turned.rms,
                                       rlut->config.grid(), axis->turned.rms, axis->config.grid())
                         : std::string("no kind fits"),
          .verdict = verdict_of({all && blit->turned.rms > 2.0 * rlut->turned.rms})};
}

Claim finer_parallelism(const Cells& at) {
  const auto &line = at(IndexKind::Squared, 8), &window = at(IndexKind::Rlut, 8);
  return {.slide = 60,
          .sentence = "For hardware, we need finer parallelism than scan-line",
          .figures = fmt::format("cycles a splat (r = 8): {} along scan lines (squared), {} by windows (rlut), for {} "
                                 "bits more",
                                 line.cycles, window.cycles, window.bits - line.bits),
          .verdict = verdict_of({line.cycles >= 4 * window.cycles})};
}

Claim one_set(const Cells& at) {
  const auto& rlut = at(IndexKind::Rlut);
  const auto rho = static_cast<std::uint32_t>(rlut.radius * rlut.config.grid());
  const auto words = cmodel::set_words(rlut.config, rho);
  const auto extent = cmodel::window_geometry(rlut.config, rho).padded;
  return {.slide = 79,
          .sentence =
              "Due to symmetry, the RLUT set for x component is the same as the RLUT set for the y component; "
              "one RLUT set, k 1D tables, each of splat_extent length",
          .figures = fmt::format("{} words at r = 4: {} tables of {}; x and y read the same", words, rlut.config.phases,
                                 extent),
          .verdict = verdict_of({words == std::int64_t{rlut.config.phases} * extent})};
}

Claim linear(const Cells& at) {
  const auto &own = at(IndexKind::Linear), &squared = at(IndexKind::Squared), &rlut = at(IndexKind::Rlut);
  return {.slide = 80,
          .sentence = "1D Linear very accurate, compact, slow",
          .figures = fmt::format("max {:.2f} of {:.2f} for the square's table (aligned, N = {}), but {:.2f} and {:.2f} "
                                 "rms turned, where places rule. {} bits. {} cycles a splat where squared takes {} "
                                 "and rlut {} (r = 4), with {} root steps a pixel",
                                 own.aligned.largest, squared.aligned.largest, kClaimEntries, own.turned.rms,
                                 squared.turned.rms, own.bits, own.cycles, squared.cycles, rlut.cycles,
                                 own.operations.root_steps),
          .verdict = verdict_of({(own.aligned.largest < 0.75 * squared.aligned.largest), own.bits <= rlut.bits,
                                 (own.cycles > 4 * squared.cycles)})};
}

Claim squared(const Cells& at) {
  const auto &own = at(IndexKind::Squared), &linear_cell = at(IndexKind::Linear), &rlut = at(IndexKind::Rlut);
  return {.slide = 80,
          .sentence = "1D Squared accurate, compact, fast",
          .figures = fmt::format("max {:.2f}, rms {:.2f} (aligned), rms {:.2f} (turned). {} bits. {} cycles a splat "
                                 "for linear's {}, though rlut takes {} (r = 4)",
                                 own.aligned.largest, own.aligned.rms, own.turned.rms, own.bits, own.cycles,
                                 linear_cell.cycles, rlut.cycles),
          .verdict = verdict_of({own.aligned.rms < 1.0 && own.turned.rms < 1.0, own.bits <= linear_cell.bits,
                                 own.cycles * 4 < linear_cell.cycles})};
}

Claim rlut(const Cells& at) {
  const auto &own = at(IndexKind::Rlut), &squared_cell = at(IndexKind::Squared), &blit = at(IndexKind::Blit2d);
  return {.slide = 80,
          .sentence = "1D RLUT accurate, compact, intended for hardware",
          .figures = fmt::format("rms {:.2f} (turned), squared has {:.2f}. {} bits, {:.1f} times squared's, 1/{} of "
                                 "blit2d's. {} cycle a splat, {} adds and {} multiply a pixel (r = 4)",
                                 own.turned.rms, squared_cell.turned.rms, own.bits,
                                 static_cast<double>(own.bits) / static_cast<double>(squared_cell.bits),
                                 blit.bits / own.bits, own.cycles, own.operations.adds, own.operations.multiplies),
          .verdict = verdict_of({own.turned.rms < 1.0 && own.turned.rms <= 1.01 * squared_cell.turned.rms,
                                 10 * own.bits < blit.bits, own.cycles < squared_cell.cycles})};
}

Claim blit(const Cells& at) {
  const auto &fine = at(IndexKind::Blit2d), &rlut_cell = at(IndexKind::Rlut);
  const FamilyCell* compact = at.best_within(IndexKind::Blit2d, rlut_cell.bits);
  const double both = compact == nullptr ? 0.0 : compact->turned.rms;
  return {.slide = 80,
          .sentence = "2D FastSplat can be very fast, accurate and compact under constrained conditions",
          .figures = fmt::format("{} cycle a splat. At K = {} max {:.2f} (aligned), rms {:.2f} (turned), the least of "
                                 "all, in {} bits. With rlut's {} bits at most rms {:.2f}, where rlut has {:.2f} (r = "
                                 "4). Accurate or compact, unless the condition is that places are few",
                                 fine.cycles, kFine, fine.aligned.largest, fine.turned.rms, fine.bits, rlut_cell.bits,
                                 both, rlut_cell.turned.rms),
          .verdict = verdict_of({fine.cycles <= rlut_cell.cycles, fine.aligned.largest < rlut_cell.aligned.largest,
                                 compact != nullptr && both < 2.0 * rlut_cell.turned.rms})};
}

}  // namespace

std::vector<Claim> deck_claims(const std::vector<FamilyCell>& cells, const EllipseErrors& ellipses) {
  const Cells at(cells);
  return {controllable(at),
          ellipse_cost(at, ellipses),
          no_computation(at),
          limited_storage(at),
          finer_parallelism(at),
          one_set(at),
          linear(at),
          squared(at),
          rlut(at),
          blit(at)};
}

std::string claims_section(const std::vector<Claim>& claims) {
  std::string text =
      "## What the deck says\n\nSentences of the first lecture deck, each with a verdict and its figures; K = 64 and N "
      "= "
      "1024 unless noted, errors in 1/255.\n\n";
  for (const Claim& claim : claims)
    text += fmt::format("- Slide {}, \"{}\": **{}**. Figures: {}.\n", claim.slide, claim.sentence,
                        to_string(claim.verdict), claim.figures);
  return text + "\n";
}

const char* to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::Holds:
      return "holds";
    case Verdict::InPart:
      return "holds in part";
    case Verdict::Fails:
      break;
  }
  return "does not hold";
}

}  // namespace fastsplat::analysis
