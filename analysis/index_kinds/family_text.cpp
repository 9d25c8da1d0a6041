// SPDX-License-Identifier: Apache-2.0
#include "analysis/index_kinds/family_text.hpp"

#include <fmt/format.h>

#include <set>

namespace fastsplat::analysis {
namespace {

std::string letters(const FamilyCell& cell) {
  std::string text;
  for (const Remark remark : cell.remarks) text += letter(remark);
  return text;
}

}  // namespace

std::string error_cells(const FieldError& e) {
  return fmt::format("{:.2f} | {:.2f} | {:+.2f}", e.largest, e.rms, e.bias);
}

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
    text += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {:.2f} | {} | {:.0f} | {} | {} |",
                        name_of(config.index()), cell.radius, config.grid(),
                        cell.has_table ? std::to_string(config.radial_entries) : "-", error_cells(cell.aligned),
                        cell.has_table ? fmt::format("{:.2f}", cell.index_max) : "-", error_cells(cell.turned),
                        cell.snap_rms, cell.bits, cell.bits_predicted, cell.cycles, letters(cell));
    text += timed ? fmt::format(" {:.0f} |\n", cell.nanoseconds) : "\n";
    met.insert(cell.remarks.begin(), cell.remarks.end());
  }
  if (!met.empty()) text += "\n";
  for (const Remark remark : met) text += fmt::format("- {}: {}\n", letter(remark), sentence(remark));
  return text;
}

}  // namespace fastsplat::analysis
