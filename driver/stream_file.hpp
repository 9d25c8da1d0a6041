// Recorded streams (.fss, docs/stream.md): what the device would be fed, in a file.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>

#include "cmodel/beat.hpp"
#include "cmodel/device.hpp"
#include "driver/render.hpp"

namespace fastsplat::driver {

/// Compiles the scene and writes the stream; atomic. Memory stays bounded whatever the stream's length.
DriverReport record_stream(const scene::Scene& scene, const cmodel::Config& config, const std::filesystem::path& path,
                           const RenderOptions& options = {});

/// Feeds a recorded stream to the cmodel. A corrupt, truncated or foreign stream is a UserError (Input) with the byte
/// offset and the reason; a configuration that differs from the stream's is refused by hash and name.
DeviceRender replay_stream(const std::filesystem::path& path, const cmodel::Config& config,
                           const RenderOptions& options = {});

/// The same to any device that checks its stream, whatever it does with it; finishes the device.
void feed_stream(const std::filesystem::path& path, cmodel::Device& device, const RenderOptions& options = {});

/// The file's beats in order, some thousands at a time, contents unchecked.
void read_beats(const std::filesystem::path& path, const cmodel::BeatSink& sink);

/// Writes beats as they are; atomic.
void write_beats(const std::filesystem::path& path, std::span<const cmodel::Beat> beats);

/// One line of text per record, to `line`; stops when it returns false.
void dump_stream(const std::filesystem::path& path, const std::function<bool(const std::string&)>& line);

}  // namespace fastsplat::driver
