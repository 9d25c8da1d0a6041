// SPDX-License-Identifier: Apache-2.0
// A small system around fastsplat_top: a memory with the frame's beats, a source that reads it in bursts, a sink for
// pixels, and a host on the register bus. What a driver for real hardware does, in its order (docs/integration.md).
#pragma once

#include <verilated.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "Vfs_system.h"
#include "cmodel/stream/beat.hpp"

namespace fastsplat::examples {

/// Behaviour of the memory and the sink: a source that pauses between bursts, a sink that is not always ready.
struct SystemTimings {
  unsigned burst_beats = 64;  ///< read from memory without a pause
  unsigned latency = 20;      ///< cycles between bursts
  unsigned sink_pause = 8;    ///< the sink is not ready in one cycle of so many; 0: always ready
};

/// P pixels of a row as they leave the device.
struct PixelBeat {
  std::vector<std::uint32_t> words;  ///< R, G, B, A of each
  bool last = false;                 ///< of the tile
  bool aborted = false;              ///< the tile was cut short
};

class Host {
 public:
  using Sink = std::function<void(const PixelBeat&)>;

  Host(const SystemTimings& timings, Sink sink);
  ~Host();

  /// The register's word. Throws UserError (Simulation) for a bus that does not answer, or answers SLVERR.
  std::uint32_t read(std::uint32_t address);
  void write(std::uint32_t address, std::uint32_t word);
  /// A write of the bytes that `strobe` names; true if it was answered with OKAY.
  bool write_bytes(std::uint32_t address, std::uint32_t word, unsigned strobe);

  /// Lets the source read these beats; the clock goes on in read(), write() and wait_for_interrupt().
  void start(std::vector<cmodel::Beat> memory);
  /// False if none came within so many cycles.
  bool wait_for_interrupt(std::uint64_t cycles);
  /// Withdraws the beats that were not read yet: a soft reset follows.
  void stop();

  std::uint64_t cycle() const { return cycle_; }
  std::size_t read_beats() const { return at_; }

 private:
  void clock();
  void expect(bool holds, const char* what) const;

  SystemTimings timings_;
  Sink sink_;
  VerilatedContext context_;
  std::unique_ptr<Vfs_system> top_;
  std::vector<cmodel::Beat> memory_;
  std::size_t at_ = 0;            ///< next beat to be offered
  std::uint64_t ready_from_ = 0;  ///< cycle in which the memory has it
  std::uint64_t cycle_ = 0;
};

}  // namespace fastsplat::examples
