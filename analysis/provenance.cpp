#include "analysis/provenance.hpp"

namespace fastsplat::analysis {

Metadata render_metadata(const std::string& engine, const scene::SceneDescription& scene,
                         const std::optional<HardwareConfig>& config) {
  Metadata metadata{{"engine", engine},
                    {"method", scene::to_string(scene.method)},
                    {"scene", scene::to_toml(scene)},
                    {"version", program_version()}};
  if (config) {
    metadata["config"] = config->name;
    metadata["config_hash"] = hash_text(config->hash);
  }
  return metadata;
}

}  // namespace fastsplat::analysis
