// SPDX-License-Identifier: Apache-2.0
// The commands that replay a failed stream, and follow its pixel.
#pragma once

#include <filesystem>
#include <string>

#include "cli/config_flags.hpp"
#include "testbench/check/verify.hpp"
#include "testbench/triage/pixel_words.hpp"

namespace fastsplat::cli {

/// `fastsplat pixel X,Y --tile N --stream ... --config ... [--set ...]`: the pixel of a mismatch in the model's words.
std::string pixel_line(const std::filesystem::path& stream, const ConfigFlags& config,
                       const testbench::TilePixel& pixel);
/// `fastsplat verify --stream ... --config ... [--set ...] --ready ... --seed ... [--fault ...]`, quoted for a shell.
std::string replay_line(const std::filesystem::path& stream, const ConfigFlags& config,
                        const testbench::VerifyOptions& options, const std::string& fault = {});

}  // namespace fastsplat::cli
