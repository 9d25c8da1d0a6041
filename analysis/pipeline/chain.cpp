// SPDX-License-Identifier: Apache-2.0
#include "analysis/pipeline/chain.hpp"

#include <cmath>
#include <numeric>
#include <utility>

#include "analysis/pipeline/add_products.hpp"
#include "analysis/pipeline/add_to_sheets.hpp"
#include "analysis/pipeline/band_bins.hpp"
#include "analysis/pipeline/density_frame.hpp"
#include "analysis/pipeline/pixel_steps.hpp"
#include "analysis/pipeline/product_rule.hpp"
#include "analysis/pipeline/weight_steps.hpp"
#include "base/parallel/parallel.hpp"
#include "driver/tables/density_tables.hpp"
#include "driver/tiles/compile.hpp"
#include "golden/settled_pixels.hpp"
#include "golden/sheet.hpp"
#include "scene/capability.hpp"

namespace fastsplat::stages {
namespace {

constexpr int kRows = 16;  ///< rows of a band: its sheets stay in the cache

const scene::Scene& drawable(const scene::Scene& scene, const cmodel::Config& config) {
  scene::Offers offers = driver::offers(config);
  scene::check_capability(scene, offers);
  // Steps cover neither patterns nor textured splats.
  for (const auto feature : {scene::Feature::Details, scene::Feature::Patterns})
    offers.features &= ~static_cast<unsigned>(feature);
  offers.engine = "error attribution";
  offers.details_fix = offers.patterns_fix = nullptr;
  scene::check_capability(scene, offers);
  driver::check_densities(scene);
  return scene;
}

}  // namespace

/// Draws a band of rows, sheet by sheet.
class Chain::Band {
 public:
  Band(const Chain& chain, const Mixture& mixture, const Staged& splats, bool golden_units, golden::Rows rows,
       int width)
      : chain_(chain),
        mixture_(mixture),
        splats_(splats),
        golden_units_(golden_units),
        samples_(driver::every_sample(chain.scene_.description)),
        rows_(rows),
        width_(width),
        weights_(chain.scene_.kernel, chain.config_),
        pixels_(chain.scene_, chain.config_, mixture, golden_units),
        product_(product_rule(chain.config_, mixture)),
        settled_(rows, width),
        ring_(chain.steps_ ? static_cast<std::size_t>(chain.steps_->reach(mixture)) : 1, golden::Sheet(rows, width)),
        picture_(static_cast<std::size_t>(rows.end - rows.first) * width, pixels_.initial()) {
    if (samples_) product_.sum = {};  // a sample has no sheet
  }

  void run(const BandBins& bins, int band) {
    for (int sheet = 0; sheet < chain_.sheets(); ++sheet) {
      for (const std::uint32_t i : bins.bin(band, sheet)) add(splats_.splats[i], splats_.shape(i));
      drain(at(sheet));
    }
  }
  void store(golden::Sums* out) const {
    for (const golden::Sums& pixel : picture_) *out++ = pixels_.out(pixel);
  }

 private:
  golden::Sheet& at(int sheet) { return ring_[static_cast<std::size_t>(sheet) % ring_.size()]; }

  void add(const StagedSplat& splat, const StagedShape* shape) {
    golden::ProjectedSplat reach;
    reach.x = splat.x;
    reach.y = splat.y;
    const Reach far = reach_of(splat, shape, more_reach(chain_.config_));
    reach.reach_x = far.x;
    reach.reach_y = far.y;
    const golden::Rows open = settled_.open_rows(reach, rows_);
    if (open.first >= open.end) return;
    weights_.rasterise(splat, shape, mixture_, golden_units_, open, width_);
    chain_.shares(splat, shape, mixture_, shares_);
    if (samples_) return composite();
    add_to_sheets(splat, weights_, shares_, product_, [this](int sheet) -> golden::Sheet& { return at(sheet); });
  }

  /// Composites each sample of the splat separately.
  void composite() {
    for (const auto& span : weights_.spans()) {
      products_.assign(static_cast<std::size_t>(span.width), {});
      add_products(weights_.weights(span), shares_.front(), product_, products_.data());
      golden::Sums* const pixels = &picture_[static_cast<std::size_t>(span.y - rows_.first) * width_ + span.x];
      for (int i = 0; i < span.width; ++i) {
        if (pixels_.take(products_[static_cast<std::size_t>(i)], pixels[i])) settled_.settle(span.x + i, span.y);
      }
    }
  }

  void drain(golden::Sheet& sheet) {
    for (int y = rows_.first; y < rows_.end; ++y) {
      const golden::Run touched = sheet.touched(y);
      if (touched.empty()) continue;
      golden::Sums* const row = &picture_[static_cast<std::size_t>(y - rows_.first) * width_];
      for (int x = touched.begin; x < touched.end; ++x) {
        if (pixels_.take(sheet.row(y)[x], row[x])) settled_.settle(x, y);
      }
      sheet.clear_row(y);
    }
  }

  const Chain& chain_;
  const Mixture& mixture_;
  const Staged& splats_;
  bool golden_units_, samples_;
  golden::Rows rows_;
  int width_;
  WeightSteps weights_;
  PixelSteps pixels_;
  ProductRule product_;
  golden::SettledPixels settled_;
  std::vector<golden::Sheet> ring_;
  std::vector<golden::Sums> picture_;
  std::vector<golden::Sums> shares_, products_;
};

Chain::Chain(const scene::Scene& scene, const cmodel::Config& config)
    : scene_(drawable(scene, config)), config_(config), steps_(std::in_place, scene, config), list_(scene) {
  if (driver::holds_densities(scene.description))
    densities_.emplace(scene, config, driver::plan_for_device(scene).slabs);
}

Chain::Chain(const scene::GaussianScene& scene, const cmodel::Config& config, int threads)
    : own_(samples_scene(scene)), scene_(*own_), config_(config), gaussians_(std::in_place, scene, config, threads) {}

Staged Chain::staged(const Mixture& mixture, bool golden_units, int threads, Staged memory) const {
  if (!gaussians_) return steps_->staged(list_, mixture, golden_units, threads, std::move(memory));
  std::vector<std::uint32_t> all(splats());
  std::iota(all.begin(), all.end(), 0U);
  return gaussians_->staged(all, mixture, threads, std::move(memory));
}

Staged Chain::staged(std::span<const std::uint32_t> which, const Mixture& mixture, int threads) const {
  if (gaussians_) return gaussians_->staged(which, mixture, threads, {});
  if (!carries() || !mixture.device(Step::Emission)) return steps_->staged(list_.part(which), mixture, false, threads);
  // Rounding errors come from all splats before.
  const Staged whole = staged(mixture, false, threads);
  Staged out;
  for (const std::uint32_t i : which) {
    out.splats.push_back(whole.splats[i]);
    if (!whole.shapes.empty()) out.shapes.push_back(whole.shapes[i]);
  }
  return out;
}

void Chain::shares(const StagedSplat& splat, const StagedShape* shape, const Mixture& mixture,
                   std::vector<golden::Sums>& out) const {
  if (gaussians_) {
    out.assign(1, splat.value);
  } else {
    steps_->shares(splat, mixture, out, shape != nullptr ? shape->growth : Growth{});
  }
}

Picture Chain::operator()(const Mixture& mixture, int threads) const {
  // If nothing is rounded up to step sheet, the order of the factors is free, and golden's is used.
  const bool golden_units = !gaussians_ && mixture.real(Step::Position, Step::Sheet);
  const int width = scene_.description.width, height = scene_.description.height;
  Staged splats = staged(mixture, golden_units, threads, [this] {
    const std::scoped_lock lock(guard_);
    return std::exchange(memory_, {});
  }());
  const driver::TileGrid bands = band_grid(config_, width, height, kRows);
  const BandBins bins(
      bands, sheets(), splats.splats.size(), threads,
      [&](std::size_t i) {
        return driver::widened(extent_of(splats.splats[i], splats.shape(i), more_reach(config_)),
                               densities_ ? DensityBand::kHalo : 0);
      },
      [&](std::size_t i) { return splats.splats[i].first; });

  Picture picture{width, height, std::vector<golden::Sums>(static_cast<std::size_t>(width) * height)};
  parallel_for(bins.work(), threads, [&](std::size_t number) {
    const int band = static_cast<int>(number);
    const golden::Rows rows{bands.y(band), bands.y(band) + bands.height(band)};
    golden::Sums* const out = &picture.pixels[static_cast<std::size_t>(rows.first) * width];
    const auto draw = [&](auto sweep) {
      sweep.run(bins, band);
      sweep.store(out);
    };
    if (densities_) {
      draw(DensityBand({scene_, config_, *steps_, *densities_, mixture, splats, golden_units}, rows));
    } else {
      draw(Band(*this, mixture, splats, golden_units, rows, width));
    }
  });
  const std::scoped_lock lock(guard_);
  memory_ = std::move(splats);
  return picture;
}

}  // namespace fastsplat::stages
