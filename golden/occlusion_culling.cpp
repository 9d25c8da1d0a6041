// SPDX-License-Identifier: Apache-2.0
#include "golden/occlusion_culling.hpp"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <numeric>

#include "base/parallel/parallel.hpp"

namespace fastsplat::golden {
namespace {

/// Adds its lifetime to `seconds`.
class Stopwatch {
 public:
  explicit Stopwatch(double& seconds) : seconds_(seconds) {}
  ~Stopwatch() { seconds_ += std::chrono::duration<double>(Clock::now() - start_).count(); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  double& seconds_;
  Clock::time_point start_ = Clock::now();
};

VoxelBlocks make_blocks(const scene::Scene& scene, const std::vector<scene::Splat>& splats,
                        const scene::Culling& culling, double& seconds) {
  const Stopwatch watch(seconds);
  if (culling.mode == scene::CullingMode::Blocks) return {*scene.volume, splats, culling.block};
  return {*scene.volume, {}, culling.block};
}

}  // namespace

OcclusionCulling::OcclusionCulling(const scene::Scene& scene, const std::vector<scene::Splat>& splats, int threads,
                                   const SheetAssignment& assignment, const scene::Culling& culling)
    : scene_(scene),
      splats_(splats),
      threads_(threads),
      assignment_(assignment),
      width_(scene.camera.width()),
      height_(scene.camera.height()),
      project_(scene),
      map_(width_, height_, culling),
      blocks_(make_blocks(scene, splats, culling, report_.test_seconds)),
      waiting_blocks_(assignment.sheets()),
      waiting_splats_(assignment.sheets()) {
  assert(culling.mode != scene::CullingMode::Off);
  report_.voxels = splats.size();
  report_.blocks = blocks_.blocks().size();
  const Stopwatch watch(report_.test_seconds);
  if (culling.mode == scene::CullingMode::Splats) {
    std::vector<std::uint32_t> all(splats.size());
    std::iota(all.begin(), all.end(), 0u);
    open(all);
  } else if (!blocks_.blocks().empty()) {
    waiting_blocks_.front().push_back(static_cast<std::uint32_t>(blocks_.blocks().size() - 1));
  }
}

std::span<const ProjectedSplat> OcclusionCulling::visible(int sheet, int margin) {
  const Stopwatch watch(report_.test_seconds);
  open_blocks(sheet, margin);
  test_splats(sheet, margin);
  return projected_;
}

void OcclusionCulling::open_blocks(int sheet, int margin) {
  std::vector<std::uint32_t>& waiting = waiting_blocks_[sheet];
  for (std::size_t i = 0; i < waiting.size(); ++i) {  // `waiting` grows in the loop
    const VoxelBlock& block = blocks_.blocks()[waiting[i]];
    const BlockView view = view_of(scene_, assignment_, block, margin);
    if (view.first_sheet > sheet) {
      waiting_blocks_[view.first_sheet].push_back(waiting[i]);
    } else if (view.window.empty()) {
      report_.outside += block.splats;
    } else if (++report_.block_tests, map_.hides(view.window)) {
      ++report_.blocks_culled;
      report_.culled_in_blocks += block.splats;
    } else if (block.leaf) {
      open(blocks_.splats(block));
    } else {
      for (std::uint32_t child = 0; child < block.count; ++child) waiting.push_back(block.first + child);
    }
  }
  waiting = {};
}

void OcclusionCulling::open(std::span<const std::uint32_t> splats) {
  for (const std::uint32_t i : splats) {
    const ProjectedSplat splat = project_(splats_[i]);
    if (window_around(splat.x, splat.y, splat.reach_x, splat.reach_y, width_, height_).empty()) {
      ++report_.outside;
    } else {
      waiting_splats_[assignment_.first(splat)].push_back(i);
    }
  }
}

void OcclusionCulling::test_splats(int sheet, int margin) {
  constexpr std::size_t kChunk = 1024;
  std::vector<std::uint32_t>& waiting = waiting_splats_[sheet];
  std::sort(waiting.begin(), waiting.end());  // splatting order: sums of doubles depend on it
  projected_.resize(waiting.size());
  hidden_.resize(waiting.size());
  parallel_for((waiting.size() + kChunk - 1) / kChunk, threads_, [&](std::size_t chunk) {
    for (std::size_t i = chunk * kChunk; i < std::min(waiting.size(), (chunk + 1) * kChunk); ++i) {
      const ProjectedSplat splat = project_(splats_[waiting[i]]);
      const Window window =
          window_around(splat.x, splat.y, splat.reach_x + margin, splat.reach_y + margin, width_, height_);
      hidden_[i] = map_.hides(window);
      projected_[i] = splat;
    }
  });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < waiting.size(); ++i) {
    if (!hidden_[i]) projected_[kept++] = projected_[i];
  }
  projected_.resize(kept);
  report_.splat_tests += waiting.size();
  report_.culled_singly += waiting.size() - kept;
  report_.splatted += kept;
  waiting = {};
}

void OcclusionCulling::composited(std::span<const FrontToBack> picture, std::span<const Run> changed) {
  const Stopwatch watch(report_.map_seconds);
  map_.update(picture, changed);
}

CullingReport OcclusionCulling::report() const {
  CullingReport report = report_;
  report.opaque_after = map_.opaque_after();
  return report;
}

Image composite_visible(const scene::Scene& scene, const std::vector<scene::Splat>& splats,
                        const RenderOptions& options, const SheetAssignment& assignment, FrameStages stages) {
  const scene::Culling& culling = scene.description.culling;
  const bool plain = !stages.deposit && stages.sheet_stages.empty() && !stages.filter;
  stages.freeze_below = culling.freeze;
  if (culling.mode == scene::CullingMode::Off) {
    return plain ? composite_sheets(scene, splats, options, assignment)
                 : sweep_frame(scene, splats, options, assignment, stages);
  }
  OcclusionCulling occlusion(scene, splats, options.threads, assignment, culling);
  stages.occlusion = &occlusion;
  Image image = sweep_frame(scene, splats, options, assignment, stages);
  if (options.report) options.report->culling = occlusion.report();
  return image;
}

}  // namespace fastsplat::golden
