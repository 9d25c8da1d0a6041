// SPDX-License-Identifier: Apache-2.0
#include "cmodel/io/register_fields.hpp"

#include <algorithm>

#include "cmodel/numbers/counters.hpp"
#include "cmodel/numbers/stall_counters.hpp"

namespace fastsplat::cmodel {
namespace {

/// A capability's field, whose value is a member of the configuration.
template <auto Member>
constexpr RegisterField built_for(const char* name, int high, int low, const char* says) {
  return {name, high, low, says, [](const Config& config) -> int { return config.*Member; }};
}

constexpr RegisterField kStatus[] = {
    {"BUSY", 0, 0, "work is under way, a beat is in check, a tile is being cut short, or a soft reset lasts"},
    {"ERROR", 1, 1, "a beat was refused; stays until a reset"},
};
constexpr RegisterField kControl[] = {
    {"CLEAR", 0, 0, "1: clears all counters"},
    {"RESET", 1, 1, "1: soft reset; done when STATUS.BUSY is 0"},
    {"DROP", 2, 2, "1, with RESET, of fastsplat_top: beats are taken and dropped until CONTROL is written without it"},
};
constexpr RegisterField kError[] = {
    {"RULE", 7, 0, "rule of docs/stream.md violated by the first refused beat; 0: none"},
    {"OPCODE", 15, 8, "opcode byte of that beat"},
};
constexpr RegisterField kIrq[] = {
    {"FRAME", 0, 0, "a frame left the device: the sink has taken its last beat"},
    {"TILE", 1, 1, "a tile's last beat was taken"},
    {"ERROR", 2, 2, "a beat was refused"},
};
static_assert(kStatus[0].mask() == kStatusBusy && kStatus[1].mask() == kStatusError);
static_assert(kControl[0].mask() == kControlClear && kControl[1].mask() == kControlReset && kControl[2].mask() == kControlDrop);
static_assert(kIrq[0].mask() == kIrqFrame && kIrq[1].mask() == kIrqTile && kIrq[2].mask() == kIrqError);
constexpr RegisterField kTile[] = {
    built_for<&Config::tile_width>("WIDTH", 15, 0, "pixels of a tile, across"),
    built_for<&Config::tile_height>("HEIGHT", 31, 16, "pixels of a tile, down"),
};
constexpr RegisterField kLanes[] = {
    built_for<&Config::lanes>("LANES", 15, 0, "P: a window is P x P pixels, a beat of pixels P"),
    built_for<&Config::rlut_sets>("SETS", 31, 16, "radius sets"),
};
constexpr RegisterField kRlut[] = {
    built_for<&Config::rlut_columns>("COLUMNS", 15, 0, "words of a phase of the RLUT, for all sets"),
    built_for<&Config::phases>("PHASES", 31, 16, "positions of a splat within a pixel, per axis"),
};
constexpr RegisterField kTables[] = {
    built_for<&Config::radial_entries>("RADIAL", 15, 0, "entries of the radial table; 0: 65536"),
    built_for<&Config::opacity_segments>("SEGMENTS", 31, 16, "segments of the slab factor; 0: 65536"),
};
constexpr RegisterField kSplatFields[] = {
    built_for<&Config::position_int_bits>("POSITION_INT", 7, 0, "integer bits of x and y, including the sign"),
    built_for<&Config::position_frac_bits>("POSITION_FRAC", 15, 8, "fraction bits of x and y"),
    built_for<&Config::colour_frac_bits>("COLOUR_FRAC", 23, 16, "fraction bits of R, G, B and tau"),
    built_for<&Config::colour_int_bits>("COLOUR_INT", 31, 24, "integer bits of R, G, B and tau"),
};
constexpr RegisterField kWeight[] = {
    built_for<&Config::radial_int_bits>("WEIGHT_INT", 7, 0, "integer bits of a weight"),
    built_for<&Config::radial_frac_bits>("WEIGHT_FRAC", 15, 8, "fraction bits of a weight"),
    built_for<&Config::rlut_guard_bits>("GUARD", 23, 16, "guard bits of the RLUT's words"),
};
constexpr RegisterField kSheet[] = {
    built_for<&Config::sheet_int_bits>("SHEET_INT", 7, 0, "integer bits of a sheet's sums"),
    built_for<&Config::sheet_frac_bits>("SHEET_FRAC", 15, 8, "fraction bits of a sheet's sums"),
    built_for<&Config::opacity_frac_bits>("OPACITY_FRAC", 23, 16, "fraction bits of the slab factor"),
    built_for<&Config::composite_frac_bits>("COMPOSITE_FRAC", 31, 24, "fraction bits of colour and transmittance"),
};
constexpr RegisterField kPixel[] = {
    built_for<&Config::pixel_int_bits>("PIXEL_INT", 7, 0, "integer bits of a pixel's words"),
    built_for<&Config::pixel_frac_bits>("PIXEL_FRAC", 15, 8, "fraction bits of a pixel's words"),
};
constexpr RegisterField kFeatures[] = {
    built_for<&Config::ellipse_frac_bits>("ELLIPSE_FRAC", 4, 0, "fraction bits of an ellipse's q; 0: no ellipses"),
    built_for<&Config::composite_every_sample>("EVERY_SAMPLE", 8, 8, "1: modes 4 and 5, every sample composited"),
    built_for<&Config::cull_map>("CULL_MAP", 10, 9, "cells of the cull map: 0 none, 1 blocks, 2 pixels"),
    built_for<&Config::radial_interpolate>("INTERPOLATE", 11, 11, "1: the radial table is interpolated, with N + 1 words"),
    built_for<&Config::classify_segment_bits>("CLASSIFY_BITS", 15, 12, "log2 of CLASSIFY's segments; 0: no densities"),
    built_for<&Config::pattern_node_bits>("PATTERN_BITS", 18, 16, "log2 of a pattern's nodes per axis; 0: no patterns"),
    built_for<&Config::index_kind>("INDEX_KIND", 22, 20, "order of docs/numerics.md, section 2: 4 is rlut"),
};
constexpr RegisterField kComposite[] = {
    built_for<&Config::composite_lanes>("COMPOSITE_LANES", 10, 0, "pixels composited in a cycle; 0: P x P"),
    built_for<&Config::counter_bits>("COUNTER_BITS", 22, 16, "counters count modulo 2^this"),
};
constexpr RegisterField kFreeze[] = {
    built_for<&Config::freeze_below>("FREEZE_BELOW", 20, 0, "early-termination threshold on transmittance"),
};
constexpr RegisterField kRounding[] = {
    built_for<&Config::rounding_snap>("SNAP", 1, 0, "of centres; here and below 0 trn, 1 rnd, 2 rnd_conv"),
    built_for<&Config::rounding_product>("PRODUCT", 3, 2, "of colour times weight"),
    built_for<&Config::rounding_fall>("FALL", 5, 4, "of the slab factor's interpolation"),
    built_for<&Config::rounding_slab>("SLAB", 7, 6, "of slab colour and opacity"),
    built_for<&Config::rounding_light>("LIGHT", 9, 8, "of transmittance times slab"),
    built_for<&Config::rounding_pixel>("PIXEL", 11, 10, "of output words"),
};

constexpr RegisterEntry kEntries[] = {
    {kRegMagic, Access::Read, "\"FSS1\", as in begin_frame", {}},
    {kRegVersion, Access::Read, "version of the stream", {}},
    {kRegHashLow, Access::Read, "the configuration's hash, low half", {}},
    {kRegHashHigh, Access::Read, "the configuration's hash, high half", {}},
    {kRegStatus, Access::Read, "state of the device", kStatus},
    {kRegControl, Access::Write, "reads as 0", kControl},
    {kRegError, Access::Read, "first refusal since reset", kError},
    {kRegErrorBeat, Access::Read, "the refused beat's number in its frame; begin_frame is 0", {}},
    {kRegIrq, Access::WriteOneToClear, "events since they were cleared", kIrq},
    {kRegIrqMask, Access::ReadWrite, "events that raise the interrupt; 0 after reset", kIrq},
    {kRegCapTile, Access::Read, "built for: tile", kTile},
    {kRegCapLanes, Access::Read, "built for: lanes, radius sets", kLanes},
    {kRegCapRlut, Access::Read, "built for: RLUT", kRlut},
    {kRegCapTables, Access::Read, "built for: tables", kTables},
    {kRegCapSplat, Access::Read, "built for: a splat's words", kSplatFields},
    {kRegCapWeight, Access::Read, "built for: weights", kWeight},
    {kRegCapSheet, Access::Read, "built for: sheets, compositing", kSheet},
    {kRegCapPixel, Access::Read, "built for: pixels", kPixel},
    {kRegCapFeatures, Access::Read, "built for: features that not every device has", kFeatures},
    {kRegCapComposite, Access::Read, "built for: compositing, counters", kComposite},
    {kRegCapFreeze, Access::Read, "built for: early termination", kFreeze},
    {kRegCapRounding, Access::Read, "built for: roundings", kRounding},
};

}  // namespace

std::span<const RegisterEntry> register_entries() { return kEntries; }

std::vector<Capability> capabilities(const Config& config) {
  std::vector<Capability> out;
  for (const RegisterEntry& entry : kEntries) {
    if (entry.fields.empty() || entry.fields.front().value == nullptr) continue;
    std::uint32_t word = 0;
    for (const RegisterField& field : entry.fields)
      word |= (static_cast<std::uint32_t>(field.value(config)) << field.low) & field.mask();
    out.push_back({entry.reg, word});
  }
  return out;
}

std::vector<CounterEntry> counter_entries() {
  std::vector<CounterEntry> out;
  const auto upper = [](std::string name) {
    for (char& c : name) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    return name;
  };
  Counters{}.for_each([&](const char* name, std::uint64_t, const char* says) { out.push_back({upper(name), says}); });
#define X(name, counter, says) out.push_back({#counter, says});
  FASTSPLAT_STALL_COUNTERS(X)
#undef X
  return out;
}

std::size_t counters_of(const Config& config) {
  return static_cast<std::size_t>(std::ranges::count_if(
      counter_entries(), [&](const CounterEntry& counter) { return has_counter(config, counter.name); }));
}

}  // namespace fastsplat::cmodel
