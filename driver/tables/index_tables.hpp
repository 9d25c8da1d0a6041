// SPDX-License-Identifier: Apache-2.0
// The table words of a radius set for each index kind: doubles in, words out (docs/numerics.md, section 4).
#pragma once

#include <cstdint>

#include "cmodel/numbers/config.hpp"
#include "cmodel/stream/records.hpp"
#include "driver/tables/quantise.hpp"
#include "scene/kernel.hpp"
#include "scene/textured_splats.hpp"

namespace fastsplat::driver {

/// The picture that a set's footprint shows (blit2d only): `number` of `textures`; null: none.
struct SetPicture {
  const scene::TexturedSplats* textures = nullptr;
  std::size_t number = 0;
};

/// The set's load_table record for the configuration's index.kind: `radius` in pixels, `base` its first column (0 for
/// the kinds without columns).
cmodel::LoadTable set_table(const cmodel::Config& config, const scene::Kernel& kernel, std::uint32_t set, double radius,
                            std::uint32_t base, const SetPicture& picture = {});

/// Weight along one axis at `distance`, of a footprint with its edge at `rim`; both in 1/K pixel. `word` is the target
/// of Site::Axis.
std::uint32_t axis_word(const scene::Kernel& kernel, double distance, double rim, const Target& word);
/// Weight at the squared distance `squared`, times `detail`; `word` is the target of Site::Footprint.
std::uint32_t footprint_word(const scene::Kernel& kernel, double squared, double rim, const Target& word,
                             double detail = 1.0);

/// v as c / 2^h with c of 24 bits, rounded up.
struct Scale {
  std::uint32_t c = 0, h = 0;
};
Scale scale_of(double v, const cmodel::Config& config);

}  // namespace fastsplat::driver
