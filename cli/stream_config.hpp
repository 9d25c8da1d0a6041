// SPDX-License-Identifier: Apache-2.0
// The configuration of a recorded stream, which bears only its hash.
#pragma once

#include <string>

#include "cli/config_flags.hpp"

namespace fastsplat::cli {

/// Without --config and --set: those of the built-in configuration with the stream's hash, or of 3-D Gaussians. Other
/// hashes leave the flags as they are. Throws UserError (Input) if the file is not a stream.
ConfigFlags for_stream(ConfigFlags flags, const std::string& stream);

}  // namespace fastsplat::cli
