// SPDX-License-Identifier: Apache-2.0
// An attribution as text, as JSON and as maps.
#pragma once

#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>

#include "analysis/errors/attribution.hpp"
#include "analysis/errors/cost.hpp"
#include "analysis/errors/suggestion.hpp"
#include "base/image.hpp"

namespace fastsplat::analysis {

/// A suggestion for the step with the largest share, tried on the scene.
struct TriedSuggestion {
  std::string step;  ///< name of the set
  Suggestion suggestion;
  Amount error;                                ///< the remaining error
  std::optional<std::pair<Cost, Cost>> costs;  ///< before and after; only for index.kind rlut, as in rtl/
};

/// The frame's chain with another configuration, which outlives it.
using ChainOf = std::function<std::unique_ptr<stages::Chain>(const cmodel::Config&)>;
/// Tries the suggestion for the step with the largest share that has one.
std::optional<TriedSuggestion> try_suggestion(const ChainOf& chain_of, const cmodel::Config& config,
                                              const Attribution& attribution, bool gaussians, int threads);

/// The answer first, then the table. `bits`: amounts are in LSB of this width.
std::string to_text(const Attribution& attribution, const std::optional<TriedSuggestion>& tried, int bits);
nlohmann::ordered_json to_json(const Attribution& attribution, const std::optional<TriedSuggestion>& tried);

/// The step that rules each pixel, with a legend.
Image blame_map(const Attribution& attribution);
/// The errors unchanged: RGBA.
Image to_image(const stages::Picture& picture);
/// A step's name as part of a file name: "position-snap".
std::string file_word(const std::string& name);

}  // namespace fastsplat::analysis
