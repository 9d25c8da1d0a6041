// SPDX-License-Identifier: Apache-2.0
#include "driver/tiles/gaussian_frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>

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

/// Error of the determinant from which on an ellipse's words do not hold its shape.
constexpr double kShapeLost = 0.5;

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

/// Whether a pixel of the picture lies within reach of the centre.
bool reachable(const scene::GaussianScene& scene, const scene::ProjectedGaussian& splat, int reach) {
  return splat.x > -reach && splat.x < scene.camera.width() + reach && splat.y > -reach &&
         splat.y < scene.camera.height() + reach;
}

/// Pixels that it may touch.
Extent box_of(const cmodel::Config& config, const QuantisedGaussian& one) {
  const EllipseReach box = reach(config, one.shape);
  const double pixel = std::ldexp(1.0, -config.position_frac_bits), most = gaussian_reach(config);
  const auto first = [&](double centre, double half) {
    return static_cast<std::int32_t>(std::floor(centre * pixel - std::min(half, most)));
  };
  const auto end = [&](double centre, double half) {
    return static_cast<std::int32_t>(std::floor(centre * pixel + std::min(half, most))) + 1;
  };
  const std::int32_t bottom = end(one.y, box.y);
  return {first(one.x, box.x), end(one.x, box.x), first(one.y, box.y), bottom, bottom};
}

}  // namespace

scene::Kernel kernel_of(const scene::GaussianDescription& description) { return {0.5, description.cutoff}; }

void check_drawable(const scene::GaussianDescription& description, const cmodel::Config& config) {
  if (!config.has_ellipses() || config.composite_every_sample == 0) {
    throw_usage({.where = "configuration " + config.name,
                 .what = "cannot composite ellipses one by one, as 3-D Gaussians require",
                 .expected = "ellipse.frac_bits above 0 and composite.every_sample = 1",
                 .got = {},
                 .fix = "leave --config out, or use --config ellipse --set composite.every_sample=1"});
  }
  check_low_pass(description, config);
}

bool too_far(const scene::GaussianScene& scene, const scene::ProjectedGaussian& splat, int reach) {
  const auto far_along = [&](double at, double variance, int size) {
    const double half = scene.description.cutoff * std::sqrt(variance);
    const double first = std::max(at - half, 0.0), last = std::min(at + half, size - 1.0);
    return at - first >= reach || last - at >= reach;
  };
  return far_along(splat.x, splat.shape.xx, scene.camera.width()) ||
         far_along(splat.y, splat.shape.yy, scene.camera.height());
}

GaussianFrame::GaussianFrame(const scene::GaussianScene& scene, const std::vector<scene::ProjectedGaussian>& projected,
                             const cmodel::Config& config, int threads)
    : config_(config), grid_(config, scene.camera.width(), scene.camera.height()) {
  check_drawable(scene.description, config_);
  report_.tiles = static_cast<std::uint64_t>(grid_.count());
  cmodel::append(preamble_, cmodel::BeginFrame{cmodel::config_hash(config_), grid_.image_width, grid_.image_height,
                                               static_cast<std::uint32_t>(grid_.count())});
  cmodel::append(preamble_, radial_table(config_, kernel_of(scene.description)));
  cmodel::append(preamble_, factor_table(config_));

  std::vector<GaussianReport> parts(part_count(projected.size()));
  gaussians_.resize(projected.size());
  parallel_parts(projected.size(), threads, [&](std::size_t part, std::size_t first, std::size_t end) {
    quantise_all(scene, std::span(projected).subspan(first, end - first), first, parts[part]);
  });
  for (const GaussianReport& part : parts) {
    report_.cut += part.cut;
    report_.vanished += part.vanished;
    report_.saturated += part.saturated;
    report_.brightest = std::max(report_.brightest, part.brightest);
    report_.thin += part.thin;
  }
  std::erase_if(gaussians_, [](const QuantisedGaussian& one) { return one.empty(); });
  report_.drawn = gaussians_.size();
  bins_.emplace(
      grid_, Bands(grid_, grid_.tile_height), Cells(), 1, gaussians_.size(), threads,
      [this](std::size_t number) { return gaussians_[number].box; }, [](std::size_t) { return 0; });
}

void GaussianFrame::quantise_all(const scene::GaussianScene& scene, std::span<const scene::ProjectedGaussian> splats,
                                 std::size_t first, GaussianReport& report) {
  const Target place = target(Site::EllipseCentre, config_), sample = target(Site::Gaussian, config_);
  const int reach = gaussian_reach(config_);
  const double rim = scene.description.cutoff * scene.description.cutoff;
  for (std::size_t i = 0; i < splats.size(); ++i) {
    const scene::ProjectedGaussian& splat = splats[i];
    report.cut += too_far(scene, splat, reach) ? 1 : 0;
    if (!reachable(scene, splat, reach)) continue;
    QuantisedGaussian& words = gaussians_[first + i];
    const scene::ScreenShape footprint{rim * splat.shape.xx, rim * splat.shape.xy, rim * splat.shape.yy};
    words = {.x = quantise_to<std::int32_t>(splat.x, place),
             .y = quantise_to<std::int32_t>(splat.y, place),
             .colour = {},
             .shape = ellipse_words(config_, footprint),
             .box = {}};
    bool saturated = false;
    for (std::size_t c = 0; c < 4; ++c) {
      const double value = splat.opacity * (c < 3 ? splat.colour[static_cast<int>(c)] : 1.0);
      const Quantised word = quantise(value, sample);
      if (c < 3) report.brightest = std::max(report.brightest, splat.colour[static_cast<int>(c)]);
      words.colour[c] = static_cast<std::uint32_t>(word.word);
      saturated = saturated || word.saturated;
    }
    if (words.empty()) {
      ++report.vanished;
      continue;
    }
    report.saturated += saturated ? 1 : 0;
    report.thin += std::abs(determinant_error(config_, words.shape, footprint)) > kShapeLost ? 1 : 0;
    words.box = box_of(config_, words);
  }
}

template <class Hidden>
GaussianReport GaussianFrame::emit_tile(int tile, cmodel::RecordSink& sink, const Hidden& hidden) const {
  const int x = grid_.x(tile), y = grid_.y(tile), width = grid_.width(tile), height = grid_.height(tile);
  const std::int32_t pixel = 1 << config_.position_frac_bits;
  std::vector<cmodel::EllipseRecord> records;
  GaussianReport report;
  sink.begin_tile({cmodel::Mode::SampleAdditive, static_cast<std::uint32_t>(tile), x, y, width, height});
  std::uint32_t tag = 0;
  for (const std::uint32_t number : bins_->bin(tile, 0, 0)) {
    const QuantisedGaussian& one = gaussians_[number];
    if (hidden(one)) continue;
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

GaussianReport GaussianFrame::emit_tile(int tile, cmodel::RecordSink& sink) const {
  return emit_tile(tile, sink, [](const QuantisedGaussian&) { return false; });
}

template <class Word>
GaussianReport GaussianFrame::emit_visible(int tile, cmodel::fast::TileUnit<Word>& unit) const {
  const int x = grid_.x(tile), y = grid_.y(tile);
  return emit_tile(tile, unit, [&](const QuantisedGaussian& one) {
    const Extent& box = one.box;
    return unit.terminated({box.x0 - x, box.y0 - y, box.x1 - x, box.y1 - y});
  });
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
  for (int tile = 0; tile < grid_.count(); ++tile) out.push_back(bins_->count(tile, 0));
  return out;
}

GaussianReport& operator+=(GaussianReport& report, const GaussianReport& tile) {
  report.records += tile.records;
  report.in_tiles += tile.in_tiles;
  return report;
}

namespace {

struct Drawn {
  cmodel::Counters counters;
  GaussianReport report;
  UnitReport units;
};

Drawn draw_plain(const GaussianFrame& frame, int tile, cmodel::PixelSink& pixels) {
  cmodel::Model device(frame.config(), cmodel::StreamScope::Subset, pixels);
  device.consume(frame.preamble());
  Drawn out;
  out.report = frame.emit_tile(tile, [&](std::span<const cmodel::Beat> beats) { device.consume(beats); });
  device.finish();
  out.counters = device.counters();
  out.units.plain = 1;
  return out;
}

void add(Drawn& to, const Drawn& more) {
  to.counters += more.counters;
  to.report += more.report;
  to.units += more.units;
}

/// Calls draw(tile, drawn) for all tiles, the longest first, on threads that each have a `Painter`.
template <class Painter, class... Of>
Drawn draw_tiles(const GaussianFrame& frame, const RenderOptions& options, Of&... of) {
  const std::vector<std::size_t> order = longest_first(frame.work());
  std::vector<Drawn> drawn(std::min(thread_count(options.threads), order.size()));
  std::atomic<std::size_t> next{0}, done{0};
  parallel_for(drawn.size(), options.threads, [&](std::size_t worker) {
    Painter painter{frame, of...};
    for (std::size_t i = next++; i < order.size(); i = next++) {
      painter.draw(static_cast<int>(order[i]), drawn[worker]);
      if (options.progress) options.progress(++done, order.size());
    }
    drawn[worker].counters += painter.counters();
  });
  Drawn out;
  for (const Drawn& one : drawn) add(out, one);
  return out;
}

struct PlainPainter {
  const GaussianFrame& frame;
  cmodel::PixelSink& pixels;
  void draw(int tile, Drawn& to) { add(to, draw_plain(frame, tile, pixels)); }
  static cmodel::Counters counters() { return {}; }
};

/// Falls back to the plain unit for tiles that the fast one gives up.
template <class Word>
class FastPainter {
 public:
  FastPainter(const GaussianFrame& frame, cmodel::PixelSink& pixels, const cmodel::fast::FrameTables& tables,
              const bool& counts)
      : frame_(frame),
        pixels_(pixels),
        counts_(counts),
        unit_(tables, pixels, counts ? cmodel::fast::Counts::All : cmodel::fast::Counts::None) {}

  void draw(int tile, Drawn& to) {
    const std::uint64_t hidden_before = unit_.hidden_splats();
    const GaussianReport report = counts_ ? frame_.emit_tile(tile, unit_) : frame_.emit_visible(tile, unit_);
    if (unit_.sound()) {
      to.report += report;
      ++to.units.fast;
      to.units.hidden_splats += unit_.hidden_splats() - hidden_before;
    } else {
      add(to, draw_plain(frame_, tile, pixels_));
      ++to.units.redone;
    }
  }
  const cmodel::Counters& counters() const { return unit_.counters(); }

 private:
  const GaussianFrame& frame_;
  cmodel::PixelSink& pixels_;
  bool counts_;
  cmodel::fast::TileUnit<Word> unit_;
};

}  // namespace

GaussianRender render_gaussians(const GaussianFrame& frame, const RenderOptions& options) {
  const TileGrid& grid = frame.grid();
  FrameSink pixels(frame.config(), grid.image_width, grid.image_height);
  GaussianRender out{.frame = {}, .counters = {}, .report = frame.report(), .units = {}};
  std::optional<cmodel::fast::FrameTables> tables;
  if (options.unit == Unit::Fast)
    tables = cmodel::fast::frame_tables(frame.config(), frame.preamble(), {.ellipses = true, .samples = true},
                                        &out.units.why_plain);
  Drawn drawn;
  if (!tables) {
    drawn = draw_tiles<PlainPainter>(frame, options, pixels);
  } else {
    out.units.vectors = cmodel::fast::vector_target();
    out.counted = options.counters;
    drawn = tables->plan.narrow ? draw_tiles<FastPainter<std::uint16_t>>(frame, options, pixels, *tables, out.counted)
                                : draw_tiles<FastPainter<std::uint32_t>>(frame, options, pixels, *tables, out.counted);
  }
  out.counters = drawn.counters;
  out.report += drawn.report;
  out.units += drawn.units;
  out.frame = pixels.take();
  return out;
}

}  // namespace fastsplat::driver
