// An attribution in words, as JSON and as maps.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>

#include "analysis/errors/attribution.hpp"
#include "analysis/errors/cost.hpp"
#include "analysis/errors/remedy.hpp"
#include "base/image.hpp"

namespace fastsplat::analysis {

/// What a remedy for the step with the largest share brings, tried on the scene.
struct TriedRemedy {
  std::string step;  ///< name of the set
  Remedy remedy;
  Amount error;                                ///< that is left with it
  std::optional<std::pair<Cost, Cost>> costs;  ///< before and after; of the device of rtl/, whose index is the RLUT
};

/// Of the step with the largest share for which there is one. `real` is the attribution's.
std::optional<TriedRemedy> try_remedy(const scene::Scene& scene, const cmodel::Config& config,
                                      const Attribution& attribution, int threads);

/// The answer first, then the table. `bits`: the LSB that is the unit of amounts.
std::string to_text(const Attribution& attribution, const std::optional<TriedRemedy>& tried, int bits);
nlohmann::ordered_json to_json(const Attribution& attribution, const std::optional<TriedRemedy>& tried);

/// Which step rules each pixel, with a legend.
Image blame_map(const Attribution& attribution);
/// The errors as they are: RGBA.
Image to_image(const stages::Picture& picture);
/// A step's name as part of a file's: "position-snap".
std::string file_word(const std::string& name);

}  // namespace fastsplat::analysis
