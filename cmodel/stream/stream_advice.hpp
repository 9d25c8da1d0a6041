// SPDX-License-Identifier: Apache-2.0
// Shared texts of all refusals of a stream: the place and the suggestion.
#pragma once

#include <cstdint>
#include <string>

#include "cmodel/stream/stream_layout.hpp"

namespace fastsplat::cmodel {

/// "beat 4 (byte offset 128)".
inline std::string beat_place(std::uint64_t beat) {
  return "beat " + std::to_string(beat) + " (byte offset " + std::to_string(beat * kBeatBytes) + ")";
}

/// "stream version 1, this program reads version 2".
inline std::string version_message(std::int64_t got) {
  return "stream version " + std::to_string(got) + ", this program reads version " + std::to_string(kStreamVersion);
}

// Suggestions by cause: damaged file, faulty writer, other version, other configuration.
inline constexpr const char* kDamagedStream = "the stream is damaged or truncated: copy or record it again";
inline constexpr const char* kMiswrittenStream =
    "see the rule in docs/stream.md: correct the program that wrote the stream, or record it again";
inline constexpr const char* kOtherVersion = "record it again";
inline constexpr const char* kForeignStream =
    "use the configuration it was recorded with, or record it again with this one";

}  // namespace fastsplat::cmodel
