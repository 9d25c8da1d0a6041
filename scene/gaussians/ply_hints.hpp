// What trainers and exporters say in the comments of a PLY's header that changes the picture.
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
  std::vector<std::string> remarks{};        ///< what is said there and not followed, a sentence each
};

/// `comments`: the text behind the words `comment` and `obj_info`, in the file's order. Of two that say the same thing
/// the last one counts. Comments with other keys are free text and pass without a remark.
PlyHints hints_of(std::span<const std::string> comments);

}  // namespace fastsplat::scene
