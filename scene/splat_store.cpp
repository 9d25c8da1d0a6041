// SPDX-License-Identifier: Apache-2.0
#include "scene/splat_store.hpp"

#include <algorithm>
#include <utility>

namespace fastsplat::scene {
namespace {

constexpr std::size_t kVoxels = std::size_t{volume::Brick::kSide} * volume::Brick::kSide * volume::Brick::kSide;

void classify(BrickSplats& out, const volume::Volume& volume, const VoxelSplats& voxels, const volume::Brick& brick) {
  std::array<std::array<float, kVoxels>, 3> rows;
  out.splats.clear();
  glm::ivec3 at;
  for (at.z = brick.low.z; at.z <= brick.high.z; ++at.z) {
    for (at.y = brick.low.y; at.y <= brick.high.y; ++at.y) {
      const float* row = &volume.voxels[volume.index(0, at.y, at.z)];
      for (at.x = brick.low.x; at.x <= brick.high.x; ++at.x) {
        Material material;
        const float extinction = voxels.extinction(row[at.x], material);
        if (!(extinction > 0.0f)) continue;
        const glm::dvec3 position = volume.position(at.x, at.y, at.z);
        BrickSplats::One one{.splat = voxels.unlit(at, position, material, extinction), .at = {}};
        for (int axis = 0; axis < 3; ++axis) {
          one.at[static_cast<std::size_t>(axis)] = static_cast<std::uint8_t>(at[axis] - brick.low[axis]);
          rows[static_cast<std::size_t>(axis)][out.splats.size()] = static_cast<float>(position[axis]);
        }
        out.splats.push_back(one);
      }
    }
  }
  const std::size_t pitch = out.splats.size() + BrickSplats::kMore;
  out.positions.assign(3 * pitch, 0.0f);
  for (std::size_t axis = 0; axis < 3; ++axis)
    std::copy_n(rows[axis].begin(), out.splats.size(),
                out.positions.begin() + static_cast<std::ptrdiff_t>(axis * pitch));
}

}  // namespace

void SplatStore::clear() {
  for (auto& one : kept_) delete one.exchange(nullptr);
  bytes_ = 0;
}

SplatStore::Key SplatStore::key_of(const Scene& scene) {
  const bool shaded = scene.shading.on;
  return {.volume = scene.volume,
          .transfer_function = scene.transfer_function,
          .shaded = shaded,
          .gradient_floor = shaded ? scene.shading.gradient_floor : 0.0,
          .opacity_scale = scene.description.opacity_scale,
          .texture = scene.description.texture};
}

void SplatStore::open(const Scene& scene) {
  Key key = key_of(scene);
  if (key == key_) return;
  clear();
  if (key.volume != key_.volume) bricks_ = volume::bricks_of(*key.volume);
  classifier_.emplace(scene.transfer_function, *key.volume);
  kept_ = std::vector<std::atomic<const BrickSplats*>>(most_bytes_ > 0 ? bricks_.size() : 0);
  key_ = std::move(key);
}

void SplatStore::fill(const Scene& scene) {
  open(scene);
  const VoxelSplats voxels(scene, SplatKind::Colours, classifier());
  BrickSplats scratch;
  for (std::size_t brick = 0; brick < bricks_.size() && bytes_ < most_bytes_; ++brick) splats(voxels, brick, scratch);
}

const BrickSplats& SplatStore::splats(const VoxelSplats& voxels, std::size_t brick, BrickSplats& scratch) {
  const bool keep = most_bytes_ > 0 && bytes_ < most_bytes_;
  if (most_bytes_ > 0) {
    if (const BrickSplats* known = kept_[brick]) return *known;
  }
  classify(scratch, *key_.volume, voxels, bricks_[brick]);
  if (!keep) return scratch;
  auto fresh = std::make_unique<const BrickSplats>(scratch);
  const BrickSplats* known = nullptr;
  // Another thread may have been faster.
  if (!kept_[brick].compare_exchange_strong(known, fresh.get())) return *known;
  bytes_ += fresh->bytes();
  return *fresh.release();
}

}  // namespace fastsplat::scene
