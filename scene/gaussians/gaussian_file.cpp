// SPDX-License-Identifier: Apache-2.0
#include "scene/gaussians/gaussian_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/json_file.hpp"
#include "base/lower_case.hpp"
#include "base/percent.hpp"
#include "base/read_file.hpp"
#include "scene/gaussians/gaussian_rows.hpp"
#include "scene/gaussians/gltf_file.hpp"
#include "scene/gaussians/ksplat_file.hpp"
#include "scene/gaussians/other_formats.hpp"
#include "scene/gaussians/sog_file.hpp"
#include "scene/gaussians/splat_file.hpp"
#include "scene/gaussians/spz_file.hpp"
#include "scene/gaussians/synthetic_gaussians.hpp"

namespace fastsplat::scene {
namespace {

struct Format {
  const char* ending;
  bool (*is)(std::string_view head);  ///< nullptr: recognised by its ending
  void (*read)(const std::string& bytes, GaussianCloud& to);
};
constexpr std::array kFormats{
    Format{".ply", is_ply, read_ply},          Format{".spz", is_spz, read_spz},
    Format{".glb", is_gltf, read_gltf},        Format{".gltf", nullptr, read_gltf},
    Format{".sog", is_sog, read_sog},          Format{"meta.json", is_sog_meta, read_sog_meta},
    Format{".ksplat", is_ksplat, read_ksplat}, Format{".splat", nullptr, read_splat},
};

const Format* format_by_content(std::string_view head) {
  const auto* const found =
      std::ranges::find_if(kFormats, [head](const Format& one) { return one.is != nullptr && one.is(head); });
  return found == kFormats.end() ? nullptr : found;
}
const Format* format_by_ending(const std::string& ending) {
  const auto* const found =
      std::ranges::find(kFormats, ending, [](const Format& one) { return std::string_view(one.ending); });
  return found == kFormats.end() ? nullptr : found;
}

using Json = nlohmann::json;

/// The files in `folder` that strings in `json` name. parse_json() limits its depth.
void add_named_files(const Json& json, const std::filesystem::path& folder, std::vector<std::filesystem::path>& files) {
  if (json.is_structured())
    for (const Json& value : json) add_named_files(value, folder, files);
  if (!json.is_string() || json.get_ref<const std::string&>().size() > 255) return;
  const std::filesystem::path file = folder / percent_decoded(json.get<std::string>());
  std::error_code error;
  if (std::filesystem::is_regular_file(file, error)) files.push_back(file);
}

/// Adds the buffers of a .gltf, and the pictures of a meta.json.
void add_named_files(std::vector<std::filesystem::path>& files) {
  constexpr std::size_t kMostBytes = std::size_t{1} << 24;  // larger ones hold their data
  const std::filesystem::path scene = files[0];
  std::error_code error;
  if (!std::filesystem::is_regular_file(scene, error) || std::filesystem::file_size(scene, error) > kMostBytes) return;
  try {
    add_named_files(parse_json<Json>(read_text_file(scene, kMostBytes)), scene.parent_path(), files);
  } catch (const std::exception&) {  // its reader says what is wrong
  }
}

}  // namespace

void refuse_dropped(const GaussianCloud& cloud) {
  if (cloud.dropped.empty()) return;
  std::size_t count = 0;
  for (const DroppedGaussians& some : cloud.dropped) count += some.count;
  throw_input({.where = cloud.source,
               .what = fmt::format("{} of {} Gaussians cannot be drawn", count, count + cloud.gaussians.size()),
               .expected = "finite numbers and a non-zero rotation",
               .got = fmt::format("Gaussian {} (from 0): its {}", cloud.dropped[0].first, cloud.dropped[0].cause),
               .fix = "leave out --strict to drop them"});
}

void check_gaussian(const Gaussian& gaussian, std::span<const glm::vec3> harmonics, const std::string& where) {
  const std::string fault = fault_of(gaussian, harmonics);
  if (fault.empty()) return;
  throw_input(
      {.where = where, .what = "a Gaussian's " + fault, .expected = {}, .got = {}, .fix = "the file is damaged"});
}

std::vector<std::filesystem::path> files_of_gaussians(const std::string& name_or_path) {
  std::string ending = std::filesystem::path(name_or_path).extension().string();
  if (is_synthetic_gaussians(name_or_path) && ending != ".ply" && ending != ".splat") return {};
  std::vector<std::filesystem::path> files{name_or_path};
  ending = lower_case(ending);
  if (ending == ".gltf" || ending == ".json") add_named_files(files);
  return files;
}

GaussianCloud load_gaussians(const std::string& name_or_path) {
  const auto files = files_of_gaussians(name_or_path);
  if (files.empty()) return make_synthetic_gaussians(name_or_path);
  const std::string head = start_of(files[0], kHeadBytes);
  const std::string ending = ending_of(files[0]);
  const Format* format = format_by_content(head);
  if (format == nullptr) {
    refuse_other_formats(files[0], head);
    format = format_by_ending(ending);
  }
  if (format != nullptr) {
    GaussianCloud cloud{.name = files[0].filename().string(), .source = files[0].string()};
    format->read(read_text_file(files[0], kMostGaussianBytes), cloud);
    return cloud;
  }
  if (head.starts_with("NRRD") || head.find("ElementDataFile") != std::string::npos || ending == ".nii" ||
      files[0].string().ends_with(".nii.gz")) {
    throw_input({.where = name_or_path,
                 .what = "a volume, not 3-D Gaussians",
                 .expected = kReadFormats,
                 .got = {},
                 .fix = "give it with --volume"});
  }
  if (!ending.empty()) require_regular_file(files[0], "check the path");
  throw_input({.where = name_or_path,
               .what = "neither a file of 3-D Gaussians nor a built-in scene",
               .expected = fmt::format("{}, or {}", kReadFormats, fmt::join(synthetic_gaussian_names(), ", ")),
               .got = {},
               .fix = "for example --gaussians shells:2000"});
}

}  // namespace fastsplat::scene
