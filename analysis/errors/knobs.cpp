// SPDX-License-Identifier: Apache-2.0
#include "analysis/errors/knobs.hpp"

#include <algorithm>
#include <array>

#include "cmodel/rtl_package/sv_package.hpp"

namespace fastsplat::analysis {
namespace {

using cmodel::Config;

constexpr std::array kKnobs{
    Knob{"snap.phases", &Config::phases},
    Knob{"position.frac_bits", &Config::position_frac_bits},
    Knob{"rlut.guard_bits", &Config::rlut_guard_bits},
    Knob{"radial.entries", &Config::radial_entries},
    Knob{"radial.frac_bits", &Config::radial_frac_bits},
    Knob{"colour.frac_bits", &Config::colour_frac_bits},
    Knob{"slices.phase_bits", &Config::slice_phase_bits},
    Knob{"slices.frac_bits", &Config::slice_frac_bits},
    Knob{"sheet.int_bits", &Config::sheet_int_bits},
    Knob{"sheet.frac_bits", &Config::sheet_frac_bits},
    Knob{"opacity.segments", &Config::opacity_segments},
    Knob{"opacity.frac_bits", &Config::opacity_frac_bits},
    Knob{"composite.frac_bits", &Config::composite_frac_bits},
    Knob{"pixel.frac_bits", &Config::pixel_frac_bits},
    Knob{"composite.freeze_below", &Config::freeze_below},
};
constexpr std::size_t kPhases = 0, kFreeze = kKnobs.size() - 1;

}  // namespace

std::span<const Knob> knobs() { return kKnobs; }
std::size_t freeze_knob() { return kFreeze; }

std::optional<Config> turned(const Config& from, const Steps& steps) {
  Config out = from;
  for (std::size_t k = 0; k < kFreeze; ++k) {
    int& value = out.*kKnobs[k].member;
    if (!cmodel::find_key(kKnobs[k].key)->power_of_two) {
      value += steps[k];
      continue;
    }
    const int log2 = Config::log2_exact(value) + steps[k];
    if (log2 < 0 || log2 > 16) return std::nullopt;
    value = 1 << log2;
  }
  out.position_frac_bits += steps[kPhases];
  // The early-termination level: as before, halved once per step of the knob. Words too short for it use their least
  // value above 0.
  if (steps[kFreeze] < 0 || out.composite_frac_bits < 1) return std::nullopt;
  const int shift = out.composite_frac_bits - from.composite_frac_bits - steps[kFreeze];
  if (from.freeze_below > 0) {
    const long long level = shift >= 0 ? static_cast<long long>(from.freeze_below) << std::min(shift, 30)
                                       : static_cast<long long>(from.freeze_below) >> std::min(-shift, 30);
    out.freeze_below = static_cast<int>(std::min<long long>(level, 1 << 20));
    if (out.freeze_below == 0 && steps[kFreeze] == 0) out.freeze_below = 1;
  } else if (steps[kFreeze] != 0) {
    return std::nullopt;
  }
  if (cmodel::first_violation(out)) return std::nullopt;
  if (cmodel::rtl_violation(out) && !cmodel::rtl_violation(from)) return std::nullopt;
  return out;
}

}  // namespace fastsplat::analysis
