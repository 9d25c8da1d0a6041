// SPDX-License-Identifier: Apache-2.0
#include "testbench/stimulus/cull_frames.hpp"

#include <algorithm>

#include "testbench/stimulus/stimulus_tables.hpp"
#include "testbench/stimulus/window_centre.hpp"

namespace fastsplat::testbench {
namespace {

using namespace cmodel;

/// Number of splats in a cull group beside the tile; in one over an opaque half; in a sheet.
constexpr std::uint32_t kBeside = 3, kOver = 4, kMany = 20;

class CullGenerator {
 public:
  CullGenerator(const Config& config, Random& random) : config_(config), random_(random) {}

  StreamDocument of_sets() {
    StreamDocument out = frame();
    TileDocument sets = with_sets(), none = sets;
    for (SheetDocument& sheet : none.sheets)
      std::erase_if(sheet.records, [](const SheetRecord& one) { return std::holds_alternative<CullBlock>(one); });
    TileDocument ends = tile(config_.tile_width, config_.tile_height);
    add(ends, {anywhere()});
    add(ends, wall(config_.tile_height));
    add(ends, {});
    out.tiles = {std::move(sets), std::move(none), std::move(ends)};
    return out;
  }

  StreamDocument frozen() {
    StreamDocument out = frame();
    TileDocument ends = tile(config_.tile_width, 1), tested = tile(config_.tile_width, config_.tile_height);
    add(ends, wall(1));
    add(tested, {splat(0, 0, config_.lanes)});
    add(tested, {});
    add(tested, wall(1));
    add(tested, {anywhere()});
    out.tiles = {std::move(ends), std::move(tested)};
    return out;
  }

 private:
  /// Up to two radius sets, of one window a side and of two; weights and factors as large as possible. No pixel of a
  /// window reads the first two entries of RADIAL, so they may be anything.
  std::vector<LoadTable> tables() {
    std::vector<LoadTable> out;
    for (std::uint32_t set = 0; set < sets(); ++set) {
      const int windows = static_cast<int>(set) + 1;
      out.push_back(random_rlut(config_, random_, TableStyle::Powers, set, windows, windows));
      rho_[set] = out.back().radius.rho;
      for (std::uint32_t& word : out.back().words) word = std::max(word, std::uint32_t{1} << config_.rlut_guard_bits);
    }
    out.push_back(random_radial(config_, random_, TableStyle::Any));
    std::ranges::fill(out.back().words, static_cast<std::uint32_t>(config_.weight_format().max));
    out.push_back(random_factor(config_, random_, TableStyle::Unit));
    // The larger set is loaded last, or the smaller one.
    if (random_.chance(50)) std::swap(out.front(), out[sets() - 1]);
    return out;
  }
  std::uint32_t sets() const { return static_cast<std::uint32_t>(std::min(config_.rlut_sets, 2)); }

  StreamDocument frame() {
    return {.width = config_.tile_width, .height = config_.tile_height, .tables = tables(), .tiles = {}};
  }
  static TileDocument tile(int width, int height) {
    return {{.mode = Mode::Exponential, .tile = 0, .x = 0, .y = 0, .width = width, .height = height}, {}};
  }
  static void add(TileDocument& tile, std::vector<SheetRecord> records) {
    tile.sheets.push_back({static_cast<std::uint32_t>(tile.sheets.size()), std::move(records)});
  }

  /// As bright as possible; its windows begin at the pixel.
  SplatRecord splat(std::uint32_t set, std::int64_t x, std::int64_t y) const {
    const auto most = static_cast<std::uint32_t>(config_.colour_format().max);
    return {.set = set,
            .tag = 0,
            .x = window_centre(config_, rho_[set], x, 0),
            .y = window_centre(config_, rho_[set], y, 0),
            .colour = {most, most, most, most}};
  }
  SplatRecord anywhere() {
    const std::int64_t y = random_.between(-2, config_.tile_height), x = random_.between(-2, config_.tile_width);
    return splat(static_cast<std::uint32_t>(random_.between(0, sets() - 1)), x, y);
  }
  std::vector<SheetRecord> many() {
    std::vector<SheetRecord> out;
    for (std::uint32_t i = 0; i < kMany; ++i) out.emplace_back(anywhere());
    return out;
  }
  /// Bright splats over so many rows of pixels.
  std::vector<SheetRecord> wall(int rows) const {
    std::vector<SheetRecord> out;
    for (int times = 0; times < 2; ++times)
      for (int y = 0; y < rows; y += config_.lanes)
        for (int x = 0; x < config_.tile_width; x += config_.lanes) out.emplace_back(splat(0, x, y));
    return out;
  }

  /// Inserts a cull group beside the tile, and its splats.
  void hide(std::vector<SheetRecord>& records, std::size_t at) const {
    const std::int64_t far = config_.position_format().min >> config_.position_frac_bits;
    std::vector<SheetRecord> hidden{
        CullBlock{.tag = 0, .x = -30000, .y = -30000, .width = 30000, .height = 60000, .splats = kBeside}};
    hidden.insert(hidden.end(), kBeside, splat(0, far, far));
    records.insert(records.begin() + static_cast<std::ptrdiff_t>(at), hidden.begin(), hidden.end());
  }

  TileDocument with_sets() {
    TileDocument out = tile(config_.tile_width, config_.tile_height);
    const int half = std::max(config_.lanes, config_.tile_height / 2);
    std::vector<SheetRecord> first = many(), over = many();
    hide(first, first.size());
    hide(first, 0);
    first.insert(first.begin(), CullBlock{.tag = 0, .x = 0, .y = 0, .width = 1, .height = 0xffff, .splats = 0});
    over.insert(over.begin(), kOver, splat(0, 0, 0));
    over.insert(over.begin(),
                CullBlock{.tag = 0, .x = 0, .y = 0, .width = config_.tile_width, .height = half, .splats = kOver});
    add(out, std::move(first));
    add(out, wall(half));
    add(out, {});
    add(out, std::move(over));
    add(out, many());
    return out;
  }

  const Config& config_;
  Random& random_;
  std::array<std::uint32_t, 2> rho_{};
};

}  // namespace

StreamDocument sets_frame(const Config& config, Random& random) { return CullGenerator(config, random).of_sets(); }

StreamDocument frozen_frame(const Config& config, Random& random) { return CullGenerator(config, random).frozen(); }

}  // namespace fastsplat::testbench
