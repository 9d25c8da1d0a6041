// SPDX-License-Identifier: Apache-2.0
// Verdicts of model and oracle on a stream that may break rules: accepted, or refused at which beat; and whether they
// agree.
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
  std::optional<std::uint64_t> refused_at;  ///< beat; empty: accepted
  std::string text;
  ErrorParts parts;  ///< of the model only
  ExitCode code = ExitCode::Pass;
};
/// Exceptions other than UserError propagate, so a crash or an assertion fails the test.
Verdict model_verdict(const cmodel::Config& config, std::span<const std::uint8_t> bytes,
                      oracle::Rendering* out = nullptr);
Verdict oracle_verdict(const cmodel::Config& config, std::span<const std::uint8_t> bytes,
                       oracle::Rendering* out = nullptr);

/// Empty if both refuse the same beat, or both accept the stream and render the same.
std::string disagreement(const cmodel::Config& config, std::span<const std::uint8_t> bytes, bool* taken = nullptr);

}  // namespace fastsplat::test
