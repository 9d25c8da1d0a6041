// SPDX-License-Identifier: Apache-2.0
#include "analysis/errors/suggestion.hpp"

#include <algorithm>

namespace fastsplat::analysis {
namespace {

using cmodel::Config;
using stages::Step;

/// Transmittance words get finer; the early-termination threshold stays.
void finer_picture(Config& config) {
  config.composite_frac_bits += 2;
  config.freeze_below *= 4;
}

void finer_phases(Config& config) {
  config.phases *= 4;
  config.position_frac_bits = std::max(config.position_frac_bits, config.phase_bits());
}

void finer_factor(Config& config) {
  config.opacity_segments *= 4;
  config.opacity_frac_bits = std::min(config.opacity_frac_bits + 2, 16);
}

void apply(Step step, Config& config) {
  switch (step) {
    case Step::Position:  // if the snap is a separate step
      config.position_frac_bits += 2;
      return;
    case Step::Snap:
      return finer_phases(config);
    case Step::Radius:
      config.rlut_columns *= 2;
      config.rlut_sets *= 2;
      return;
    case Step::Emission:
    case Step::Share:
      config.colour_frac_bits += 2;
      return;
    case Step::Depth:
      config.slice_phase_bits += 2;
      return;
    case Step::Phi:
      config.slice_frac_bits += 2;
      return;
    case Step::Distance:
      config.rlut_guard_bits += 2;
      return;
    case Step::Index:
      config.radial_entries *= 4;
      return;
    case Step::Weight:
      config.radial_frac_bits += 2;
      return;
    case Step::Product:
      config.sheet_frac_bits += 2;
      return;
    case Step::Sheet:
      config.sheet_int_bits += 1;
      return;
    case Step::Transfer:
      config.classify_segment_bits += 2;
      return;
    case Step::Colour:  // also refines the words of densities
      config.sheet_frac_bits += 2;
      return;
    case Step::Slope:
    case Step::Normal:
    case Step::Facing:
    case Step::Phong:
    case Step::Blend:
    case Step::Shaded:  // no key decides their formats
      return;
    case Step::Factor:
      return finer_factor(config);
    case Step::Slab:
    case Step::Composite:
      return finer_picture(config);
    case Step::Freeze:
      config.freeze_below /= 4;
      return;
    case Step::Pixel:
      config.pixel_frac_bits += 2;
      return;
  }
}

}  // namespace

std::string changes(const Config& from, const Config& to) {
  std::string text;
  for (const cmodel::ConfigKey& key : cmodel::config_keys()) {
    if (from.*key.member == to.*key.member) continue;
    text += (text.empty() ? "" : ", ") + std::string(key.name) + " " + cmodel::text_of(from, key) + " -> " +
            cmodel::text_of(to, key);
  }
  return text;
}

std::optional<Suggestion> suggestion(Step step, const Config& config, bool gaussians) {
  Suggestion out{config, {}};
  if (gaussians && step == Step::Snap) step = Step::Position;  // ellipses are not snapped
  apply(step, out.config);
  // One more bit where two exceed the limits.
  if (step == Step::Position && cmodel::first_violation(out.config)) --out.config.position_frac_bits;
  if (cmodel::first_violation(out.config) || out.config == config) return std::nullopt;
  out.changes = changes(config, out.config);
  out.config.name += "+";
  return out;
}

}  // namespace fastsplat::analysis
