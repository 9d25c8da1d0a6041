// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>

#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "base/lower_case.hpp"
#include "scene/gaussians/gaussian_file.hpp"
#include "scene/gaussians/gaussian_scene.hpp"
#include "scene/gaussians/gltf_file.hpp"
#include "scene/gaussians/ply_packed.hpp"
#include "scene/gaussians/splat_file.hpp"
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
};
std::string binary_ply(const GaussianCloud& cloud) { return ply_bytes(cloud); }
constexpr std::array kWriters{
    Writer{".compressed.ply", packed_ply_bytes, kMostDegree, true, true, true},
    Writer{".ply", binary_ply, kMostDegree, true, true, true},
    Writer{".splat", splat_bytes, 0, false, false, false},
    Writer{".spz", spz_bytes, kMostDegree, false, false, true},
    Writer{".glb", glb_bytes, kMostDegree, false, true, false},
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
  return lost;
}

void save_gaussians(const GaussianCloud& cloud, const std::filesystem::path& path, PlyText text) {
  const Writer& writer = writer_for(path);
  write_text_file(path, text == PlyText::Ascii ? ply_bytes(cloud, text) : writer.bytes(cloud));
}

}  // namespace fastsplat::scene
