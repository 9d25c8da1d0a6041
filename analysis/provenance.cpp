// SPDX-License-Identifier: Apache-2.0
#include "analysis/provenance.hpp"

#include <bit>

#include "base/fnv1a.hpp"
#include "base/hash_text.hpp"
#include "base/version.hpp"

namespace fastsplat::analysis {
namespace {

/// FNV-1a, eight bytes at a time.
class Hash {
 public:
  void add(std::uint64_t word) { value_ = fnv1a(value_, word); }
  void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = kFnv1aStart;
};

}  // namespace

images::Metadata render_metadata(const std::string& engine, const scene::SceneDescription& scene,
                                 const std::optional<HardwareConfig>& config) {
  images::Metadata metadata{{"engine", engine},
                            {"method", scene::to_string(scene.method)},
                            {"scene", scene::to_toml(scene)},
                            {"version", program_version()}};
  if (config) {
    metadata["config"] = config->name;
    metadata["config_hash"] = hash_text(config->hash);
  }
  return metadata;
}

images::Metadata render_metadata(const std::string& engine, const scene::Scene& scene,
                                 const std::optional<HardwareConfig>& config) {
  auto metadata = render_metadata(engine, scene.description, config);
  metadata["volume"] = scene.volume->source;
  metadata["content_hash"] = hash_text(content_hash(scene));
  return metadata;
}

std::uint64_t content_hash(const scene::Scene& scene) {
  Hash hash;
  const volume::Volume& volume = *scene.volume;
  for (int axis = 0; axis < 3; ++axis) {
    hash.add(static_cast<std::uint64_t>(volume.dims[axis]));
    hash.add(volume.spacing[axis]);
  }
  for (int axis = 0; volume.oblique && axis < 3; ++axis) {
    for (int world = 0; world < 3; ++world) hash.add(volume.axes[axis][world]);
  }
  for (const float voxel : volume.voxels) hash.add(static_cast<std::uint64_t>(std::bit_cast<std::uint32_t>(voxel)));
  const scene::TransferFunction& tf = scene.transfer_function;
  hash.add(static_cast<std::uint64_t>(tf.domain));
  hash.add(tf.reference_length);
  if (tf.reference_length_mm) hash.add(*tf.reference_length_mm);
  for (const auto& point : tf.points) {
    for (const double number : {point.at, point.colour.r, point.colour.g, point.colour.b, point.opacity})
      hash.add(number);
  }
  const scene::Shading& shading = scene.shading;
  hash.add(static_cast<std::uint64_t>(shading.on));
  for (const double number :
       {shading.ambient, shading.diffuse, shading.specular, shading.shininess, shading.gradient_floor})
    hash.add(number);
  return hash.value();
}

}  // namespace fastsplat::analysis
