// SPDX-License-Identifier: Apache-2.0
#include "tests/cmodel/plain_cull_clock_helper.hpp"

#include <algorithm>
#include <array>
#include <deque>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "cmodel/model.hpp"

namespace fastsplat::test {
namespace {

using cmodel::Opcode;

/// The model's drawing, from its taps: windows of each splat, dirty blocks of each sheet.
struct Drawn final : cmodel::TapSink, cmodel::PixelSink {
  using Key = std::pair<std::uint32_t, std::uint32_t>;
  std::map<Key, std::vector<std::pair<int, int>>> windows;  ///< (tile, tag): first pixels
  std::map<Key, std::uint64_t> blocks;                      ///< (tile, sheet): dirty
  std::map<Key, std::vector<std::pair<int, int>>> frozen;   ///< likewise: pixels of these blocks that are
  std::uint32_t eps = 0;
  int lanes = 0;
  void on_tile(cmodel::TilePixels&&) override {}
  void on_tap(const cmodel::TapRecord& tap) override {
    if (tap.tap == cmodel::Tap::Footprint) windows[{tap.tile, tap.tag}].emplace_back(tap.x, tap.y);
    if (tap.tap != cmodel::Tap::Composite) return;
    ++blocks[{tap.tile, tap.sheet}];
    for (int i = 0; i < lanes * lanes; ++i) {
      if (tap.payload[static_cast<std::size_t>(4 * i + 3)] < eps)
        frozen[{tap.tile, tap.sheet}].emplace_back(tap.x + i % lanes, tap.y + i / lanes);
    }
  }
};

/// A beat, with its figures that need no clock.
struct Item {
  Opcode opcode{};
  bool payload = false;
  std::uint64_t cycles = 1;  ///< in decode, without waits; hidden splats have 1 (M-cull-6)
  bool skipped = false;      ///< of a hidden set
  bool trusted = false;      ///< ... that a fetching source sends nevertheless
  int set = -1;              ///< cull_block: its number
  int waits = -1;            ///< the cull_block whose verdict a fetching source waits for
  std::uint64_t blocks = 0;  ///< end_sheet: dirty
  int row = 0;               ///< end_sheet: the first row of blocks with a new opaque cell (M-cull-9)
  int mode = 0, width = 0, height = 0;
};

std::vector<Item> items_of(const cmodel::Config& config, std::span<const cmodel::Beat> beats) {
  Drawn drawn;
  drawn.eps = static_cast<std::uint32_t>(config.freeze_below);
  drawn.lanes = config.lanes;
  cmodel::CullLog log;
  cmodel::Model model(config, cmodel::StreamScope::Whole, drawn, &drawn);
  model.log_culls(&log);
  model.consume(beats);
  std::vector<Item> out;
  std::uint64_t words = 0;
  std::uint32_t tile = 0, sheet = 0;
  int width = 0, height = 0, mode = 0, sets = 0;
  std::set<std::pair<int, int>> opaque;  // pixels of the tile
  std::map<std::uint32_t, std::uint32_t> rho;
  std::deque<std::pair<int, bool>> covered;  // the groups of the next splats, and whether they are hidden
  std::size_t answer = 0;
  bool behind = false;  // splats of groups, and no other record yet
  // Whether a group with splats is hidden, among those announced last and before; whether its splats are sent without a
  // verdict.
  bool hides = false, hid = false, trusts = false;
  for (const cmodel::Beat& beat : beats) {
    Item item;
    if (words > 0) {
      item.payload = true;
      item.opcode = Opcode::LoadTable;
      item.cycles = std::min<std::uint64_t>(words, cmodel::kBeatWords);  // M-decode-2
      words -= item.cycles;
      out.push_back(item);
      continue;
    }
    item.opcode = static_cast<Opcode>(beat[0] & 0xFF);
    const cmodel::Record record = cmodel::from_beat(beat);
    if (item.opcode == Opcode::LoadTable) words = cmodel::announced_words(beat);
    if (const auto* one = std::get_if<cmodel::BeginTile>(&record)) {
      tile = one->tile, width = one->width, height = one->height, mode = static_cast<int>(one->mode);
      item.width = one->width, item.height = height, item.mode = mode;
      answer = 0;
      covered.clear();
      opaque.clear();
    }
    if (const auto* one = std::get_if<cmodel::BeginSheet>(&record)) sheet = one->sheet;
    const auto next_answer = [&] { return mode < 2 && log.tile(tile)[answer++]; };
    if (const auto* one = std::get_if<cmodel::CullBlock>(&record)) {
      const bool hidden = next_answer();
      covered.insert(covered.end(), one->splats, {sets, hidden});
      hides = hides || (hidden && one->splats > 0);
      item.set = sets++;
    }
    const auto splat = [&](std::uint32_t tag) {
      if (mode < 2 && !covered.empty()) {
        if (!behind) {
          trusts = !hid;  // M-fetch-4
          hid = hides;
          hides = false;
        }
        item.waits = covered.front().first;
        item.trusted = trusts;
        item.skipped = covered.front().second;
        covered.pop_front();
      }
      if (item.skipped) return;  // sent, it costs a cycle (M-cull-14)
      const auto& windows = drawn.windows[{tile, tag}];
      const bool hidden = next_answer();
      if (hidden != windows.empty()) throw std::logic_error("the log says another thing than the taps");
      if (hidden) return;
      std::uint64_t rows = 0, all = windows.size();
      std::set<int> seen;
      for (const auto& [x, y] : windows) seen.insert(y);
      if (const auto* circle = std::get_if<cmodel::SplatRecord>(&record)) {
        // E = ceil(2 rho / k), in whole windows.
        const auto k = static_cast<std::uint32_t>(config.phases), lanes = static_cast<std::uint32_t>(config.lanes);
        const std::uint32_t extent = (2 * rho.at(circle->set) + k - 1) / k;
        rows = (extent + lanes - 1) / lanes;
        if (rows > 1 && mode < 2) answer += rows * rows;
      } else {
        rows = std::get<cmodel::EllipseRecord>(record).windows.rows;  // its windows have no answers (N-6.1-10)
      }
      item.cycles = all + rows - seen.size();  // M-cull-6: of windows that are issued (M-cull-7), and of empty rows
    };
    if (const auto* one = std::get_if<cmodel::SplatRecord>(&record)) splat(one->tag);
    if (const auto* one = std::get_if<cmodel::EllipseRecord>(&record)) splat(one->tag);
    // A record after the splats of groups waits for the last of these groups (M-fetch-5).
    const bool covers = item.waits >= 0;
    if (behind && !covers) item.waits = sets - 1 - (item.set >= 0 ? 1 : 0);
    behind = covers;
    if (item.opcode == Opcode::LoadTable && (beat[0] >> 8 & 0xFF) == 0) rho[beat[1]] = beat[2];
    if (item.opcode == Opcode::EndSheet) {
      item.blocks = drawn.blocks[{tile, sheet}];
      item.row = (height + config.lanes - 1) / config.lanes;
      // A cell is opaque if all of its pixels in the tile are.
      const int u = config.cull_cell();
      const auto all = [&](int x, int y) {
        for (int j = y / u * u; j < std::min(y / u * u + u, height); ++j)
          for (int i = x / u * u; i < std::min(x / u * u + u, width); ++i)
            if (!opaque.contains({i, j})) return false;
        return true;
      };
      std::vector<std::pair<int, int>> fresh;
      for (const auto& [x, y] : drawn.frozen[{tile, sheet}])
        if (x < width && y < height && opaque.insert({x, y}).second) fresh.emplace_back(x, y);
      for (const auto& [x, y] : fresh)
        if (all(x, y)) item.row = std::min(item.row, y / config.lanes);
    }
    out.push_back(item);
  }
  return out;
}

/// The device's registers before decode, decode, the walks over finished sheets and the cull tables, cycle by cycle.
class Clock {
 public:
  Clock(const cmodel::Config& config, std::span<const cmodel::Beat> beats, std::optional<std::uint64_t> latency)
      : config_(config),
        latency_(latency),
        delay_(config.has_ellipses() ? 10 : 0),
        slices_(static_cast<std::uint64_t>(config.slices())),
        items_(items_of(config, beats)) {
    out_.beats.resize(items_.size());
    held_.fill(-1);
  }

  PlainCullClock run() {
    std::size_t sent = 0;
    for (const Item& item : items_) sent += latency_ && item.skipped && !item.trusted ? 0 : 1;
    c_ = blocks(config_.tile_width) * blocks(config_.tile_height);  // the picture is wiped (M-reset-5)
    for (; done_ < sent; ++c_) {
      if (held_[kDecode] < 0 && (open_ || c_ < picture_to_)) ++out_.starved;
      write_tables();
      report_verdicts();
      advance(decode());
      source();
    }
    out_.starved += picture_to_ > c_ ? picture_to_ - c_ : 0;
    std::vector<BeatTimes> kept;
    for (const int at : order_) kept.push_back(out_.beats[static_cast<std::size_t>(at)]);
    out_.beats = std::move(kept);
    return std::move(out_);
  }

 private:
  // Registers: 0 and 1 check's, 2 .. 5 are t0 .. t3, 6 decode's (M-cull-3).
  static constexpr std::size_t kT0 = 2, kT3 = 5, kDecode = 6;
  struct Job {  ///< a table's
    std::uint64_t after, units;
    std::size_t table;
  };

  std::uint64_t blocks(int pixels) const {
    return static_cast<std::uint64_t>((pixels + config_.lanes - 1) / config_.lanes);
  }
  const Item& item(int number) const { return items_[static_cast<std::size_t>(number)]; }
  bool holds(std::size_t place, Opcode opcode) const {
    return held_[place] >= 0 && item(held_[place]).opcode == opcode && !item(held_[place]).payload;
  }

  /// A table's row, or P words of it, is written in this cycle (M-cull-10).
  void write_tables() {
    for (; !jobs_.empty() && jobs_.front().units == 0 && jobs_.front().after < c_; jobs_.pop_front())
      --to_build_[jobs_.front().table];
    not_whole_ = to_build_;
    if (!jobs_.empty() && jobs_.front().after < c_ && --jobs_.front().units == 0) {
      --to_build_[jobs_.front().table];
      jobs_.pop_front();
    }
  }
  /// The first cycle in t3 (M-cull-4).
  void report_verdicts() {
    if (holds(kT3, Opcode::CullBlock)) verdict_.try_emplace(item(held_[kT3]).set, c_);
  }

  /// True if decode has finished its beat.
  bool decode() {
    if (held_[kDecode] < 0) return false;
    const bool waits = (holds(kDecode, Opcode::BeginSheet) && c_ < buffer_from_[buffer_]) ||
                       (holds(kDecode, Opcode::BeginTile) && c_ < picture_to_) ||  // M-pixel-5
                       (holds(kDecode, Opcode::EndTile) && c_ < at_rest_);
    if (waits || --left_in_decode_ > 0) return false;
    out_.beats[static_cast<std::size_t>(held_[kDecode])].left = c_;
    ++done_;
    if (holds(kDecode, Opcode::BeginTile)) begin_tile(item(held_[kDecode]));
    if (holds(kDecode, Opcode::EndSheet)) end_sheet(item(held_[kDecode]));
    if (holds(kDecode, Opcode::EndTile)) end_tile();
    return true;
  }
  void begin_tile(const Item& tile) {
    open_ = true;
    tile_ = tile;
    rows_ = static_cast<int>(blocks(tile.height));
    first_row_ = {0, 0};
    ended_ = 0;
    opaque_yet_ = false;
    jobs_.clear();  // M-cull-11
    to_build_ = {};
  }
  void end_sheet(const Item& sheet) {
    const std::uint64_t m = sheet.blocks * slices_;
    const std::uint64_t a = std::max(c_ + 12 + delay_, walked_ ? f_ + 4 : 0);  // M-walk-4, and below
    f_ = a + std::max<std::uint64_t>(m, 1) - 1;
    walked_ = true;
    buffer_from_[buffer_] = f_ + 1;
    buffer_ = 1 - buffer_;
    at_rest_ = f_ + (m > 0 ? 7 : 3);
    opaque_yet_ = opaque_yet_ || sheet.row < rows_;
    const std::size_t table = ended_++ % 2;
    ++all_ended_;
    walk_end_[table] = f_ + 1;
    if (tile_.mode < 2) change_tables(sheet.row, table);  // M-cull-12
  }
  /// If nothing has to be written, the table is whole when the sheet has left k6 (M-cull-8) and the previous table is
  /// whole (M-cull-10).
  void change_tables(int row, std::size_t table) {
    if (opaque_yet_)  // M-cull-9
      for (int& first : first_row_) first = std::min(first, row);
    const auto changed = opaque_yet_ ? static_cast<std::uint64_t>(rows_ - first_row_[table]) : 0;
    const std::uint64_t each =
        config_.cull_cell() == 1 ? static_cast<std::uint64_t>(config_.lanes) * blocks(tile_.width) : 1;
    jobs_.push_back({f_ + 6, changed * each, table});
    ++to_build_[table];
    ++not_whole_[table];
    if (opaque_yet_) first_row_[table] = rows_;
  }
  void end_tile() {
    open_ = false;
    picture_to_ = c_ + 3 + blocks(tile_.width) * static_cast<std::uint64_t>(tile_.height);  // M-pixel-1, M-pixel-2
  }

  /// Beats move on from the last register to the first (M-check-3, M-decode-1).
  void advance(bool decoded) {
    if (decoded) held_[kDecode] = -1;
    bool free = held_[kDecode] < 0;
    for (std::size_t i = kDecode; i-- > 0;) {
      if (held_[i] >= 0 && free && (i != kT0 || leaves_t0())) {
        if (i == kT3) {
          out_.beats[static_cast<std::size_t>(held_[i])].entered = c_ + 1;
          left_in_decode_ = item(held_[i]).cycles;
        }
        held_[i + 1] = std::exchange(held_[i], -1);
      }
      free = held_[i] < 0;
    }
  }
  /// A sheet begins when the table that its splats are tested against is whole (M-cull-4, M-cull-10); in tiles of other
  /// modes at once (M-cull-12).
  bool leaves_t0() {
    if (holds(kT0, Opcode::BeginTile)) begun_in_t0_ = 0, mode_in_t0_ = item(held_[kT0]).mode;
    if (!holds(kT0, Opcode::BeginSheet)) return true;
    const std::size_t table = begun_in_t0_ % 2;
    const bool may = begun_in_t0_ < 2 || mode_in_t0_ > 1 ||
                     (all_ended_ + 1 >= all_begun_ && c_ >= walk_end_[table] && not_whole_[table] == 0);
    out_.waited += may ? 0 : 1;
    begun_in_t0_ += may ? 1 : 0;
    all_begun_ += may ? 1 : 0;
    return may;
  }

  void source() {
    const int all = static_cast<int>(items_.size());
    // M-fetch-3, M-fetch-4
    while (latency_ && next_ < all && item(next_).skipped && !item(next_).trusted) ++next_;
    if (held_[0] >= 0 || next_ >= all) return;
    const Item& one = item(next_);
    // M-fetch-8; a source that does not fetch sends all beats (M-cull-14).
    if (latency_ && one.waits >= 0 && !one.trusted &&
        (!verdict_.contains(one.waits) || c_ < verdict_.at(one.waits) + std::max<std::uint64_t>(*latency_, 1) + 6))
      return;
    out_.beats[static_cast<std::size_t>(next_)].taken = c_;
    order_.push_back(next_);
    held_[0] = next_++;
  }

  const cmodel::Config& config_;
  const std::optional<std::uint64_t> latency_;
  const std::uint64_t delay_, slices_;
  const std::vector<Item> items_;
  PlainCullClock out_;
  std::uint64_t c_ = 0;                   ///< the cycle
  std::array<int, 7> held_{};             ///< the beat in each register, or -1
  int next_ = 0;                          ///< next beat to send
  std::vector<int> order_;                ///< beats in the order sent
  std::size_t done_ = 0;                  ///< beats that left decode
  std::uint64_t left_in_decode_ = 0;      ///< cycles of decode's beat, this one included
  std::map<int, std::uint64_t> verdict_;  ///< of each cull_block
  // Buffers, walk, picture.
  std::array<std::uint64_t, 2> buffer_from_{};
  std::size_t buffer_ = 0;
  std::uint64_t f_ = 0, at_rest_ = 0, picture_to_ = 0;
  bool walked_ = false;
  // Tables.
  std::deque<Job> jobs_;
  std::array<std::size_t, 2> to_build_{}, not_whole_{};  ///< unfinished jobs, by table
  std::array<int, 2> first_row_{};
  std::uint64_t begun_in_t0_ = 0, ended_ = 0;    ///< sheets of the tile
  std::uint64_t all_begun_ = 0, all_ended_ = 0;  ///< since reset: in t0, in decode
  std::array<std::uint64_t, 2> walk_end_{};      ///< by table: of its sheet, the cycle after
  int mode_in_t0_ = 0;
  bool opaque_yet_ = false;
  Item tile_;  ///< its begin_tile
  int rows_ = 0;
  bool open_ = false;  ///< a tile
};

}  // namespace

PlainCullClock plain_cull_clock(const cmodel::Config& config, std::span<const cmodel::Beat> beats,
                                std::optional<std::uint64_t> latency) {
  return Clock(config, beats, latency).run();
}

}  // namespace fastsplat::test
