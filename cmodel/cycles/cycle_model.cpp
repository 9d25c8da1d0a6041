// SPDX-License-Identifier: Apache-2.0
#include "cmodel/cycles/cycle_model.hpp"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <stdexcept>
#include <utility>

#include "cmodel/cycles/cycle_stages.hpp"
#include "cmodel/io/fetch_commands.hpp"
#include "cmodel/numbers/window_geometry.hpp"
#include "cmodel/splat/ellipse_unit.hpp"
#include "cmodel/splat/snap.hpp"

namespace fastsplat::cmodel {
std::uint64_t wipe_cycles(const Config& config) {
  return static_cast<std::uint64_t>(config.tile_width / config.lanes) *
         static_cast<std::uint64_t>(config.tile_height / config.lanes);
}

std::optional<ErrorParts> cycle_violation(const Config& config) {
  if (config.has_patterns()) {
    return ErrorParts{.where = "pattern.node_bits",
                      .what = "the cycle model does not support solid patterns",
                      .expected = "0",
                      .got = std::to_string(config.pattern_node_bits),
                      .fix = "use pattern.node_bits = 0"};
  }
  if (config.has_phases()) return std::nullopt;  // one window a cycle, as for rlut
  return ErrorParts{.where = "index.kind",
                    .what = "works along scan lines, but the cycle model assumes P x P pixels at once",
                    .expected = "rlut, blit2d or separable",
                    .got = text_of(config, *find_key("index.kind")),
                    .fix = "use one of these kinds (see docs/numerics.md, section 4)"};
}

CycleModel::CycleModel(const Config& config, StreamScope scope, const CycleOptions& options)
    : config_(config),
      options_(options),
      decode_(config, scope),
      snap_(config),
      sets_(static_cast<std::size_t>(config.rlut_sets)),
      dirty_(config.lanes),
      delay_(stages::splat_delay(config)),
      weight_delay_(stages::weight_delay(config)),
      cull_(config),
      next_offer_(options.first_beat),
      check_free_(wipe_cycles(config)),
      end_(check_free_) {}

void CycleModel::empty(std::uint64_t from, std::uint64_t to) {
  if (from >= to) return;
  if (tile_open_) {
    accountant_.pause(Pause::Input, from, to);
    stalls_.stall_input += to - from;
    stalls_.busy += to - from;
    return;
  }
  // Outside of tiles the device is busy only while a picture goes out; picture() has accounted for that.
  const std::uint64_t first = std::max(from, picture_from_), last = std::min(to, picture_to_);
  if (first >= last) return;
  stalls_.stall_input += last - first;
  stalls_.busy += last - first;
}

std::uint64_t CycleModel::checked_at(std::uint64_t taken) const {
  return std::max(std::max(arrives(taken), check_free_) + stages::kWeigh, result_free_) + stages::kResult;
}

std::uint64_t CycleModel::enter(Opcode opcode, bool payload) {
  const std::uint64_t offered = options_.input == nullptr ? next_offer_ : options_.input->next(next_offer_);
  const std::uint64_t free = options_.sliced ? beats_in_.free() : check_free_;
  const std::uint64_t taken = std::max(offered, free);
  const std::uint64_t verdict = checked_at(taken);
  if (options_.sliced) beats_in_.pass(taken, std::max(arrives(taken), check_free_));
  beat_.wanted = std::max(next_offer_, free);
  beat_.offered = offered;
  beat_.taken = taken;
  next_offer_ = taken + 1;
  check_free_ = verdict - stages::kResult;
  sent_.count(opcode, payload);
  std::uint64_t checked = 0, map = 0;
  if (config_.culls()) {
    const CullPipe::Passage passage = cull_.pass(verdict, ready_, opcode == Opcode::BeginSheet && !payload);
    result_free_ = passage.entered;
    checked = passage.left;
    map = passage.waited;
    last_verdict_ = opcode == Opcode::CullBlock && !payload ? passage.verdict : last_verdict_;
  } else {
    result_free_ = checked = std::max(verdict, ready_);
  }
  beat_.entered = checked + 1;
  const std::uint64_t waited = checked + 1 > register_free_ ? std::min(map, checked + 1 - register_free_) : 0;
  empty(register_free_, checked + 1 - waited);
  if (waited > 0) {
    accountant_.pause(Pause::Map, checked + 1 - waited, checked + 1);
    stalls_.stall_input += waited;
    stalls_.busy += waited;
  }
  return checked + 1;
}

void CycleModel::leave(std::uint64_t since, std::uint64_t at) {
  ready_ = at;  // the next beat follows
  register_free_ = at + 1;
  stalls_.busy += at + 1 - since;
  end_ = std::max(end_, at + 1);
  if (options_.spans == nullptr) return;
  beat_.left = at;
  options_.spans->on_beat(beat_);
}

void CycleModel::take(const Beat& beat) {
  const bool payload = payload_words_ > 0;
  const auto opcode = static_cast<Opcode>(get(beat, layout::kOpcode));
  const Record* record = decode_.feed(beat);
  const bool gone = !payload && record != nullptr && dropped(*record);
  if (gone && options_.fetch && !trusts_) return;
  beat_.payload = payload;
  beat_.opcode = payload ? Opcode::LoadTable : opcode;
  const std::uint64_t at = enter(opcode, payload);
  if (gone) {
    hide(at);
    return;
  }
  if (payload) {
    const std::uint64_t words = std::min<std::uint64_t>(payload_words_, kBeatWords);
    payload_words_ -= words;
    leave(at, at + words - 1);
    stalls_.stall_table += words;
    accountant_.table_words(words);
    if (record != nullptr) load(std::get<LoadTable>(*record));
    return;
  }
  switch (opcode) {
    case Opcode::Splat:
      splat(std::get<SplatRecord>(*record), at);
      return;
    case Opcode::Ellipse:
      ellipse(std::get<EllipseRecord>(*record), at);
      return;
    case Opcode::BeginTile:
      begin_tile(std::get<BeginTile>(*record), at);
      return;
    case Opcode::BeginSheet:
      begin_sheet(std::get<BeginSheet>(*record), at);
      return;
    case Opcode::EndSheet:
      end_sheet(at);
      return;
    case Opcode::EndTile:
      end_tile(at);
      return;
    case Opcode::LoadTable:
      payload_words_ = announced_words(beat);
      break;
    case Opcode::CullBlock:
      cull_block(std::get<CullBlock>(*record));
      break;
    case Opcode::BeginFrame:
    case Opcode::EndFrame:
      break;
  }
  // end_frame costs nothing while the last picture goes out.
  if (tile_open_ || at >= picture_to_) accountant_.pause(Pause::Records, at, at + 1);
  leave(at, at);
}

bool CycleModel::answer() { return answers_ != nullptr && (*answers_)[answered_++]; }

void CycleModel::cull_block(const CullBlock& record) {
  ++counters_.cull_blocks;
  const bool tested = tile_open_ && culls_in(tile_.mode);
  const bool hidden = tested && answer();
  if (config_.culls() && options_.spans != nullptr)
    options_.spans->on_verdict({.tag = record.tag, .hidden = hidden, .reported = last_verdict_});
  if (!tested) return;
  if (answers_ != nullptr) ++stalls_.cull_tests;
  if (hidden) ++stalls_.hidden_sets;
  hides_ = hides_ || (hidden && record.splats > 0);
  cull_sets_.announce(record.tag, record.splats, {hidden, last_verdict_});
}

bool CycleModel::dropped(const Record& record) {
  const Verdict* set = nullptr;
  if (const auto* circle = std::get_if<SplatRecord>(&record)) set = cull_sets_.next(circle->tag);
  if (const auto* ellipse = std::get_if<EllipseRecord>(&record)) set = cull_sets_.next(ellipse->tag);
  if (set == nullptr) {
    if (behind_set_ && cull_sets_.waiting() > 0) refuse_parted_sets(decode_.beats() - 1, cull_sets_.waiting());
    if (behind_set_) fetch_behind(last_verdict_);  // verdict of the last group
    behind_set_ = false;
    return false;
  }
  if (!behind_set_) trusts_ = !std::exchange(hid_, std::exchange(hides_, false));
  behind_set_ = options_.fetch.has_value();
  if (behind_set_ && !set->hidden && !trusts_) fetch_behind(set->cycle);
  return set->hidden;
}

void CycleModel::fetch_behind(std::uint64_t verdict) {
  next_offer_ = std::max(next_offer_, verdict + std::max<std::uint64_t>(options_.fetch->latency, 1) + stages::kFetch);
}

void CycleModel::hide(std::uint64_t at) {
  accountant_.pause(Pause::Hidden, at, at + 1);
  leave(at, at);
}

void CycleModel::load(const LoadTable& table) {
  if (table.table != Table::Rlut) return;
  sets_[table.radius.set] = {.rho = table.radius.rho,
                             .extent = static_cast<std::int32_t>(window_geometry(config_, table.radius.rho).padded)};
}

void CycleModel::splat(const SplatRecord& record, std::uint64_t at) {
  const Set& set = sets_[record.set];
  footprint(at, record.tag, snap_(record.x, set.rho).origin, snap_(record.y, set.rho).origin, set.extent, set.extent,
            true);
}

void CycleModel::ellipse(const EllipseRecord& record, std::uint64_t at) {
  const EllipseWindows& windows = record.windows;
  footprint(at, record.tag, ellipse_axis(config_, record.x, windows.left).origin,
            ellipse_axis(config_, record.y, windows.top).origin,
            static_cast<std::int32_t>(windows.columns) * config_.lanes,
            static_cast<std::int32_t>(windows.rows) * config_.lanes, false);
}

std::uint64_t CycleModel::issue(std::uint64_t at, std::int32_t x, std::int32_t y) {
  if (!every_sample(tile_.mode) || at >= window_issued_ + stages::kHazard) return at;
  const bool over = std::abs(x - window_x_) < config_.lanes && std::abs(y - window_y_) < config_.lanes;
  if (!over) return at;
  const std::uint64_t done = window_issued_ + stages::kHazard;
  stalls_.stall_hazard += done - at;
  accountant_.pause(Pause::Hazard, at, done);
  return done;
}

void CycleModel::footprint(std::uint64_t at, std::uint32_t tag, std::int32_t x, std::int32_t y, std::int32_t width,
                           std::int32_t height, bool tests_windows) {
  ++counters_.splats;
  const std::uint64_t windows =
      static_cast<std::uint64_t>(width / config_.lanes) * static_cast<std::uint64_t>(height / config_.lanes);
  if (answers_ != nullptr) {
    ++stalls_.cull_tests;
    if (answer()) {
      ++stalls_.hidden_splats;
      hide(at);
      return;
    }
    if (tests_windows && windows > 1) {
      if (answers_->any(answered_, windows)) return some_windows(at, tag, x, y, width, height);
      answered_ += windows;
    }
  }
  if (!every_sample(tile_.mode)) dirty_.mark(x + halo_, y + halo_, width, height);
  counters_.windows += windows;
  sheet_.windows += windows;
  const std::uint64_t since = at;
  at = issue(at, x, y);
  window_issued_ = at + windows - 1;
  window_x_ = x + width - config_.lanes;
  window_y_ = y + height - config_.lanes;
  leave(since, window_issued_);
  if (options_.taps == nullptr) return;
  at += delay_;
  tap(Tap::Snap, at + stages::kSnap, tag, x, y);
  for (std::int32_t row = 0; row < height; row += config_.lanes) {
    for (std::int32_t column = 0; column < width; column += config_.lanes) window(at++, tag, x + column, y + row);
  }
}

void CycleModel::window(std::uint64_t at, std::uint32_t tag, std::int32_t x, std::int32_t y) const {
  at += weight_delay_;
  tap(Tap::Footprint, at + stages::kFootprint, tag, x, y);
  if (every_sample(tile_.mode)) {
    tap(Tap::Composite, at + stages::kSample, tag, x, y);
  } else {
    tap(Tap::Sheet, at + stages::kSheet, tag, x, y);
  }
}

void CycleModel::some_windows(std::uint64_t at, std::uint32_t tag, std::int32_t x, std::int32_t y, std::int32_t width,
                              std::int32_t height) {
  const std::uint64_t since = at;
  std::uint64_t windows = 0;
  const int columns = width / config_.lanes;
  for (std::int32_t row = 0; row < height; row += config_.lanes) {
    const std::uint64_t before = windows;
    for (int first = 0; first < columns; first += 64) {
      const auto some = static_cast<std::size_t>(std::min(columns - first, 64));
      const std::uint64_t hidden = answers_->bits(answered_, some);
      answered_ += some;
      stalls_.hidden_windows += static_cast<std::uint64_t>(std::popcount(hidden));
      for (std::uint64_t seen = ~hidden & ~std::uint64_t{0} >> (64 - some); seen != 0; seen &= seen - 1) {
        const std::int32_t column = (first + std::countr_zero(seen)) * config_.lanes;
        dirty_.mark(x + column, y + row, config_.lanes, config_.lanes);
        if (options_.taps != nullptr) {
          if (windows == 0) tap(Tap::Snap, at + delay_ + stages::kSnap, tag, x, y);
          window(at + delay_, tag, x + column, y + row);
        }
        ++windows;
        ++at;
      }
    }
    if (windows > before) continue;
    accountant_.pause(Pause::Hidden, at, at + 1);  // the walk takes one row of windows a cycle
    ++at;
  }
  counters_.windows += windows;
  sheet_.windows += windows;
  leave(since, at - 1);
}

void CycleModel::begin_tile(const BeginTile& record, std::uint64_t at) {
  const std::uint64_t done = std::max(at, picture_to_);
  stalls_.stall_tile += done - at;
  accountant_.pause(Pause::Records, done, done + 1);
  leave(at, done);
  tile_ = record;
  tile_open_ = true;
  halo_ = holds_densities(record.mode) ? 1 : 0;
  dirty_.begin_tile(record.width + 2 * halo_, record.height + 2 * halo_);
  span_ = {.tile = record.tile, .begun = done};
  sheet_ = {};
  window_issued_ = 0;
  answers_ = nullptr;
  answered_ = 0;
  cull_sheet_ = 0;
  if (!config_.culls()) return;
  cull_sets_.clear();  // groups whose splats the source left out
  cull_.begin_tile(record.width, record.height);
  if (options_.culls == nullptr || !culls_in(record.mode)) return;
  // A tile without cull_blocks and splats has no answers. If answers are missing, CullAnswers throws.
  static const CullAnswers kNone;
  answers_ = options_.culls->find(record.tile);
  if (answers_ == nullptr) answers_ = &kNone;
}

void CycleModel::begin_sheet(const BeginSheet& record, std::uint64_t at) {
  const std::uint64_t done = std::max(at, buffer_free_[buffer_]);
  stalls_.stall_buffer += done - at;
  accountant_.pause(Pause::Buffer, at, done);
  accountant_.settle(buffer_);
  accountant_.pause(Pause::Records, done, done + 1);
  leave(at, done);
  sheet_ = {.tile = tile_.tile, .sheet = record.sheet, .offered = at, .begun = done};
}

void CycleModel::end_sheet(std::uint64_t at) {
  accountant_.pause(Pause::Records, at, at + 1);
  leave(at, at);
  ++counters_.sheets;
  const std::uint64_t blocks = dirty_.count();
  if (halo_ == 0) counters_.dirty_blocks += blocks;
  // Densities are only copied here, a block a cycle.
  const std::uint64_t slices = halo_ > 0 ? 1 : static_cast<std::uint64_t>(config_.slices()), picks = blocks * slices;
  const std::uint64_t first = std::max(at + delay_ + weight_delay_ + stages::kWalk, walk_free_);
  const std::uint64_t last = first + std::max<std::uint64_t>(picks, 1) - 1;  // an empty walk takes a cycle
  walk_free_ = last + stages::kNextWalk;
  std::uint64_t done = last, worked = first + picks;  // the walk's last cycle, and the one after its last pick
  if (halo_ > 0) {
    if (waits_) worked = (done = classify(last)) + 1;
    waits_ = {.number = sheet_.sheet, .blocks = {}};
    dirty_.each([&](int column, int row) { waits_->blocks.emplace_back(column, row); });
  } else {
    compositor_idle_ = last + (blocks > 0 ? stages::kIdle : stages::kIdleAfterEmpty);
  }
  buffer_free_[buffer_] = done + stages::kFree;
  accountant_.sheet(buffer_, sheet_.windows, first, worked);
  if (config_.culls() && culls_in(tile_.mode)) {
    const int row = answers_ == nullptr ? cull_.rows() : answers_->first_row(cull_sheet_++);
    cull_.composited(last, row);
  }
  buffer_ = 1 - buffer_;
  sheet_.closed = at;
  sheet_.blocks = blocks;
  sheet_.walk_from = first;
  sheet_.walk_to = done + 1;
  sheet_.picks = worked - first;
  if (options_.spans != nullptr) options_.spans->on_sheet(sheet_);
  if (options_.taps != nullptr && halo_ == 0) {
    std::uint64_t pick = first + slices - 1;  // of a block's last slice
    dirty_.each([&](int column, int row) {
      tap(Tap::Composite, pick + stages::kComposite, 0, column * config_.lanes, row * config_.lanes);
      pick += slices;
    });
  }
  dirty_.clear();
}

std::uint64_t CycleModel::classify(std::uint64_t at) {
  const std::uint64_t blocks = waits_->blocks.size(), steps = stages::density_steps(config_);
  const std::uint64_t first = at + stages::kClassify, last = first + std::max<std::uint64_t>(blocks * steps, 1) - 1;
  walk_free_ = std::max(walk_free_, last + stages::kAfterClassify);
  // A sheet without blocks may end before the pipe has finished the one before it.
  compositor_idle_ = std::max(
      compositor_idle_, last + stages::density_late(config_) + (blocks > 0 ? stages::kIdle : stages::kIdleAfterEmpty));
  counters_.dirty_blocks += blocks;
  if (options_.taps == nullptr) return last;
  const std::uint32_t open = std::exchange(sheet_.sheet, waits_->number);
  std::uint64_t pick = first + stages::density_pick(config_);
  for (const auto& [column, row] : waits_->blocks) {
    tap(Tap::Composite, pick + stages::kComposite, 0, column * config_.lanes - halo_, row * config_.lanes - halo_);
    pick += steps;
  }
  sheet_.sheet = open;
  return last;
}

void CycleModel::end_tile(std::uint64_t at) {
  std::uint64_t done = std::max(at, compositor_idle_);
  span_.picks = 0;
  std::uint64_t drained = at;
  if (waits_) {
    // Its turn comes when it was copied and the sheet before it was classified.
    const std::uint64_t turn = std::max(at, buffer_free_[1 - buffer_]);
    const std::uint64_t from = turn + stages::kClassify, to = classify(turn) + 1;
    accountant_.pause(Pause::Drain, at, from);
    accountant_.settle(buffer_);
    accountant_.sheet(buffer_, 0, from, to);
    drained = from;
    span_.picks = to - from;
    waits_.reset();
    done = compositor_idle_;
  }
  stalls_.stall_tile += done - at;
  accountant_.pause(Pause::Drain, drained, done);
  accountant_.settle(0);
  accountant_.settle(1);
  accountant_.pause(Pause::Records, done, done + 1);
  leave(at, done);
  tile_open_ = false;
  if (answers_ != nullptr && answered_ != answers_->size())
    throw std::logic_error("the log of culled records belongs to another stream");
  ++counters_.tiles;
  sheet_.sheet = 0;  // pixels belong to no sheet
  picture(done);
  span_.closed = done;
  span_.picture_from = picture_from_;
  span_.picture_to = picture_to_;
  if (options_.spans != nullptr) options_.spans->on_tile(span_);
}

void CycleModel::picture(std::uint64_t at) {
  const int beats_per_row = (tile_.width + config_.lanes - 1) / config_.lanes;
  const auto beats = static_cast<std::uint64_t>(beats_per_row) * static_cast<std::uint64_t>(tile_.height);
  pixel_beats_ += beats;
  std::uint64_t shown = at + stages::kPixel, left = 0, out = 0;  // offered by pixel out; taken of it; gone
  if (options_.output == nullptr && options_.taps == nullptr) {
    shown += beats;
    out = shown + (options_.sliced ? 1 : 0);
  } else {
    for (int y = 0; y < tile_.height; ++y) {
      for (int x = 0; x < tile_.width; x += config_.lanes) {
        if (options_.sliced) {
          left = std::max(shown, pixels_out_.free());
          shown = pixels_out_.offers(left);
        }
        const std::uint64_t taken = options_.output == nullptr ? shown : options_.output->next(shown);
        if (options_.taps != nullptr) {
          for (int i = x; i < std::min(tile_.width, x + config_.lanes); ++i) tap(Tap::Pixel, taken, 0, i, y);
        }
        if (options_.sliced) pixels_out_.pass(left, taken);
        shown = (options_.sliced ? left : taken) + 1;
        out = taken + 1;
      }
    }
  }
  picture_from_ = at + 1;
  picture_to_ = shown;
  const std::uint64_t working = beats + stages::kPixel - 1;
  accountant_.pixels(working, picture_to_ - picture_from_ - working);
  end_ = std::max(end_, out);
}

void CycleModel::finish() {
  decode_.finish();
  empty(register_free_, end_);
  register_free_ = end_;
}

void CycleModel::tap(Tap kind, std::uint64_t cycle, std::uint32_t tag, std::int32_t x, std::int32_t y) const {
  options_.taps->on_tap({.tap = kind,
                         .tile = tile_.tile,
                         .sheet = sheet_.sheet,
                         .tag = tag,
                         .cycle = cycle,
                         .x = x,
                         .y = y,
                         .payload = {}});
}

}  // namespace fastsplat::cmodel
