// SPDX-License-Identifier: Apache-2.0
#include "cli/rtl_run.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cli/progress_bar.hpp"
#include "driver/tiles/compile.hpp"

namespace fastsplat::cli {

ExitCode RtlRun::exit_code() const {
  if (!check) return ExitCode::Pass;
  return check->mismatches == 0 && check->comparisons > 0 ? ExitCode::Pass : ExitCode::Failed;
}

void prepare_rtl(const cmodel::Config& config, const std::vector<testbench::RtlAbilities>& abilities,
                 const Common& common, const std::string& otherwise) {
  static std::unique_ptr<ProgressBar> bar;
  const auto begin = [&common](const std::string& line) {
    Output(common).note(line);
    bar = std::make_unique<ProgressBar>("compiling", watching(common));
    return bar->callback();
  };
  testbench::watch_rtl_builds({.begin = begin, .end = [] { bar.reset(); }});
  testbench::require_rtl(config, abilities, otherwise);
}

namespace {

/// A device for run_device(), and what to read from it at the end.
struct Simulation {
  driver::DeviceFactory make;
  std::function<void(cmodel::Device&)> finished;
};

Simulation simulation(const cmodel::Config& config, Checking checking, std::optional<RtlRun>& run) {
  const auto rtl = std::make_shared<testbench::RtlDevice*>();
  run.emplace();
  run->config = config;
  Simulation out;
  out.make = [&config, checking, rtl](cmodel::PixelSink& pixels) -> std::unique_ptr<cmodel::Device> {
    if (checking == Checking::EveryTap) {
      auto checked = std::make_unique<testbench::CheckedDevice>(
          config, cmodel::StreamScope::Subset, pixels, [&](cmodel::PixelSink& tiles, testbench::RawTapSink& taps) {
            testbench::RtlOptions with_taps;
            with_taps.taps = &taps;
            return testbench::make_rtl_device(config, tiles, with_taps);
          });
      *rtl = &checked->device();
      return checked;
    }
    testbench::RtlOptions unchecked;
    unchecked.assertions = testbench::Assertions::Off;
    auto plain = testbench::make_rtl_device(config, pixels, unchecked);
    *rtl = plain.get();
    return plain;
  };
  out.finished = [checking, rtl, &run](cmodel::Device& finished) {
    run->stalls = (*rtl)->cycle_counters();
    run->last_cycle = (*rtl)->cycles();
    if (checking == Checking::Off) return;
    run->check = dynamic_cast<const testbench::CheckedDevice&>(finished).report();
    if (run->check->first) {
      run->difference = testbench::describe(run->config, *run->check->first);
    } else if (!run->check->differences.empty()) {
      run->difference = run->check->differences.front();
    }
  };
  return out;
}

}  // namespace

driver::DeviceFrame render_rtl(const cmodel::BeatSource& source, const driver::TileGrid& grid,
                               const cmodel::Config& config, Checking checking, std::optional<RtlRun>& run) {
  const Simulation rtl = simulation(config, checking, run);
  return driver::run_device(source, grid, config, rtl.make, rtl.finished);
}

driver::DeviceRender render_rtl(const scene::Scene& scene, const cmodel::Config& config,
                                const driver::RenderOptions& options, Checking checking, std::optional<RtlRun>& run) {
  const Simulation rtl = simulation(config, checking, run);
  return driver::run_device(scene, config, rtl.make, options, rtl.finished);
}

std::string mismatches_text(const testbench::CheckReport& check) {
  return grouped(check.mismatches) + (check.mismatches == 1 ? " mismatch" : " mismatches") +
         (check.stopped ? ", stopped there" : "");
}

nlohmann::ordered_json optional_json(const std::optional<std::uint64_t>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json by_tap_json(const testbench::CheckReport& check) {
  nlohmann::ordered_json json;
  for (int tap = 0; tap < cmodel::kTapCount; ++tap)
    json[cmodel::to_string(static_cast<cmodel::Tap>(tap))] = check.by_tap[static_cast<std::size_t>(tap)];
  return json;
}

Wave write_wave(const WaveFlags& flags, const cmodel::BeatSource& source, const cmodel::Config& config,
                const RtlRun& run) {
  if (flags.file.empty()) return {};
  testbench::VerifyOptions options;
  options.config = config;
  return write_wave(flags, source, std::move(options), run.last_cycle);
}

Wave write_wave(const WaveFlags& flags, const scene::Scene& scene, const cmodel::Config& config, const RtlRun& run) {
  if (flags.file.empty()) return {};
  const driver::CompiledFrame compiled(scene, config);
  return write_wave(
      flags, [&](const cmodel::BeatSink& sink) { compiled.emit(sink); }, config, run);
}

std::string to_text(const RtlRun& run) {
  std::string text = fmt::format("rtl: {} cycles\n", grouped(run.stalls.busy));
  if (!run.check) return text;
  text += fmt::format("check: {} comparisons, {}\n", grouped(run.check->comparisons), mismatches_text(*run.check));
  return run.difference.empty() ? text : text + run.difference + "\n";
}

nlohmann::ordered_json to_json(const RtlRun& run) {
  nlohmann::ordered_json json{{"cycles_rtl", run.stalls.busy}};
  if (run.check) json["cycles_model"] = optional_json(run.check->cycles_model);
  run.stalls.for_each(run.config,
                      [&](const char* name, std::uint64_t value, const char*) { json["cycles"][name] = value; });
  if (!run.check) return json;
  json["check"] = {{"comparisons", run.check->comparisons},
                   {"mismatches", run.check->mismatches},
                   {"stopped", run.check->stopped},
                   {"by_tap", by_tap_json(*run.check)}};
  if (!run.difference.empty()) json["check"]["first"] = run.difference;
  return json;
}

}  // namespace fastsplat::cli
