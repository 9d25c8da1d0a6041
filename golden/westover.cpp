// SPDX-License-Identifier: Apache-2.0
// Composite every sample (Westover 1989): each splat is composited by itself, in traversal order. Overlapping kernels
// of one layer should be added but dim one another, so the picture depends on the order inside a layer.
#include <atomic>

#include "golden/bands.hpp"
#include "golden/render.hpp"
#include "golden/settled_pixels.hpp"
#include "golden/splat/composite.hpp"
#include "golden/splat/footprint.hpp"
#include "golden/splat/projection.hpp"

namespace fastsplat::golden {

Image westover(const scene::Scene& scene, const std::vector<scene::Splat>& splats, const RenderOptions& options) {
  const int width = scene.camera.width();
  const int height = scene.camera.height();
  const scene::SlabOpacity opacity = scene.description.slab_opacity;
  Image image(width, height);
  const Projector project(scene);
  const Bands bands{height};
  const BandIndex index(scene, splats, bands, 1, options.threads, [](const ProjectedSplat&) { return 0; });

  const bool settles = !options.plain && never_brighter_than_opaque(splats);
  std::atomic<std::uint64_t> hidden = 0;
  for_each_band(index.splats_per_band(), options.threads, options.progress, [&](int band) {
    const Rows rows = bands.rows(band);
    std::vector<FrontToBack> pixels(static_cast<std::size_t>(rows.end - rows.first) * width);
    SettledPixels settled_pixels(rows, width);
    Footprint footprint;
    for (const std::uint32_t i : index.bucket(band, 0)) {
      const ProjectedSplat splat = project(splats[i]);
      const Rows open = settled_pixels.open_rows(splat, rows);
      if (open.first >= open.end) {
        ++hidden;
        continue;
      }
      footprint.rasterise(scene.kernel, splat, open, width);
      for (const Footprint::Span& span : footprint.spans()) {
        const double* weights = footprint.weights(span);
        FrontToBack* row = &pixels[static_cast<std::size_t>(span.y - rows.first) * width + span.x];
        for (int x = 0; x < span.width; ++x) {
          if (settled_pixels.at(span.x + x, span.y)) continue;
          Sums sums = splat.value;
          for (double& sum : sums) sum *= weights[x];
          row[x].add(make_layer(sums, opacity));
          if (settles && settled(row[x])) settled_pixels.settle(span.x + x, span.y);
        }
      }
    }
    float* out = image.pixel(0, rows.first);
    for (const FrontToBack& pixel : pixels) {
      pixel.store(out);
      out += image.channels;
    }
  });
  if (options.report) options.report->footprints = index.size(), options.report->hidden_footprints = hidden;
  return image;
}

}  // namespace fastsplat::golden
