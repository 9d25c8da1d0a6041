// SPDX-License-Identifier: Apache-2.0
#include "scene/gaussians/gaussian_file.hpp"

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/lower_case.hpp"
#include "base/read_file.hpp"
#include "scene/gaussians/gaussian_rows.hpp"
#include "scene/gaussians/other_formats.hpp"
#include "scene/gaussians/synthetic_gaussians.hpp"

namespace fastsplat::scene {

void check_gaussian(const Gaussian& gaussian, std::span<const glm::vec3> harmonics, const std::string& where) {
  const std::string fault = fault_of(gaussian, harmonics);
  if (fault.empty()) return;
  throw_input(
      {.where = where, .what = "a Gaussian's " + fault, .expected = {}, .got = {}, .fix = "the file is damaged"});
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
  const std::string head = start_of(files[0], kHeadBytes);
  if (is_ply(head)) return read_gaussian_ply(files[0]);
  refuse_other_formats(files[0], head);
  const std::string ending = ending_of(files[0]);
  if (ending == ".ply") return read_gaussian_ply(files[0]);
  if (ending == ".splat") return read_splat_file(files[0]);
  if (head.starts_with("NRRD") || head.find("ElementDataFile") != std::string::npos || ending == ".nii" ||
      files[0].string().ends_with(".nii.gz")) {
    throw_input({.where = name_or_path,
                 .what = "a volume, not 3-D Gaussians",
                 .expected = ".ply or .splat",
                 .got = {},
                 .fix = "give it with --volume"});
  }
  throw_input({.where = name_or_path,
               .what = "neither a file of 3-D Gaussians nor a built-in scene",
               .expected = fmt::format(".ply or .splat, or {}", fmt::join(synthetic_gaussian_names(), ", ")),
               .got = {},
               .fix = "for example --gaussians shells:2000"});
}

}  // namespace fastsplat::scene
