// SPDX-License-Identifier: Apache-2.0
// Inputs of the tests of mixtures: small scenes, random and given ones, and random mixtures.
#pragma once

#include <string>
#include <vector>

#include "analysis/pipeline/step.hpp"
#include "cmodel/numbers/config.hpp"
#include "scene/scene.hpp"
#include "tests/cmodel/random_helper.hpp"

namespace fastsplat::stages::test {

/// Scenes of all methods of the device, both projections, whole and cropped, faint and opaque; some twenty pixels
/// across.
scene::SceneDescription random_scene(fastsplat::test::Random& random);
/// Small scenes of three kinds.
std::vector<scene::SceneDescription> small_scenes();

/// Sheets of densities: both projections, ramps and isosurfaces, shaded and not, whole and cropped, faint and opaque.
scene::SceneDescription random_density_scene(fastsplat::test::Random& random);
/// Three such scenes.
std::vector<scene::SceneDescription> small_density_scenes();

/// Mixtures of few steps, of half of them, of nearly all; those of densities only on request.
Mixture random_mixture(fastsplat::test::Random& random, bool densities = false);
/// Any formats, sums in the same or another one, centres in the picture or in tiles.
FloatNumbers random_floats(fastsplat::test::Random& random);
/// Steps of all three sides. Sheets and positions are not floats where the page does not say what that means.
Mixture random_mixture_with_floats(fastsplat::test::Random& random);

/// All keys, to reproduce a configuration.
std::string text_of(const cmodel::Config& config);

}  // namespace fastsplat::stages::test
