// SPDX-License-Identifier: Apache-2.0
#include "analysis/errors/energy.hpp"

#include <nlohmann/json.hpp>

#include "analysis/errors/cost.hpp"

namespace fastsplat::analysis {
namespace {

// Picojoules by M. Horowitz, "Computing's energy problem", ISSCC 2014 (45 nm, 0.9 V), and N. P. Jouppi et al., "Ten
// lessons from three generations shaped Google's TPUv4i", ISCA 2021 (7 nm).

/// Of a full adder or a multiplier's cell: sums of 8 bits 0.007 pJ (7 nm) and 0.03 (45 nm), of 32 bits 0.03 and 0.1;
/// products of 8 bits 0.07 and 0.2, of 32 bits 1.48 and 3.1, by their 64 and 1024 cells: the least and the greatest.
constexpr Joules kCell{0.007e-12 / 8, 0.03e-12 / 8};
/// Of a bit of DRAM, from accesses of 64 bits: HBM2 250 pJ, DDR3 2600.
constexpr Joules kDram{250e-12 / 64, 2600e-12 / 64};

/// Of a bit of a memory of `bits`: an access of 64 bits to 8 KB takes 7.5 and 10 pJ, 32 KB 8.5 and 20, 1 MB 14 and 100.
/// Smaller memories count as 8 KB.
Joules sram(double bits) {
  const double bytes = bits / 8.0;
  if (bytes <= 8192.0) return {7.5e-12 / 64, 10e-12 / 64};
  if (bytes <= 32768.0) return {8.5e-12 / 64, 20e-12 / 64};
  return {14e-12 / 64, 100e-12 / 64};
}

/// How often something happens, least and most.
struct Times {
  double low, high;
};
Times always(double count) { return {count, count}; }

Joules times(const Times& events, double units, const Joules& one) {
  return {events.low * units * one.low, events.high * units * one.high};
}
Joules arithmetic(const Times& events, const Arithmetic& one) {
  return times(events, one.adder_bits + one.multiplier_bits, kCell);
}
Joules sum(Joules a, const Joules& b) { return a += b; }

}  // namespace

std::string no_energy(const cmodel::Config& config, cmodel::Mode mode) {
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
  const double lanes = static_cast<double>(config.lanes) * config.lanes;
  const bool samples = cmodel::every_sample(activity.mode), sums = activity.mode == cmodel::Mode::Sum;
  const Times splats = always(static_cast<double>(n.splats)), windows = always(static_cast<double>(n.windows)),
              used{static_cast<double>(n.lanes_weighted), windows.high * lanes},
              // Lanes composite their own samples; else the pixels of dirty blocks.
      pixels{static_cast<double>(n.pixels_composited - n.frozen_pixels),
             samples ? used.high : static_cast<double>(n.dirty_blocks) * lanes},
              left = always(static_cast<double>(activity.bytes_out) / cmodel::kPixelBytes);

  // An X-ray composites by four sums. A splat reads a row of P words of the RLUT for each axis and window.
  const double word = m.sheet_bits / (2.0 * config.tile_width * config.tile_height),
               pixel = m.picture_bits / (static_cast<double>(config.tile_width) * config.tile_height);
  const double rlut_words = 2.0 * m.rlut_bits / (config.rlut_columns * config.phases) * config.lanes;
  const Arithmetic composited = sums ? Arithmetic{.adder_bits = pixel} : one.composited;
  const Joules sheet = sram(m.sheet_bits / 2.0 / lanes), picture = sram(m.picture_bits / config.composited_at_once());
  const double radial_word = m.radial_bits / config.radial_entries,
               factor_word = m.factor_bits / config.opacity_segments;
  std::vector<EnergyPart> parts{
      {"stream", "beats, from DRAM", times(always(8.0 * static_cast<double>(activity.bytes_in)), 1.0, kDram)},
      {"positions", "arithmetic of splats and windows",
       sum(arithmetic(splats, one.splat), arithmetic(windows, one.window))},
      {"tables", "RLUT, radial table and slab factors, read",
       sum(times(windows, activity.ellipses ? 0.0 : rlut_words, sram(m.rlut_bits)),
           sum(times(used, radial_word, sram(m.radial_bits)),
               times(pixels, sums ? 0.0 : factor_word, sram(m.factor_bits))))},
      {"weights", "of all lanes", arithmetic(used, one.weight)},
      {"products", "colour and optical depth times weight", arithmetic(used, one.product)},
      {"sums", "in the sheet", samples ? Joules{} : arithmetic(used, one.sum)},
      {"sheets", "read and written by lanes and compositor",
       samples ? Joules{} : sum(times(used, 2.0 * word, sheet), times(pixels, 2.0 * word, sheet))},
      {"compositing", "opacity, light and transmittance", arithmetic(pixels, composited)},
      {"picture", "read and written by the compositor, read at the end",
       sum(times(pixels, 2.0 * pixel, picture), times(left, pixel, picture))},
      {"output", "pixels as words", arithmetic(left, one.output)},
      {"pixels", "to DRAM", times(always(8.0 * static_cast<double>(activity.bytes_out)), 1.0, kDram)}};
  return parts;
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
