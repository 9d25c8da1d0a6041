// SPDX-License-Identifier: Apache-2.0
// Animations: renders numbered frames, keeps up-to-date ones of earlier runs, and writes the video.
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "cli/frame.hpp"
#include "cli/output.hpp"
#include "cli/render_arguments.hpp"
#include "scene/sequence.hpp"

namespace fastsplat::cli {

/// The sequence selected by --orbit, --sequence and --frames; empty for a still, and for --sequence of Gaussians, whose
/// frames are the cameras of --cameras. UserError (Usage) if the flags contradict each other.
std::optional<scene::Sequence> sequence_of(const RenderArguments& arguments);

/// Throws UserError unless all files of all frames and the video can be written; called before any rendering.
void check_animation(const RenderArguments& arguments, int frames);

/// Writes a rendered frame and adds its figures to the JSON.
using WriteFrame = std::function<ExitCode(const FrameFiles&, nlohmann::ordered_json&)>;
/// A frame before it is rendered.
struct AnimationFrame {
  images::Metadata metadata;  ///< that its files get
  std::function<WriteFrame(const Progress&)> render;
};

/// Renders the frames 0 to `frames - 1` in order. A frame whose files are all complete images with the metadata it
/// would get is kept, unless it is checked; other files under its names are replaced. Returns early with the exit code
/// of the first frame whose check fails.
ExitCode run_animation(const RenderArguments& arguments, int frames, const std::function<AnimationFrame(int)>& frame,
                       const Output& output);
/// The frames of a volume's scene.
ExitCode run_animation(const RenderArguments& arguments, const Renderer& renderer, const scene::SceneDescription& still,
                       const scene::Sequence& sequence, const Output& output);

}  // namespace fastsplat::cli
