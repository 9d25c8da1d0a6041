// SPDX-License-Identifier: Apache-2.0
// The command that replays a failed stream.
#pragma once

#include <filesystem>
#include <string>

#include "cli/config_flags.hpp"
#include "testbench/check/verify.hpp"

namespace fastsplat::cli {

/// `fastsplat verify --stream ... --config ... [--set ...] --ready ... --seed ... [--fault ...]`, quoted for a shell.
std::string replay_line(const std::filesystem::path& stream, const ConfigFlags& config,
                        const testbench::VerifyOptions& options, const std::string& fault = {});

}  // namespace fastsplat::cli
