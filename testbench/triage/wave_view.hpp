// SPDX-License-Identifier: Apache-2.0
// The save file that opens a waveform in GTKWave with its signals in groups.
#pragma once

#include <cstdint>
#include <istream>
#include <optional>
#include <string>

namespace fastsplat::testbench {

/// The instance to show first.
struct WaveFocus {
  std::uint64_t cycle = 0;  ///< the marker stands at this clock edge
  std::string instance;     ///< below fastsplat_dut; its ports come first. Empty for none
};

/// First line of a save file that this program wrote. GTKWave writes one of its own when a user saves.
inline constexpr const char* kWaveViewMark =
    "[*] written by fastsplat; replaced with the waveform, unless GTKWave has saved it";

/// The save file for `waveform` (its name without folder). `ports`: as testbench/module/wave_ports.hpp writes them.
/// Groups: the focus, the streams, registers and taps at the top's ports (open); then each unit's ports (closed).
std::string wave_view(const std::string& waveform, std::istream& ports, const std::optional<WaveFocus>& focus);

}  // namespace fastsplat::testbench
