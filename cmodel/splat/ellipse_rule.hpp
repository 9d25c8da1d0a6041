// What makes an ellipse's record one that can be drawn (docs/stream.md, rule 18).
#pragma once

#include <optional>

#include "base/error.hpp"
#include "cmodel/numbers/config.hpp"
#include "cmodel/stream/records.hpp"

namespace fastsplat::cmodel {

/// What is wrong with the shape or the windows; x and y are in range.
std::optional<ErrorParts> ellipse_violation(const Config& config, const EllipseRecord& record);

}  // namespace fastsplat::cmodel
