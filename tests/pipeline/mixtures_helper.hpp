// SPDX-License-Identifier: Apache-2.0
// What the tests of mixtures are made of: small scenes, random and given ones, and random mixtures.
#pragma once

#include <string>
#include <vector>

#include "analysis/pipeline/step.hpp"
#include "cmodel/numbers/config.hpp"
#include "scene/scene.hpp"
#include "tests/cmodel/random_helper.hpp"

namespace fastsplat::stages::test {

/// Of all methods of the device, both projections, whole and cropped, faint and opaque; some twenty pixels across.
scene::SceneDescription random_scene(fastsplat::test::Random& random);
/// Small scenes of three kinds.
std::vector<scene::SceneDescription> small_scenes();

/// Sheets of densities: both projections, ramps and isosurfaces, shaded and not, whole and cropped, faint and opaque.
scene::SceneDescription random_density_scene(fastsplat::test::Random& random);
/// Three such scenes.
std::vector<scene::SceneDescription> small_density_scenes();

/// Of few steps, of half of them, of nearly all; those of densities among them only if asked for.
Mixture random_mixture(fastsplat::test::Random& random, bool densities = false);

/// All keys, to have a configuration again.
std::string text_of(const cmodel::Config& config);

}  // namespace fastsplat::stages::test
