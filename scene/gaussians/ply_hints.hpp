// SPDX-License-Identifier: Apache-2.0
// Comments in a PLY's header by which trainers and exporters change the picture.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scene/gaussians/gaussian_cloud.hpp"

namespace fastsplat::scene {

struct PlyHints {
  std::optional<UpAxis> up{};
  bool antialiased = false, linear = false;  ///< as GaussianCloud's
  std::optional<int> degree{};               ///< of the harmonics
  std::vector<std::string> remarks{};        ///< unsupported declarations, a sentence each
};

/// `comments`: the text after the words `comment` and `obj_info`, in the file's order. If two comments have the same
/// key, the last one counts. Comments with other keys are free text and are ignored without a remark.
PlyHints hints_of(std::span<const std::string> comments);

}  // namespace fastsplat::scene
