// SPDX-License-Identifier: Apache-2.0
// The fields of the device's registers (docs/microarchitecture.md, "Registers"). docs/registers.md,
// fastsplat_registers.h and capabilities() are made from this map.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "cmodel/io/register_map.hpp"
#include "cmodel/numbers/config.hpp"

namespace fastsplat::cmodel {

enum class Access { Read, Write, ReadWrite, WriteOneToClear };

struct RegisterField {
  const char* name;
  int high, low;  ///< bits
  const char* says;
  int (*value)(const Config&) = nullptr;  ///< of a capability: its value in a configuration
  constexpr std::uint32_t mask() const { return (~0U >> (31 - high + low)) << low; }
};

struct RegisterEntry {
  Register reg;
  Access access;
  const char* says;
  std::span<const RegisterField> fields;  ///< from bit 0 up; empty: one word of 32 bits
};

/// All registers but the counters, by address.
std::span<const RegisterEntry> register_entries();

/// A register that shows what the device was built for. Only 65536 is too wide for a field, which then shows 0.
struct Capability {
  Register reg;
  std::uint32_t word;
};
std::vector<Capability> capabilities(const Config& config);

/// A counter's name as in RTL and pages, upper case, and what it counts; in the order of their numbers.
struct CounterEntry {
  std::string name;
  const char* says;
};
std::vector<CounterEntry> counter_entries();
/// Number of counters, the first ones, that a device of this configuration has.
std::size_t counters_of(const Config& config);

}  // namespace fastsplat::cmodel
