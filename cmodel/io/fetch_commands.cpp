// SPDX-License-Identifier: Apache-2.0
#include "cmodel/io/fetch_commands.hpp"

#include <stdexcept>

#include "cmodel/cull/cull_unit.hpp"
#include "cmodel/stream/records.hpp"

namespace fastsplat::cmodel {
namespace {

/// Consecutive beats that become a command.
class Run {
 public:
  explicit Run(std::uint64_t address) : address_(address) {}
  void add(std::uint64_t beats) { beats_ += beats; }
  void add_set(std::uint32_t splats) {
    ++beats_;
    ++sets_;
    splats_ += splats;
  }
  bool has_sets() const { return sets_ > 0; }
  std::uint64_t splats() const { return splats_; }
  /// Appends the command to `out`; the next one begins after the splats.
  void close(std::vector<FetchCommand>& out) {
    if (beats_ == 0) return;
    if (beats_ >> 32 != 0 || splats_ >> 32 != 0 || sets_ > kMostFetchSets)
      throw std::logic_error("a fetch command exceeds its format");
    out.push_back({.address = address_,
                   .beats = static_cast<std::uint32_t>(beats_),
                   .sets = static_cast<std::uint32_t>(sets_),
                   .splats = static_cast<std::uint32_t>(splats_)});
    address_ += (beats_ + splats_) * kBeatBytes;
    beats_ = sets_ = splats_ = 0;
  }

 private:
  std::uint64_t address_, beats_ = 0, sets_ = 0, splats_ = 0;
};

}  // namespace

void refuse_parted_sets(std::uint64_t beat, std::uint64_t waiting) {
  throw UserError(ExitCode::Input,
                  {.where = "beat " + std::to_string(beat) + " (byte offset " + std::to_string(beat * kBeatBytes) + ")",
                   .what = "cull_block between the splats of a group: a fetching source cannot skip them",
                   .expected = "no open splats of previous groups",
                   .got = std::to_string(waiting),
                   .fix = "send every beat, or write a sheet's cull_blocks before its splats"});
}

std::vector<FetchCommand> fetch_commands(const Config& config, std::span<const Beat> beats, std::uint64_t address) {
  std::vector<FetchCommand> out;
  Run run(address);
  bool tests = false;
  for (std::size_t at = 0; at < beats.size();) {
    const auto opcode = static_cast<Opcode>(get(beats[at], layout::kOpcode));
    if (opcode == Opcode::BeginTile) tests = config.culls() && culls_in(std::get<BeginTile>(from_beat(beats[at])).mode);
    if (opcode == Opcode::CullBlock && config.culls()) {
      run.add_set(tests ? std::get<CullBlock>(from_beat(beats[at])).splats : 0);
      ++at;
      continue;
    }
    if (run.has_sets()) {
      const std::uint64_t splats = run.splats();
      run.close(out);
      for (std::uint64_t i = 0; i < splats; ++i) {
        if (static_cast<Opcode>(get(beats[at + i], layout::kOpcode)) == Opcode::CullBlock)
          refuse_parted_sets(at + i, splats - i);
      }
      at += splats;
      if (splats > 0) continue;
    }
    const std::uint64_t more = 1 + announced_beats(beats[at]);
    run.add(more);
    at += more;
  }
  run.close(out);
  return out;
}

}  // namespace fastsplat::cmodel
