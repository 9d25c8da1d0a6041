#include "testbench/stimulus/directed_stream.hpp"

#include <algorithm>

#include "cmodel/records.hpp"
#include "testbench/stimulus/stimulus.hpp"

namespace fastsplat::testbench {

std::vector<Record> records_of(const std::vector<cmodel::Beat>& beats) {
  std::vector<Record> out;
  for (std::size_t at = 0; at < beats.size(); at += 1 + cmodel::announced_beats(beats[at]))
    out.push_back({at, static_cast<cmodel::Opcode>(get(beats[at], cmodel::layout::kOpcode))});
  return out;
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

}  // namespace fastsplat::testbench
