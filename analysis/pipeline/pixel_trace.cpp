// SPDX-License-Identifier: Apache-2.0
#include "analysis/pipeline/pixel_trace.hpp"

#include <algorithm>
#include <map>
#include <numeric>

#include "analysis/pipeline/add_products.hpp"
#include "analysis/pipeline/band_bins.hpp"
#include "analysis/pipeline/product_rule.hpp"
#include "analysis/pipeline/weight_steps.hpp"
#include "base/error.hpp"
#include "driver/tiles/frame_head.hpp"

namespace fastsplat::stages {
namespace {

/// Pixels that a centre or an edge can move when steps change sides, and more.
constexpr int kMargin = 2;

std::vector<std::uint32_t> near_splats(const Chain& chain, int x, int y, int threads) {
  std::vector<std::uint8_t> near(chain.splats());
  for (const Mixture& mixture : {Mixture{}, Mixture::all_device()}) {
    const Staged staged = chain.staged(mixture, false, threads);
    for (std::size_t i = 0; i < near.size(); ++i) {
      const driver::Extent box =
          driver::widened(extent_of(staged.splats[i], staged.shape(i), more_reach(chain.config())), kMargin);
      near[i] |= x >= box.x0 && x < box.x1 && y >= box.y0 && y < box.y1 ? 1 : 0;
    }
  }
  std::vector<std::uint32_t> out;
  for (std::size_t i = 0; i < near.size(); ++i)
    if (near[i] != 0) out.push_back(static_cast<std::uint32_t>(i));
  return out;
}

/// Composites what a sheet gathered. True if nothing behind it can change the pixel.
bool composite(const PixelSteps& steps, SheetTrace& sheet, golden::Sums& pixel) {
  sheet.sums = steps.cut(sheet.sums);
  sheet.factor = steps.factor(sheet.sums[3]);
  sheet.slab = steps.slab(sheet.sums);
  const bool terminated = steps.take(sheet.sums, pixel);
  sheet.after = pixel;
  return terminated;
}

}  // namespace

PixelChain::PixelChain(const Chain& chain, int x, int y, int threads) : chain_(chain), x_(x), y_(y), threads_(threads) {
  const scene::SceneDescription& description = chain.scene().description;
  if (x < 0 || y < 0 || x >= description.width || y >= description.height) {
    throw_usage(
        {.where = "pixel",
         .what = "outside the picture",
         .expected = "0,0 to " + std::to_string(description.width - 1) + "," + std::to_string(description.height - 1),
         .got = std::to_string(x) + "," + std::to_string(y),
         .fix = "0,0 is the picture's top left"});
  }
  if (chain.holds_densities()) {
    throw_usage({.where = "pixel",
                 .what = "does not follow densities: each pixel depends on its neighbours",
                 .expected = {},
                 .got = {},
                 .fix = "use --classify pre; `fastsplat errors` attributes densities' errors"});
  }
  near_ = near_splats(chain, x, y, threads);
}

PixelTrace PixelChain::operator()(const Mixture& mixture) const {
  const scene::Scene& scene = chain_.scene();
  const cmodel::Config& config = chain_.config();
  const Staged staged = chain_.staged(near_, mixture, threads_);
  std::vector<std::size_t> order(staged.splats.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return staged.splats[i].first; });

  WeightSteps weights(scene.kernel, config);
  const PixelSteps steps(scene, config, mixture, false);
  ProductRule rule = product_rule(config, mixture);
  const bool samples = driver::every_sample(scene.description);
  const RoundToFloat sum = samples ? RoundToFloat{} : rule.sum;  // a sample has no sheet
  rule.sum = {};
  PixelTrace out;
  std::map<int, SheetTrace> sheets;  // by number; with every sample composited, by the sample's
  std::vector<golden::Sums> shares;
  for (const std::size_t i : order) {
    const StagedSplat& splat = staged.splats[i];
    const StagedShape* const shape = staged.shape(i);
    weights.follow(x_);
    weights.rasterise(splat, shape, mixture, false, {y_, y_ + 1}, scene.description.width);
    const std::optional<WeightSteps::Followed> here = weights.followed();
    if (!here || here->weight == 0.0) continue;
    const auto number = static_cast<std::uint32_t>(out.splats.size());
    out.splats.push_back({near_[i], splat, here->entries, here->weight});
    chain_.shares(splat, shape, mixture, shares);
    for (std::size_t s = 0; s < shares.size(); ++s) {
      if (shares[s] == golden::Sums{}) continue;
      SheetTrace& sheet = sheets[samples ? static_cast<int>(number) : splat.first + static_cast<int>(s)];
      sheet.sheet = splat.first + static_cast<int>(s);
      ShareTrace share{number, shares[s], {}};
      add_products(std::span(&here->weight, 1), shares[s], rule, &share.product);
      for (std::size_t c = 0; c < 4; ++c) sheet.sums[c] = sum(sheet.sums[c] + share.product[c]);
      sheet.shares.push_back(share);
    }
  }
  golden::Sums pixel = steps.initial();
  for (auto& [number, sheet] : sheets) {
    if (out.terminated) break;
    out.terminated = composite(steps, sheet, pixel);
    out.sheets.push_back(std::move(sheet));
  }
  out.out = steps.out(pixel);
  return out;
}

}  // namespace fastsplat::stages
