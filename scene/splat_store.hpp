// SPDX-License-Identifier: Apache-2.0
// Keeps what does not depend on the view: a volume's bricks, and in each the classified splats with their surfaces.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "base/memory.hpp"
#include "scene/splats.hpp"
#include "scene/volume/bricks.hpp"

namespace fastsplat::scene {

/// The splats of a brick's voxels, x fastest.
struct BrickSplats {
  struct One {
    UnlitSplat splat;
    std::array<std::uint8_t, 3> at;  ///< its voxel, from the brick's lowest one
  };
  static constexpr std::size_t kMore = 8;  ///< floats behind each row of positions, so that vectors may read them

  std::vector<One> splats;
  std::vector<float> positions;  ///< mm, world: all x, all y, all z

  const float* row(std::size_t axis) const { return positions.data() + axis * (splats.size() + kMore); }
  glm::vec3 position(std::size_t i) const { return {row(0)[i], row(1)[i], row(2)[i]}; }
  std::size_t bytes() const { return sizeof *this + splats.size() * sizeof(One) + positions.size() * sizeof(float); }
};

/// Memory for a store that nobody bounded otherwise: a quarter of the machine's.
inline std::size_t usual_store_bytes() { return machine_memory() / 4; }

class SplatStore {
 public:
  /// Keeps at most about `most_bytes`; other bricks are made anew for each frame.
  explicit SplatStore(std::size_t most_bytes) : most_bytes_(most_bytes) {}
  ~SplatStore() { clear(); }
  SplatStore(const SplatStore&) = delete;
  SplatStore& operator=(const SplatStore&) = delete;

  /// To be called before a frame, with no other frame being drawn. Forgets what was made for scenes with other splats.
  void open(const Scene& scene);
  /// The same, and makes all bricks. On this thread alone.
  void fill(const Scene& scene);
  const std::vector<volume::Brick>& bricks() const { return bricks_; }
  const Classifier& classifier() const { return *classifier_; }
  /// The splats of a brick, in the store or in `scratch`. `voxels` are those of the scene. For several threads at once.
  const BrickSplats& splats(const VoxelSplats& voxels, std::size_t brick, BrickSplats& scratch);
  /// Whether it is open for the splats of this scene.
  bool serves(const Scene& scene) const { return key_of(scene) == key_; }
  std::size_t bytes() const { return bytes_; }  ///< kept

 private:
  /// What the splats depend on.
  struct Key {
    std::shared_ptr<const volume::Volume> volume;
    TransferFunction transfer_function;
    bool shaded = false;
    double gradient_floor = 0.0, opacity_scale = 0.0;
    Texture texture;
    bool operator==(const Key&) const = default;
  };
  static Key key_of(const Scene& scene);
  void clear();

  std::size_t most_bytes_;
  Key key_;
  std::vector<volume::Brick> bricks_;
  std::optional<Classifier> classifier_;
  std::vector<std::atomic<const BrickSplats*>> kept_;  ///< per brick; owned
  std::atomic<std::size_t> bytes_{0};
};

}  // namespace fastsplat::scene
