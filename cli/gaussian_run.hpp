// SPDX-License-Identifier: Apache-2.0
// `render --gaussians`: renders 3-D Gaussians with the floating-point renderer or the integer device.
#pragma once

#include "base/error.hpp"
#include "base/images/image_file.hpp"
#include "cli/render_arguments.hpp"

namespace fastsplat::cli {

/// Everything that determines a picture's values: pictures with equal entries are comparable. `engine`: what made it.
images::Metadata gaussian_metadata(const std::string& engine, const scene::GaussianScene& scene,
                                   const std::optional<cmodel::Config>& config, golden::GaussianOrder order);

/// Preconditions: `arguments.gaussians.file` is set; flags shared with volumes have been checked.
ExitCode run_gaussians(const RenderArguments& arguments);

}  // namespace fastsplat::cli
