// SPDX-License-Identifier: Apache-2.0
#include "driver/tiles/gaussian_frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>

#include "base/error.hpp"
#include "base/parallel/parallel.hpp"
#include "cmodel/fast/tile_unit.hpp"
#include "cmodel/model.hpp"
#include "driver/splats/ellipse_shape.hpp"
#include "driver/tables/quantise.hpp"
#include "driver/tables/tables.hpp"
#include "driver/tiles/beat_writer.hpp"
#include "driver/tiles/frame_sink.hpp"
#include "driver/tiles/gaussian_windows.hpp"

namespace fastsplat::driver {
namespace {

/// exp(-q/2), cut at the cutoff.
scene::Kernel kernel_of(const scene::GaussianScene& scene) { return {0.5, scene.description.cutoff}; }

const cmodel::Config& checked(const cmodel::Config& config) {
  if (config.has_ellipses() && config.composite_every_sample != 0) return config;
  throw_usage({.where = "configuration " + config.name,
               .what = "cannot composite ellipses one by one, as 3-D Gaussians require",
               .expected = "ellipse.frac_bits above 0 and composite.every_sample = 1",
               .got = {},
               .fix = "leave --config out, or use --config ellipse --set composite.every_sample=1"});
}

/// No variance is below the low-pass, so the words A and C of every shape fit if they fit there.
void check_low_pass(const scene::GaussianDescription& description, const cmodel::Config& config) {
  const double square = description.cutoff * description.cutoff;
  const double rim = std::ldexp(static_cast<double>(config.rlut_rim()), -2 * config.position_frac_bits);
  const double least = rim / square / std::ldexp(1.0, cmodel::kEllipseTermBits);
  if (description.low_pass > least) return;
  throw_usage({.where = "--low-pass with configuration " + config.name,
               .what = "the shapes of the smallest footprints exceed an ellipse's words",
               .expected = fmt::format("above {:.4g}", least),
               .got = fmt::format("{}", description.low_pass),
               .fix = "raise --low-pass or --cutoff, or lower rlut.guard_bits"});
}

/// Whether some of the Gaussian's pixels in the picture lie beyond the reach of a record.
bool too_far(const scene::GaussianScene& scene, const scene::ProjectedGaussian& splat, int reach) {
  const auto far_along = [&](double at, double variance, int size) {
    const double half = scene.description.cutoff * std::sqrt(variance);
    const double first = std::max(at - half, 0.0), last = std::min(at + half, size - 1.0);
    return at - first >= reach || last - at >= reach;
  };
  return far_along(splat.x, splat.shape.xx, scene.camera.width()) ||
         far_along(splat.y, splat.shape.yy, scene.camera.height());
}

/// Whether a pixel of the picture lies within reach of the centre.
bool reachable(const scene::GaussianScene& scene, const scene::ProjectedGaussian& splat, int reach) {
  return splat.x > -reach && splat.x < scene.camera.width() + reach && splat.y > -reach &&
         splat.y < scene.camera.height() + reach;
}

}  // namespace

GaussianFrame::GaussianFrame(const scene::GaussianScene& scene, const std::vector<scene::ProjectedGaussian>& projected,
                             const cmodel::Config& config)
    : config_(checked(config)),
      grid_(config, scene.camera.width(), scene.camera.height()),
      bins_(static_cast<std::size_t>(grid_.count())) {
  report_.tiles = static_cast<std::uint64_t>(grid_.count());
  cmodel::append(preamble_, cmodel::BeginFrame{cmodel::config_hash(config_), grid_.image_width, grid_.image_height,
                                               static_cast<std::uint32_t>(grid_.count())});
  cmodel::append(preamble_, radial_table(config_, kernel_of(scene)));
  cmodel::append(preamble_, factor_table(config_));

  check_low_pass(scene.description, config_);
  const Target place = target(Site::EllipseCentre, config_), sample = target(Site::Gaussian, config_);
  const int reach = gaussian_reach(config_);
  const double rim = scene.description.cutoff * scene.description.cutoff;
  for (const scene::ProjectedGaussian& splat : projected) {
    report_.cut += too_far(scene, splat, reach) ? 1 : 0;
    if (!reachable(scene, splat, reach)) continue;
    QuantisedGaussian words{
        .x = quantise_to<std::int32_t>(splat.x, place),
        .y = quantise_to<std::int32_t>(splat.y, place),
        .colour = {},
        .shape = ellipse_words(config_, {rim * splat.shape.xx, rim * splat.shape.xy, rim * splat.shape.yy})};
    bool saturated = false;
    for (std::size_t c = 0; c < 4; ++c) {
      const double value = splat.opacity * (c < 3 ? splat.colour[static_cast<int>(c)] : 1.0);
      const Quantised word = quantise(value, sample);
      words.colour[c] = static_cast<std::uint32_t>(word.word);
      saturated = saturated || word.saturated;
    }
    if (std::ranges::all_of(words.colour, [](std::uint32_t word) { return word == 0; })) {
      ++report_.vanished;
      continue;
    }
    report_.saturated += saturated ? 1 : 0;
    ++report_.drawn;
    gaussians_.push_back(words);
    bin(static_cast<std::uint32_t>(gaussians_.size() - 1));
  }
}

void GaussianFrame::bin(std::uint32_t number) {
  const QuantisedGaussian& one = gaussians_[number];
  const EllipseReach box = reach(config_, one.shape);
  const double pixel = std::ldexp(1.0, -config_.position_frac_bits), most = gaussian_reach(config_);
  // The range [first, end) of tiles along an axis that has `end` tiles.
  const auto tiles = [&](double centre, double half, int size, int end) {
    const double from = std::floor((centre - std::min(half, most)) / size), to = (centre + std::min(half, most)) / size;
    return std::pair(static_cast<int>(std::clamp(from, 0.0, double(end))),
                     static_cast<int>(std::clamp(std::floor(to) + 1.0, 0.0, double(end))));
  };
  const auto [left, right] = tiles(one.x * pixel, box.x, grid_.tile_width, grid_.columns());
  const auto [top, bottom] = tiles(one.y * pixel, box.y, grid_.tile_height, grid_.rows());
  for (int row = top; row < bottom; ++row) {
    for (int column = left; column < right; ++column)
      bins_[static_cast<std::size_t>(row * grid_.columns() + column)].push_back(number);
  }
}

GaussianReport GaussianFrame::emit_tile(int tile, cmodel::RecordSink& sink) const {
  const int x = grid_.x(tile), y = grid_.y(tile), width = grid_.width(tile), height = grid_.height(tile);
  const std::int32_t pixel = 1 << config_.position_frac_bits;
  std::vector<cmodel::EllipseRecord> records;
  GaussianReport report;
  sink.begin_tile({cmodel::Mode::SampleAdditive, static_cast<std::uint32_t>(tile), x, y, width, height});
  std::uint32_t tag = 0;
  for (const std::uint32_t number : bins_[static_cast<std::size_t>(tile)]) {
    const QuantisedGaussian& one = gaussians_[number];
    cmodel::EllipseRecord record{.tag = 0,
                                 .x = one.x - x * pixel,
                                 .y = one.y - y * pixel,
                                 .colour = one.colour,
                                 .shape = one.shape,
                                 .windows = {}};
    records.clear();
    for (const cmodel::EllipseWindows& windows :
         gaussian_windows(config_, one.shape, record.x, record.y, width, height)) {
      record.tag = tag + static_cast<std::uint32_t>(records.size());
      record.windows = windows;
      records.push_back(record);
    }
    if (records.empty()) continue;
    if (tag == 0) sink.begin_sheet({0});
    sink.ellipses(records);
    tag += static_cast<std::uint32_t>(records.size());
    ++report.in_tiles;
  }
  if (tag > 0) sink.end_sheet({0, tag});
  sink.end_tile({static_cast<std::uint32_t>(tile), tag > 0 ? 1U : 0U});
  report.records = tag;
  return report;
}

GaussianReport GaussianFrame::emit_tile(int tile, const cmodel::BeatSink& sink) const {
  BeatWriter beats(sink);
  return emit_tile(tile, beats);
}

GaussianReport GaussianFrame::emit(const cmodel::BeatSink& sink, const Progress& progress) const {
  GaussianReport out = report_;
  sink(preamble_);
  for (int tile = 0; tile < grid_.count(); ++tile) {
    out += emit_tile(tile, sink);
    if (progress) progress(static_cast<std::size_t>(tile) + 1, static_cast<std::size_t>(grid_.count()));
  }
  return out;
}

std::vector<std::uint64_t> GaussianFrame::work() const {
  std::vector<std::uint64_t> out;
  for (const auto& bin : bins_) out.push_back(bin.size());
  return out;
}

GaussianReport& operator+=(GaussianReport& report, const GaussianReport& tile) {
  report.records += tile.records;
  report.in_tiles += tile.in_tiles;
  return report;
}

namespace {

struct DrawnTile {
  cmodel::Counters counters;
  GaussianReport report;
  UnitReport units;
};

DrawnTile draw_plain(const GaussianFrame& frame, int tile, cmodel::PixelSink& pixels) {
  cmodel::Model device(frame.config(), cmodel::StreamScope::Subset, pixels);
  device.consume(frame.preamble());
  DrawnTile out;
  out.report = frame.emit_tile(tile, [&](std::span<const cmodel::Beat> beats) { device.consume(beats); });
  device.finish();
  out.counters = device.counters();
  out.units.plain = 1;
  return out;
}

/// Falls back to the plain unit if the fast one gives the tile up.
template <class Word>
DrawnTile draw_fast(const GaussianFrame& frame, const cmodel::fast::FrameTables& tables, int tile,
                    cmodel::PixelSink& pixels) {
  cmodel::fast::TileUnit<Word> unit(tables, pixels);
  DrawnTile out;
  out.report = frame.emit_tile(tile, unit);
  if (!unit.sound()) {
    out = draw_plain(frame, tile, pixels);
    out.units.redone = 1;
    return out;
  }
  out.counters = unit.counters();
  out.units.fast = 1;
  return out;
}

}  // namespace

GaussianRender render_gaussians(const GaussianFrame& frame, const RenderOptions& options) {
  const TileGrid& grid = frame.grid();
  FrameSink pixels(frame.config(), grid.image_width, grid.image_height);
  const std::vector<std::uint64_t> work = frame.work();
  GaussianRender out{.frame = {}, .counters = {}, .report = frame.report(), .units = {}};
  std::optional<cmodel::fast::FrameTables> tables;
  if (options.unit == Unit::Fast)
    tables = cmodel::fast::frame_tables(frame.config(), frame.preamble(), {.ellipses = true, .samples = true},
                                        &out.units.why_plain);
  if (tables) out.units.vectors = cmodel::fast::vector_target();
  std::vector<DrawnTile> tiles(work.size());
  std::atomic<std::size_t> done{0};
  parallel_for(work, options.threads, [&](std::size_t number) {
    const int tile = static_cast<int>(number);
    tiles[number] = !tables               ? draw_plain(frame, tile, pixels)
                    : tables->plan.narrow ? draw_fast<std::uint16_t>(frame, *tables, tile, pixels)
                                          : draw_fast<std::uint32_t>(frame, *tables, tile, pixels);
    if (options.progress) options.progress(done.fetch_add(1) + 1, work.size());
  });
  for (const DrawnTile& tile : tiles) {
    out.counters += tile.counters;
    out.report += tile.report;
    out.units += tile.units;
  }
  out.frame = pixels.take();
  return out;
}

}  // namespace fastsplat::driver
