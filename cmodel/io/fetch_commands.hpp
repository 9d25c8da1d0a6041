// SPDX-License-Identifier: Apache-2.0
// Commands for a fetching source: which beats of a stream in memory to read, and where splats lie that the device may
// not need (M-fetch-1).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/error.hpp"
#include "cmodel/numbers/config.hpp"
#include "cmodel/stream/beat.hpp"

namespace fastsplat::cmodel {

/// Reads and sends `beats` beats from `address` on. The last `sets` of them are its only cull_blocks. If `splats` is
/// not 0, that many splats of these cull groups follow, in order and without a gap. Groups that the device reports as
/// hidden are then skipped; if it hid nothing of the previous command, all are read. If `splats` is 0, verdicts change
/// nothing.
struct FetchCommand {
  std::uint64_t address = 0;  ///< bytes; a multiple of a beat's
  std::uint32_t beats = 0, sets = 0, splats = 0;
  bool operator==(const FetchCommand&) const = default;
};

/// Most cull groups of a command: the room in rtl/io/fastsplat_fetch.sv.
inline constexpr std::uint32_t kMostFetchSets = 1024;

/// Commands for a legal stream, or for whole tiles of one, in memory from `address` on; a single one if the
/// configuration does not cull. Throws UserError (Input) for a cull_block between the splats of a group.
std::vector<FetchCommand> fetch_commands(const Config& config, std::span<const Beat> beats, std::uint64_t address);

/// Throws UserError (Input): the cull_block at beat `beat` comes while `waiting` splats of earlier groups are to come,
/// so no source can find where they end (M-fetch-6).
[[noreturn]] void refuse_parted_sets(std::uint64_t beat, std::uint64_t waiting);

/// A command as fastsplat_fetch takes it: address in words 0 and 1, then beats, sets, splats.
inline std::array<std::uint32_t, 5> words_of(const FetchCommand& command) {
  return {static_cast<std::uint32_t>(command.address), static_cast<std::uint32_t>(command.address >> 32), command.beats,
          command.sets, command.splats};
}

}  // namespace fastsplat::cmodel
