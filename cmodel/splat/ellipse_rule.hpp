// SPDX-License-Identifier: Apache-2.0
// Checks whether an ellipse record can be drawn (docs/stream.md, rule 18).
#pragma once

#include <optional>

#include "base/error.hpp"
#include "cmodel/numbers/config.hpp"
#include "cmodel/stream/records.hpp"

namespace fastsplat::cmodel {

/// The first error of shape or windows, or empty. Requires x and y in range.
std::optional<ErrorParts> ellipse_violation(const Config& config, const EllipseRecord& record);

}  // namespace fastsplat::cmodel
