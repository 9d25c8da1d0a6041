// SPDX-License-Identifier: Apache-2.0
// What a file of Gaussians costs, attribute by attribute, and the device behind it (docs/errors.md, section 9).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "analysis/errors/attribution.hpp"
#include "cmodel/numbers/config.hpp"
#include "driver/tiles/gaussian_frame.hpp"
#include "scene/gaussians/gaussian_scene.hpp"

namespace fastsplat::analysis {

/// One attribute of the file, or one step of the device.
struct FileError {
  std::string name;
  bool of_device = false;
  double share = 0.0;  ///< of its increment in the whole error; all add up to 1
  Amount increment;    ///< when it joins all before it
  Amount only;         ///< with it alone changed; of attributes
};

struct FileErrors {
  std::size_t original = 0, encoded = 0, matched = 0;  ///< Gaussians
  std::vector<FileError> parts;                        ///< attributes, then steps; none is left out
  Amount file, device, total;                          ///< encoded against original; device against encoded; both
  driver::GaussianReport report;                       ///< what of `encoded` the device does not hold
};

/// The picture of `original` in golden against that of `encoded` on the device. Both have the camera and the order of
/// `original`. Shares are share_of() the whole error.
FileErrors file_errors(const scene::GaussianScene& original, const scene::GaussianCloud& encoded,
                       const cmodel::Config& config, int threads, const Progress& progress);

std::string to_text(const FileErrors& errors, int lsb_bits);
nlohmann::ordered_json to_json(const FileErrors& errors);

}  // namespace fastsplat::analysis
