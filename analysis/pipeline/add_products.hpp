// What a splat adds to a row of a sheet: the steps `product` and sum, with vectors.
#pragma once

#include <span>

#include "cmodel/numbers/sites.hpp"
#include "golden/splat/projected_splat.hpp"

namespace fastsplat::stages {

/// The product's rounding, or none.
struct ProductRule {
  enum class Kind { Exact, Down, HalfUp, HalfEven } kind = Kind::Exact;
  double scale = 1.0;     ///< 2^sf
  double greatest = 0.0;  ///< the largest sheet word, in words
};

/// sums[i][c] += product(weights[i], value[c]). The bits do not depend on the processor's vectors.
void add_products(std::span<const double> weights, const golden::Sums& value, const ProductRule& rule,
                  golden::Sums* sums);

}  // namespace fastsplat::stages
