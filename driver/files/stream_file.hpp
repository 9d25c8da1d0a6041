// SPDX-License-Identifier: Apache-2.0
// Recorded streams (.fss, docs/stream.md): the device's input in a file.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>

#include "cmodel/stream/beat.hpp"
#include "cmodel/stream/device.hpp"
#include "cmodel/stream/records.hpp"
#include "driver/tiles/render.hpp"

namespace fastsplat::driver {

/// Largest image of a recorded stream. A replay holds the whole image, so this bounds the memory that a header can
/// cost.
constexpr std::int64_t kMostImagePixels = std::int64_t{1} << 26;
/// Throws UserError (Usage) for a larger image.
void check_image_size(int width, int height);

/// Compiles the scene and writes the stream atomically. Memory stays bounded for any length of the stream.
DriverReport record_stream(const scene::Scene& scene, const cmodel::Config& config, const std::filesystem::path& path,
                           const RenderOptions& options = {});

/// The same for a compiled view of 3-D Gaussians (driver/tiles/gaussian_frame.hpp).
class GaussianFrame;
struct GaussianReport;
GaussianReport record_stream(const GaussianFrame& frame, const std::filesystem::path& path,
                             const Progress& progress = {});

/// The configuration hash in the stream's header.
std::uint64_t recorded_config(const std::filesystem::path& path);

/// Feeds a recorded stream to the cmodel. A corrupt, truncated or foreign stream is a UserError (Input) with the byte
/// offset and the reason; a configuration that differs from the stream's is refused by hash and name.
DeviceRender replay_stream(const std::filesystem::path& path, const cmodel::Config& config,
                           const RenderOptions& options = {});

/// The same for any device that checks its stream; finishes the device. Returns the header.
cmodel::BeginFrame feed_stream(const std::filesystem::path& path, cmodel::Device& device,
                               const RenderOptions& options = {});

/// Passes the file's beats to the sink in order, some thousands at a time, contents unchecked. Errors that the sink
/// reports at a beat are prefixed with the file's name.
void read_beats(const std::filesystem::path& path, const cmodel::BeatSink& sink);

/// Runs `action`; errors that it reports at a beat are prefixed with the file's name.
void naming(const std::filesystem::path& path, const std::function<void()>& action);

/// Throws UserError (Input) if the tiles of an otherwise valid stream leave out pixels of its image. replay_stream and
/// feed_stream check this themselves.
void require_covered(const std::filesystem::path& path);

/// Writes beats unchanged and atomically.
void write_beats(const std::filesystem::path& path, std::span<const cmodel::Beat> beats);

/// Passes one line of text per record to `line`; stops when it returns false. A truncated stream, or one that does not
/// match the beat count and checksum of its end_frame, is refused after the lines of its records.
void dump_stream(const std::filesystem::path& path, const std::function<bool(const std::string&)>& line);

}  // namespace fastsplat::driver
