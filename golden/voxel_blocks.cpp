// SPDX-License-Identifier: Apache-2.0
#include "golden/voxel_blocks.hpp"

#include <algorithm>
#include <limits>

#include "golden/occlusion_map.hpp"

namespace fastsplat::golden {
namespace {

/// Interleaves a brick's coordinate bits, x lowest: eight bricks of one parent differ only in the last three bits.
std::uint64_t morton(const glm::uvec3& at) {
  std::uint64_t code = 0;
  for (unsigned bit = 0; bit < 21; ++bit) {
    for (int axis = 0; axis < 3; ++axis) {
      code |= static_cast<std::uint64_t>(at[axis] >> bit & 1u) << (3 * bit + static_cast<unsigned>(axis));
    }
  }
  return code;
}

struct Brick {
  std::uint64_t code = 0;
  std::uint32_t place = 0;  ///< index in the grid of bricks
};

/// Grows a block by another block or splat.
void include(VoxelBlock& block, const glm::vec3& low, const glm::vec3& high, std::uint16_t sheet) {
  block.low = glm::min(block.low, low);
  block.high = glm::max(block.high, high);
  block.axis_sheet = std::min(block.axis_sheet, sheet);
}

VoxelBlock nothing(bool leaf, std::size_t first) {
  constexpr float kFar = std::numeric_limits<float>::max();
  return {glm::vec3(kFar), glm::vec3(-kFar), std::numeric_limits<std::uint16_t>::max(), leaf,
          static_cast<std::uint32_t>(first)};
}

}  // namespace

VoxelBlocks::VoxelBlocks(const volume::Volume& volume, const std::vector<scene::Splat>& splats, int edge)
    : order_(splats.size()) {
  if (splats.empty()) return;
  const glm::uvec3 grid((volume.dims + edge - 1) / edge);
  const glm::vec3 corner(-0.5 * glm::dvec3(volume.dims) * volume.spacing);
  const glm::vec3 per_mm(1.0 / (volume.spacing * static_cast<double>(edge)));
  std::vector<std::uint32_t> place(splats.size());
  std::vector<std::uint32_t> count(static_cast<std::size_t>(grid.x) * grid.y * grid.z);
  for (std::size_t i = 0; i < splats.size(); ++i) {
    const glm::vec3 inside = glm::clamp((glm::vec3(volume.to_grid(splats[i].position)) - corner) * per_mm,
                                        glm::vec3(0.0f), glm::vec3(grid - 1u));
    const glm::uvec3 at(inside);
    place[i] = (at.z * grid.y + at.y) * grid.x + at.x;
    ++count[place[i]];
  }

  std::vector<Brick> bricks;
  for (std::uint32_t z = 0, at = 0; z < grid.z; ++z) {
    for (std::uint32_t y = 0; y < grid.y; ++y) {
      for (std::uint32_t x = 0; x < grid.x; ++x, ++at) {
        if (count[at] > 0) bricks.push_back({morton({x, y, z}), at});
      }
    }
  }
  std::sort(bricks.begin(), bricks.end(), [](const Brick& a, const Brick& b) { return a.code < b.code; });

  // A stable counting sort of the splats by brick; `count` becomes the position of the brick's next splat.
  std::vector<std::uint64_t> codes;
  std::uint32_t start = 0;
  for (const Brick& brick : bricks) {
    blocks_.push_back(nothing(true, start));
    blocks_.back().count = blocks_.back().splats = count[brick.place];
    codes.push_back(brick.code);
    count[brick.place] = start;
    start += blocks_.back().count;
  }
  for (std::uint32_t i = 0; i < splats.size(); ++i) order_[count[place[i]]++] = i;
  for (VoxelBlock& block : blocks_) {
    for (const std::uint32_t i : this->splats(block)) {
      include(block, splats[i].position, splats[i].position, splats[i].sheet);
    }
  }

  for (std::size_t first = 0; blocks_.size() - first > 1;) {
    const std::size_t end = blocks_.size();
    std::vector<std::uint64_t> parents;
    for (std::size_t i = first; i < end; ++i) {
      const std::uint64_t code = codes[i - first] >> 3;
      if (parents.empty() || parents.back() != code) {
        parents.push_back(code);
        blocks_.push_back(nothing(false, i));
      }
      const VoxelBlock child = blocks_[i];
      VoxelBlock& parent = blocks_.back();
      include(parent, child.low, child.high, child.axis_sheet);
      ++parent.count;
      parent.splats += child.splats;
    }
    codes = std::move(parents);
    first = end;
  }
}

// A box in front of the eye projects into the convex hull of its projected corners, and depth is linear: its extremes
// are at corners. The slack covers rounding, since corners and splats are computed differently.
BlockView view_of(const scene::Scene& scene, const SheetAssignment& assignment, const VoxelBlock& block, int margin) {
  constexpr double kSlack = 1.0 / 1024.0;  // pixels; kernel units
  constexpr double kFar = std::numeric_limits<double>::max();
  const double unit = scene.volume->kernel_unit();
  glm::dvec2 low(kFar), high(-kFar);
  double nearest = kFar, scale = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const scene::ScreenPoint at =
        scene.camera.project({corner & 1 ? block.high.x : block.low.x, corner & 2 ? block.high.y : block.low.y,
                              corner & 4 ? block.high.z : block.low.z});
    low = glm::min(low, glm::dvec2(at.x, at.y));
    high = glm::max(high, glm::dvec2(at.x, at.y));
    nearest = std::min(nearest, at.depth);
    scale = std::max(scale, at.scale);
  }
  const glm::dvec2 centre = 0.5 * (low + high);
  const glm::dvec2 reach =
      0.5 * (high - low) + scene.kernel.radius() * unit * scale + static_cast<double>(margin) + kSlack;
  ProjectedSplat front;
  front.z = nearest / unit - kSlack;
  front.sheet = block.axis_sheet;
  return {window_around(centre.x, centre.y, reach.x, reach.y, scene.camera.width(), scene.camera.height()),
          assignment.first(front)};
}

}  // namespace fastsplat::golden
