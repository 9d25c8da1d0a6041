// SPDX-License-Identifier: Apache-2.0
#include "analysis/errors/energy.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "analysis/errors/cost.hpp"

namespace fastsplat::analysis {
namespace {

/// Of a bit of a memory of `bits`.
Joules memory(double bits) {
  const auto row = std::ranges::find_if(kMemoryEnergy, [&](const auto& one) { return bits <= 8.0 * one.bytes; });
  return row == kMemoryEnergy.end() ? kMemoryEnergy.back().bit : row->bit;
}

/// How often something happens, least and most.
struct Times {
  double low, high;
};
Times always(std::uint64_t count) { return {static_cast<double>(count), static_cast<double>(count)}; }

Joules times(const Times& events, double units, const Joules& one) {
  return {events.low * units * one.low, events.high * units * one.high};
}
Joules arithmetic(const Times& events, const Arithmetic& one) {
  return times(events, one.adder_bits + one.multiplier_bits, kCellEnergy);
}
Joules operator+(Joules a, const Joules& b) { return a += b; }

}  // namespace

std::string energy_violation(const cmodel::Config& config, cmodel::Mode mode) {
  if (config.index() != cmodel::IndexKind::Rlut) return "the cost model covers index.kind rlut alone";
  if (cmodel::holds_densities(mode)) return "the cost model leaves out classification by pixel";
  return {};
}

std::vector<EnergyPart> energy(const cmodel::Config& device, const Activity& activity) {
  cmodel::Config config = device;
  if (!activity.ellipses) config.ellipse_frac_bits = 0;
  const cmodel::Counters& n = activity.counters;
  const EventArithmetic one = event_arithmetic(config);
  const Memories m = memories(config);
  const double lanes = static_cast<double>(config.lanes) * config.lanes,
               tile = static_cast<double>(config.tile_width) * config.tile_height;
  const bool samples = cmodel::every_sample(activity.mode), sums = activity.mode == cmodel::Mode::Sum;
  const Times splats = always(n.splats), windows = always(n.windows),
              delivered = always(activity.bytes_out / cmodel::kPixelBytes);
  const Times weighted{static_cast<double>(n.lanes_weighted), windows.high * lanes};
  // Lanes composite their own samples; else the pixels of dirty blocks.
  const Times composited{static_cast<double>(n.pixels_composited - n.frozen_pixels),
                         samples ? weighted.high : static_cast<double>(n.dirty_blocks) * lanes};

  // Bits of a word, four channels together, and of a bank: lanes and composited pixels have one each.
  const double sheet = m.sheet_bits / (2.0 * tile), picture = m.picture_bits / tile;
  const Joules sheet_bit = memory(m.sheet_bits / (2.0 * lanes)),
               picture_bit = memory(m.picture_bits / config.composited_at_once());
  // A window reads P words of the RLUT for each axis; an ellipse none. An X-ray has no slab factor and adds four sums.
  const double rlut =
      activity.ellipses ? 0.0 : 2.0 * config.lanes * m.rlut_bits / (config.rlut_columns * config.phases);
  const double radial = m.radial_bits / config.radial_entries,
               factor = sums ? 0.0 : m.factor_bits / config.opacity_segments;
  return {{"stream", times(always(8 * activity.bytes_in), 1.0, kDramEnergy)},
          {"positions", arithmetic(splats, one.splat) + arithmetic(windows, one.window)},
          {"tables", times(windows, rlut, memory(m.rlut_bits)) + times(weighted, radial, memory(m.radial_bits)) +
                         times(composited, factor, memory(m.factor_bits))},
          {"weights", arithmetic(weighted, one.weight)},
          {"products", arithmetic(weighted, one.product)},
          {"sums", samples ? Joules{} : arithmetic(weighted, one.sum)},
          // Read and written by lanes; read and cleared by the compositor.
          {"sheets",
           samples ? Joules{} : times(weighted, 2.0 * sheet, sheet_bit) + times(composited, 2.0 * sheet, sheet_bit)},
          {"compositing", arithmetic(composited, sums ? Arithmetic{.adder_bits = picture} : one.composited)},
          // Read and written by the compositor, read at the end.
          {"picture", times(composited, 2.0 * picture, picture_bit) + times(delivered, picture, picture_bit)},
          {"output", arithmetic(delivered, one.output)},
          {"pixels", times(always(8 * activity.bytes_out), 1.0, kDramEnergy)}};
}

Joules total(const std::vector<EnergyPart>& parts) {
  Joules out;
  for (const EnergyPart& part : parts) out += part.joules;
  return out;
}

nlohmann::ordered_json to_json(const std::vector<EnergyPart>& parts) {
  const auto range = [](const Joules& joules) {
    return nlohmann::ordered_json{{"low_uj", 1e6 * joules.low}, {"high_uj", 1e6 * joules.high}};
  };
  nlohmann::ordered_json json = range(total(parts));
  for (const EnergyPart& part : parts) json["parts"][part.name] = range(part.joules);
  return json;
}

}  // namespace fastsplat::analysis
