// What `render --engine rtl` and `verify` share: a scene through the Verilated device, and its result in words.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "cli/output.hpp"
#include "cli/wave_flags.hpp"
#include "driver/tiles/render.hpp"
#include "testbench/check/verify.hpp"
#include "testbench/device/rtl_module.hpp"

namespace fastsplat::cli {

/// Finds the simulators of `config` with these abilities, or builds them, with a note and a progress bar; those that
/// are built later in this process have them too. `otherwise`: the way out where RTL cannot be built.
void prepare_rtl(const cmodel::Config& config, const std::vector<testbench::RtlAbilities>& abilities,
                 const Common& common, const std::string& otherwise = {});

enum class Checking { Off, EveryTap };

/// A frame of the RTL: its cycles and, if checked, the checker's report.
struct RtlRun {
  cmodel::Config config;
  cmodel::StallCounters stalls;
  std::optional<testbench::CheckReport> check;
  std::string difference;        ///< first one, in words
  std::uint64_t last_cycle = 0;  ///< after reset, at the end of the run

  ExitCode exit_code() const;
};

driver::DeviceRender render_rtl(const scene::Scene& scene, const cmodel::Config& config,
                                const driver::RenderOptions& options, Checking checking, std::optional<RtlRun>& run);

/// The waveform of such a frame.
Wave write_wave(const WaveFlags& flags, const scene::Scene& scene, const cmodel::Config& config, const RtlRun& run);

std::string to_text(const RtlRun& run);
/// Keys for the JSON of a verb.
nlohmann::ordered_json to_json(const RtlRun& run);

/// "222 mismatches"; "1,000 mismatches, stopped there" where there may be more.
std::string mismatches_text(const testbench::CheckReport& check);

/// null where there is none
nlohmann::ordered_json optional_json(const std::optional<std::uint64_t>& value);
/// {"snap": n, ...}
nlohmann::ordered_json by_tap_json(const testbench::CheckReport& check);

}  // namespace fastsplat::cli
