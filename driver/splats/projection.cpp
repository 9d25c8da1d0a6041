// SPDX-License-Identifier: Apache-2.0
#include "driver/splats/projection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "base/error.hpp"
#include "base/parallel/parallel.hpp"
#include "driver/tables/density_tables.hpp"

namespace fastsplat::driver {
namespace {

struct RadiusRange {
  double smallest = std::numeric_limits<double>::infinity();
  double largest = 0.0;
};

/// Footprint radii over the corners of the volume's box: scale is monotone in depth, so the corners bound it.
RadiusRange radius_range(const scene::Scene& scene) {
  const volume::Volume& volume = *scene.volume;
  RadiusRange range;
  for (int corner = 0; corner < 8; ++corner) {
    const auto at =
        volume.position((corner & 1) != 0 ? volume.dims.x - 1 : 0, (corner & 2) != 0 ? volume.dims.y - 1 : 0,
                        (corner & 4) != 0 ? volume.dims.z - 1 : 0);
    const double radius = pixel_radius(scene, scene.camera.project(at).scale);
    range.smallest = std::min(range.smallest, radius);
    range.largest = std::max(range.largest, radius);
  }
  return range;
}

/// The splats of a part of the grid.
struct Piece {
  scene::GridPart part;
  std::vector<QuantisedSplat> splats;
  std::vector<SplatEllipse> ellipses;  ///< of each splat, in a frame with ellipses
  std::vector<std::size_t> ends;       ///< per slice of the part, where its splats end
  std::vector<std::size_t> places;     ///< per slice of the part, where its splats begin in the frame
  std::uint64_t voxels = 0, saturated = 0, vanished = 0;
  double asked = 0.0, lost = 0.0;
  std::uint64_t widened = 0;
  std::uint32_t least_shrink = 1 << 16;
  double reach = 0.0;

  void add(const SplatQuantiser::Shaped& one, int slice) {
    const std::size_t before = splats.size();
    add(one.result, slice);
    if (splats.size() == before) return;
    ellipses.push_back(one.ellipse);
    widened += one.widened ? 1 : 0;
    least_shrink = std::min(least_shrink, one.ellipse.shrink);
    reach = std::max({reach, one.reach.x, one.reach.y});
  }
  void add(const SplatQuantiser::Result& one, int slice) {
    while (part.first_slice + static_cast<int>(ends.size()) < slice) ends.push_back(splats.size());
    ++voxels;
    asked += one.asked;
    if (one.splat.words == SplatWords{}) {
      ++vanished;
      lost += one.asked;
      return;
    }
    saturated += one.saturated ? 1 : 0;
    splats.push_back(one.splat);
  }
  void end() { ends.resize(static_cast<std::size_t>(part.end_slice - part.first_slice), splats.size()); }
  std::span<const QuantisedSplat> slice(int slice) const {
    if (slice < part.first_slice || slice >= part.end_slice) return {};
    const auto i = static_cast<std::size_t>(slice - part.first_slice);
    const std::size_t begin = i == 0 ? 0 : ends[i - 1];
    return std::span(splats).subspan(begin, ends[i] - begin);
  }
};

/// Independent parts: slabs of slices, or bands of rows if a splat needs the rounding errors of earlier splats on its
/// line. Their number is fixed, so that sums do not depend on the number of threads.
std::vector<Piece> pieces_of(const scene::Traversal& traversal, bool bands) {
  constexpr int kPieces = 32;
  const int extent = bands ? traversal.rows() : traversal.slices(), count = std::min(extent, kPieces);
  std::vector<Piece> pieces(static_cast<std::size_t>(count));
  for (int n = 0; n < count; ++n) {
    scene::GridPart& part = pieces[static_cast<std::size_t>(n)].part = traversal.all();
    (bands ? part.first_row : part.first_slice) = n * extent / count;
    (bands ? part.end_row : part.end_slice) = (n + 1) * extent / count;
  }
  return pieces;
}

/// Concatenates in traversal order: slice by slice, within a slice piece by piece.
void join(std::vector<Piece>& pieces, int slices, int threads, Projected& to) {
  std::size_t total = 0;
  for (int slice = 0; slice < slices; ++slice) {
    for (Piece& piece : pieces) {
      if (slice < piece.part.first_slice || slice >= piece.part.end_slice) continue;
      piece.places.push_back(total);
      total += piece.slice(slice).size();
    }
  }
  to.splats = Uninitialised<QuantisedSplat>(total);
  const bool shaped = std::ranges::any_of(pieces, [](const Piece& piece) { return !piece.ellipses.empty(); });
  if (shaped) to.ellipses = Uninitialised<SplatEllipse>(total);
  parallel_for(pieces.size(), threads, [&](std::size_t number) {
    Piece& piece = pieces[number];
    for (int slice = piece.part.first_slice; slice < piece.part.end_slice; ++slice) {
      const std::size_t place = piece.places[static_cast<std::size_t>(slice - piece.part.first_slice)];
      const auto splats = piece.slice(slice);
      std::ranges::copy(splats, to.splats.begin() + static_cast<std::ptrdiff_t>(place));
      if (!shaped) continue;
      const auto first = piece.ellipses.begin() + (splats.data() - piece.splats.data());
      std::copy_n(first, splats.size(), to.ellipses.begin() + static_cast<std::ptrdiff_t>(place));
    }
    piece.splats = {};  // a frame is in memory once, not twice
    piece.ellipses = {};
  });
}

/// Only radius sets have pictures; ellipses do not. Detail raises weights to 1 + m; a format that ends at 1 would cut
/// them.
void check_textures(const scene::TexturedSplats& textures, const scene::Scene& scene, const cmodel::Config& config) {
  if (textures.phases().empty()) return;
  if (draws_ellipses(scene, config)) {
    throw_usage({.where = "splat_texture.amplitude",
                 .what = "the device cannot draw textured ellipses",
                 .expected = "circles, or splats without texture",
                 .got = "ellipses",
                 .fix = "use --splat-texture 0, circles without anti-aliasing, motion and lens, or --engine golden"});
  }
  if (config.radial_int_bits > 0) return;
  throw_usage({.where = "configuration " + config.name,
               .what = "textured splats have weights above 1",
               .expected = "radial.int_bits = 1",
               .got = "0",
               .fix = "add --set radial.int_bits=1, or use --splat-texture 0"});
}

}  // namespace

// The device holds footprints no wider than the RLUT, in every kind of index.
void check_reach(double reach, const cmodel::Config& config) {
  const double widest = config.rlut_columns / 2.0;
  if (reach <= widest) return;
  throw_usage(
      {.where = "configuration " + config.name,
       .what = "a footprint is too wide for the device",
       .expected = fmt::format("half sides of at most {} pixels (rlut.columns = {})", widest, config.rlut_columns),
       .got = fmt::format("{:.2f} pixels", reach),
       .fix = "use a smaller --size, --zoom or blur, or a configuration with more rlut.columns"});
}

RadiusSets radius_sets(const scene::Scene& scene, const cmodel::Config& config, std::size_t pictures) {
  const RadiusRange range = radius_range(scene);
  // If splats have individual shapes, any radius but the largest is drawn as an ellipse.
  return RadiusSets(config, draws_ellipses(scene, config) ? range.largest : range.smallest, range.largest, pictures);
}

Projected project(const scene::Scene& scene, const cmodel::Config& config, const Slices& slices,
                  const scene::SheetPlan& plan, int threads) {
  scene::TexturedSplats textures(scene.description.footprint.texture, scene.kernel);
  check_textures(textures, scene, config);
  const std::size_t pictures = std::max<std::size_t>(1, textures.phases().size());
  Projected out{
      .splats = {}, .ellipses = {}, .sets = radius_sets(scene, config, pictures), .textures = std::move(textures)};
  const SplatQuantiser quantised(scene, config, out.sets, slices, plan,
                                 out.textures.phases().empty() ? nullptr : &out.textures);
  const scene::Traversal traversal(
      scene, holds_densities(scene.description) ? scene::SplatKind::Densities : scene::SplatKind::Colours);
  out.carried = quantised.carries();

  std::vector<Piece> pieces = pieces_of(traversal, out.carried);
  parallel_for(pieces.size(), threads, [&](std::size_t number) {
    Piece& piece = pieces[number];
    std::optional<RoundingCarry> carry;
    if (out.carried) carry.emplace(quantised.carry(piece.part.first_row, piece.part.end_row, traversal.columns()));
    traversal.visit(piece.part, [&](std::span<const scene::Splat> row, std::span<const std::uint32_t> lines) {
      quantised.row(row, lines, carry ? &*carry : nullptr,
                    [&piece](const auto& one, int sheet) { piece.add(one, sheet); });
    });
    piece.end();
  });

  double asked = 0.0, lost = 0.0, reach = 0.0;
  for (const Piece& piece : pieces) {
    out.widened += piece.widened;
    out.least_shrink = std::min(out.least_shrink, piece.least_shrink);
    reach = std::max(reach, piece.reach);
    out.voxels += piece.voxels;
    out.saturated += piece.saturated;
    out.vanished += piece.vanished;
    asked += piece.asked;
    lost += piece.lost;
  }
  out.vanished_share = out.carried || asked == 0.0 ? 0.0 : lost / asked;
  check_reach(reach, config);
  join(pieces, traversal.slices(), threads, out);
  return out;
}

}  // namespace fastsplat::driver
