// SPDX-License-Identifier: Apache-2.0
// A random ellipse that the stream's rules allow.
#pragma once

#include "cmodel/numbers/config.hpp"
#include "cmodel/stream/records.hpp"
#include "testbench/stimulus/random.hpp"

namespace fastsplat::testbench {

/// From thin to round and from less than a pixel to many windows, about (x,y), words of the position format. Seldom
/// more than `most` windows a side. The caller sets tag and colours.
cmodel::EllipseRecord random_ellipse(const cmodel::Config& config, Random& random, std::int32_t x, std::int32_t y,
                                     std::int64_t most);

}  // namespace fastsplat::testbench
