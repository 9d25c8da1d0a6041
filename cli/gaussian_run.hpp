// `render --gaussians`: a view of 3-D Gaussians through the floating-point renderer or the integer device.
#pragma once

#include "base/error.hpp"
#include "cli/render_arguments.hpp"

namespace fastsplat::cli {

/// `arguments.gaussians.file` is there, and whatever has a meaning for volumes as well was checked.
ExitCode run_gaussians(const RenderArguments& arguments);

}  // namespace fastsplat::cli
