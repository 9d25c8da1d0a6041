// SPDX-License-Identifier: Apache-2.0
#include "cmodel/numbers/config.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <vector>

#include "base/fnv1a.hpp"
#include "base/suggest.hpp"

namespace fastsplat::cmodel {
namespace {

constexpr const char* kRoundings[] = {"trn", "rnd", "rnd_conv"};  // in the order of Rounding

constexpr const char* kCarries[] = {"off", "xray", "on"};  // in the order of Carry

constexpr const char* kIndexKinds[] = {"linear", "squared", "squared_elliptic",
                                       "blit2d", "rlut",    "separable"};  // in the order of IndexKind

constexpr const char* kIndexSymmetries[] = {"off", "eightfold"};  // in the order of IndexSymmetry

constexpr const char* kCullMaps[] = {"off", "block", "pixel"};  // in the order of CullMap

constexpr ConfigKey rounding(const char* name, int Config::*member, const char* meaning) {
  return {.name = name,
          .member = member,
          .min = 0,
          .max = 2,
          .power_of_two = false,
          .meaning = meaning,
          .names = kRoundings,
          .neutral = static_cast<int>(Rounding::RND)};
}

constexpr std::array kKeys{
    ConfigKey{"array.lanes", &Config::lanes, 1, 32, true, "P: lanes per side; a window is P x P pixels"},
    ConfigKey{"tile.width", &Config::tile_width, 1, 4096, false, "W: screen tile, pixels, multiple of P"},
    ConfigKey{"tile.height", &Config::tile_height, 1, 4096, false, "H: screen tile, pixels, multiple of P"},
    ConfigKey{"position.int_bits", &Config::position_int_bits, 4, 16, false,
              "pi: splat centre S pi.pf, tile-relative pixels"},
    ConfigKey{"position.frac_bits", &Config::position_frac_bits, 0, 12, false, "pf"},
    ConfigKey{"snap.phases", &Config::phases, 1, 4096, true, "k: sub-pixel positions per axis, at most 2^pf"},
    ConfigKey{"rlut.sets", &Config::rlut_sets, 1, 64, false, "radius sets loadable at once"},
    ConfigKey{"rlut.columns", &Config::rlut_columns, 1, 1024, false, "RLUT columns shared by all sets, multiple of P"},
    ConfigKey{"rlut.guard_bits", &Config::rlut_guard_bits, 0, 12, false,
              "g: fraction bits below one radial table step"},
    ConfigKey{"radial.entries", &Config::radial_entries, 2, 65536, true, "N: radial table entries"},
    ConfigKey{"radial.int_bits", &Config::radial_int_bits, 0, 1, false, "wi: weights U wi.wf"},
    ConfigKey{"radial.frac_bits", &Config::radial_frac_bits, 2, 16, false, "wf"},
    ConfigKey{"colour.frac_bits", &Config::colour_frac_bits, 2, 16, false,
              "cf: colour and optical depth of a splat, U ci.cf"},
    ConfigKey{"slices.phase_bits", &Config::slice_phase_bits, 0, 12, false,
              "zf: depth steps per kernel unit = 2^zf (driver)"},
    ConfigKey{"slices.frac_bits", &Config::slice_frac_bits, 2, 24, false,
              "hf: cumulative slice weight One.hf (driver)"},
    ConfigKey{"sheet.int_bits", &Config::sheet_int_bits, 1, 8, false, "si: sheet accumulators U si.sf"},
    ConfigKey{"sheet.frac_bits", &Config::sheet_frac_bits, 4, 31, false, "sf"},
    ConfigKey{"opacity.segments", &Config::opacity_segments, 1, 65536, true, "G: segments of the slab factor table"},
    ConfigKey{"opacity.frac_bits", &Config::opacity_frac_bits, 2, 16, false, "of: slab factor One.of"},
    ConfigKey{"composite.frac_bits", &Config::composite_frac_bits, 4, 20, false,
              "tf: transmittance One.tf, colour U 1.tf"},
    ConfigKey{"composite.freeze_below", &Config::freeze_below, 0, 1 << 20, false,
              "eps: early-termination threshold on transmittance words"},
    ConfigKey{"pixel.int_bits", &Config::pixel_int_bits, 0, 8, false, "xi: output words U xi.xf"},
    ConfigKey{"pixel.frac_bits", &Config::pixel_frac_bits, 4, 31, false, "xf"},
    rounding("rounding.snap", &Config::rounding_snap, "R_s: rounding of a centre onto the 1/k grid"),
    rounding("rounding.product", &Config::rounding_product, "R_p: rounding of colour times weight"),
    rounding("rounding.fall", &Config::rounding_fall, "R_f: rounding of the slab factor's interpolation"),
    rounding("rounding.slab", &Config::rounding_slab, "R_a: rounding of slab colour and opacity"),
    rounding("rounding.light", &Config::rounding_light, "R_l: rounding of transmittance times slab colour and opacity"),
    rounding("rounding.pixel", &Config::rounding_pixel, "R_o: rounding of output words"),
    ConfigKey{.name = "rounding.carry",
              .member = &Config::rounding_carry,
              .min = 0,
              .max = 2,
              .power_of_two = false,
              .meaning = "where a splat's rounding error diffuses to the next splat (driver)",
              .names = kCarries,
              .neutral = static_cast<int>(Carry::XRay)},
    ConfigKey{.name = "index.kind",
              .member = &Config::index_kind,
              .min = 0,
              .max = 5,
              .power_of_two = false,
              .meaning = "method that finds a pixel's weight",
              .names = kIndexKinds,
              .neutral = static_cast<int>(IndexKind::Rlut)},
    ConfigKey{.name = "index.symmetry",
              .member = &Config::index_symmetry,
              .min = 0,
              .max = 1,
              .power_of_two = false,
              .meaning = "footprints stored in a blit2d set",
              .names = kIndexSymmetries,
              .neutral = static_cast<int>(IndexSymmetry::Off)},
    ConfigKey{.name = "ellipse.frac_bits",
              .member = &Config::ellipse_frac_bits,
              .min = 0,
              .max = 20,
              .power_of_two = false,
              .meaning = "f: fraction bits of an ellipse's q below one RLUT word; 0: no ellipses",
              .neutral = 0},
    ConfigKey{.name = "composite.lanes",
              .member = &Config::composite_lanes,
              .min = 0,
              .max = 1024,
              .power_of_two = false,
              .meaning = "C: pixels composited per cycle, a divisor of P^2; 0: a whole block",
              .neutral = 0},
    ConfigKey{.name = "counters.bits",
              .member = &Config::counter_bits,
              .min = 16,
              .max = 64,
              .power_of_two = false,
              .meaning = "width of the device's counters, which wrap",
              .neutral = 64},
    ConfigKey{.name = "composite.every_sample",
              .member = &Config::composite_every_sample,
              .min = 0,
              .max = 1,
              .power_of_two = false,
              .meaning = "1: the device can composite every sample of a tile in the order of its splats",
              .neutral = 0},
    ConfigKey{.name = "cull.map",
              .member = &Config::cull_map,
              .min = 0,
              .max = 2,
              .power_of_two = false,
              .meaning = "cells of the map that finds hidden splats; off: no culling",
              .names = kCullMaps,
              .neutral = static_cast<int>(CullMap::Off)},
    ConfigKey{.name = "radial.interpolate",
              .member = &Config::radial_interpolate,
              .min = 0,
              .max = 1,
              .power_of_two = false,
              .meaning = "1: weights are interpolated linearly between two entries of the radial table",
              .neutral = 0},
    ConfigKey{.name = "classify.segment_bits",
              .member = &Config::classify_segment_bits,
              .min = 0,
              .max = 12,
              .power_of_two = false,
              .meaning = "log2 of the transfer function's segments for densities classified by pixel; 0: none",
              .neutral = 0},
    ConfigKey{.name = "pattern.node_bits",
              .member = &Config::pattern_node_bits,
              .min = 0,
              .max = kMostPatternNodeBits,
              .power_of_two = false,
              .meaning = "log2 of the nodes along a side of a solid pattern's table; 0: no patterns",
              .neutral = 0},
    ConfigKey{.name = "colour.int_bits",
              .member = &Config::colour_int_bits,
              .min = 0,
              .max = 4,
              .power_of_two = false,
              .meaning = "ci: integer bits of colour and optical depth; 0: colours are below 1",
              .neutral = 0},
};

ErrorParts violation(const char* key, std::string what, std::string expected, int got, std::string fix) {
  return {.where = key,
          .what = std::move(what),
          .expected = std::move(expected),
          .got = std::to_string(got),
          .fix = std::move(fix)};
}

ErrorParts multiple_of_lanes(const char* key, int got, int lanes) {
  return violation(key, "is not a multiple of array.lanes", "a multiple of " + std::to_string(lanes), got,
                   "use " + std::to_string((got + lanes - 1) / lanes * lanes));
}

/// Checks a value against the key's own limits.
std::optional<ErrorParts> key_violation(const ConfigKey& key, int value) {
  if (value < key.min || value > key.max)
    return violation(key.name, "out of range", allowed(key), value, std::string(key.name) + " is " + key.meaning);
  if (key.power_of_two && !std::has_single_bit(static_cast<unsigned>(value))) {
    return violation(key.name, "is not a power of two", "a power of two", value,
                     "use " + std::to_string(std::bit_floor(static_cast<unsigned>(value))) + " or " +
                         std::to_string(std::bit_ceil(static_cast<unsigned>(value))));
  }
  return std::nullopt;
}

/// Most words of blit2d's widest set, which is one load_table record.
constexpr std::int64_t kMostBlitWords = std::int64_t{1} << 24;

/// Limits of index.kind (N-2-7).
std::optional<ErrorParts> index_violation(const Config& config) {
  const int side_bits = std::bit_width(static_cast<unsigned>(config.rlut_columns - 1)) + config.position_frac_bits;
  if (config.index_symmetry != static_cast<int>(IndexSymmetry::Off) && config.index() != IndexKind::Blit2d) {
    return ErrorParts{.where = "index.symmetry",
                      .what = "applies to stored footprints, which only blit2d has",
                      .expected = "index.kind = blit2d",
                      .got = kIndexKinds[config.index_kind],
                      .fix = "use index.symmetry = off"};
  }
  switch (config.index()) {
    case IndexKind::Linear:
      if (side_bits + config.rlut_guard_bits > 31) {
        return violation("rlut.guard_bits", "leads to squared distances of more than 63 bits (index.kind = linear)",
                         "log2(rlut.columns) + position.frac_bits + guard_bits <= 31",
                         side_bits + config.rlut_guard_bits, "lower rlut.guard_bits or position.frac_bits");
      }
      break;
    case IndexKind::Squared:
    case IndexKind::SquaredElliptic:
      if (side_bits > 17) {
        return violation("position.frac_bits", "leads to squared distances of more than 62 bits (index.kind = squared)",
                         "log2(rlut.columns) + position.frac_bits <= 17", side_bits,
                         "lower position.frac_bits or rlut.columns");
      }
      break;
    case IndexKind::Blit2d: {
      const std::int64_t side = std::int64_t{config.phases} * config.rlut_columns;
      if (side * side > kMostBlitWords) {
        return ErrorParts{.where = "snap.phases",
                          .what = "leads to more footprints than load_table supports (index.kind = blit2d)",
                          .expected = "(snap.phases x rlut.columns)^2 at most " + std::to_string(kMostBlitWords),
                          .got = std::to_string(side * side),
                          .fix = "lower snap.phases or rlut.columns"};
      }
      break;
    }
    case IndexKind::Rlut:
    case IndexKind::Separable:
      break;
  }
  return std::nullopt;
}

/// Limits of radial.interpolate (N-2-7).
std::optional<ErrorParts> interpolation_violation(const Config& config) {
  if (!config.interpolates()) return std::nullopt;
  const IndexKind kind = config.index();
  if (kind != IndexKind::Rlut && kind != IndexKind::Squared && kind != IndexKind::SquaredElliptic) {
    return ErrorParts{.where = "radial.interpolate",
                      .what = "interpolates over squared distance, which this kind of index does not use",
                      .expected = "index.kind = rlut, squared or squared_elliptic",
                      .got = kIndexKinds[config.index_kind],
                      .fix = "use radial.interpolate = 0, or index.kind = rlut"};
  }
  if (config.rlut_guard_bits < 1) {
    return violation("rlut.guard_bits", "leaves no bits between two radial entries for interpolation",
                     "at least 1 with radial.interpolate = 1", config.rlut_guard_bits,
                     "raise rlut.guard_bits, or use radial.interpolate = 0");
  }
  return std::nullopt;
}

/// Limits of classification by pixel (N-2-7).
std::optional<ErrorParts> classify_violation(const Config& config) {
  if (!config.classifies()) return std::nullopt;
  const char* key = "classify.segment_bits";
  if (config.sheet_frac_bits > 16 || config.sheet_int_bits + config.sheet_frac_bits > 18) {
    return violation("sheet.frac_bits", "leads to density words that are too wide for gradients",
                     "frac_bits <= 16 and int_bits + frac_bits <= 18 with classify.segment_bits",
                     config.sheet_frac_bits, "lower sheet.frac_bits, or use classify.segment_bits = 0");
  }
  if (config.classify_rest_bits() < 0) {
    return violation(key, "exceeds the number of density words below 1",
                     "at most sheet.frac_bits = " + std::to_string(config.sheet_frac_bits),
                     config.classify_segment_bits, "lower classify.segment_bits");
  }
  if (config.tile_width < 3 || config.tile_height < 3) {
    return violation(config.tile_width < 3 ? "tile.width" : "tile.height", "has no room for a halo of densities",
                     "at least 3 with classify.segment_bits", std::min(config.tile_width, config.tile_height),
                     "use larger tiles, or classify.segment_bits = 0");
  }
  if (config.culls()) {
    return ErrorParts{.where = "cull.map",
                      .what = "would cull splats whose densities a neighbour's gradient needs",
                      .expected = "off with classify.segment_bits",
                      .got = kCullMaps[config.cull_map],
                      .fix = "use cull.map = off, or classify.segment_bits = 0"};
  }
  return std::nullopt;
}

/// Limits of ellipses (N-2-7).
std::optional<ErrorParts> ellipse_violation(const Config& config) {
  if (!config.has_ellipses()) return std::nullopt;
  const char* key = "ellipse.frac_bits";
  if (config.index() == IndexKind::Linear) {
    return ErrorParts{.where = key,
                      .what = "requires a radial table by squared distance, but that of linear is by distance",
                      .expected = "an index.kind other than linear",
                      .got = kIndexKinds[config.index_kind],
                      .fix = "use ellipse.frac_bits = 0, or index.kind = rlut"};
  }
  const int position_bits = config.position_int_bits + config.position_frac_bits;
  if (config.position_frac_bits > kEllipsePositionFracBits || position_bits > kEllipsePositionBits) {
    const bool fraction = config.position_frac_bits > kEllipsePositionFracBits;
    return violation("position.frac_bits", "leads to positions that are too wide for an ellipse's record",
                     fraction ? "at most " + std::to_string(kEllipsePositionFracBits)
                              : "int_bits + frac_bits <= " + std::to_string(kEllipsePositionBits),
                     fraction ? config.position_frac_bits : position_bits,
                     "lower position.frac_bits or int_bits, or use ellipse.frac_bits = 0");
  }
  if (config.radial_index_bits() + config.rlut_guard_bits < 2) {
    return violation("radial.entries", "leaves no bits to round an ellipse's q",
                     "log2(radial.entries) + rlut.guard_bits >= 2", config.radial_entries,
                     "raise radial.entries, or use ellipse.frac_bits = 0");
  }
  if (config.rlut_columns > kEllipseWindows * config.lanes || config.rlut_columns > kEllipseReach) {
    return violation(
        "rlut.columns", "exceeds the range of an ellipse's record",
        "at most " + std::to_string(std::min(kEllipseWindows * config.lanes, kEllipseReach)) + " with ellipses",
        config.rlut_columns, "lower rlut.columns, or use ellipse.frac_bits = 0");
  }
  const int steepest = config.radial_index_bits() + config.rlut_guard_bits + 4 - 2 * config.position_frac_bits;
  if (steepest >= kEllipseTermBits) {
    return violation(
        "position.frac_bits", "makes the coefficients of the steepest ellipse (1/4 pixel) too large for a record",
        "log2(radial.entries) + rlut.guard_bits + 4 - 2 frac_bits <= " + std::to_string(kEllipseTermBits - 1), steepest,
        "raise position.frac_bits, or use ellipse.frac_bits = 0");
  }
  const int bits = config.ellipse_format().word_bits;
  if (bits > kEllipseMostBits) {
    return violation(key, "makes an ellipse's q too wide",
                     "log2(radial.entries) + rlut.guard_bits + 2 log2(array.lanes) + 10 + frac_bits <= " +
                         std::to_string(kEllipseMostBits),
                     bits, "lower ellipse.frac_bits or rlut.guard_bits");
  }
  return std::nullopt;
}

}  // namespace

int Config::log2_exact(int power_of_two) { return std::bit_width(static_cast<unsigned>(power_of_two)) - 1; }

std::span<const ConfigKey> config_keys() { return kKeys; }

const ConfigKey* find_key(std::string_view name) {
  const auto found = std::find_if(kKeys.begin(), kKeys.end(), [&](const ConfigKey& key) { return key.name == name; });
  return found == kKeys.end() ? nullptr : &*found;
}

std::string allowed(const ConfigKey& key) {
  if (key.names.empty()) return std::to_string(key.min) + ".." + std::to_string(key.max);
  std::string text = key.names.front();
  for (std::size_t i = 1; i < key.names.size(); ++i)
    text += std::string(i + 1 < key.names.size() ? ", " : " or ") + key.names[i];
  return text;
}

std::string text_of(const Config& config, const ConfigKey& key) {
  const int value = config.*key.member;
  return key.names.empty() ? std::to_string(value) : key.names[static_cast<std::size_t>(value)];
}

std::optional<ErrorParts> set(Config& config, std::string_view name, std::string_view text) {
  const ConfigKey* key = find_key(name);
  if (key == nullptr) {
    std::vector<std::string> known;
    for (const ConfigKey& other : kKeys) known.emplace_back(other.name);
    return ErrorParts{.where = std::string(name),
                      .what = "unknown configuration key",
                      .expected = {},
                      .got = {},
                      .fix = suggestion(name, known)};
  }
  int value = 0;
  const auto refuse = [&](const char* what) {
    return ErrorParts{.where = key->name,
                      .what = what,
                      .expected = allowed(*key),
                      .got = std::string(text),
                      .fix = std::string(key->name) + " is " + key->meaning};
  };
  if (key->names.empty()) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (end != text.data() + text.size() || error == std::errc::invalid_argument)
      return refuse("is not a whole number");
    if (error == std::errc::result_out_of_range) return refuse("out of range");
  } else {
    const auto found = std::find(key->names.begin(), key->names.end(), text);
    if (found == key->names.end()) {
      ErrorParts wrong = refuse("unknown value");
      const std::vector<std::string> known(key->names.begin(), key->names.end());
      if (const auto meant = did_you_mean(text, known); !meant.empty()) wrong.fix = meant;
      return wrong;
    }
    value = static_cast<int>(found - key->names.begin());
  }
  if (auto violation = key_violation(*key, value)) return violation;
  config.*key->member = value;
  return std::nullopt;
}

std::optional<ErrorParts> first_violation(const Config& config) {
  for (const auto& key : kKeys) {
    if (auto found = key_violation(key, config.*key.member)) return found;
  }
  if (config.tile_width % config.lanes != 0) return multiple_of_lanes("tile.width", config.tile_width, config.lanes);
  if (config.tile_height % config.lanes != 0) return multiple_of_lanes("tile.height", config.tile_height, config.lanes);
  if (config.rlut_columns % config.lanes != 0)
    return multiple_of_lanes("rlut.columns", config.rlut_columns, config.lanes);
  if (config.phase_bits() > config.position_frac_bits) {
    return violation("snap.phases", "is finer than the position it snaps",
                     "at most 2^position.frac_bits = " + std::to_string(1 << config.position_frac_bits), config.phases,
                     "raise position.frac_bits or lower snap.phases");
  }
  if (config.rlut_columns * config.phases < 2) {
    return violation("rlut.columns", "is too small for any radius set",
                     "rlut.columns x snap.phases >= 2 (radius 1/k pixel)", config.rlut_columns * config.phases,
                     "raise rlut.columns or snap.phases");
  }
  const int reach = config.tile_width > config.tile_height ? config.tile_width : config.tile_height;
  if ((1 << (config.position_int_bits - 1)) < reach + config.rlut_columns) {
    return violation("position.int_bits", "does not cover every splat that touches a tile",
                     "2^(int_bits-1) >= tile side + rlut.columns = " + std::to_string(reach + config.rlut_columns),
                     1 << (config.position_int_bits - 1), "raise position.int_bits");
  }
  if (config.colour_bits() > 16) {
    return violation("colour.int_bits", "leads to colours that are too wide for a record", "int_bits + frac_bits <= 16",
                     config.colour_bits(), "lower colour.frac_bits");
  }
  if (config.sheet_int_bits + config.sheet_frac_bits > 32) {
    return violation("sheet.frac_bits", "leads to sheet words of more than 32 bits", "int_bits + frac_bits <= 32",
                     config.sheet_int_bits + config.sheet_frac_bits, "lower sheet.frac_bits");
  }
  if (config.pixel_int_bits + config.pixel_frac_bits > 32) {
    return violation("pixel.frac_bits", "leads to pixel words of more than 32 bits", "int_bits + frac_bits <= 32",
                     config.pixel_int_bits + config.pixel_frac_bits, "lower pixel.frac_bits");
  }
  if (config.opacity_remainder_bits() < 0) {
    return violation("opacity.segments", "exceeds the number of sheet words",
                     "at most 2^(sheet.int_bits + sheet.frac_bits) = 2^" +
                         std::to_string(config.sheet_int_bits + config.sheet_frac_bits),
                     config.opacity_segments, "lower opacity.segments");
  }
  if (config.grid() == 1 && config.rounding_snap == static_cast<int>(Rounding::RND_CONV) &&
      (config.tile_width % 2 != 0 || config.tile_height % 2 != 0)) {
    // An even pixel of the tile may be odd in the image: splats would snap differently in every other tile.
    return violation("rounding.snap",
                     "rounds ties to even pixels of the tile, which differ from the image's in tiles of odd sides",
                     "snap.phases of 2 or more, or tile sides that are even",
                     config.tile_width % 2 != 0 ? config.tile_width : config.tile_height,
                     "use an even tile.width and tile.height, or rounding.snap = rnd");
  }
  if (config.freeze_below > (1 << config.composite_frac_bits)) {
    return violation("composite.freeze_below", "would terminate an untouched pixel",
                     "at most 2^composite.frac_bits = " + std::to_string(1 << config.composite_frac_bits),
                     config.freeze_below,
                     "use a small number such as " + std::to_string((1 << config.composite_frac_bits) / 1024));
  }
  const int block = config.lanes * config.lanes;
  if (config.composite_lanes > block || block % config.composited_at_once() != 0) {
    return violation(
        "composite.lanes", "does not divide a block's pixels",
        "a divisor of array.lanes^2 = " + std::to_string(block) + ", or 0 for all of them", config.composite_lanes,
        "use " + std::to_string(
                     std::min(block, static_cast<int>(std::bit_floor(static_cast<unsigned>(config.composite_lanes))))));
  }
  if (config.composite_every_sample != 0 && config.composited_at_once() != block) {
    return violation("composite.lanes",
                     "divides blocks into slices, but composite.every_sample composites whole blocks",
                     "0 or array.lanes^2 = " + std::to_string(block) + " with composite.every_sample = 1",
                     config.composite_lanes, "use composite.lanes = 0, or composite.every_sample = 0");
  }
  if (auto found = index_violation(config)) return found;
  if (auto found = interpolation_violation(config)) return found;
  if (auto found = classify_violation(config)) return found;
  return ellipse_violation(config);
}

std::uint64_t config_hash(const Config& config) {
  std::uint64_t hash = kFnv1aStart;
  for (const auto& key : kKeys) {
    if (key.neutral == config.*key.member) continue;
    hash = fnv1a(hash, std::string(key.name) + "=" + text_of(config, key) + "\n");
  }
  return hash;
}

}  // namespace fastsplat::cmodel
