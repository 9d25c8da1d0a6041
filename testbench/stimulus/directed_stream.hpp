// SPDX-License-Identifier: Apache-2.0
// Shared by the directed checks: a small stream with every record, the places of its records, and a check that hits
// bins.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "cmodel/numbers/config.hpp"
#include "cmodel/stream/stream_layout.hpp"
#include "testbench/stimulus/directed.hpp"

namespace fastsplat::testbench {

/// A record: its first beat and its kind. Words of tables are not records, whatever they look like.
struct Record {
  std::size_t at;
  cmodel::Opcode opcode;
};
std::vector<Record> records_of(const std::vector<cmodel::Beat>& beats);
/// The beat of the first record of a kind that the stream has.
std::size_t first_of(const std::vector<cmodel::Beat>& beats, cmodel::Opcode wanted);
/// Whether fastsplat_top takes the beat behind a reset: it drops others (docs/integration.md).
bool begins_frame(const cmodel::Beat& beat);
/// Overwrites a field.
void overwrite(cmodel::Beat& beat, const cmodel::Field& field, std::uint64_t value);

/// The first small stream that has a cull_block and a tile of two sheets, so that every record occurs. If none has, the
/// last one tried, whose bins then stay empty.
std::vector<cmodel::Beat> small_stream(const cmodel::Config& config);

/// A small stream whose first tile is of densities, in two or more sheets, and the beat of that tile's end_tile. For
/// configurations that classify; throws std::logic_error if no seed makes one.
std::pair<std::vector<cmodel::Beat>, std::size_t> small_densities(const cmodel::Config& config);

class Check {
 public:
  DirectedResult result;
  Coverage::Id bin(const char* group, const char* name) { return result.coverage.declare(group, name); }
  void equal(const std::string& what, std::uint64_t expected, std::uint64_t got, Coverage::Id bin) {
    ++result.comparisons;
    if (expected == got)
      result.coverage.hit(bin);
    else
      result.failures.push_back(what + ": expected " + std::to_string(expected) + ", got " + std::to_string(got));
  }
};

}  // namespace fastsplat::testbench
