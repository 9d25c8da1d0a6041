// SPDX-License-Identifier: Apache-2.0
#include "cmodel/fast/frame_tables.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "cmodel/decode/stream_decode.hpp"
#include "cmodel/fast/row_kernel.hpp"
#include "cmodel/numbers/window_geometry.hpp"

namespace fastsplat::cmodel::fast {
namespace {

constexpr std::size_t kMemoBytes = std::size_t{1} << 28;
/// For index kinds other than rlut: filling in more footprints takes longer than drawing a few splats.
constexpr std::size_t kOtherMemoBytes = std::size_t{1} << 25;
constexpr int kWidest = 128;    ///< side of a footprint, pixels
constexpr int kTableSlack = 8;  ///< pixels that vectors may write beyond a row

/// The largest excess with which (tau + excess) * factor(tau) stays within 1.0 for every tau. Within a segment the
/// factor is at most its first word. Empty if 1.0 is exceeded without any excess.
std::optional<std::uint64_t> opacity_excess(const Config& config, std::span<const std::uint32_t> factor) {
  const int shift = config.opacity_remainder_bits();
  const std::uint64_t one = std::uint64_t{1} << (config.sheet_frac_bits + config.opacity_frac_bits);
  std::uint64_t excess = one;
  for (std::size_t i = 0; i + 1 < factor.size(); ++i) {
    const std::uint64_t largest = ((static_cast<std::uint64_t>(i) + 1) << shift) - 1;
    const std::uint64_t most = factor[i] == 0 ? 2 * one : (one - 1) / factor[i];
    if (factor[i] < factor[i + 1] || most < largest) return std::nullopt;
    excess = std::min(excess, most - largest);
  }
  return excess;
}

}  // namespace

std::optional<FrameTables> frame_tables(const Config& config, std::span<const Beat> preamble, const FrameNeeds& needs,
                                        const char** why_not) {
  const auto none = [why_not](const char* reason) {
    if (why_not != nullptr) *why_not = reason;
    return std::optional<FrameTables>{};
  };
  const auto plan = fast_plan(config, why_not);
  if (!plan) return {};
  if (!has_vectors()) return none("this processor lacks the required vector instructions");
  if (needs.ellipses && config.culls()) return none("splats are ellipses, and the device culls them");
  if (needs.ellipses && config.interpolates()) return none("splats are ellipses, and weights are interpolated");
  if (needs.tints) return none("sheets are tinted by a pattern");
  const auto samples = sample_plan(config, *plan, needs.samples ? why_not : nullptr);
  if (needs.samples && !samples) return {};
  WeightUnit unit = weight_unit(config);
  SlabOpacity opacity(config);
  std::uint32_t sets = 0;
  std::size_t bytes = 0;
  std::vector<std::uint32_t> radial, factor;
  std::optional<DensityStage> densities;
  BeginFrame frame{};
  StreamDecode decode(config, StreamScope::Subset);
  for (const Beat& beat : preamble) {
    const Record* record = decode.feed(beat);
    if (record != nullptr && std::holds_alternative<BeginFrame>(*record)) frame = std::get<BeginFrame>(*record);
    const auto* table = record == nullptr ? nullptr : std::get_if<LoadTable>(record);
    if (table == nullptr) continue;
    switch (table->table) {
      case Table::Rlut:
        std::visit([&](auto& kind) { kind.load(*table); }, unit);
        sets = std::max(sets, table->radius.set + 1);
        bytes += WeightMemo::bytes(config, table->radius.rho);
        if (static_cast<int>(window_geometry(config, table->radius.rho).padded) > kWidest)
          return none("a footprint is wider than 128 pixels");
        if (config.culls() && window_geometry(config, table->radius.rho).windows > 1)
          return none("the device culls windows of footprints larger than one window");
        if (bytes > (config.index() == IndexKind::Rlut ? kMemoBytes : kOtherMemoBytes))
          return none("the footprints at all grid positions exceed its memory");
        break;
      case Table::Radial:
        std::visit([&](auto& kind) { kind.load_radial(table->words); }, unit);
        radial = table->words;
        break;
      case Table::Factor:
        opacity.load(table->words);
        factor = table->words;
        break;
      case Table::Classify:
      case Table::Root:
      case Table::Glint:
      case Table::Lighting:
      case Table::Sheets:
      case Table::Nodes:
      case Table::Pattern:
        if (!densities) densities.emplace(config);
        densities->load(table->table, table->words);
        break;
    }
  }
  const auto excess = factor.empty() ? std::nullopt : opacity_excess(config, factor);
  FrameTables out{.config = config,
                  .plan = *plan,
                  .memo = WeightMemo(config, unit, sets, plan->weight_shift),
                  .opacity = opacity,
                  .opacity_holds = excess.has_value(),
                  .opacity_excess = excess.value_or(0),
                  .ellipses = config.interpolates() ? std::nullopt : ellipse_table(config, radial, plan->weight_shift),
                  .samples = std::nullopt,
                  .densities = std::move(densities),
                  .frame = frame,
                  .reach = kTableSlack};
  if (needs.ellipses && !out.ellipses)
    return none("an ellipse's position in the radial table is too wide for the vector lanes");
  std::uint32_t heaviest = out.ellipses ? out.ellipses->heaviest : 0;
  for (std::uint32_t set = 0; set < sets; ++set) {
    out.reach = std::max(out.reach, out.memo.shape(set).extent + kTableSlack);
    heaviest = std::max(heaviest, out.memo.shape(set).heaviest);
  }
  if (samples) out.samples = SampleTables{*samples, std::move(factor), heaviest << plan->weight_shift};
  return out;
}

}  // namespace fastsplat::cmodel::fast
