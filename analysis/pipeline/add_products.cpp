// SPDX-License-Identifier: Apache-2.0
#include "analysis/pipeline/add_products.hpp"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "analysis/pipeline/add_products.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace fastsplat::stages {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// All four sums of a pixel at once if vectors hold four, else in parts.
#if HWY_TARGET == HWY_SCALAR
using Part = hn::CappedTag<double, 1>;
constexpr std::size_t kLanes = 1;
#elif HWY_MAX_BYTES < 32
using Part = hn::CappedTag<double, 2>;
constexpr std::size_t kLanes = 2;
#else
using Part = hn::CappedTag<double, 4>;
constexpr std::size_t kLanes = 4;
#endif

/// The rounded product as a value. `product` is in units of 2^-sf unless kKind is Exact.
template <ProductRule::Kind kKind, class V>
V rounded(V product, V greatest, V ulp) {
  const Part d;
  if constexpr (kKind == ProductRule::Kind::Exact) return product;
  if constexpr (kKind == ProductRule::Kind::Down) product = hn::Floor(product);
  if constexpr (kKind == ProductRule::Kind::HalfUp) product = hn::Floor(hn::Add(product, hn::Set(d, 0.5)));
  if constexpr (kKind == ProductRule::Kind::HalfEven) product = hn::Round(product);
  return hn::Mul(hn::Min(product, greatest), ulp);
}

template <ProductRule::Kind kKind>
void add_row(std::span<const double> weights, const golden::Sums& value, const ProductRule& rule, golden::Sums* sums) {
  const Part d;
  const auto greatest = hn::Set(d, rule.greatest), ulp = hn::Set(d, 1.0 / rule.scale);
  const double scale = kKind == ProductRule::Kind::Exact ? 1.0 : rule.scale;
  for (std::size_t part = 0; part < 4; part += kLanes) {
    const auto factor = hn::Mul(hn::LoadU(d, value.data() + part), hn::Set(d, scale));
    for (std::size_t i = 0; i < weights.size(); ++i) {
      double* at = sums[i].data() + part;
      const auto product = rounded<kKind>(hn::Mul(hn::Set(d, weights[i]), factor), greatest, ulp);
      hn::StoreU(hn::Add(hn::LoadU(d, at), product), d, at);
    }
  }
}

void add_any(std::span<const double> weights, const golden::Sums& value, const ProductRule& rule, golden::Sums* sums) {
  switch (rule.kind) {
    case ProductRule::Kind::Exact:
      return add_row<ProductRule::Kind::Exact>(weights, value, rule, sums);
    case ProductRule::Kind::Down:
      return add_row<ProductRule::Kind::Down>(weights, value, rule, sums);
    case ProductRule::Kind::HalfUp:
      return add_row<ProductRule::Kind::HalfUp>(weights, value, rule, sums);
    case ProductRule::Kind::HalfEven:
      return add_row<ProductRule::Kind::HalfEven>(weights, value, rule, sums);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace fastsplat::stages
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fastsplat::stages {
HWY_EXPORT(add_any);

namespace {

double rounded(double product, const ProductRule& rule) {
  const double steps = product * rule.scale;
  switch (rule.kind) {
    case ProductRule::Kind::Exact:
      return rule.product(product);
    case ProductRule::Kind::Down:
      return std::min(std::floor(steps), rule.greatest) / rule.scale;
    case ProductRule::Kind::HalfUp:
      return std::min(std::floor(steps + 0.5), rule.greatest) / rule.scale;
    case ProductRule::Kind::HalfEven:
      break;
  }
  return std::min(std::nearbyint(steps), rule.greatest) / rule.scale;
}

void add_floats(std::span<const double> weights, const golden::Sums& value, const ProductRule& rule,
                golden::Sums* sums) {
  for (std::size_t i = 0; i < weights.size(); ++i) {
    for (std::size_t c = 0; c < 4; ++c) sums[i][c] = rule.sum(sums[i][c] + rounded(weights[i] * value[c], rule));
  }
}

}  // namespace

void add_products(std::span<const double> weights, const golden::Sums& value, const ProductRule& rule,
                  golden::Sums* sums) {
  if (rule.product.on() || rule.sum.on()) return add_floats(weights, value, rule, sums);
  HWY_DYNAMIC_DISPATCH(add_any)(weights, value, rule, sums);
}
}  // namespace fastsplat::stages
#endif
