// SPDX-License-Identifier: Apache-2.0
// The fetch master between a memory and a device, which may be played: looks at all that goes on between them.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "cmodel/io/fetch_commands.hpp"
#include "testbench/device/axi_read_memory.hpp"

namespace fastsplat::test {

enum class FetchFault {
  None,
#define FAULT(name, said, meaning) name,
#include "tests/fetch/fetch_faults.def"
#undef FAULT
};

/// How fastsplat_fetch is built: by default, or with bursts of 4 beats, two of them under way, room
/// for 8 beats and for 8 groups without a verdict.
enum class FetchBuild { Default, Narrow };

/// What lies in memory and what the device answers.
struct FetchStream {
  std::vector<cmodel::Beat> beats;
  std::vector<cmodel::FetchCommand> commands;
  std::uint64_t address = 0;
  std::vector<int> set_of;   ///< by beat: the cull_block that decides on it, by number; -1: none
  std::vector<int> block;    ///< by beat: its number, if it is a cull_block with a verdict; else -1
  std::vector<bool> hidden;  ///< by cull_block
  /// By cull_block: its splats are asked for whatever the verdict, for no set of the command before was hidden.
  std::vector<bool> trusted;
  /// Works `trusted` out again, where `hidden` was changed.
  void trust();
  /// The beats that the device is to get, in order.
  std::vector<std::size_t> wanted() const;
};

/// Of a stream in memory: three beats before a page ends.
constexpr std::uint64_t kAddress = 0x8'0000'0fa0;

/// Of a legal stream: sets hidden as the model says.
FetchStream fetch_stream(const cmodel::Config& config, std::vector<cmodel::Beat> beats, std::uint64_t address);

struct FetchRun {
  FetchBuild build = FetchBuild::Default;
  testbench::AxiTimings memory = {};
  bool shy = false;  ///< the memory is ready for an address only when it is offered
  testbench::Pattern ready = {}, commands = {};
  unsigned verdict_wait = 0;  ///< a verdict comes up to so many cycles later than it could, by seed
  std::uint64_t seed = 1;
  FetchFault fault = FetchFault::None;
  std::size_t spoiled = ~std::size_t{0};  ///< a beat that cannot be read
  bool spoiled_once = false;              ///< and can be read later
  int other_tag = -1;                     ///< this cull_block's verdict has another tag,
  std::uint32_t other_by = 1;             ///< greater by this, modulo 2^32
  unsigned error = 0;                     ///< the error expected
  bool any_error = false;                 ///< or any other
  std::size_t stop_after = 0;             ///< beats sent before `stop` is raised; 0: never
  std::uint64_t stop_at = 0;              ///< cycle in which it is; 0: never
  std::uint64_t stop_after_error = 0;     ///< cycles from an error to `stop`; 0: never
  /// Then, as docs/integration.md says: once the master is not busy the device is reset; once the device is at rest
  /// `stop` is lowered, and everything is sent once more, without an error.
  bool again = false;
  unsigned ahead = 6;                  ///< sets that the device takes before the verdict of the first of them
  std::size_t mute = ~std::size_t{0};  ///< groups with a verdict; then the device refuses a beat and reports no more verdicts
  std::uint64_t stray = 0;             ///< from this cycle on, a verdict when no set waits for one; 0: never
};

/// What the master feeds, cycle by cycle.
class FetchDevice {
 public:
  struct Verdict {
    std::uint32_t tag = 0;
    bool hidden = false;
  };
  virtual ~FetchDevice() = default;
  // In the cycle that begins:
  virtual bool ready() = 0;  ///< asked first
  virtual std::optional<Verdict> verdict() = 0;
  /// The cycle ends with this beat on the stream; null: none.
  virtual void edge(const cmodel::Beat* beat) = 0;
  /// All that it was sent has been dealt with.
  virtual bool at_rest() = 0;
  /// A soft reset; it is over when the device is at rest.
  virtual void restart() = 0;
};

/// Takes a beat when `run.ready` says so, and reports verdicts as early as a device can, or `run.verdict_wait` later.
class PlayedDevice final : public FetchDevice {
 public:
  PlayedDevice(const FetchStream& stream, const FetchRun& run) : stream_(stream), run_(run), wanted_(stream.wanted()) {}
  bool ready() override;
  std::optional<Verdict> verdict() override;
  void edge(const cmodel::Beat* beat) override;
  bool at_rest() override { return waiting_.empty(); }
  void restart() override {
    taken_ = judged_ = 0;
    mute_ = false;
    waiting_.clear();
  }

 private:
  struct Waiting {
    std::size_t block;
    std::uint32_t tag;
    std::uint64_t cycle;
  };
  const FetchStream& stream_;
  const FetchRun& run_;
  std::vector<std::size_t> wanted_;
  std::deque<Waiting> waiting_;
  std::size_t taken_ = 0, judged_ = 0;
  std::uint64_t cycle_ = 0, last_ = 0;
  bool mute_ = run_.mute != ~std::size_t{0};
  bool taking_ = false;  ///< in this cycle
};

struct FetchResult {
  std::string finding;                        ///< the first thing that was wrong; empty: none
  std::vector<std::uint64_t> offered, taken;  ///< by beat sent
  std::vector<std::uint64_t> verdicts;        ///< by cull_block that was sent
  std::uint64_t begun = 0;                    ///< the first command was taken
  std::uint64_t cycles = 0, bursts = 0, asked = 0;
  std::size_t most_under_way = 0, most_unjudged = 0;  ///< bursts; sets
  unsigned error = 0;
  bool all_sent = false, stopped = false;
};

FetchResult run_fetch(const FetchStream& stream, const FetchRun& run, FetchDevice& device);
inline FetchResult run_fetch(const FetchStream& stream, const FetchRun& run) {
  PlayedDevice device(stream, run);
  return run_fetch(stream, run, device);
}

}  // namespace fastsplat::test
