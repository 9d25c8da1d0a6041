// What the bits of the device's registers are (docs/microarchitecture.md, "Registers"): the map that docs/registers.md
// and fastsplat_registers.h are generated of, and of which capabilities() are packed.
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
  int (*value)(const Config&) = nullptr;  ///< of a capability: what the configuration makes of it
  constexpr std::uint32_t mask() const { return (~0U >> (31 - high + low)) << low; }
};

struct RegisterEntry {
  Register reg;
  Access access;
  const char* says;
  std::span<const RegisterField> fields;  ///< from bit 0 up; none: one word of 32 bits
};

/// All registers but the counters, by address.
std::span<const RegisterEntry> register_entries();

/// A register whose word says what the device was built for. A field too narrow for its value, which only 65536 is,
/// tells it as 0.
struct Capability {
  Register reg;
  std::uint32_t word;
};
std::vector<Capability> capabilities(const Config& config);

/// A counter's name as RTL and pages have it, upper case, and what it counts; in the order of their numbers.
struct CounterEntry {
  std::string name;
  const char* says;
};
std::vector<CounterEntry> counter_entries();
/// How many of them, the first, a device of this configuration has.
std::size_t counters_of(const Config& config);

}  // namespace fastsplat::cmodel
