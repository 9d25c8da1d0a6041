// SPDX-License-Identifier: Apache-2.0
// 3-D Gaussians in the lab: settings of their own beside the camera's, and the views of one cloud.
#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/image.hpp"
#include "scene/gaussians/projected_gaussian.hpp"
#include "scene/scene.hpp"

namespace fastsplat::lab {

struct GaussianRequest {
  std::string name;                        ///< built in, "shells:2000", or a file
  scene::GaussianDescription description;  ///< `up` if `up_given`
  bool up_given = false;                   ///< else up is as the file declares: -y, and z if built in
  std::string flags;                       ///< " --up z --cutoff 2", of the program
};

/// Settings of Gaussians, each as a setting of a scene in the page's tables.
nlohmann::ordered_json gaussian_settings();
/// Why a setting of a scene has no effect on Gaussians; empty for the camera's and the size.
std::string idle_for_gaussians(const std::string& setting);
/// Whether it is one of gaussian_settings().
bool is_of_gaussians(const std::string& setting);

/// Camera and size from `scene`, the rest from the settings of the request. Throws UserError about an invalid value.
GaussianRequest gaussian_request(const std::string& name, const nlohmann::ordered_json& settings,
                                 const scene::SceneDescription& scene);

struct GaussianView {
  std::string key;
  scene::GaussianScene scene;
  std::vector<scene::ProjectedGaussian> projected;
  Image golden;
};

/// Keeps a cloud and its last view.
class GaussianViews {
 public:
  /// Throws UserError for clouds too large for a page, before they are loaded.
  const GaussianView& of(const GaussianRequest& request);

 private:
  std::string name_;
  std::shared_ptr<const scene::GaussianCloud> cloud_;
  std::optional<GaussianView> view_;
};

}  // namespace fastsplat::lab
