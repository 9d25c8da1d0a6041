// SPDX-License-Identifier: Apache-2.0
// The clock cycle of each event of the RTL, computed from the stream without a clock (docs/microarchitecture.md). Time
// goes by records, not by cycles; pixels are not computed. For devices that cull, the results of tests come from a log
// that Model wrote.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "cmodel/cull/cull_log.hpp"
#include "cmodel/cull/cull_sets.hpp"
#include "cmodel/cull/cull_unit.hpp"
#include "cmodel/cycles/cull_pipe.hpp"
#include "cmodel/cycles/cycle_account.hpp"
#include "cmodel/cycles/ready_pattern.hpp"
#include "cmodel/cycles/register_slice.hpp"
#include "cmodel/cycles/stream_beats.hpp"
#include "cmodel/decode/stream_decode.hpp"
#include "cmodel/numbers/config.hpp"
#include "cmodel/numbers/stall_counters.hpp"
#include "cmodel/splat/dirty_map.hpp"
#include "cmodel/splat/snap.hpp"
#include "cmodel/stream/device.hpp"

namespace fastsplat::cmodel {

/// Cycles after reset in which memories are wiped, a word a cycle: the blocks of a W x H tile (M-reset-4). No beat is
/// taken meanwhile.
std::uint64_t wipe_cycles(const Config& config);

/// A sheet's cycles in the device. Spans are half-open.
struct SheetCycles {
  std::uint32_t tile = 0, sheet = 0;
  std::uint64_t offered = 0;                 ///< begin_sheet lies in decode from here
  std::uint64_t begun = 0, closed = 0;       ///< begin_sheet and end_sheet carried out
  std::uint64_t windows = 0, blocks = 0;     ///< P x P windows; dirty blocks
  std::uint64_t walk_from = 0, walk_to = 0;  ///< the compositor picks blocks, slice by slice
  std::uint64_t picks = 0;                   ///< cycles with a pick; all in densities: the sheet before is classified
};

/// A tile's cycles. `picture_to` is the cycle after the one in which its last pixels were taken.
struct TileCycles {
  std::uint32_t tile = 0;
  std::uint64_t begun = 0, closed = 0;  ///< begin_tile and end_tile carried out
  std::uint64_t picture_from = 0, picture_to = 0;
  std::uint64_t picks = 0;  ///< of densities: cycles in which the last sheet is classified
};

/// A beat's cycles in check and decode.
struct BeatCycles {
  Opcode opcode{};                       ///< of its record; of a table's payload, load_table
  bool payload = false;                  ///< table words
  std::uint64_t wanted = 0;              ///< first cycle in which the device could have taken it
  std::uint64_t offered = 0, taken = 0;  ///< the source has it; the device takes it
  std::uint64_t entered = 0;             ///< it lies in decode's register
  std::uint64_t left = 0;                ///< its last cycle there
};

/// The verdict on a cull_block, and the cycle in which the device reports it to its source.
struct VerdictCycles {
  std::uint32_t tag = 0;
  bool hidden = false;
  std::uint64_t reported = 0;
  bool operator==(const VerdictCycles&) const = default;
};

class CycleSink {
 public:
  virtual ~CycleSink() = default;
  virtual void on_beat(const BeatCycles&) {}
  virtual void on_verdict(const VerdictCycles&) {}  ///< of devices that cull
  virtual void on_sheet(const SheetCycles& sheet) = 0;
  virtual void on_tile(const TileCycles& tile) = 0;
};

/// A source that reads the stream from a memory and never requests the splats of hidden cull groups
/// (rtl/io/fastsplat_fetch.sv). Throws UserError (Input) for a cull_block between the splats of a group
/// (cmodel/io/fetch_commands.hpp).
struct Fetch {
  std::uint64_t latency = 1;  ///< of the memory: cycles from an address taken to its first beat; 0 counts as 1
};

struct CycleOptions {
  const ReadyPattern* input = nullptr;   ///< when the source begins to offer a beat; null: always
  const ReadyPattern* output = nullptr;  ///< when the sink takes pixels; null: always
  std::uint64_t first_beat = 0;          ///< cycle after reset from which the source has a beat
  bool sliced = false;                   ///< the ports are fastsplat_top's: a register slice lies at each stream
  TapSink* taps = nullptr;               ///< every event with its cycle; payloads are empty
  CycleSink* spans = nullptr;
  const CullLog* culls = nullptr;   ///< of all tiles, for a device that culls; null: nothing is hidden
  std::optional<Fetch> fetch = {};  ///< empty: every beat is sent
};

/// Why the model does not have the timing of a configuration; empty if it does.
std::optional<ErrorParts> cycle_violation(const Config& config);

class CycleModel final : public Device {
 public:
  /// The objects of `options` must outlive the model.
  CycleModel(const Config& config, StreamScope scope, const CycleOptions& options = {});

  void consume(std::span<const Beat> beats) override {
    for (const Beat& beat : beats) take(beat);
  }
  void finish() override;
  /// tiles, sheets, splats, windows, cull_blocks and dirty_blocks; the others need pixels and stay 0.
  const Counters& counters() const override { return counters_; }
  /// The cycle in which check decides on a beat that is taken in cycle `taken`, after those consumed. One that breaks a
  /// rule is not consumed.
  std::uint64_t checked_at(std::uint64_t taken) const;

  // After finish():
  /// Sums to stalls().busy.
  CycleAccount account() const { return accountant_.account(); }
  const StallCounters& stalls() const { return stalls_; }
  /// The first cycle after reset from which nothing is left to do.
  std::uint64_t end_cycle() const { return end_; }
  /// Cycles after reset in which the device waited for a frame: the wipe, and a late source outside of tiles.
  std::uint64_t idle_cycles() const { return end_ - stalls_.busy; }
  /// Beats that the source sent: all but skipped ones of hidden cull groups.
  const StreamBeats& sent() const { return sent_; }
  /// Beats of pixels, P pixels each.
  std::uint64_t pixel_beats() const { return pixel_beats_; }

 private:
  struct Set {
    std::uint32_t rho = 0;
    std::int32_t extent = 0;
  };

  void take(const Beat& beat);
  /// The cycle in which a beat taken in this one at the port is offered to check.
  std::uint64_t arrives(std::uint64_t taken) const { return options_.sliced ? beats_in_.offers(taken) : taken; }
  /// The beat enters the register at the returned cycle; accounts for the empty register before it.
  std::uint64_t enter(Opcode opcode, bool payload);
  /// The next answer of the open tile's tests; false if it has no tests.
  bool answer();
  void cull_block(const CullBlock& record);
  /// Accounts for the cycle of a splat that is hidden or dropped.
  void hide(std::uint64_t at);
  /// Whether the splat's cull group is hidden. With a fetching source, it is never sent, or waits for the verdict.
  bool dropped(const Record& record);
  /// A fetching source requests the next beat after the verdict of cycle `verdict`.
  void fetch_behind(std::uint64_t verdict);
  /// Accounts for a splat some of whose windows are hidden.
  void some_windows(std::uint64_t at, std::uint32_t tag, std::int32_t x, std::int32_t y, std::int32_t width,
                    std::int32_t height);
  void window(std::uint64_t at, std::uint32_t tag, std::int32_t x, std::int32_t y) const;
  /// The register is empty in [from, to).
  void empty(std::uint64_t from, std::uint64_t to);
  /// A record is carried out in cycle `at`; it lay in the register since `since`.
  void leave(std::uint64_t since, std::uint64_t at);
  void splat(const SplatRecord& record, std::uint64_t at);
  void ellipse(const EllipseRecord& record, std::uint64_t at);
  /// The cycle in which a record's first window, at (x,y), is issued; accounts for its wait (every sample).
  std::uint64_t issue(std::uint64_t at, std::int32_t x, std::int32_t y);
  /// Accounts for a splat's windows, the first at (x,y): width x height pixels. An ellipse's are not tested.
  void footprint(std::uint64_t at, std::uint32_t tag, std::int32_t x, std::int32_t y, std::int32_t width,
                 std::int32_t height, bool tests_windows);
  void load(const LoadTable& table);
  void begin_tile(const BeginTile& record, std::uint64_t at);
  void begin_sheet(const BeginSheet& record, std::uint64_t at);
  void end_sheet(std::uint64_t at);
  void end_tile(std::uint64_t at);
  /// Densities: classifies the waiting sheet. `at` is the last cycle of the next sheet's copy, or end_tile's turn.
  /// Returns the last cycle of its walk.
  std::uint64_t classify(std::uint64_t at);
  void picture(std::uint64_t at);
  void tap(Tap kind, std::uint64_t cycle, std::uint32_t tag, std::int32_t x, std::int32_t y) const;

  Config config_;
  CycleOptions options_;
  StreamDecode decode_;
  Snap snap_;
  Accountant accountant_;
  Counters counters_;
  StallCounters stalls_;
  std::vector<Set> sets_;
  DirtyMap dirty_;
  std::uint64_t delay_;         ///< added to the splat path (ellipses)
  std::uint64_t weight_delay_;  ///< added from the weights on (interpolation)

  CullPipe cull_;
  const CullAnswers* answers_ = nullptr;  ///< of the open tile
  std::size_t answered_ = 0, cull_sheet_ = 0;
  struct Verdict {
    bool hidden = false;
    std::uint64_t cycle = 0;
  };
  CullSets<Verdict> cull_sets_;
  std::uint64_t last_verdict_ = 0;
  StreamBeats sent_;
  // Flags of a fetching source. A splat of a cull group came, and nothing after the last group yet (behind_set_). A
  // group with splats is hidden, among those announced together now (hides_) or before (hid_). All splats of the groups
  // are sent (trusts_, M-fetch-4).
  bool behind_set_ = false, hides_ = false, hid_ = false, trusts_ = false;

  std::uint64_t payload_words_ = 0;  ///< of the open table
  std::uint64_t next_offer_ = 0;     ///< earliest cycle in which the next beat can be offered
  RegisterSlice beats_in_, pixels_out_;
  std::uint64_t check_free_ = 0;     ///< earliest cycle in which check's first stage takes the next beat
  std::uint64_t result_free_ = 0;    ///< earliest cycle in which its second stage takes it from there
  std::uint64_t ready_ = 0;          ///< earliest cycle in which decode takes the next beat from it
  std::uint64_t register_free_ = 0;  ///< first cycle after the last beat left
  std::uint64_t end_ = 0;
  BeatCycles beat_;  ///< in the register

  bool tile_open_ = false;
  BeginTile tile_;
  SheetCycles sheet_;
  TileCycles span_;
  std::size_t buffer_ = 0;
  std::uint64_t window_issued_ = 0;  ///< the last window: its cycle, and its first pixel
  std::int32_t window_x_ = 0, window_y_ = 0;
  std::array<std::uint64_t, 2> buffer_free_{};  ///< cycle from which begin_sheet may take it
  std::uint64_t walk_free_ = 0;                 ///< earliest first pick of the next sheet
  std::uint64_t compositor_idle_ = 0;           ///< cycle from which it has nothing to do
  std::uint64_t picture_from_ = 0, picture_to_ = 0;
  std::uint64_t pixel_beats_ = 0;

  // Of a tile of densities.
  struct DensitySheet {
    std::uint32_t number = 0;
    std::vector<std::pair<int, int>> blocks;  ///< dirty blocks: column, row
  };
  int halo_ = 0;                       ///< halo of its sheets, pixels
  std::optional<DensitySheet> waits_;  ///< for the sheet behind it
};

}  // namespace fastsplat::cmodel
