// SPDX-License-Identifier: Apache-2.0
// `render --gaussians`: stills and animations of 3-D Gaussians.
#pragma once

#include "base/error.hpp"
#include "cli/frame.hpp"
#include "cli/render_arguments.hpp"

namespace fastsplat::cli {

/// Preconditions: `arguments.gaussians.file` is set; flags shared with volumes have been checked. `how`: without a
/// configuration yet.
ExitCode run_gaussians(const RenderArguments& arguments, const Renderer& how);

}  // namespace fastsplat::cli
