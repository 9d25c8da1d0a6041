// Numbered frames of a sequence: what is asked for, what is still good from an earlier run, the frames, the video.
#pragma once

#include <optional>
#include <string>

#include "cli/frame.hpp"
#include "cli/output.hpp"
#include "cli/render_arguments.hpp"
#include "scene/sequence.hpp"

namespace fastsplat::cli {

/// What --orbit, --sequence and --frames ask for; nothing for a still. UserError (Usage) where they contradict.
std::optional<scene::Sequence> sequence_of(const RenderArguments& arguments);

/// Every name of every frame can be written, and so can the video; before any time is spent.
void check_animation(const RenderArguments& arguments, const scene::Sequence& sequence);

/// Frame after frame, in order. A frame whose every file is a whole image with the very metadata it would get is kept,
/// anything else under its name is replaced. Ends early with the exit code of a frame whose check fails.
ExitCode run_animation(const RenderArguments& arguments, const Renderer& renderer, const scene::SceneDescription& still,
                       const scene::Sequence& sequence, const Output& output);

}  // namespace fastsplat::cli
