// From flags to a scene: file first, flags over it, everything checked before anything is read or allocated.
#pragma once

#include "cli/arguments.hpp"
#include "scene/scene.hpp"

namespace fastsplat::cli {

scene::SceneDescription describe(const SceneFlags& flags);

/// Reads the volume and resolves all names.
scene::Scene build(const SceneFlags& flags);

/// One line: "ch2bet 181x217x181, mri-head, image_aligned, 512x512".
std::string summary(const scene::Scene& scene);

}  // namespace fastsplat::cli
