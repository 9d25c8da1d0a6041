#include "tests/cmodel/plain_cull_clock_helper.hpp"

#include <algorithm>
#include <array>
#include <deque>
#include <map>
#include <set>
#include <stdexcept>

#include "cmodel/model.hpp"

namespace fastsplat::test {
namespace {

using cmodel::Opcode;

/// What the model drew, by its taps: windows of each splat, dirty blocks of each sheet.
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

/// A beat and what is known of it without a clock.
struct Item {
  Opcode opcode{};
  bool payload = false;
  std::uint64_t cycles = 1;  ///< in decode, waits aside
  bool skipped = false;      ///< of a hidden set
  bool trusted = false;      ///< ... that a fetching source sends all the same
  int set = -1;              ///< cull_block: its number
  int waits = -1;            ///< the cull_block whose verdict a fetching source must have
  std::uint64_t blocks = 0;  ///< end_sheet: dirty
  int row = 0;               ///< end_sheet: the first row of blocks with a new opaque cell
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
  std::deque<std::pair<int, bool>> covered;  // the next splats' sets, and whether these are hidden
  std::size_t answer = 0;
  bool behind = false;  // splats of sets, and nothing else yet
  // A set with splats is hidden, of those announced last, and before; whether what they announce is sent unjudged.
  bool hides = false, hid = false, trusts = false;
  for (const cmodel::Beat& beat : beats) {
    Item item;
    if (words > 0) {
      item.payload = true;
      item.opcode = Opcode::LoadTable;
      item.cycles = std::min<std::uint64_t>(words, cmodel::kBeatWords);
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
          trusts = !hid;
          hid = hides;
          hides = false;
        }
        item.waits = covered.front().first;
        item.trusted = trusts;
        item.skipped = covered.front().second;
        covered.pop_front();
      }
      if (item.skipped) return;
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
        const auto& shaped = std::get<cmodel::EllipseRecord>(record).windows;
        rows = shaped.rows;
        if (shaped.rows * shaped.columns > 1 && mode < 2) answer += std::size_t{shaped.rows} * shaped.columns;
      }
      item.cycles = all + rows - seen.size();
    };
    if (const auto* one = std::get_if<cmodel::SplatRecord>(&record)) splat(one->tag);
    if (const auto* one = std::get_if<cmodel::EllipseRecord>(&record)) splat(one->tag);
    // What comes behind the splats of sets waits for the last of these.
    const bool covers = item.waits >= 0;
    if (behind && !covers) item.waits = sets - 1 - (item.set >= 0 ? 1 : 0);
    behind = covers;
    if (item.opcode == Opcode::LoadTable && (beat[0] >> 8 & 0xFF) == 0) rho[beat[1]] = beat[2];
    if (item.opcode == Opcode::EndSheet) {
      item.blocks = drawn.blocks[{tile, sheet}];
      item.row = (height + config.lanes - 1) / config.lanes;
      // A cell is opaque where all of its pixels in the tile are.
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

}  // namespace

PlainCullClock plain_cull_clock(const cmodel::Config& config, std::span<const cmodel::Beat> beats,
                                std::optional<std::uint64_t> latency) {
  const std::vector<Item> items = items_of(config, beats);
  const std::uint64_t delay = config.has_ellipses() ? 10 : 0;
  const auto slices = static_cast<std::uint64_t>(config.slices());
  PlainCullClock out;
  out.beats.resize(items.size());
  // Registers: 0 and 1 check's, 2 .. 5 are t0 .. t3, 6 decode's. What each holds, or -1.
  std::array<int, 7> held;
  held.fill(-1);
  int next = 0;                          // beat to be sent
  std::uint64_t left_in_decode = 0;      // cycles of what decode holds, this one included
  std::map<int, std::uint64_t> verdict;  // of each cull_block
  // Buffers, walk, picture.
  std::array<std::uint64_t, 2> buffer_from{};
  std::size_t buffer = 0;
  std::uint64_t f = 0, at_rest = 0, picture_to = 0;
  bool walked = false;
  // Tables.
  struct Job {
    std::uint64_t after, units;
    std::size_t table;
  };
  std::deque<Job> jobs;
  std::array<std::size_t, 2> to_build{};  // jobs that are not done, by table
  std::array<int, 2> first_row{};
  std::uint64_t begun_in_t0 = 0, ended = 0;    // sheets of the tile
  std::uint64_t all_begun = 0, all_ended = 0;  // since reset: in t0, in decode
  std::array<std::uint64_t, 2> walk_end{};     // by table: of its sheet, the cycle after
  int mode_in_t0 = 0;
  bool opaque_yet = false;
  int rows = 0, width = 0, mode = 0;
  std::size_t done = 0, sent = 0;
  bool open = false;  // a tile
  const auto wipe = static_cast<std::uint64_t>(config.tile_width / config.lanes) *
                    static_cast<std::uint64_t>(config.tile_height / config.lanes);
  for (const Item& item : items) sent += latency && item.skipped && !item.trusted ? 0 : 1;
  std::vector<int> order;  // beats as they were sent
  std::uint64_t c = wipe;
  for (; done < sent; ++c) {
    if (held[6] < 0 && (open || c < picture_to)) ++out.starved;
    // A table's row, or P words of it, is written in this cycle.
    for (; !jobs.empty() && jobs.front().units == 0 && jobs.front().after < c; jobs.pop_front())
      --to_build[jobs.front().table];
    std::array<std::size_t, 2> not_whole = to_build;
    if (!jobs.empty() && jobs.front().after < c && --jobs.front().units == 0) {
      --to_build[jobs.front().table];
      jobs.pop_front();
    }
    for (std::size_t i = 2; i < 6; ++i)
      if (held[i] >= 0 && i == 5 && items[static_cast<std::size_t>(held[i])].opcode == Opcode::CullBlock &&
          !items[static_cast<std::size_t>(held[i])].payload)
        verdict.try_emplace(items[static_cast<std::size_t>(held[i])].set, c);
    // Decode.
    bool carried = false;
    if (held[6] >= 0) {
      const Item& item = items[static_cast<std::size_t>(held[6])];
      const bool record = !item.payload;
      bool waits = record && item.opcode == Opcode::BeginSheet && c < buffer_from[buffer];
      waits = waits || (record && item.opcode == Opcode::BeginTile && c < picture_to);
      waits = waits || (record && item.opcode == Opcode::EndTile && c < at_rest);
      if (!waits && --left_in_decode == 0) {
        carried = true;
        out.beats[static_cast<std::size_t>(held[6])].left = c;
        ++done;
        if (record && item.opcode == Opcode::BeginTile) {
          open = true;
          rows = (item.height + config.lanes - 1) / config.lanes, width = item.width, mode = item.mode;
          first_row = {0, 0};
          ended = 0;
          opaque_yet = false;
          jobs.clear();
          to_build = {};
        }
        if (record && item.opcode == Opcode::EndSheet) {
          const std::uint64_t m = item.blocks * slices;
          const std::uint64_t a = std::max(c + 12 + delay, walked ? f + 4 : 0);
          f = a + std::max<std::uint64_t>(m, 1) - 1;
          walked = true;
          buffer_from[buffer] = f + 1;
          buffer = 1 - buffer;
          at_rest = f + (m > 0 ? 7 : 3);
          opaque_yet = opaque_yet || item.row < rows;
          const std::size_t table = ended++ % 2;
          ++all_ended;
          walk_end[table] = f + 1;
          if (mode < 2) {
            // Where nothing has to be written the table is whole when the sheet has left k6 and the one before is.
            if (opaque_yet)
              for (int& row : first_row) row = std::min(row, item.row);
            const auto changed = opaque_yet ? static_cast<std::uint64_t>(rows - first_row[table]) : 0;
            const std::uint64_t each = config.cull_cell() == 1
                                           ? static_cast<std::uint64_t>(config.lanes) *
                                                 static_cast<std::uint64_t>((width + config.lanes - 1) / config.lanes)
                                           : 1;
            jobs.push_back({f + 6, changed * each, table}), ++to_build[table], ++not_whole[table];
            if (opaque_yet) first_row[table] = rows;
          }
        }
        if (record && item.opcode == Opcode::EndTile) {
          open = false;
          int of = held[6];
          while (items[static_cast<std::size_t>(of)].opcode != Opcode::BeginTile ||
                 items[static_cast<std::size_t>(of)].payload)
            --of;
          const Item& tile = items[static_cast<std::size_t>(of)];
          picture_to = c + 3 +
                       static_cast<std::uint64_t>((tile.width + config.lanes - 1) / config.lanes) *
                           static_cast<std::uint64_t>(tile.height);
        }
      }
    }
    // Who moves on: from the last register to the first.
    bool free = held[6] < 0 || carried;
    if (carried) held[6] = -1;
    for (std::size_t i = 6; i-- > 0;) {
      const bool moves = held[i] >= 0 && free;
      bool may = moves;
      if (moves && i == 2) {
        const Item& item = items[static_cast<std::size_t>(held[i])];
        if (item.opcode == Opcode::BeginTile && !item.payload) begun_in_t0 = 0, mode_in_t0 = item.mode;
        if (item.opcode == Opcode::BeginSheet && !item.payload) {
          may = begun_in_t0 < 2 || mode_in_t0 > 1 ||
                (all_ended + 1 >= all_begun && c >= walk_end[begun_in_t0 % 2] && not_whole[begun_in_t0 % 2] == 0);
          out.waited += may ? 0 : 1;
          begun_in_t0 += may ? 1 : 0;
          all_begun += may ? 1 : 0;
        }
      }
      if (may) {
        if (i == 5) {
          out.beats[static_cast<std::size_t>(held[i])].entered = c + 1;
          left_in_decode = items[static_cast<std::size_t>(held[i])].cycles;
        }
        held[i + 1] = held[i];
        held[i] = -1;
      }
      free = held[i] < 0;
    }
    // The source.
    const auto left_out = [&](const Item& one) { return one.skipped && !one.trusted; };
    while (latency && next < static_cast<int>(items.size()) && left_out(items[static_cast<std::size_t>(next)])) ++next;
    if (held[0] >= 0 || next >= static_cast<int>(items.size())) continue;
    const Item& item = items[static_cast<std::size_t>(next)];
    if (latency && item.waits >= 0 && !item.trusted &&
        (!verdict.contains(item.waits) || c < verdict.at(item.waits) + std::max<std::uint64_t>(*latency, 1) + 6))
      continue;
    out.beats[static_cast<std::size_t>(next)].taken = c;
    order.push_back(next);
    held[0] = next++;
  }
  out.starved += picture_to > c ? picture_to - c : 0;
  std::vector<BeatTimes> kept;
  for (const int at : order) kept.push_back(out.beats[static_cast<std::size_t>(at)]);
  out.beats = std::move(kept);
  return out;
}

}  // namespace fastsplat::test
