// SPDX-License-Identifier: Apache-2.0
// Animations: renders numbered frames, keeps up-to-date ones of earlier runs, and writes the video.
#pragma once

#include <optional>
#include <string>

#include "cli/frame.hpp"
#include "cli/output.hpp"
#include "cli/render_arguments.hpp"
#include "scene/sequence.hpp"

namespace fastsplat::cli {

/// The sequence selected by --orbit, --sequence and --frames; empty for a still. UserError (Usage) if they contradict.
std::optional<scene::Sequence> sequence_of(const RenderArguments& arguments);

/// Throws UserError unless all files of all frames and the video can be written; called before any rendering.
void check_animation(const RenderArguments& arguments, const scene::Sequence& sequence);

/// Renders the frames in order. A frame whose files are all complete images with the metadata it would get is kept;
/// other files under its names are replaced. Returns early with the exit code of the first frame whose check fails.
ExitCode run_animation(const RenderArguments& arguments, const Renderer& renderer, const scene::SceneDescription& still,
                       const scene::Sequence& sequence, const Output& output);

}  // namespace fastsplat::cli
