// SPDX-License-Identifier: Apache-2.0
// The device written again, from docs/numerics.md and docs/stream.md alone: plain loops over whole tiles, exact wide
// integers, nothing shared with the model. Oracle and model must produce the same words.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "tests/cmodel/oracle/symbols.hpp"

namespace fastsplat::oracle {

enum class Kind { Snap, Footprint, Sheet, Composite, Pixel };

struct Event {
  Kind kind = Kind::Snap;
  std::uint32_t tile = 0, sheet = 0, tag = 0;
  std::int32_t x = 0, y = 0;
  std::vector<std::uint32_t> payload;
  bool operator==(const Event&) const = default;
};

struct Picture {
  std::uint32_t tile = 0;
  std::int32_t x = 0, y = 0;
  int width = 0, height = 0;
  std::vector<std::uint32_t> words;
  bool operator==(const Picture&) const = default;
};

/// How much of it was ellipses: for figures only; no word of the device shows it.
struct EllipseWork {
  std::uint64_t records = 0, windows = 0, weighted = 0;
  std::uint64_t wrapped = 0;  ///< records with a coefficient that left its word
};

struct Rendering {
  std::vector<Event> events;
  std::vector<Picture> tiles;
  std::map<std::string, std::uint64_t> counts;  ///< by the names of the device's counters
  EllipseWork ellipses;                         ///< the oracle's only
};

/// Renders a whole stream; throws Refusal if the stream breaks a rule.
Rendering render(const Symbols& symbols, std::span<const std::uint8_t> bytes);

}  // namespace fastsplat::oracle
