// SPDX-License-Identifier: Apache-2.0
#include "cmodel/numbers/index_set.hpp"

#include "cmodel/numbers/window_geometry.hpp"

namespace fastsplat::cmodel {

std::int64_t stored_phases(const Config& config) {
  const bool all = config.index_symmetry == static_cast<int>(IndexSymmetry::Off) || config.phases == 1;
  return all ? config.phases : config.phases / 2 + 1;  // two phases are their own mirror images
}

std::int64_t set_words(const Config& config, std::uint32_t rho) {
  const std::int64_t side = window_geometry(config, rho).padded;
  switch (config.index()) {
    case IndexKind::Linear:
    case IndexKind::Squared:
      return 2;  // c, h
    case IndexKind::SquaredElliptic:
      return 4;  // A, B, C, h
    case IndexKind::Blit2d: {
      const std::int64_t phases = stored_phases(config);
      const bool all = config.index_symmetry == static_cast<int>(IndexSymmetry::Off);
      return (all ? phases * phases : phases * (phases + 1) / 2) * side * side;
    }
    case IndexKind::Rlut:
    case IndexKind::Separable:
      break;
  }
  return side * config.phases;
}

WordRange set_word_range(const Config& config, std::size_t word) {
  switch (config.index()) {
    case IndexKind::Linear:
    case IndexKind::Squared:
      return {0, word == 0 ? kLargestScale : kLargestShift};
    case IndexKind::SquaredElliptic:
      if (word == 1) return {-2 * kLargestScale, 2 * kLargestScale};
      return {0, word == 3 ? kLargestShift : kLargestScale};
    case IndexKind::Blit2d:
      return {0, config.weight_format().max};
    case IndexKind::Separable:
      return {0, config.axis_weight_format().max};
    case IndexKind::Rlut:
      break;
  }
  return {0, config.rlut_rim()};
}

std::optional<ErrorParts> set_violation(const Config& config, std::span<const std::uint32_t> words) {
  if (config.index() != IndexKind::SquaredElliptic) return std::nullopt;
  const std::int64_t a = words[0], b = static_cast<std::int32_t>(words[1]), c = words[2];
  if (4 * a * c >= b * b) return std::nullopt;
  return ErrorParts{.where = {},
                    .what = "invalid ellipse: q would be negative somewhere",
                    .expected = "4 A C >= B^2 = " + std::to_string(b * b),
                    .got = std::to_string(4 * a * c),
                    .fix = {}};
}

}  // namespace fastsplat::cmodel
