// SPDX-License-Identifier: Apache-2.0
#include "lab/termination.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "cmodel/model.hpp"
#include "driver/tiles/compile.hpp"

namespace fastsplat::lab {
namespace {

/// Notes the first sheet behind which a pixel's transmittance lies below the threshold.
class Watch final : public cmodel::TapSink {
 public:
  Watch(const cmodel::Config& config, const driver::TileGrid& grid)
      : lanes_(config.lanes), threshold_(static_cast<std::uint32_t>(config.freeze_below)), grid_(grid) {
    map_.width = grid.image_width, map_.height = grid.image_height;
    map_.sheets.assign(static_cast<std::size_t>(map_.width) * static_cast<std::size_t>(map_.height), -1);
  }

  void on_tap(const cmodel::TapRecord& record) override {
    if (record.tap != cmodel::Tap::Composite) return;
    const int tile = static_cast<int>(record.tile);
    const int right = std::min(lanes_, grid_.width(tile) - record.x);
    const int below = std::min(lanes_, grid_.height(tile) - record.y);
    for (int j = std::max(0, -record.y); j < below; ++j) {
      for (int i = std::max(0, -record.x); i < right; ++i) {
        const std::uint32_t transmittance = record.payload[static_cast<std::size_t>(j * lanes_ + i) * 4 + 3];
        auto& sheet =
            map_.sheets[static_cast<std::size_t>(grid_.y(tile) + record.y + j) * static_cast<std::size_t>(map_.width) +
                        static_cast<std::size_t>(grid_.x(tile) + record.x + i)];
        if (sheet < 0 && transmittance < threshold_) sheet = static_cast<std::int32_t>(record.sheet);
      }
    }
  }

  TerminationMap take() { return std::move(map_); }

 private:
  int lanes_;
  std::uint32_t threshold_;
  driver::TileGrid grid_;
  TerminationMap map_;
};

}  // namespace

TerminationMap termination(const scene::Scene& scene, const cmodel::Config& config) {
  const driver::CompiledFrame compiled(scene, config);
  Watch watch(config, compiled.grid());
  if (scene.description.method == scene::Method::XRay) return watch.take();
  cmodel::NullPixels nowhere;
  cmodel::Model model(config, cmodel::StreamScope::Subset, nowhere, &watch);
  compiled.emit([&](std::span<const cmodel::Beat> beats) { model.consume(beats); });
  model.finish();
  return watch.take();
}

}  // namespace fastsplat::lab
