// SPDX-License-Identifier: Apache-2.0
#include "tests/cmodel/plain_cluster_helper.hpp"

#include <algorithm>
#include <deque>
#include <optional>
#include <stdexcept>

#include "cmodel/cycles/cycle_model.hpp"

namespace fastsplat::test {
namespace {

using cmodel::Opcode;

struct Listener final : cmodel::CycleSink {
  std::vector<PlainBeat> beats;
  std::uint32_t tile = 0;
  void on_beat(const cmodel::BeatCycles& beat) override {
    PlainBeat plain{.opcode = beat.opcode, .payload = beat.payload};
    if (beat.payload || beat.opcode == Opcode::Splat || beat.opcode == Opcode::Ellipse)
      plain.cycles = beat.left - beat.entered + 1;
    beats.push_back(plain);
  }
  void on_sheet(const cmodel::SheetCycles& sheet) override { beats.back().blocks = sheet.blocks; }
  void on_tile(const cmodel::TileCycles&) override {}
};

/// docs/microarchitecture.md of one device, clocked; the sink is always ready.
class PlainDevice {
 public:
  PlainDevice(const cmodel::Config& config, std::size_t queue)
      : wipe_(static_cast<std::uint64_t>((config.tile_width / config.lanes) * (config.tile_height / config.lanes))),
        walk_(12 + (config.has_ellipses() ? 10 : 0) + (config.interpolates() ? 2 : 0)),  // M-ellipse-1, M-weights-1
        slices_(static_cast<std::uint64_t>(config.slices())),
        places_(queue) {}

  bool has_place() const { return taken_places_ < places_; }
  void reserve() { ++taken_places_; }
  void arrive(const PlainBeat& beat) { queue_.push_back(beat); }
  /// No beat is queued or on the link.
  bool all_taken() const { return taken_places_ == 0; }
  bool at_rest(std::uint64_t cycle) const {
    return all_taken() && !weighed_ && !result_ && !beat_ && !tile_open_ && cycle >= picture_end_;
  }

  void clock(std::uint64_t cycle) {
    const bool picture = cycle < picture_end_;
    // M-account-1
    if (beat_ || tile_open_ || picture) {
      ++out.stalls.busy;
      out.end = cycle + 1;
      if (!beat_) ++out.stalls.stall_input;  // M-register-16, and the other stalls below
    }
    out.end = std::max(out.end, wipe_);
    // Each register takes the beat before it when it is empty or is emptied in this cycle (M-check-1, M-check-3,
    // M-decode-1, M-decode-3). The source's beat follows (M-check-2), once the wipe has ended (M-reset-5).
    const bool done = beat_ && carry_out(cycle);
    if (done) beat_.reset();
    if (!beat_ && result_) {
      beat_ = result_;
      spent_ = 0;
      result_.reset();
    }
    if (!result_ && weighed_) {
      result_ = weighed_;
      weighed_.reset();
    }
    if (cycle < wipe_ || weighed_ || queue_.empty()) return;
    weighed_ = queue_.front();
    queue_.pop_front();
    --taken_places_;
    if (weighed_->opcode == Opcode::BeginTile) out.tiles.push_back(weighed_->tile);
    last_taken = cycle;
  }

  PlainDeviceCycles out;
  std::uint64_t last_taken = 0;
  std::deque<PlainBeat> unsent;

 private:
  bool carry_out(std::uint64_t cycle) {
    ++spent_;
    if (beat_->payload) ++out.stalls.stall_table;
    if (beat_->payload || beat_->opcode == Opcode::Splat || beat_->opcode == Opcode::Ellipse)
      return spent_ == beat_->cycles;
    switch (beat_->opcode) {  // M-decode-2
      case Opcode::BeginTile:
        if (cycle < rest_ || cycle < picture_end_) return ++out.stalls.stall_tile, false;
        tile_open_ = true;
        return true;
      case Opcode::BeginSheet:
        // M-decode-4, M-decode-5, M-pipe-2
        if (cycle < buffer_free_[buffer_]) return ++out.stalls.stall_buffer, false;
        return true;
      case Opcode::EndSheet: {
        const auto first = std::max(cycle + walk_, walked_ + 4);  // M-walk-2, M-walk-4, and below
        walked_ = first + std::max<std::uint64_t>(beat_->blocks * slices_, 1) - 1;
        buffer_free_[buffer_] = walked_ + 1;
        rest_ = walked_ + (beat_->blocks > 0 ? 7 : 3);
        buffer_ = 1 - buffer_;
        return true;
      }
      case Opcode::EndTile:
        if (cycle < rest_) return ++out.stalls.stall_tile, false;
        tile_open_ = false;
        picture_end_ = cycle + 3 + beat_->pixels;  // M-pixel-2, M-pixel-5
        return true;
      default:
        return true;
    }
  }

  std::uint64_t wipe_, walk_, slices_;
  std::size_t places_, taken_places_ = 0;
  std::deque<PlainBeat> queue_;
  std::optional<PlainBeat> weighed_, result_, beat_;  ///< in the two registers of check, in decode
  std::uint64_t spent_ = 0;
  bool tile_open_ = false;
  std::size_t buffer_ = 0;
  std::uint64_t buffer_free_[2] = {0, 0}, walked_ = 0, rest_ = 0, picture_end_ = 0;
};

}  // namespace

std::vector<PlainBeat> plain_beats(const cmodel::Config& config, std::span<const cmodel::Beat> beats) {
  Listener listener;
  cmodel::CycleModel model(config, cmodel::StreamScope::Whole, {.spans = &listener});
  model.consume(beats);
  model.finish();
  auto& out = listener.beats;
  if (out.size() != beats.size()) throw std::runtime_error("not a cost for each beat");
  std::uint32_t tile = 0;
  std::uint64_t pixels = 0;
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (!out[i].payload && out[i].opcode == Opcode::BeginTile) {
      tile = static_cast<std::uint32_t>(get(beats[i], cmodel::layout::kTileNumber));
      const auto width = get(beats[i], cmodel::layout::kTileWidth), height = get(beats[i], cmodel::layout::kTileHeight);
      pixels = static_cast<std::uint64_t>((width + config.lanes - 1) / config.lanes * height);
    }
    out[i].tile = tile;
    out[i].pixels = pixels;
  }
  return out;
}

std::vector<PlainDeviceCycles> plain_cluster(const cmodel::Config& config, std::span<const PlainBeat> beats,
                                             std::size_t count, std::uint64_t rate, std::size_t queue) {
  std::vector<PlainDevice> devices(count, PlainDevice(config, queue));
  std::deque<PlainBeat> preamble;
  std::deque<std::deque<PlainBeat>> tiles;
  for (const PlainBeat& beat : beats) {
    if (!beat.payload && (beat.opcode == Opcode::BeginTile || beat.opcode == Opcode::EndFrame)) tiles.emplace_back();
    (tiles.empty() ? preamble : tiles.back()).push_back(beat);
  }

  std::size_t served = count - 1;
  std::uint64_t left = 0;          // bytes of the beat on the link
  std::vector<std::size_t> whose;  // its receiver
  PlainBeat carried;
  for (std::uint64_t cycle = 0;; ++cycle) {
    if (cycle > 100'000'000) throw std::runtime_error("the clocked model does not end");
    // Tiles, in stream order, go to idle devices: the device whose last beat came first is first.
    while (preamble.empty() && !tiles.empty()) {
      PlainDevice* first = nullptr;
      for (PlainDevice& device : devices)
        if (device.unsent.empty() && device.all_taken() && (first == nullptr || device.last_taken < first->last_taken))
          first = &device;
      if (first == nullptr) break;
      first->unsent = std::move(tiles.front());
      tiles.pop_front();
    }
    // The link: bytes of this cycle.
    std::uint64_t budget = rate;
    while (rate == 0 || budget > 0) {
      if (left == 0) {
        whose.clear();
        if (!preamble.empty()) {
          if (!std::all_of(devices.begin(), devices.end(), [](const auto& d) { return d.has_place(); })) break;
          carried = preamble.front();
          preamble.pop_front();
          for (std::size_t i = 0; i < count; ++i) whose.push_back(i);
        } else {
          for (std::size_t i = 1; i <= count && whose.empty(); ++i) {
            const std::size_t at = (served + i) % count;
            if (!devices[at].unsent.empty() && devices[at].has_place()) whose.push_back(at);
          }
          if (whose.empty()) break;
          served = whose[0];
          carried = devices[served].unsent.front();
          devices[served].unsent.pop_front();
        }
        for (const std::size_t at : whose) devices[at].reserve();
        left = cmodel::kBeatBytes;
      }
      const std::uint64_t now = rate == 0 ? left : std::min(left, budget);
      left -= now;
      budget -= rate == 0 ? 0 : now;
      if (left > 0) break;
      for (const std::size_t at : whose) devices[at].arrive(carried);
    }
    for (PlainDevice& device : devices) device.clock(cycle);
    bool rest = tiles.empty() && preamble.empty() && left == 0;
    for (const PlainDevice& device : devices) rest = rest && device.unsent.empty() && device.at_rest(cycle + 1);
    if (rest) break;
  }
  std::vector<PlainDeviceCycles> out;
  for (const PlainDevice& device : devices) out.push_back(device.out);
  return out;
}

}  // namespace fastsplat::test
