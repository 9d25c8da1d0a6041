// SPDX-License-Identifier: Apache-2.0
// Adds a splat to a row of a sheet: step `product` and the sum, vectorised.
#pragma once

#include <span>

#include "analysis/pipeline/float_format.hpp"
#include "cmodel/numbers/sites.hpp"
#include "golden/splat/projected_splat.hpp"

namespace fastsplat::stages {

/// How a product is rounded; Exact: not at all.
struct ProductRule {
  enum class Kind { Exact, Down, HalfUp, HalfEven } kind = Kind::Exact;
  double scale = 1.0;             ///< 2^sf
  double greatest = 0.0;          ///< the largest sheet word
  RoundToFloat product{}, sum{};  ///< of Kind::Exact where steps product or sheet are floats
};

/// sums[i][c] += product(weights[i], value[c]), the sum rounded too where it is floats. The result does not depend on
/// the processor's vector width.
void add_products(std::span<const double> weights, const golden::Sums& value, const ProductRule& rule,
                  golden::Sums* sums);

}  // namespace fastsplat::stages
