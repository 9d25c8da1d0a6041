// SPDX-License-Identifier: Apache-2.0
// The rounding of step `product` in a hybrid pipeline, for add_products().
#pragma once

#include "analysis/pipeline/add_products.hpp"
#include "analysis/pipeline/step.hpp"
#include "cmodel/numbers/config.hpp"

namespace fastsplat::stages {

ProductRule product_rule(const cmodel::Config& config, const Mixture& mixture);

}  // namespace fastsplat::stages
