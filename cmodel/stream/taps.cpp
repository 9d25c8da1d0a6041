// SPDX-License-Identifier: Apache-2.0
#include "cmodel/stream/taps.hpp"

namespace fastsplat::cmodel {

const char* to_string(Tap tap) {
  switch (tap) {
    case Tap::Snap:
      return "snap";
    case Tap::Footprint:
      return "footprint";
    case Tap::Sheet:
      return "sheet";
    case Tap::Composite:
      return "composite";
    case Tap::Pixel:
      return "pixel";
  }
  return "?";
}

}  // namespace fastsplat::cmodel
