// SPDX-License-Identifier: Apache-2.0
// TEST - REF in LSB, value by value: the input of every figure, cluster and map.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "analysis/compare.hpp"
#include "base/image.hpp"

namespace fastsplat::analysis {

/// 2^bits - 1: how many LSB make 1.0.
double lsb_per_unit(int bits);

/// Throws UserError: NotComparable when sizes or channels differ, Usage when an option is out of range.
void check_comparable(const Image& ref, const Image& test, const CompareOptions& options);

/// Per value, NaN where REF or TEST is not finite.
std::vector<double> error_values(const Image& ref, const Image& test, const CompareOptions& options);
/// `value` (a float) rounded half up to the grid of `unit` LSB per 1.0; unchanged if no float is nearer to the grid.
double rounded_once(double value, double unit);
/// REF rounded once to the LSB grid (half up), against REF. NaN in the same places as error_values.
std::vector<double> floor_values(const Image& ref, const Image& test, const CompareOptions& options);

/// Signed error of the channel with the largest |error| per pixel, NaN where no channel is finite.
std::vector<double> worst_channel(const std::vector<double>& errors, int channels);

/// Runs body(block, begin, end) over [0, count) in fixed blocks, so that what a block sums does not depend on
/// `threads`.
void for_blocks(std::size_t count, std::size_t block, int threads,
                const std::function<void(std::size_t, std::size_t, std::size_t)>& body);

}  // namespace fastsplat::analysis
