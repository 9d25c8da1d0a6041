// What the tests of mixtures are made of: small scenes, random and given ones, and random mixtures.
#pragma once

#include <string>
#include <vector>

#include "cmodel/config.hpp"
#include "scene/scene.hpp"
#include "stages/step.hpp"
#include "tests/cmodel/random_helper.hpp"

namespace fastsplat::stages::test {

/// Of all methods of the device, both projections, whole and cropped, faint and opaque; some twenty pixels across.
scene::SceneDescription random_scene(fastsplat::test::Random& random);
/// Small scenes of three kinds.
std::vector<scene::SceneDescription> small_scenes();

/// Of few steps, of half of them, of nearly all.
Mixture random_mixture(fastsplat::test::Random& random);

/// All keys, to have a configuration again.
std::string text_of(const cmodel::Config& config);

}  // namespace fastsplat::stages::test
