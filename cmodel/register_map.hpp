// Addresses of the device's registers (docs/microarchitecture.md, "Registers"): the package and the testbench both read
// them here.
#pragma once

#include <array>
#include <cstdint>

namespace fastsplat::cmodel {

struct Register {
  const char* name;
  std::uint32_t address;  ///< bytes
};

inline constexpr Register kRegMagic{"MAGIC", 0x00}, kRegVersion{"VERSION", 0x04}, kRegHashLow{"HASH_LOW", 0x08},
    kRegHashHigh{"HASH_HIGH", 0x0C}, kRegStatus{"STATUS", 0x10}, kRegControl{"CONTROL", 0x14};
/// Counter n has its low word at 0x80 + 8 n, its high word 4 bytes on.
inline constexpr Register kRegCounters{"COUNTERS", 0x80};

inline constexpr std::array kRegisters{kRegMagic,  kRegVersion, kRegHashLow, kRegHashHigh,
                                       kRegStatus, kRegControl, kRegCounters};

}  // namespace fastsplat::cmodel
