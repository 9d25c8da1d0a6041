// SPDX-License-Identifier: Apache-2.0
// A recorded stream and the device's results for it, as plain text for any simulator (docs/capi.md, "Vectors").
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "cmodel/numbers/config.hpp"
#include "cmodel/numbers/counters.hpp"
#include "cmodel/stream/taps.hpp"
#include "driver/tiles/render.hpp"

namespace fastsplat::driver {

/// One of the written files.
struct VectorFile {
  std::string name;
  std::uint64_t lines = 0, bytes = 0;
  std::uint32_t crc = 0;  ///< CRC-32 (IEEE, as zlib) over all bytes
};

struct VectorReport {
  std::vector<VectorFile> files;  ///< without vectors.json, which lists them
  std::uint64_t beats = 0, pixel_beats = 0;
  std::array<std::uint64_t, cmodel::kTapCount> taps{};  ///< records
  cmodel::Counters counters;
};

/// The files' names, vectors.json last.
std::vector<std::string> vector_file_names();

/// Feeds the stream to the model and writes beats.hex, output.hex, one .hex file per tap, and records.json with the
/// same records. Writes vectors.json last, which lists all files with their checksums. Creates the folder if its parent
/// exists. Replaces all files of these names or none. Throws UserError (Input) as replay_stream does. Memory stays
/// bounded.
VectorReport write_vectors(const std::filesystem::path& stream, const cmodel::Config& config,
                           const std::filesystem::path& folder, const RenderOptions& options = {});

}  // namespace fastsplat::driver
