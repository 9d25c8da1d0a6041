// SPDX-License-Identifier: Apache-2.0
// Built-in volumes: exact, reproducible, any size.
#pragma once

#include <string>
#include <vector>

#include "scene/volume/volume.hpp"

namespace fastsplat::volume {

/// `marschner-lobb`, `shells`, `binary-cube`, `checkerboard-floor`, `checkerboard-tunnel`, `constant`, `point`,
/// `layer`, `pair`, `terrain`, `fire`. Values in [0,1], spacing 1 mm, cubic, edge `size` voxels (2..1024).
Volume make_synthetic(const std::string& name, int size);
/// The same without voxels.
Volume describe_synthetic(const std::string& name, int size);

std::vector<std::string> synthetic_names();
int default_synthetic_size(const std::string& name);

}  // namespace fastsplat::volume
