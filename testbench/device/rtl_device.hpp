// SPDX-License-Identifier: Apache-2.0
// The Verilated device behind the model's interface: beats in, pixels, taps and counters out, plus a clock.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cmodel/numbers/config.hpp"
#include "cmodel/numbers/stall_counters.hpp"
#include "cmodel/stream/device.hpp"
#include "testbench/device/pattern.hpp"
#include "testbench/device/raw_taps.hpp"
#include "testbench/device/reset_fill.hpp"
#include "testbench/device/rtl_module.hpp"

namespace fastsplat::testbench {

/// Default length of a reset, in cycles.
constexpr int kResetCycles = 4;

/// Whether the RTL's assertions are checked; without, a device is a little faster.
enum class Assertions { Off, On };

struct RtlOptions {
  Pattern input;   ///< when the source offers a beat (an offered beat stays until taken)
  Pattern output;  ///< when the sink takes pixels
  ResetFill fill = ResetFill::Random;
  std::uint64_t seed = 1;            ///< of ResetFill::Random
  std::uint64_t timeout = 1u << 20;  ///< cycles without any transfer before UserError (Simulation)
  RawTapSink* taps = nullptr;        ///< outlives the device; null: nothing is reported
  /// A waveform of the cycles [wave_from, wave_to); none while the path is empty.
  std::filesystem::path wave;
  std::uint64_t wave_from = 0, wave_to = 0;
  bool wave_after_reset = false;  ///< only after the first warm_reset(), which restarts the cycles
  Assertions assertions = Assertions::On;
};

/// Answer to a register access.
struct RegisterAnswer {
  std::uint32_t word = 0;  ///< of a read
  bool okay = false;       ///< false: SLVERR
};

/// Half of a write's offer.
enum class WriteHalf { Address, Data };

/// Refusal of an illegal beat. `checked`: the cycle before that in which error rises. If the beat is dropped because of
/// an earlier refusal, the cycle of its transfer.
struct Refusal {
  std::uint64_t taken = 0, checked = 0;
};

/// If the device refuses the stream, consume() throws UserError (Simulation) once; later beats are dropped until a
/// reset. Callers that expect a refusal use refuse().
class RtlDevice : public cmodel::Device {
 public:
  /// Cycles since reset was released.
  virtual std::uint64_t cycles() const = 0;
  /// Read through AXI4-Lite.
  virtual cmodel::StallCounters cycle_counters() = 0;
  /// One AXI4-Lite access; the answer is taken `wait` cycles after it came. The stream side goes on by its patterns.
  /// Throws UserError (Simulation) if the answer is not in the cycle that docs/microarchitecture.md gives.
  virtual RegisterAnswer read_register(std::uint32_t address, int wait = 0) = 0;
  virtual RegisterAnswer write_register(std::uint32_t address, std::uint32_t word, int wait = 0) = 0;
  /// Offers one half of a write for so many cycles, then withdraws it: true if the device took it or answered.
  virtual bool takes_half_write(WriteHalf half, std::uint32_t address, std::uint32_t word, int cycles) = 0;
  /// Leaves the answers to a read and a write waiting; without `read_too` only the write's, with the read under way. A
  /// reset has to follow.
  virtual void leave_answers_waiting(bool read_too) = 0;
  /// Resets again in the middle of any work, for so many cycles; memories keep what they hold, counters
  /// restart. Answers and pixels are not taken meanwhile. Throws UserError (Simulation) if one is still there
  /// afterwards.
  virtual void warm_reset(int cycles = kResetCycles) = 0;
  /// Offers an illegal beat. Returns when it was taken and checked, or nullopt if the device does not refuse it.
  /// Neither it nor any later beat is reported to observers, until a reset.
  virtual std::optional<Refusal> refuse(const cmodel::Beat& beat) = 0;
  /// Offers beats that the device drops without an error. They are not reported to observers.
  virtual void drop(std::span<const cmodel::Beat> beats) = 0;
  /// Requests a soft reset by CONTROL. With `wait` returns once the device is at rest; without, the next beats wait for
  /// that.
  virtual void soft_reset(bool wait = true) = 0;
  virtual bool interrupt() const = 0;
  /// Whether its ports are fastsplat_top's, with a register slice at each stream; otherwise fastsplat_core's.
  virtual bool sliced() const = 0;
  /// Number of tiles that came out marked as cut short since reset was released. Unless a refusal or a soft reset was
  /// requested, such a tile is UserError (Simulation).
  virtual std::uint64_t aborted_tiles() const = 0;
};

/// Prepares the simulators of `config` with these abilities, built if needed; throws as rtl_module(). `otherwise` is
/// the caller's alternative without RTL.
void require_rtl(const cmodel::Config& config, const std::vector<RtlAbilities>& abilities,
                 const std::string& otherwise = {});

/// The RTL of the configuration, under any name; built if needed (rtl_module.hpp). Throws as require_rtl(), and
/// UserError (Simulation) if the configuration hash in the device's registers is not `config`'s. While the device runs,
/// UserError (Simulation) reports a hang, a refused stream, or a failed assertion of the RTL with its place and cycle.
std::unique_ptr<RtlDevice> make_rtl_device(const cmodel::Config& config, cmodel::PixelSink& pixels,
                                           const RtlOptions& options = {});

}  // namespace fastsplat::testbench
