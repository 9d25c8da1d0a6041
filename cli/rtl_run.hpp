// SPDX-License-Identifier: Apache-2.0
// Shared by `render --engine rtl` and `verify`: a scene through the Verilated device, and the result as text.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "cli/output.hpp"
#include "cli/wave_flags.hpp"
#include "driver/tiles/render.hpp"
#include "driver/tiles/run_device.hpp"
#include "testbench/check/verify.hpp"
#include "testbench/device/rtl_module.hpp"

namespace fastsplat::cli {

/// Finds or builds the simulators of `config` with these abilities, with a note and a progress bar; later builds in
/// this process report in the same way. `otherwise`: alternative that the error suggests if RTL cannot be built.
void prepare_rtl(const cmodel::Config& config, const std::vector<testbench::RtlAbilities>& abilities,
                 const Common& common, const std::string& otherwise = {});

enum class Checking { Off, EveryTap };

/// A frame of the RTL: its cycles and, if checked, the checker's report.
struct RtlRun {
  cmodel::Config config;
  cmodel::StallCounters stalls;
  std::optional<testbench::CheckReport> check;
  std::string difference;        ///< the first, as text
  std::uint64_t last_cycle = 0;  ///< after reset, at the end of the run

  ExitCode exit_code() const;
};

/// Simulates what `source` sends, a subset stream.
driver::DeviceFrame render_rtl(const cmodel::BeatSource& source, const driver::TileGrid& grid,
                               const cmodel::Config& config, Checking checking, std::optional<RtlRun>& run);
driver::DeviceRender render_rtl(const scene::Scene& scene, const cmodel::Config& config,
                                const driver::RenderOptions& options, Checking checking, std::optional<RtlRun>& run);

/// Simulates the frame again and writes its waveform.
Wave write_wave(const WaveFlags& flags, const cmodel::BeatSource& source, const cmodel::Config& config,
                const RtlRun& run);
Wave write_wave(const WaveFlags& flags, const scene::Scene& scene, const cmodel::Config& config, const RtlRun& run);

std::string to_text(const RtlRun& run);
/// Keys of a subcommand's JSON.
nlohmann::ordered_json to_json(const RtlRun& run);

/// "222 mismatches"; "1,000 mismatches, stopped there" if there may be more.
std::string mismatches_text(const testbench::CheckReport& check);

/// null if absent
nlohmann::ordered_json optional_json(const std::optional<std::uint64_t>& value);
/// {"snap": n, ...}
nlohmann::ordered_json by_tap_json(const testbench::CheckReport& check);

}  // namespace fastsplat::cli
