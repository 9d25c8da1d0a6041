// SPDX-License-Identifier: Apache-2.0
// Compares every tap of a device with the model's, matched by tap and order, with equal tags; keeps the first
// divergence. Knows no simulator type.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cmodel/numbers/config.hpp"
#include "cmodel/stream/device.hpp"
#include "cmodel/stream/taps.hpp"

namespace fastsplat::testbench {

/// A tap record that owns its payload.
struct TapCopy {
  cmodel::Tap tap = cmodel::Tap::Snap;
  std::uint32_t tile = 0, sheet = 0, tag = 0;
  std::uint64_t cycle = 0;
  std::int32_t x = 0, y = 0;
  std::vector<std::uint32_t> payload;
};
TapCopy copy(const cmodel::TapRecord& record);

struct Divergence {
  std::optional<TapCopy> model, rtl;  ///< one is absent where a record has no partner
  std::size_t word = 0;               ///< first differing payload word; payload size where the headers differ
  bool header = false;                ///< tile, sheet, tag or place differ
};

/// As text: stage, tile, sheet, splat, pixel, both values, their bit difference.
std::string describe(const cmodel::Config& config, const Divergence& divergence);

/// The same as a row of a table; the place is the model's or, if the model has no record, the RTL's.
struct DivergenceRow {
  const char* tap = "";
  std::optional<std::uint32_t> tile, sheet, splat;  ///< absent outside tiles, or if the tap has none
  std::int32_t x = 0, y = 0;                        ///< of the window, block or pixel
  std::optional<std::uint64_t> cycle;               ///< of the RTL; absent if the RTL has no record
  std::string what;           ///< which word: "pixel (5,1): sheet R"; or that the record itself differs
  std::string expected, got;  ///< hexadecimal; a place if the records differ; "nothing"
};
DivergenceRow row_of(const cmodel::Config& config, const Divergence& divergence);

/// Records in order, headers and payloads in one flat array that is used again from its beginning: no allocation per
/// record once it is as long as the device is deep.
class TapQueue {
 public:
  /// Everything but the payload; records are matched and compared by it.
  struct Header {
    std::uint32_t tile, sheet, tag;
    std::int32_t x, y;
    std::uint32_t words;
    bool operator==(const Header&) const = default;
  };
  static Header header(const cmodel::TapRecord& record) {
    return {.tile = record.tile,
            .sheet = record.sheet,
            .tag = record.tag,
            .x = record.x,
            .y = record.y,
            .words = static_cast<std::uint32_t>(record.payload.size())};
  }
  void push(const cmodel::TapRecord& record);
  bool empty() const { return head_ == tail_; }
  Header front() const;
  std::span<const std::uint32_t> payload() const;  ///< of the front
  void pop();
  std::size_t words() const { return tail_ - head_; }

 private:
  void make_room(std::size_t words);

  std::vector<std::uint32_t> data_;  ///< [head_, tail_) are in the queue
  std::size_t head_ = 0, tail_ = 0;
};

class Scoreboard {
 public:
  cmodel::TapSink& model() { return model_side_; }
  cmodel::TapSink& rtl() { return rtl_side_; }

  /// Missing records count as divergences.
  void finish();
  std::uint64_t comparisons() const { return comparisons_; }  ///< records compared
  std::uint64_t mismatches() const { return mismatches_; }
  const std::array<std::uint64_t, cmodel::kTapCount>& by_tap() const { return by_tap_; }
  const std::array<std::uint64_t, cmodel::kTapCount>& mismatches_by_tap() const { return mismatches_by_tap_; }
  /// Number of divergences kept, at least one. To be called before any record.
  void keep(std::size_t most) { most_kept_ = std::max<std::size_t>(most, 1); }
  const std::vector<Divergence>& kept() const { return kept_; }
  const Divergence* first() const { return kept_.empty() ? nullptr : &kept_.front(); }
  /// Words of records that the model made and the RTL has not: bounded by the device's depth while it works.
  std::size_t backlog() const;

 private:
  struct Side final : cmodel::TapSink {
    Side(Scoreboard* owner, bool model) : board(owner), is_model(model) {}
    Scoreboard* board;
    bool is_model;
    void on_tap(const cmodel::TapRecord& record) override;
  };
  void expect(const cmodel::TapRecord& record);
  void check(const cmodel::TapRecord& record);
  void mismatch(cmodel::Tap tap, Divergence divergence);

  Side model_side_{this, true}, rtl_side_{this, false};
  std::array<TapQueue, cmodel::kTapCount> expected_;
  std::uint64_t comparisons_ = 0, mismatches_ = 0;
  std::array<std::uint64_t, cmodel::kTapCount> by_tap_{};
  std::array<std::uint64_t, cmodel::kTapCount> mismatches_by_tap_{};
  std::size_t most_kept_ = 1;
  std::vector<Divergence> kept_;

 public:
  Scoreboard() = default;
  Scoreboard(const Scoreboard&) = delete;
  Scoreboard& operator=(const Scoreboard&) = delete;
};

}  // namespace fastsplat::testbench
