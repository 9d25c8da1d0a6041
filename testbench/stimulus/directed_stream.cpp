// SPDX-License-Identifier: Apache-2.0
#include "testbench/stimulus/directed_stream.hpp"

#include <algorithm>
#include <stdexcept>

#include "cmodel/stream/records.hpp"
#include "testbench/stimulus/stimulus.hpp"

namespace fastsplat::testbench {

std::vector<Record> records_of(const std::vector<cmodel::Beat>& beats) {
  std::vector<Record> out;
  for (std::size_t at = 0; at < beats.size(); at += 1 + cmodel::announced_beats(beats[at]))
    out.push_back({at, static_cast<cmodel::Opcode>(get(beats[at], cmodel::layout::kOpcode))});
  return out;
}

std::size_t first_of(const std::vector<cmodel::Beat>& beats, cmodel::Opcode wanted) {
  const auto records = records_of(beats);
  return std::ranges::find(records, wanted, &Record::opcode)->at;
}

bool begins_frame(const cmodel::Beat& beat) {
  return get(beat, cmodel::layout::kOpcode) == static_cast<std::int64_t>(cmodel::Opcode::BeginFrame) &&
         get(beat, cmodel::layout::kFrameMagic) == std::int64_t{cmodel::kStreamMagic};
}

void overwrite(cmodel::Beat& beat, const cmodel::Field& field, std::uint64_t value) {
  beat[static_cast<std::size_t>(field.word)] &= ~field_mask(field);
  put(beat, field, value);
}

std::vector<cmodel::Beat> small_stream(const cmodel::Config& config) {
  constexpr std::uint64_t kMostSeeds = 32;
  std::vector<cmodel::Beat> beats;
  for (std::uint64_t seed = 1; seed <= kMostSeeds; ++seed) {
    beats = write_document(config, make_stimulus(config, StimulusClass::Mixed, seed, 40).document);
    const auto records = records_of(beats);
    int sheets = 0, most = 0;
    for (const Record& record : records) {
      if (record.opcode == cmodel::Opcode::BeginTile) sheets = 0;
      if (record.opcode == cmodel::Opcode::BeginSheet) most = std::max(most, ++sheets);
    }
    const bool culls = std::ranges::find(records, cmodel::Opcode::CullBlock, &Record::opcode) != records.end();
    if (culls && most >= 2) break;
  }
  return beats;
}

std::pair<std::vector<cmodel::Beat>, std::size_t> small_densities(const cmodel::Config& config) {
  constexpr std::uint64_t kMostSeeds = 200;
  for (std::uint64_t seed = 1; seed <= kMostSeeds; ++seed) {
    const auto document = make_stimulus(config, StimulusClass::Mixed, seed, 40).document;
    const TileDocument& tile = document.tiles.front();
    if (!cmodel::holds_densities(tile.begin.mode) || tile.sheets.size() < 2) continue;
    auto beats = write_document(config, document);
    const auto records = records_of(beats);
    const auto end = std::ranges::find(records, cmodel::Opcode::EndTile, &Record::opcode);
    return {std::move(beats), end->at};
  }
  throw std::logic_error("no stream of densities in " + std::to_string(kMostSeeds) + " seeds");
}

}  // namespace fastsplat::testbench
