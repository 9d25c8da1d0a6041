// SPDX-License-Identifier: Apache-2.0
// One pixel of a stream: every word of the model that makes it, sheet by sheet and splat by splat.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cmodel/numbers/config.hpp"
#include "testbench/check/verify.hpp"

namespace fastsplat::testbench {

using FourWords = std::array<std::uint32_t, 4>;  ///< R, G, B, and tau, T or A

/// A pixel as reports of mismatches name it.
struct TilePixel {
  std::uint32_t tile = 0;
  std::int32_t x = 0, y = 0;  ///< in the tile
};
/// Where the word that diverged belongs; nullopt if it is of no pixel.
std::optional<TilePixel> pixel_of(const cmodel::Config& config, const Divergence& divergence);

struct PixelWords {
  /// A splat with a weight at the pixel.
  struct Splat {
    std::uint32_t tag = 0, weight = 0;
    FourWords colour{}, product{};
  };
  /// With every sample composited, a sample.
  struct Sheet {
    std::uint32_t number = 0;
    std::vector<Splat> splats;
    FourWords sums{};                ///< as composited; a sample's products
    std::optional<FourWords> after;  ///< C_R, C_G, C_B, T behind it, or an X-ray's sums; absent if never composited
  };
  TilePixel at;
  std::uint64_t splats_of_tile = 0;
  std::vector<Sheet> sheets;
  FourWords out{};
};

/// Feeds the model with the stream, whose end `scope` decides. `at`: in the picture if `in_picture`, else in its tile.
/// Throws as the model does, and UserError (Usage) if no tile has the pixel, and for tiles of densities, whose pixels
/// depend on their neighbours.
PixelWords words_of_pixel(const BeatSource& source, const cmodel::Config& config, const TilePixel& at, bool in_picture,
                          cmodel::StreamScope scope = cmodel::StreamScope::Subset);

std::string to_text(const PixelWords& words);
nlohmann::ordered_json to_json(const PixelWords& words);

}  // namespace fastsplat::testbench
