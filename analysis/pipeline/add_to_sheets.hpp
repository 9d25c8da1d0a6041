// SPDX-License-Identifier: Apache-2.0
// Adds a splat to its sheets: its weights, already rasterised, times its share in each sheet.
#pragma once

#include <span>

#include "analysis/pipeline/add_products.hpp"
#include "analysis/pipeline/splat_steps.hpp"
#include "analysis/pipeline/weight_steps.hpp"
#include "golden/sheet.hpp"

namespace fastsplat::stages {

/// `sheet_at(n)`: sheet n, a golden::Sheet&. Empty shares touch no sheet.
template <class SheetAt>
void add_to_sheets(const StagedSplat& splat, const WeightSteps& weights, std::span<const golden::Sums> shares,
                   const ProductRule& product, SheetAt sheet_at) {
  for (std::size_t s = 0; s < shares.size(); ++s) {
    if (shares[s] == golden::Sums{}) continue;
    golden::Sheet& sheet = sheet_at(splat.first + static_cast<int>(s));
    for (const auto& span : weights.spans()) {
      add_products(weights.weights(span), shares[s], product, sheet.row(span.y) + span.x);
      sheet.touch(span.y, {span.x, span.x + span.width});
    }
  }
}

}  // namespace fastsplat::stages
