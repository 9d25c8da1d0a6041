// Commands for a fetching source: the beats of a stream in memory that it reads, and the place of splats that the
// device may not need (docs/microarchitecture.md, "Fetch").
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/error.hpp"
#include "cmodel/numbers/config.hpp"
#include "cmodel/stream/beat.hpp"

namespace fastsplat::cmodel {

/// Reads and sends `beats` beats from `address` on. The last `sets` of them are its only cull_blocks. If `splats` is
/// not 0, that many splats of these sets follow, in order and without a gap. Sets that the device reports as hidden are
/// then skipped; if it hid nothing of the previous command, all are read. If `splats` is 0, answers change nothing.
struct FetchCommand {
  std::uint64_t address = 0;  ///< bytes; a multiple of a beat's
  std::uint32_t beats = 0, sets = 0, splats = 0;
  bool operator==(const FetchCommand&) const = default;
};

/// Sets of a command at the most: rtl/io/fastsplat_fetch.sv has room for as many.
inline constexpr std::uint32_t kMostFetchSets = 1024;

/// Of a legal stream, or of whole tiles of one, in memory from `address` on. Where the configuration does not cull a
/// single command. Throws UserError (Input) for a set whose splats a cull_block lies between.
std::vector<FetchCommand> fetch_commands(const Config& config, std::span<const Beat> beats, std::uint64_t address);

/// That a cull_block, beat `beat`, comes while `waiting` splats of sets before it are still to come: no source can tell
/// where these end.
[[noreturn]] void refuse_parted_sets(std::uint64_t beat, std::uint64_t waiting);

/// A command as fastsplat_fetch takes it: address in words 0 and 1, then beats, sets, splats.
inline std::array<std::uint32_t, 5> words_of(const FetchCommand& command) {
  return {static_cast<std::uint32_t>(command.address), static_cast<std::uint32_t>(command.address >> 32), command.beats,
          command.sets, command.splats};
}

}  // namespace fastsplat::cmodel
