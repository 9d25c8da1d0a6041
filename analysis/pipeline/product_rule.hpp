// The step `product` of a mixture, as add_products takes it.
#pragma once

#include "analysis/pipeline/add_products.hpp"
#include "analysis/pipeline/step.hpp"
#include "cmodel/numbers/config.hpp"

namespace fastsplat::stages {

ProductRule product_rule(const cmodel::Config& config, const Mixture& mixture);

}  // namespace fastsplat::stages
