// Addresses of the device's registers (docs/microarchitecture.md, "Registers"): the package and the testbench both read
// them here.
#pragma once

#include <array>
#include <cstdint>

#include "cmodel/config.hpp"

namespace fastsplat::cmodel {

struct Register {
  const char* name;
  std::uint32_t address;  ///< bytes
};

inline constexpr Register kRegMagic{"MAGIC", 0x00}, kRegVersion{"VERSION", 0x04}, kRegHashLow{"HASH_LOW", 0x08},
    kRegHashHigh{"HASH_HIGH", 0x0C}, kRegStatus{"STATUS", 0x10}, kRegControl{"CONTROL", 0x14}, kRegError{"ERROR", 0x18},
    kRegErrorBeat{"ERROR_BEAT", 0x1C}, kRegIrq{"IRQ", 0x20}, kRegIrqMask{"IRQ_MASK", 0x24};
// What the device was built for; their words are capabilities().
inline constexpr Register kRegCapTile{"CAP_TILE", 0x40}, kRegCapLanes{"CAP_LANES", 0x44}, kRegCapRlut{"CAP_RLUT", 0x48},
    kRegCapTables{"CAP_TABLES", 0x4C}, kRegCapSplat{"CAP_SPLAT", 0x50}, kRegCapWeight{"CAP_WEIGHT", 0x54},
    kRegCapSheet{"CAP_SHEET", 0x58}, kRegCapPixel{"CAP_PIXEL", 0x5C};
/// Counter n has its low word at 0x80 + 8 n, its high word 4 bytes on.
inline constexpr Register kRegCounters{"COUNTERS", 0x80};

inline constexpr std::array kRegisters{kRegMagic, kRegVersion,   kRegHashLow, kRegHashHigh, kRegStatus,  kRegControl,
                                       kRegError, kRegErrorBeat, kRegIrq,     kRegIrqMask,  kRegCounters};

// Bits of STATUS.
inline constexpr std::uint32_t kStatusBusy = 1, kStatusError = 2;
// Bits of CONTROL, written.
inline constexpr std::uint32_t kControlClear = 1, kControlReset = 2;
// Bits of IRQ and IRQ_MASK.
inline constexpr std::uint32_t kIrqFrame = 1, kIrqTile = 2, kIrqError = 4;

/// A register whose word says what the device was built for.
struct Capability {
  Register reg;
  std::uint32_t word;
};
inline std::array<Capability, 8> capabilities(const Config& config) {
  const auto pack = [](int b0, int b1, int b2 = 0, int b3 = 0) {
    return static_cast<std::uint32_t>(b0 | b1 << 8 | b2 << 16) | static_cast<std::uint32_t>(b3) << 24;
  };
  // 65536, which a table's length may be, is told as 0: it spoils no other field.
  const auto halves = [](int low, int high) {
    return (static_cast<std::uint32_t>(low) & 0xffffU) | static_cast<std::uint32_t>(high) << 16;
  };
  return {Capability{kRegCapTile, halves(config.tile_width, config.tile_height)},
          Capability{kRegCapLanes, halves(config.lanes, config.rlut_sets)},
          Capability{kRegCapRlut, halves(config.rlut_columns, config.phases)},
          Capability{kRegCapTables, halves(config.radial_entries, config.opacity_segments)},
          Capability{kRegCapSplat, pack(config.position_int_bits, config.position_frac_bits, config.colour_frac_bits)},
          Capability{kRegCapWeight, pack(config.radial_int_bits, config.radial_frac_bits, config.rlut_guard_bits)},
          Capability{kRegCapSheet, pack(config.sheet_int_bits, config.sheet_frac_bits, config.opacity_frac_bits,
                                        config.composite_frac_bits)},
          Capability{kRegCapPixel, pack(config.pixel_int_bits, config.pixel_frac_bits)}};
}

}  // namespace fastsplat::cmodel
