// SPDX-License-Identifier: Apache-2.0
// A simulated device as a testbench drives it: its ports and its clock edges. It is fastsplat_top inside
// fastsplat_dut.sv, or fastsplat_core alone. Programs and modules of RTL (rtl_module.hpp) share only this header, so it
// includes only headers of the standard library.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <type_traits>

namespace fastsplat::testbench {

/// Ports of fastsplat_core that every configuration has in at most 8 bits.
#define FASTSPLAT_NARROW_PORTS(X)                                                                                     \
  X(clk_i)                                                                                                            \
  X(rst_ni)                                                                                                           \
  X(s_tvalid_i)                                                                                                       \
  X(s_tready_o) X(m_tready_i) X(m_tvalid_o) X(m_tlast_o) X(m_tuser_o) X(awvalid_i) X(awready_o) X(wvalid_i)           \
      X(wready_o) X(bready_i) X(bvalid_o) X(bresp_o) X(arvalid_i) X(arready_o) X(rready_i) X(rvalid_o) X(rresp_o)     \
          X(error_o) X(irq_o) X(tap_snap_valid_o) X(tap_sheet_valid_o) X(tap_window_valid_o) X(tap_composite_valid_o) \
              X(tap_sheet_done_o) X(verdict_valid_o) X(verdict_hidden_o)
/// Ports of any width.
#define FASTSPLAT_WIDE_PORTS(X)                                                                                    \
  X(s_tdata_i)                                                                                                     \
  X(awaddr_i)                                                                                                      \
  X(wdata_i)                                                                                                       \
  X(araddr_i) X(rdata_o) X(m_tdata_o) X(m_tkeep_o) X(tap_tile_o) X(tap_snap_tag_o) X(tap_snap_x_o) X(tap_snap_y_o) \
      X(tap_snap_mx_o) X(tap_snap_my_o) X(tap_sheet_tag_o) X(tap_sums_o) X(tap_window_tag_o) X(tap_window_x_o)     \
          X(tap_window_y_o) X(tap_weights_o) X(tap_composite_block_o) X(tap_state_o) X(verdict_tag_o)

/// A port where the simulator holds it: an unsigned integer of 1, 2, 4 or 8 bytes, or an array of 32-bit words.
class WidePort {
 public:
  template <class T>
  explicit WidePort(T& port) : at_(&port), bytes_(sizeof(T)) {
    static_assert(std::is_trivially_copyable_v<T>);
  }

  /// The lowest 32 bits.
  std::uint32_t value() const {
    std::uint32_t word = 0;
    std::memcpy(&word, at_, bytes_ < sizeof(word) ? bytes_ : sizeof(word));
    return word;
  }
  /// Drives the port's lowest bits; the others become 0. Bits that the port has not are dropped.
  void drive(std::uint32_t word) {
    const std::uint64_t wide = word;
    std::memcpy(at_, &wide, bytes_ < sizeof(wide) ? bytes_ : sizeof(wide));
  }
  /// All words; of a port of less than 32 bits in `small`.
  std::span<const std::uint32_t> words(std::array<std::uint32_t, 1>& small) const {
    if (bytes_ >= sizeof(std::uint32_t))
      return {static_cast<const std::uint32_t*>(at_), bytes_ / sizeof(std::uint32_t)};
    small[0] = value();
    return small;
  }
  std::uint32_t* data() { return static_cast<std::uint32_t*>(at_); }

 private:
  void* at_;
  std::size_t bytes_;
};

/// Ports that only fastsplat_dut has.
#define FASTSPLAT_SLICE_PORTS(X) X(tap_tile_left_o) X(tap_beat_held_o) X(tap_beat_taken_o)

struct Ports {
#define X(name) std::uint8_t& name;
  FASTSPLAT_NARROW_PORTS(X)
#undef X
#define X(name) WidePort name;
  FASTSPLAT_WIDE_PORTS(X)
#undef X
#define X(name) const std::uint8_t* name = nullptr;  ///< null: fastsplat_core alone
  FASTSPLAT_SLICE_PORTS(X)
#undef X
};

struct SimulatorOptions {
  int fill = 2;             ///< of memories and registers before the reset: 0 zeros, 1 ones, 2 random
  int seed = 1;             ///< of random ones; above 0
  bool assertions = true;   ///< assertions are checked
  bool trace = false;       ///< trace() will be called
  std::uint32_t fault = 0;  ///< number of the planted fault (rtl/fault.svh); 0: none
};

class SimulatedTop {
 public:
  virtual ~SimulatedTop() = default;
  virtual Ports ports() = 0;
  /// Settles all signals after inputs have changed.
  virtual void eval() = 0;
  /// Whether an assertion has failed since the start.
  virtual bool failed() const = 0;
  /// Text that the simulator has printed in this thread since the last call.
  virtual std::string take_output() = 0;
  /// Begins a waveform (FST). False: the file cannot be written, or this simulator cannot. When the simulator ends, the
  /// names of all ports lie in PATH.ports (wave_ports.hpp).
  virtual bool trace(const char* path) = 0;
  /// Adds the present values to the waveform.
  virtual void dump(std::uint64_t time) = 0;
  /// Writes line counts as Verilator does; nothing where they are not counted.
  virtual void write_coverage(const char* path) = 0;
};

}  // namespace fastsplat::testbench
