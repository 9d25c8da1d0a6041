// SPDX-License-Identifier: Apache-2.0
// A scene over time: the settings that change from frame to frame.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scene/capability.hpp"

namespace fastsplat::scene {

/// One setting and the values it passes through, evenly spread over the sequence and linear between.
struct Track {
  std::string setting;       ///< as in scene.toml: "camera.azimuth", "opacity_scale"
  std::vector<double> keys;  ///< at least one; integer settings round interpolated values to the nearest
};

/// The first key belongs to frame 0. The last one belongs to the last frame or, in a loop, to the frame after it, which
/// equals the first.
struct Sequence {
  int frames = 1;
  bool loop = false;
  std::vector<Track> tracks;
};

inline constexpr int kMaxFrames = 1'000'000;

/// `camera.azimuth` from one angle to another, both included; whole turns are loops. UserError (Usage) when the two are
/// equal.
Sequence orbit(double from, double to, int frames);

/// The table [sequence] of a scene.toml. Throws UserError (Input) if the file lacks it.
Sequence load_sequence(const std::filesystem::path& scene_file);

/// `still` with every track's setting at its value in frame 0 <= frame < frames.
SceneDescription at_frame(const Sequence& sequence, const SceneDescription& still, int frame);

/// The settings that would change nothing in any of the frames.
std::vector<Given> idle_of(std::vector<Given> given, const Sequence& sequence, const SceneDescription& still);

}  // namespace fastsplat::scene
