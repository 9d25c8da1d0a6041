#include "scene/gaussians/gaussian_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "base/error.hpp"
#include "scene/gaussians/synthetic_gaussians.hpp"

namespace fastsplat::scene {
namespace {

template <class Vector>
bool finite(const Vector& vector) {
  for (int i = 0; i < vector.length(); ++i) {
    if (!std::isfinite(vector[i])) return false;
  }
  return true;
}

[[noreturn]] void bad(const std::string& where, const std::string& what, const std::string& expected) {
  throw_input({.where = where, .what = what, .expected = expected, .got = {}, .fix = "the file is damaged"});
}

}  // namespace

void check_gaussian(const Gaussian& gaussian, std::span<const glm::vec3> harmonics, const std::string& where) {
  if (!finite(gaussian.position)) bad(where, "its position is not finite", "numbers that a float holds");
  if (!finite(gaussian.scale)) bad(where, "its scale is not finite", "numbers that a float holds");
  if (!(std::min({gaussian.scale.x, gaussian.scale.y, gaussian.scale.z}) >= 0.0F))
    bad(where, "its scale is negative", "standard deviations");
  if (!(gaussian.opacity >= 0.0F && gaussian.opacity <= 1.0F)) bad(where, "its opacity is not a number", "a number");
  if (!std::ranges::all_of(harmonics, [](const glm::vec3& one) { return finite(one); }))
    bad(where, "its colour is not finite", "numbers that a float holds");
}

glm::vec4 unit_rotation(const glm::dvec4& rotation, const std::string& where) {
  const double length = glm::length(rotation);
  if (!(length > 0.0) || !std::isfinite(length)) bad(where, "its rotation has no direction", "a quaternion w x y z");
  return rotation / length;
}

std::vector<std::filesystem::path> files_of_gaussians(const std::string& name_or_path) {
  std::string ending = std::filesystem::path(name_or_path).extension().string();
  return is_synthetic_gaussians(name_or_path) && ending != ".ply" && ending != ".splat"
             ? std::vector<std::filesystem::path>{}
             : std::vector<std::filesystem::path>{name_or_path};
}

GaussianCloud load_gaussians(const std::string& name_or_path) {
  const auto files = files_of_gaussians(name_or_path);
  if (files.empty()) return make_synthetic_gaussians(name_or_path);
  std::string ending = files[0].extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
  if (ending == ".ply") return read_gaussian_ply(files[0]);
  if (ending == ".splat") return read_splat_file(files[0]);
  throw_input({.where = name_or_path,
               .what = "not a file of 3-D Gaussians by its ending, nor a built-in scene",
               .expected = fmt::format(".ply or .splat, or {}", fmt::join(synthetic_gaussian_names(), ", ")),
               .got = {},
               .fix = "for example --gaussians shells:2000"});
}

}  // namespace fastsplat::scene
