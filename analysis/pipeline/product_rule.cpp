// SPDX-License-Identifier: Apache-2.0
#include "analysis/pipeline/product_rule.hpp"

#include <cmath>

#include "cmodel/numbers/sites.hpp"

namespace fastsplat::stages {

ProductRule product_rule(const cmodel::Config& config, const Mixture& mixture) {
  const RoundToFloat& sum = mixture.sum_rounding(Step::Sheet);
  if (!mixture.device(Step::Product)) return {.product = mixture.rounding(Step::Product), .sum = sum};
  const cmodel::Narrowing site = cmodel::narrowing(config, cmodel::Site::Product);
  const auto kind = [&] {
    switch (site.rounding()) {
      case cmodel::Rounding::TRN:
        return ProductRule::Kind::Down;
      case cmodel::Rounding::RND:
        return ProductRule::Kind::HalfUp;
      case cmodel::Rounding::RND_CONV:
        break;
    }
    return ProductRule::Kind::HalfEven;
  };
  return {.kind = kind(),
          .scale = std::ldexp(1.0, site.to().frac_bits),
          .greatest = static_cast<double>(site.to().max),
          .sum = sum};
}

}  // namespace fastsplat::stages
