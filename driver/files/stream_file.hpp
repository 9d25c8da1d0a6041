// Recorded streams (.fss, docs/stream.md): what the device would be fed, in a file.
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

/// Of a recorded stream's image: a replay holds all of it, and a header alone must not cost more memory than that.
constexpr std::int64_t kMostImagePixels = std::int64_t{1} << 26;
/// UserError (Usage) above it.
void check_image_size(int width, int height);

/// Compiles the scene and writes the stream; atomic. Memory stays bounded whatever the stream's length.
DriverReport record_stream(const scene::Scene& scene, const cmodel::Config& config, const std::filesystem::path& path,
                           const RenderOptions& options = {});

/// The same of a compiled view of 3-D Gaussians (driver/tiles/gaussian_frame.hpp).
class GaussianFrame;
struct GaussianReport;
GaussianReport record_stream(const GaussianFrame& frame, const std::filesystem::path& path,
                             const Progress& progress = {});

/// Feeds a recorded stream to the cmodel. A corrupt, truncated or foreign stream is a UserError (Input) with the byte
/// offset and the reason; a configuration that differs from the stream's is refused by hash and name.
DeviceRender replay_stream(const std::filesystem::path& path, const cmodel::Config& config,
                           const RenderOptions& options = {});

/// The same to any device that checks its stream, whatever it does with it; finishes the device. Returns the header.
cmodel::BeginFrame feed_stream(const std::filesystem::path& path, cmodel::Device& device,
                               const RenderOptions& options = {});

/// The file's beats in order, some thousands at a time, contents unchecked. What the sink finds wrong at a beat is told
/// with the file's name.
void read_beats(const std::filesystem::path& path, const cmodel::BeatSink& sink);

/// Runs `action`; what it finds wrong at a beat is told with the file's name.
void naming(const std::filesystem::path& path, const std::function<void()>& action);

/// UserError (Input) for a stream, sound otherwise, whose tiles leave out pixels of its image: replay_stream and
/// feed_stream look themselves.
void require_covered(const std::filesystem::path& path);

/// Writes beats as they are; atomic.
void write_beats(const std::filesystem::path& path, std::span<const cmodel::Beat> beats);

/// One line of text per record, to `line`; stops when it returns false. A stream that is cut, or whose beats or
/// checksum are not those of its end, is refused after the lines of what is there.
void dump_stream(const std::filesystem::path& path, const std::function<bool(const std::string&)>& line);

}  // namespace fastsplat::driver
