// SPDX-License-Identifier: Apache-2.0
// What model and oracle say to a stream that may break rules: taken, or refused at which beat; and whether they agree.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "base/error.hpp"
#include "cmodel/numbers/config.hpp"
#include "tests/cmodel/compare_helper.hpp"

namespace fastsplat::test {

struct Verdict {
  std::optional<std::uint64_t> refused_at;  ///< beat; empty: taken
  std::string text;
  ErrorParts parts;  ///< of the model only
  ExitCode code = ExitCode::Pass;
};
/// Anything but a UserError passes through, so a crash or an assertion is a failing test.
Verdict model_verdict(const cmodel::Config& config, std::span<const std::uint8_t> bytes,
                      oracle::Rendering* out = nullptr);
Verdict oracle_verdict(const cmodel::Config& config, std::span<const std::uint8_t> bytes,
                       oracle::Rendering* out = nullptr);

/// Empty where both refuse the same beat, or both take the stream and render the same.
std::string disagreement(const cmodel::Config& config, std::span<const std::uint8_t> bytes, bool* taken = nullptr);

}  // namespace fastsplat::test
