// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "base/lower_case.hpp"
#include "scene/gaussians/gaussian_file.hpp"
#include "scene/gaussians/gaussian_scene.hpp"
#include "scene/gaussians/gltf_file.hpp"
#include "scene/gaussians/harmonics.hpp"
#include "scene/gaussians/ply_packed.hpp"
#include "scene/gaussians/splat_file.hpp"
#include "scene/gaussians/spz_codes.hpp"
#include "scene/gaussians/spz_file.hpp"

namespace fastsplat::scene {
namespace {

struct Writer {
  const char* ending;
  std::string (*bytes)(const GaussianCloud&);
  int degree;        ///< most of the harmonics
  bool up;           ///< declares the vertical axis
  bool linear;       ///< declares that colours are linear light
  bool antialiased;  ///< declares that the scene was trained anti-aliased
  bool by_distance;  ///< declares the order of distances from the eye; others that of depths
  StoredRange log_scale, colour, harmonic;
  std::vector<double> (*rounding)(const GaussianCloud&);  ///< of positions; nullptr: none
};
std::string binary_ply(const GaussianCloud& cloud) { return ply_bytes(cloud); }
constexpr StoredRange kAll{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(), 0.0};
constexpr std::array kWriters{
    Writer{".compressed.ply", packed_ply_bytes, kMostDegree, true, true, true, false, kPackedLogScale, kPackedColour,
           kPackedHarmonic, packed_ply_rounding},
    Writer{".ply", binary_ply, kMostDegree, true, true, true, false, kPlyLogScale, kAll, kAll, nullptr},
    Writer{".splat", splat_bytes, 0, false, false, false, false, kAll, kSplatColour, kAll, nullptr},
    Writer{".spz", spz_bytes, kMostDegree, false, false, true, false, spz::kLogScale, spz::kColour, spz::kHarmonic,
           spz_rounding},
    Writer{".glb", glb_bytes, kMostDegree, false, true, false, true, kAll, kAll, kAll, nullptr},
};

const Writer& writer_for(const std::filesystem::path& path) {
  const std::string name = lower_case(path.filename().string());
  for (const Writer& one : kWriters)
    if (name.ends_with(one.ending)) return one;
  throw_usage({.where = path.string(),
               .what = "unknown ending for a file of 3-D Gaussians",
               .expected = fmt::format("{}", fmt::join(written_gaussian_endings(), ", ")),
               .got = ending_of(path).empty() ? "none" : ending_of(path),
               .fix = "name the file scene.ply, for example"});
}

bool holds(const StoredRange& range, const glm::dvec3& values) {
  return range.holds(values.x) && range.holds(values.y) && range.holds(values.z);
}

/// Number of Gaussians that move by more than their own size and by more than 1/1024 of the scene, outliers aside.
std::size_t moved(const GaussianCloud& cloud, const std::vector<double>& rounding) {
  double size = 0.0;
  std::vector<float> places(cloud.gaussians.size());
  for (int axis = 0; axis < 3; ++axis) {
    const auto at = [&](double share) {
      const auto nth = places.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(places.size() - 1));
      std::nth_element(places.begin(), nth, places.end());
      return static_cast<double>(*nth);
    };
    std::ranges::transform(cloud.gaussians, places.begin(), [axis](const Gaussian& one) { return one.position[axis]; });
    const double low = at(0.05);
    size = std::max(size, at(0.95) - low);
  }
  std::size_t count = 0;
  for (std::size_t i = 0; i < rounding.size(); ++i) {
    const glm::vec3& scale = cloud.gaussians[i].scale;
    count += rounding[i] > std::max({static_cast<double>(scale.x), static_cast<double>(scale.y),
                                     static_cast<double>(scale.z), size / 1024.0})
                 ? 1
                 : 0;
  }
  return count;
}

void note_clamped(const GaussianCloud& cloud, const Writer& writer, std::vector<std::string>& lost) {
  std::size_t scales = 0, colours = 0, harmonics = 0;
  for (std::size_t i = 0; i < cloud.gaussians.size(); ++i) {
    const auto own = cloud.harmonics_of(i);
    scales += holds(writer.log_scale, glm::log(glm::dvec3(cloud.gaussians[i].scale))) ? 0 : 1;
    colours += holds(writer.colour, 0.5 + kConstantHarmonic * glm::dvec3(own[0])) ? 0 : 1;
    const auto held = [&writer](const glm::vec3& one) { return holds(writer.harmonic, one); };
    harmonics += std::ranges::all_of(own.subspan(1), held) ? 0 : 1;
  }
  const auto note = [&](const char* what, std::size_t count, double low, double high) {
    if (count > 0)
      lost.push_back(fmt::format("{} holds {} from {:.3g} to {:.3g}: those of {} of {} Gaussians were clamped",
                                 writer.ending, what, low, high, count, cloud.gaussians.size()));
  };
  note("scales", scales, std::exp(writer.log_scale.low), std::exp(writer.log_scale.high));
  note("colours", colours, writer.colour.low, writer.colour.high);
  note("harmonics", harmonics, writer.harmonic.low, writer.harmonic.high);
}

}  // namespace

std::vector<std::string> written_gaussian_endings() {
  std::vector<std::string> endings;
  for (const Writer& one : kWriters) endings.emplace_back(one.ending);
  return endings;
}

void check_gaussian_ending(const std::filesystem::path& path) { writer_for(path); }

std::vector<std::string> lost_in_gaussian_file(const GaussianCloud& cloud, const std::filesystem::path& path) {
  const Writer& writer = writer_for(path);
  std::vector<std::string> lost;
  if (cloud.degree > writer.degree)
    lost.push_back(fmt::format("{} holds no harmonics above degree {}: those to degree {} were dropped", writer.ending,
                               writer.degree, cloud.degree));
  if (cloud.antialiased && !writer.antialiased)
    lost.push_back(fmt::format("{} cannot declare that the scene was trained anti-aliased", writer.ending));
  if (cloud.linear && !writer.linear)
    lost.push_back(fmt::format("{} cannot declare that colours are linear light", writer.ending));
  if (cloud.up && cloud.up != UpAxis::MinusY && !writer.up)
    lost.push_back(fmt::format("{} cannot declare the vertical axis {}: add --up when you draw it", writer.ending,
                               up_axis_names()[static_cast<std::size_t>(*cloud.up)]));
  if (cloud.by_distance != writer.by_distance)
    lost.push_back(fmt::format("{} declares the order by {}: add --order {} when you draw it", writer.ending,
                               writer.by_distance ? "distance from the eye" : "depth",
                               cloud.by_distance ? "distance" : "centres"));
  note_clamped(cloud, writer, lost);
  if (const std::size_t count = writer.rounding != nullptr ? moved(cloud, writer.rounding(cloud)) : 0; count > 0)
    lost.push_back(
        fmt::format("{} moves {} of {} Gaussians by more than their own size: remove distant outliers, or write .ply",
                    writer.ending, count, cloud.gaussians.size()));
  return lost;
}

void save_gaussians(const GaussianCloud& cloud, const std::filesystem::path& path, PlyText text) {
  const Writer& writer = writer_for(path);
  write_text_file(path, text == PlyText::Ascii ? ply_bytes(cloud, text) : writer.bytes(cloud));
}

}  // namespace fastsplat::scene
