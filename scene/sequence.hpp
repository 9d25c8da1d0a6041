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
  std::vector<double> keys;  ///< at least one; whole settings take the nearest whole number of what lies between
};

/// The first key belongs to frame 0. The last one belongs to the last frame or, in a loop, to the frame after it, which
/// is the first again.
struct Sequence {
  int frames = 1;
  bool loop = false;
  std::vector<Track> tracks;
};

inline constexpr int kMaxFrames = 1'000'000;

/// `camera.azimuth` from one angle to another, both included; whole turns are loops. UserError (Usage) when the two are
/// equal.
Sequence orbit(double from, double to, int frames);

/// What the table [sequence] of a scene.toml says. UserError (Input) when the file has none.
Sequence load_sequence(const std::filesystem::path& scene_file);

/// `still` with every track's setting as it is in frame 0 <= frame < frames.
SceneDescription at_frame(const Sequence& sequence, const SceneDescription& still, int frame);

/// Those settings that would change nothing in any of the frames.
std::vector<Given> idle_of(std::vector<Given> given, const Sequence& sequence, const SceneDescription& still);

}  // namespace fastsplat::scene
