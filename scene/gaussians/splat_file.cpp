// SPDX-License-Identifier: Apache-2.0
#include "scene/gaussians/splat_file.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.hpp"
#include "scene/gaussians/byte_words.hpp"
#include "scene/gaussians/gaussian_rows.hpp"
#include "scene/gaussians/harmonics.hpp"

namespace fastsplat::scene {
namespace {

/// The byte nearest to a number of 0..255.
void append_nearest(std::string& to, double value) { append_byte(to, nearest_step(value, 255.0)); }

}  // namespace

void read_splat(const std::string& bytes, GaussianCloud& cloud) {
  const std::string& where = cloud.source;
  if (bytes.size() % kSplatBytes != 0) {
    throw_input({.where = where,
                 .what = "the file ends inside a Gaussian",
                 .expected = fmt::format("a multiple of {} bytes", kSplatBytes),
                 .got = fmt::format("{} bytes, {} too many", bytes.size(), bytes.size() % kSplatBytes),
                 .fix = "the file is truncated or not a .splat file: write or download it again"});
  }
  // The format has no signature. The first Gaussian's eight numbers are never text.
  const auto is_text = [](unsigned char c) { return c == '\t' || c == '\n' || c == '\r' || (c >= ' ' && c < 127); };
  if (std::ranges::all_of(std::string_view(bytes).substr(0, kSplatBytes), is_text))
    throw_input({.where = where,
                 .what = "not a .splat file",
                 .expected = fmt::format("binary, {} bytes a Gaussian", kSplatBytes),
                 .got = "text",
                 .fix = "check that this is the right file"});
  GaussianRows rows(cloud, where);
  for (std::size_t at = 0; at < bytes.size(); at += kSplatBytes) {
    Gaussian one;
    glm::vec3 constant;
    glm::dvec4 rotation;
    for (std::size_t i = 0; i < 3; ++i) {
      const int axis = static_cast<int>(i);
      one.position[axis] = float_at(bytes, at + 4 * i);
      one.scale[axis] = float_at(bytes, at + 12 + 4 * i);
      constant[axis] = static_cast<float>((byte_at(bytes, at + 24 + i) / 255.0 - 0.5) / kConstantHarmonic);
    }
    one.opacity = static_cast<float>(byte_at(bytes, at + 27) / 255.0);
    for (std::size_t i = 0; i < 4; ++i)
      rotation[static_cast<int>(i)] = (static_cast<double>(byte_at(bytes, at + 28 + i)) - 128.0) / 128.0;
    rows.add(one, rotation, {&constant, 1});
  }
  rows.end();
}

std::string splat_bytes(const GaussianCloud& cloud) {
  std::string out;
  for (std::size_t i = 0; i < cloud.gaussians.size(); ++i) {
    const Gaussian& one = cloud.gaussians[i];
    for (int axis = 0; axis < 3; ++axis) append_float(out, one.position[axis]);
    for (int axis = 0; axis < 3; ++axis) append_float(out, one.scale[axis]);
    for (int c = 0; c < 3; ++c)
      append_nearest(out, 255.0 * (0.5 + kConstantHarmonic * static_cast<double>(cloud.harmonics_of(i)[0][c])));
    append_nearest(out, 255.0 * static_cast<double>(one.opacity));
    for (int k = 0; k < 4; ++k) append_nearest(out, 128.0 * static_cast<double>(one.rotation[k]) + 128.0);
  }
  return out;
}

}  // namespace fastsplat::scene
