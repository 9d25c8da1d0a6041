// SPDX-License-Identifier: Apache-2.0
#include "cmodel/splat/weight_unit.hpp"

namespace fastsplat::cmodel {

WeightUnit weight_unit(const Config& config) {
  switch (config.index()) {
    case IndexKind::Linear:
      return LinearUnit(config);
    case IndexKind::Squared:
    case IndexKind::SquaredElliptic:
      return SquaredUnit(config);
    case IndexKind::Blit2d:
      return BlitUnit(config);
    case IndexKind::Separable:
      return SeparableUnit(config);
    case IndexKind::Rlut:
      break;
  }
  return RlutUnit(config);
}

}  // namespace fastsplat::cmodel
