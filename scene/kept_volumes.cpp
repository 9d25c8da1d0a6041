// SPDX-License-Identifier: Apache-2.0
#include "scene/kept_volumes.hpp"

#include <map>
#include <optional>
#include <utility>

#include "scene/splat_store.hpp"
#include "scene/volume/volume_file.hpp"

namespace fastsplat::scene {
namespace {

using Key = std::pair<std::string, std::optional<double>>;

Key key_of(const SceneDescription& description) { return {description.volume, description.nan_as}; }

std::map<Key, KeptVolume>& all() {
  static std::map<Key, KeptVolume> kept;
  return kept;
}

std::size_t bytes_of(const volume::Volume& header) {
  const glm::dvec3 dims(header.dims);
  return static_cast<std::size_t>(dims.x * dims.y * dims.z * sizeof(float));
}

}  // namespace

void keep_volume(const SceneDescription& description) {
  if (all().contains(key_of(description))) return;
  std::size_t bytes = bytes_of(volume::read_volume_header(description.volume));
  for (const auto& [key, kept] : all()) bytes += bytes_of(*kept.volume) + (kept.store ? kept.store->bytes() : 0);
  const std::size_t most = usual_store_bytes();
  if (bytes > most) return;
  Scene scene = build_scene(description);
  KeptVolume& kept = all()[key_of(description)];
  kept.volume = scene.whole;
  if (!description.crop.everything()) return;
  kept.store = std::make_shared<SplatStore>(most - bytes);
  kept.store->fill(scene);
}

void forget_volume(const SceneDescription& description) { all().erase(key_of(description)); }

KeptVolume kept_volume(const SceneDescription& description) {
  const auto found = all().find(key_of(description));
  if (found == all().end()) return {};
  return found->second;
}

}  // namespace fastsplat::scene
