// SPDX-License-Identifier: Apache-2.0
// `render --gaussians`: renders 3-D Gaussians with the floating-point renderer or the integer device.
#pragma once

#include "base/error.hpp"
#include "cli/render_arguments.hpp"

namespace fastsplat::cli {

/// Preconditions: `arguments.gaussians.file` is set; flags shared with volumes have been checked.
ExitCode run_gaussians(const RenderArguments& arguments);

}  // namespace fastsplat::cli
