// SPDX-License-Identifier: Apache-2.0
#include "scene/voxel_box.hpp"

#include <fmt/format.h>

#include <string_view>

#include "base/error.hpp"
#include "base/number_text.hpp"

namespace fastsplat::scene {

namespace {

/// Numbers of A..B,C..D,E..F with A <= B and so on.
template <class Vector, class Parse>
bool ranges(std::string_view text, const Parse& parse, Vector& low, Vector& high) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto comma = text.find(',');
    if ((comma == std::string_view::npos) != (axis == 2)) return false;
    const std::string_view range = text.substr(0, comma);
    const auto dots = range.find("..");
    if (dots == std::string_view::npos) return false;
    const auto least = parse(range.substr(0, dots)), most = parse(range.substr(dots + 2));
    if (!least || !most || *most < *least) return false;
    low[axis] = *least;
    high[axis] = *most;
    if (axis < 2) text.remove_prefix(comma + 1);
  }
  return true;
}

}  // namespace

std::optional<VoxelBox> box_from(const std::string& text) {
  VoxelBox box;
  if (text.empty()) return box;
  const bool fine =
      ranges(text, integer_from<int>, box.low, box.high) && glm::all(glm::greaterThanEqual(box.low, glm::ivec3(0)));
  return fine ? std::optional(box) : std::nullopt;
}

std::optional<RealBox> real_box_from(const std::string& text) {
  RealBox box;
  return ranges(text, number_from, box.low, box.high) ? std::optional(box) : std::nullopt;
}

std::string to_string(const VoxelBox& box) {
  if (box.everything()) return {};
  return fmt::format("{}..{},{}..{},{}..{}", box.low.x, box.high.x, box.low.y, box.high.y, box.low.z, box.high.z);
}

std::shared_ptr<const volume::Volume> cropped(std::shared_ptr<const volume::Volume> volume, const VoxelBox& box) {
  if (box.everything()) return volume;
  if (glm::any(glm::greaterThanEqual(box.high, volume->dims))) {
    throw_usage({.where = "crop",
                 .what = "the box exceeds the volume",
                 .expected = "a box in " + to_string({glm::ivec3(0), volume->dims - 1}),
                 .got = to_string(box),
                 .fix = "`fastsplat volume info` prints the number of voxels"});
  }
  volume::Volume part = *volume;
  part.voxels.clear();
  part.dims = box.high - box.low + 1;
  part.voxels.reserve(static_cast<std::size_t>(part.dims.x) * part.dims.y * part.dims.z);
  for (int k = box.low.z; k <= box.high.z; ++k) {
    for (int j = box.low.y; j <= box.high.y; ++j) {
      const auto row = volume->voxels.begin() + static_cast<std::ptrdiff_t>(volume->index(box.low.x, j, k));
      part.voxels.insert(part.voxels.end(), row, row + part.dims.x);
    }
  }
  part.centre +=
      0.5 * (volume->position(box.low.x, box.low.y, box.low.z) + volume->position(box.high.x, box.high.y, box.high.z));
  return std::make_shared<const volume::Volume>(std::move(part));
}

}  // namespace fastsplat::scene
