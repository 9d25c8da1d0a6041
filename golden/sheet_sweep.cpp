#include "golden/sheet_sweep.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "golden/bands.hpp"
#include "golden/sheet.hpp"
#include "golden/splat/composite.hpp"
#include "golden/splat/footprint.hpp"
#include "golden/splat/projection.hpp"
#include "scene/kernel_growth.hpp"

namespace fastsplat::golden {

int KernelSlices::reach() const {
  // One more than 2R/W slabs when the ends fall inside slabs, one more for the rounding of the ends' positions.
  return std::min(grid_.count, static_cast<int>(std::ceil(2.0 * kernel_.radius() * largest_growth_ / grid_.width)) + 2);
}

int KernelSlices::first(const ProjectedSplat& splat) const {
  const double slab = std::floor((splat.z - kernel_.radius() * splat.depth_growth - grid_.first) / grid_.width);
  return static_cast<int>(std::clamp(slab, 0.0, grid_.count - 1.0));
}

void KernelSlices::shares(const ProjectedSplat& splat, std::vector<double>& out) const {
  assert(splat.depth_growth <= largest_growth_ * (1.0 + 1e-6));  // positions are float
  out.clear();
  double in_front = 0.0;  // share of the splat in front of the current slab
  for (int slab = first(splat); slab < grid_.count && in_front < 1.0; ++slab) {
    const bool last = slab == grid_.count - 1;
    const double z1 = grid_.first + (slab + 1) * grid_.width;
    const double behind_slab = last ? 1.0 : kernel_.cumulative((z1 - splat.z) / splat.depth_growth);
    out.push_back(behind_slab - in_front);
    in_front = behind_slab;
  }
}

KernelSlices image_slabs(const scene::Scene& scene) {
  return {scene.kernel, scene::sheet_plan(scene, scene::Method::ImageAligned).slabs, scene::largest_growth(scene)};
}

namespace {

/// Hands the touched runs over and leaves the sheet empty.
void drain(Sheet& sheet, std::vector<Sums>& pixels, const TakeSheet& take) {
  const Rows rows = sheet.rows();
  for (int y = rows.first; y < rows.end; ++y) {
    const Run touched = sheet.touched(y);
    if (touched.empty()) continue;
    const std::size_t begin = static_cast<std::size_t>(y - rows.first) * sheet.width() + touched.begin;
    const auto count = static_cast<std::size_t>(touched.size());
    take(std::span(pixels).subspan(begin, count), std::span<const Sums>(sheet.row(y) + touched.begin, count));
    sheet.clear_row(y);
  }
}

/// Thin slabs need long rings; then bands are narrower, to keep a thread's ring below this many bytes.
constexpr double kRingBytes = 64e6;

int rows_for_ring(int sheets, int width) {
  const double row_bytes = static_cast<double>(sheets) * width * sizeof(Sums);
  return static_cast<int>(std::clamp(kRingBytes / row_bytes, 4.0, 16.0));
}

}  // namespace

Image sweep_sheets(const scene::Scene& scene, const std::vector<scene::Splat>& splats, const RenderOptions& options,
                   const SheetAssignment& assignment, const Sums& initial, const TakeSheet& take,
                   const StorePixel& store) {
  const int width = scene.camera.width();
  const int height = scene.camera.height();
  Image image(width, height);
  const Projector project(scene);
  const int reach = assignment.reach();
  const Bands bands{height, rows_for_ring(reach, width)};
  const BandIndex index(scene, splats, bands, assignment.sheets(), options.threads,
                        [&](const ProjectedSplat& splat) { return assignment.first(splat); });

  for_each_band(index.splats_per_band(), options.threads, options.progress, [&](int band) {
    const Rows rows = bands.rows(band);
    std::vector<Sheet> ring(reach, Sheet(rows, width));
    std::vector<Sums> pixels(static_cast<std::size_t>(rows.end - rows.first) * width, initial);
    std::vector<double> shares;
    Footprint footprint;

    for (int sheet = 0; sheet < assignment.sheets(); ++sheet) {
      for (const std::uint32_t i : index.bucket(band, sheet)) {
        const ProjectedSplat splat = project(splats[i]);
        footprint.rasterise(scene.kernel, splat, rows, width);
        assignment.shares(splat, shares);
        assert(static_cast<int>(shares.size()) <= reach);
        for (std::size_t s = 0; s < shares.size(); ++s) {
          ring[(sheet + s) % reach].add(footprint, scaled(splat.value, shares[s]));
        }
      }
      drain(ring[sheet % reach], pixels, take);
    }

    float* out = image.pixel(0, rows.first);
    for (const Sums& pixel : pixels) {
      store(pixel, out);
      out += image.channels;
    }
  });
  return image;
}

Image composite_sheets(const scene::Scene& scene, const std::vector<scene::Splat>& splats, const RenderOptions& options,
                       const SheetAssignment& assignment) {
  const scene::SlabOpacity opacity = scene.description.slab_opacity;
  const double freeze = scene.description.culling.freeze;
  const auto take = [opacity, freeze](std::span<Sums> pixels, std::span<const Sums> sheet) {
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      if (!(sheet[i][3] > 0.0) || pixels[i][3] < freeze) continue;
      FrontToBack pixel{pixels[i][0], pixels[i][1], pixels[i][2], pixels[i][3]};
      pixel.add(make_layer(sheet[i], opacity));
      pixels[i] = {pixel.red, pixel.green, pixel.blue, pixel.transmittance};
    }
  };
  const auto store = [](const Sums& pixel, float* rgba) {
    FrontToBack{pixel[0], pixel[1], pixel[2], pixel[3]}.store(rgba);
  };
  const Sums nothing_yet = {0.0, 0.0, 0.0, 1.0};
  return sweep_sheets(scene, splats, options, assignment, nothing_yet, take, store);
}

}  // namespace fastsplat::golden
