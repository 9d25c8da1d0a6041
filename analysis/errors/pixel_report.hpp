// SPDX-License-Identifier: Apache-2.0
// One pixel's whole story: device beside real, and which steps its error comes from (docs/errors.md, section 8).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "analysis/pipeline/pixel_trace.hpp"

namespace fastsplat::analysis {

/// What a step adds to the pixel's error when it, too, becomes the device's, after those before it.
struct PixelPart {
  stages::StepSet set;
  golden::Sums error{};  ///< R, G, B, A
};

struct PixelReport {
  int x = 0, y = 0;
  stages::PixelTrace real, device;
  std::vector<PixelPart> parts;  ///< in pipeline order; together the error
  std::size_t channel = 0;       ///< with the largest error
  golden::Sums error() const;    ///< device - real
};

/// Throws as PixelChain does.
PixelReport explain(const stages::Chain& chain, int x, int y, int threads);

/// Sheets that the text shows splat by splat. By default: the brightest splats of the sheet in which the channel's
/// error grows most.
struct Details {
  bool all = false;
  std::optional<int> sheet;
};
/// Steps, sheets and splats; `bits`: one LSB is 1/(2^bits - 1). Throws UserError (Usage) if no splat is in the sheet.
std::string to_text(const PixelReport& report, const stages::Chain& chain, const Details& details, int bits);
/// Everything, with the device's words.
nlohmann::ordered_json to_json(const PixelReport& report, const stages::Chain& chain);

}  // namespace fastsplat::analysis
