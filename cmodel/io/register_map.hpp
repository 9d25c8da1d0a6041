// SPDX-License-Identifier: Apache-2.0
// Addresses of the device's registers (docs/microarchitecture.md, "Registers"), for the package and the testbench.
// register_fields.hpp has their fields.
#pragma once

#include <array>
#include <cstdint>

namespace fastsplat::cmodel {

struct Register {
  const char* name;
  std::uint32_t address;  ///< bytes
};

inline constexpr Register kRegMagic{"MAGIC", 0x00}, kRegVersion{"VERSION", 0x04}, kRegHashLow{"HASH_LOW", 0x08},
    kRegHashHigh{"HASH_HIGH", 0x0C}, kRegStatus{"STATUS", 0x10}, kRegControl{"CONTROL", 0x14}, kRegError{"ERROR", 0x18},
    kRegErrorBeat{"ERROR_BEAT", 0x1C}, kRegIrq{"IRQ", 0x20}, kRegIrqMask{"IRQ_MASK", 0x24};
// What the device was built for; capabilities() of register_fields.hpp makes their words.
inline constexpr Register kRegCapTile{"CAP_TILE", 0x40}, kRegCapLanes{"CAP_LANES", 0x44}, kRegCapRlut{"CAP_RLUT", 0x48},
    kRegCapTables{"CAP_TABLES", 0x4C}, kRegCapSplat{"CAP_SPLAT", 0x50}, kRegCapWeight{"CAP_WEIGHT", 0x54},
    kRegCapSheet{"CAP_SHEET", 0x58}, kRegCapPixel{"CAP_PIXEL", 0x5C}, kRegCapFeatures{"CAP_FEATURES", 0x60},
    kRegCapComposite{"CAP_COMPOSITE", 0x64}, kRegCapFreeze{"CAP_FREEZE", 0x68}, kRegCapRounding{"CAP_ROUNDING", 0x6C};
/// Counter n has its low word at 0x80 + 8 n, its high word 4 bytes on.
inline constexpr Register kRegCounters{"COUNTERS", 0x80};

inline constexpr std::array kRegisters{kRegMagic, kRegVersion,   kRegHashLow, kRegHashHigh, kRegStatus,  kRegControl,
                                       kRegError, kRegErrorBeat, kRegIrq,     kRegIrqMask,  kRegCounters};

// Bits of STATUS.
inline constexpr std::uint32_t kStatusBusy = 1, kStatusError = 2;
// Bits of CONTROL, written.
inline constexpr std::uint32_t kControlClear = 1, kControlReset = 2, kControlDrop = 4;
// Bits of IRQ and IRQ_MASK.
inline constexpr std::uint32_t kIrqFrame = 1, kIrqTile = 2, kIrqError = 4;

}  // namespace fastsplat::cmodel
