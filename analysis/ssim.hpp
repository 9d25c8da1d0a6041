// SPDX-License-Identifier: Apache-2.0
// Structural similarity, Wang, Bovik, Sheikh, Simoncelli 2004, equations 13 and 17.
#pragma once

#include <functional>

namespace fastsplat::analysis {

/// Writes row y of one channel; non-finite values are NaN.
using RowSource = std::function<void(int channel, int y, double* row)>;

/// Mean over channels and windows of SSIM with an 11 x 11 Gaussian window (sigma 1.5, weights summing to 1), K1 = 0.01,
/// K2 = 0.03, L = peak. Only windows wholly inside the image, as in the authors' code; an image smaller than 11 in a
/// direction uses the largest odd window that fits both. Windows with a value that is not finite are left out; NaN when
/// none is left.
double ssim(int width, int height, int channels, double peak, int threads, const RowSource& ref, const RowSource& test);

}  // namespace fastsplat::analysis
