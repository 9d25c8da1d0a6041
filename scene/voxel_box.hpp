// SPDX-License-Identifier: Apache-2.0
// A box of voxels in the user's notation: "10..90,0..216,0..180".
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>

#include "scene/volume/volume.hpp"

namespace fastsplat::scene {

/// From `low` to `high`, both included; everything() if high.x < low.x.
struct VoxelBox {
  glm::ivec3 low{0}, high{-1};
  bool everything() const { return high.x < low.x; }
  bool operator==(const VoxelBox&) const = default;
};

/// nullopt if the text is not a box; "" is everything.
std::optional<VoxelBox> box_from(const std::string& text);

/// Both ends included, in any unit.
struct RealBox {
  glm::dvec3 low{0.0}, high{0.0};
};
/// The same of any finite numbers.
std::optional<RealBox> real_box_from(const std::string& text);

std::string to_string(const VoxelBox& box);

/// The voxels inside as a separate volume, its world centred on them; minimum and maximum stay those of the whole.
/// Throws UserError (Usage) if the box leaves the volume.
std::shared_ptr<const volume::Volume> cropped(std::shared_ptr<const volume::Volume> volume, const VoxelBox& box);

}  // namespace fastsplat::scene
