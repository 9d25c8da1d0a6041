// SPDX-License-Identifier: Apache-2.0
// fastsplat cycles: how many cycles the device takes and how they are spent.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "analysis/provenance.hpp"
#include "base/atomic_file.hpp"
#include "base/hash_text.hpp"
#include "base/version.hpp"
#include "cli/config_flags.hpp"
#include "cli/config_json.hpp"
#include "cli/culling_comparison.hpp"
#include "cli/cycle_timeline.hpp"
#include "cli/cycle_trace.hpp"
#include "cli/frame_scaling.hpp"
#include "cli/frame_traffic.hpp"
#include "cli/gaussian_flags.hpp"
#include "cli/names.hpp"
#include "cli/output.hpp"
#include "cli/output_names.hpp"
#include "cli/progress_bar.hpp"
#include "cli/scene_flags.hpp"
#include "cli/stream_config.hpp"
#include "cli/subcommands/subcommands.hpp"
#include "cli/volume_json.hpp"
#include "cmodel/cycles/cycle_model.hpp"
#include "cmodel/model.hpp"
#include "driver/files/stream_file.hpp"
#include "driver/splats/splat_quantiser.hpp"
#include "driver/tiles/cull_log.hpp"
#include "driver/tiles/frame_head.hpp"
#include "driver/tiles/render.hpp"
#include "driver/tiles/run_device.hpp"
#include "testbench/device/pattern.hpp"

namespace fastsplat::cli {
namespace {

constexpr int kLatency = 40;  ///< cycles of memory latency in --cull-table by default

struct CyclesArguments {
  Common common;
  SceneFlags scene;
  GaussianFlags gaussians;  ///< instead of a volume's scene
  std::string stream;       ///< a recorded stream instead of a scene
  ConfigFlags config;
  ScalingFlags scaling;
  std::string input = "always", ready = "always", trace;
  bool timeline = false, cull_table = false;
  int seed = 1, fetch = -1;  ///< not given
};

using Json = nlohmann::ordered_json;

/// Results of the model.
struct Counts {
  cmodel::CycleAccount account;
  cmodel::StallCounters stalls;
  cmodel::Counters counters;
  cmodel::StreamBeats sent;
  std::uint64_t pixel_beats = 0, idle = 0, end = 0;

  void take(const cmodel::CycleModel& model) {
    sent = model.sent();
    pixel_beats = model.pixel_beats();
    account = model.account();
    stalls = model.stalls();
    counters = model.counters();
    idle = model.idle_cycles();
    end = model.end_cycle();
  }
  /// Sums over all devices; `end` is the last device's.
  void take(const ScalingRun& run, const FrameScaling& scaling) {
    sent = run.one_device().sent;
    pixel_beats = run.one_device().pixel_beats;
    counters = run.counters();
    for (const auto& device : scaling.each) {
      account += device.account;
      stalls += device.stalls;
      idle += device.idle;
    }
    end = scaling.frame;
  }
};

struct CyclesResult {
  std::string scene;                   ///< its summary; empty for a stream
  std::string stream;                  ///< its file; empty for a scene
  cmodel::BeginFrame header;           ///< of a stream
  std::optional<double> hidden_share;  ///< of a scene's splats, see hidden_share(); a device that culls has `culls`
  cmodel::Config config;
  std::string input, ready;  ///< patterns
  int seed = 1;
  Counts counts;
  std::vector<FrameScaling> scalings;       ///< if requested, by number of devices; `counts` are those of the last
  std::string trace;                        ///< empty for none
  std::optional<Json> timeline;             ///< if requested
  std::optional<cmodel::CullCounts> culls;  ///< of a device that culls
  std::optional<int> fetch;
  std::vector<driver::CullRow> cull_table;  ///< if requested
  FrameTraffic traffic;
  double seconds = 0.0;
};

/// Share of the splats whose blocks had all terminated: the device computes them in vain. Empty if the plain unit drew
/// any tile, or if the device culls.
std::optional<double> hidden_share(const driver::DeviceRender& drawn) {
  if (drawn.units.fast == 0 || drawn.units.plain > 0 || drawn.counters.splats == 0) return std::nullopt;
  return static_cast<double>(drawn.units.hidden_splats) / static_cast<double>(drawn.counters.splats);
}

/// Whether the cause exists only on devices that cull.
bool of_culling(std::string_view cause) { return cause == "hidden" || cause == "map"; }

std::string to_text(const cmodel::CullCounts& culls) {
  return fmt::format("culling: {} of {} cull groups hidden, {} of {} splats tested, {} windows of visible splats\n",
                     grouped(culls.hidden_sets), grouped(culls.set_tests), grouped(culls.hidden_splats),
                     grouped(culls.splat_tests), grouped(culls.hidden_windows));
}

std::string to_text(const Counts& counts, int slices, bool culls) {
  const auto& account = counts.account;
  const std::uint64_t composited = counts.counters.dirty_blocks * static_cast<std::uint64_t>(slices);
  std::string text;
  // If the sink is rarely ready, the last share can be a million times the ideal: fit the column to it.
  const auto share = [&](std::uint64_t cycles) { return fmt::format("{:.3f}", 100.0 * ratio(cycles, account.ideal)); };
  const std::size_t wide = std::max<std::size_t>(8, share(counts.stalls.busy).size());
  const auto row = [&](char sign, std::string_view name, std::uint64_t cycles, std::string_view meaning) {
    text += fmt::format("{} {:<14}{:>18} {:>{}} %  {}\n", sign, name, grouped(cycles), share(cycles), wide, meaning);
  };
  bool first = true;
  account.for_each([&](std::string_view name, std::uint64_t cycles, std::string_view meaning) {
    if (!culls && of_culling(name)) return;
    row(first ? ' ' : '+', name, cycles, meaning);
    first = false;
  });
  row('=', "actual", counts.stalls.busy, "cycles the device was busy");
  text += fmt::format("  {:<14}{:>18} {:{}}    waiting for the frame after reset, while memories are cleared\n", "idle",
                      grouped(counts.idle), "", wide);
  text +=
      fmt::format("actual/ideal {:.4f}, splat array used {:.1f} %, compositor used {:.1f} %, {:.3f} splats/cycle\n",
                  ratio(counts.stalls.busy, account.ideal), 100.0 * ratio(counts.counters.windows, counts.stalls.busy),
                  100.0 * ratio(composited, counts.stalls.busy), ratio(counts.counters.splats, counts.stalls.busy));
  return text;
}

std::string to_text(const CyclesResult& result) {
  const auto& counters = result.counts.counters;
  return (result.scene.empty() ? "" : result.scene + "\n") +
         fmt::format("configuration {} {}, {} splats, {} windows, {} sheets, {} tiles\n", result.config.name,
                     hash_text(cmodel::config_hash(result.config)), grouped(counters.splats), grouped(counters.windows),
                     grouped(counters.sheets), grouped(counters.tiles)) +
         to_text(result.counts, result.config.slices(), result.config.culls()) +
         (result.culls ? to_text(*result.culls) : "") +
         (result.hidden_share
              ? fmt::format("{:.1f} % of the splats lay entirely on terminated blocks and changed nothing\n",
                            100.0 * *result.hidden_share)
              : "") +
         to_text(result.traffic) + (result.scalings.size() > 1 ? to_table(result.scalings) : "") +
         (result.scalings.empty() ? "" : to_text(result.scalings.back())) +
         (result.cull_table.empty() ? "" : cli::to_text(result.cull_table)) +
         (result.trace.empty() ? "" : result.trace + "\n");
}

Json to_json(const Counts& counts, bool culls) {
  Json json;
  json["actual"] = counts.stalls.busy;
  json["idle"] = counts.idle;
  json["end"] = counts.end;
  counts.account.for_each([&](const char* name, std::uint64_t cycles, const char*) {
    if (culls || !of_culling(name)) json["account"][name] = cycles;
  });
  json["counters"] = {{"stall_input", counts.stalls.stall_input},
                      {"stall_table", counts.stalls.stall_table},
                      {"stall_buffer", counts.stalls.stall_buffer},
                      {"stall_tile", counts.stalls.stall_tile}};
  if (counts.stalls.stall_hazard != 0) json["counters"]["stall_hazard"] = counts.stalls.stall_hazard;
  return json;
}

Json to_json(const CyclesResult& result) {
  const auto& [account, stalls, counters, sent, pixel_beats, idle, end] = result.counts;
  Json json{{"verb", "cycles"},
            {"version", program_version()},
            {result.stream.empty() ? "scene" : "stream", result.stream.empty() ? result.scene : result.stream},
            {"config", priced_config_json(result.config)},
            {"input", result.input},
            {"ready", result.ready},
            {"seed", result.seed},
            {"tiles", counters.tiles},
            {"sheets", counters.sheets},
            {"splats", counters.splats},
            {"windows", counters.windows},
            {"dirty_blocks", counters.dirty_blocks},
            {"cycles", to_json(result.counts, result.config.culls())},
            {"actual_to_ideal", ratio(stalls.busy, account.ideal)},
            {"utilisation", ratio(counters.windows, stalls.busy)},
            {"splats_per_cycle", ratio(counters.splats, stalls.busy)}};
  if (!result.stream.empty()) json.update({{"width", result.header.width}, {"height", result.header.height}});
  if (result.culls) {
    json["culls"] = {{"sets_tested", result.culls->set_tests},
                     {"sets_hidden", result.culls->hidden_sets},
                     {"splats_tested", result.culls->splat_tests},
                     {"splats_hidden", result.culls->hidden_splats},
                     {"windows_hidden", result.culls->hidden_windows}};
  }
  if (result.fetch) json["fetch"] = *result.fetch;
  if (!result.cull_table.empty()) json["cull_table"] = cli::to_json(result.cull_table);
  json["traffic"] = traffic_json(result.traffic);
  json["energy"] = result.traffic.energy_violation.empty() ? analysis::to_json(result.traffic.energy) : Json(nullptr);
  if (result.hidden_share) json["hidden_share"] = *result.hidden_share;
  if (!result.scalings.empty()) json["scaling"] = to_json(result.scalings.back());
  if (result.scalings.size() > 1) {
    for (const auto& scaling : result.scalings) json["by_devices"].push_back(to_json(scaling));
  }
  if (!result.trace.empty()) json["trace"] = result.trace;
  if (result.timeline) json["timeline"] = *result.timeline;
  json["seconds"] = result.seconds;
  return json;
}

void check_culling(const CyclesArguments& arguments, const cmodel::Config& config) {
  const auto refuse = [](std::string where, std::string what, std::string fix) {
    throw_usage({.where = std::move(where), .what = std::move(what), .expected = {}, .got = {}, .fix = std::move(fix)});
  };
  if (arguments.cull_table && !arguments.stream.empty())
    refuse("--cull-table", "a recorded stream supports one cull.map only", "use a scene instead of --stream");
  if (arguments.cull_table && arguments.gaussians.file)
    refuse("--cull-table", "3-D Gaussians have no cull groups", "use a volume, or leave it out");
  if (arguments.fetch >= 0 && !config.culls() && !arguments.cull_table)
    refuse("--fetch", "requires culling, and cull.map is off", "add --set cull.map=block");
  if (arguments.fetch >= 0 && arguments.scaling.bytes_per_cycle.value_or(0) > 0)
    refuse("--fetch",
           "cannot be combined with --bytes-per-cycle: each device fetches for itself, without a shared link",
           "leave --fetch or --bytes-per-cycle out");
}

ExitCode run(const CyclesArguments& arguments) {
  const Output output(arguments.common);
  if (!arguments.gaussians.file) refuse_without_gaussians(arguments.gaussians);
  if (!arguments.stream.empty() && (arguments.gaussians.file || !(arguments.scene == SceneFlags{}))) {
    throw_usage({.where = "--stream",
                 .what = "cannot be combined with a scene's flags",
                 .expected = {},
                 .got = {},
                 .fix = "use either --stream or a scene's flags"});
  }
  refuse_display(arguments.scene);
  require_file("--trace", arguments.trace);
  check(arguments.scaling, arguments.trace.empty() ? "" : "--trace");
  check(arguments.scaling, arguments.timeline ? "--timeline" : "");
  if (arguments.timeline && arguments.common.json.empty()) {
    throw_usage({.where = "--timeline",
                 .what = "requires --json",
                 .expected = {},
                 .got = {},
                 .fix = "add --json FILE, or use --trace FILE for a separate timeline"});
  }
  check_outputs({.images = {},
                 .maps = {},
                 .raws = {},
                 .others = {arguments.trace, arguments.common.json},
                 .inputs = joined(arguments.gaussians.file   ? inputs_of(arguments.gaussians)
                                  : arguments.stream.empty() ? inputs_of(arguments.scene)
                                                             : std::vector{arguments.stream},
                                  inputs_of_config(arguments.config.config.value_or("")))});
  const auto config = arguments.gaussians.file   ? load_for_gaussians(arguments.config)
                      : arguments.stream.empty() ? load(arguments.config)
                                                 : load(for_stream(arguments.config, arguments.stream));
  check_culling(arguments, config);
  if (auto wrong = cmodel::cycle_violation(config)) {
    wrong->where = "configuration " + config.name + ": " + wrong->where;
    throw_usage(*wrong);
  }
  const auto [input, ready] =
      testbench::patterns_of(arguments.input, arguments.ready, static_cast<std::uint64_t>(arguments.seed));
  CycleTrace trace;
  cmodel::CycleOptions options;
  if (arguments.input != "always") options.input = &input;
  if (arguments.ready != "always") options.output = &ready;
  // Source and sink wait at fastsplat_top's ports, as in verify. If neither waits, no count depends on the slices.
  options.sliced = (options.input != nullptr || options.output != nullptr) && arguments.fetch < 0;
  CycleTimeline timeline(arguments.trace.empty() ? nullptr : &trace);
  if (arguments.timeline) {
    options.spans = &timeline;
  } else if (!arguments.trace.empty()) {
    options.spans = &trace;
  }

  driver::CullRun culls;
  if (config.culls()) options.culls = &culls.log;
  if (arguments.fetch >= 0 && config.culls())
    options.fetch = cmodel::Fetch{static_cast<std::uint64_t>(arguments.fetch)};

  CyclesResult result{.scene = {},
                      .stream = arguments.stream,
                      .header = {},
                      .hidden_share = {},
                      .config = config,
                      .input = arguments.input,
                      .ready = arguments.ready,
                      .seed = arguments.seed,
                      .counts = {},
                      .scalings = {},
                      .trace = arguments.trace,
                      .timeline = {},
                      .culls = {},
                      .fetch = {},
                      .cull_table = {},
                      .traffic = {}};
  if (config.culls() && arguments.fetch >= 0) result.fetch = arguments.fetch;
  analysis::Activity activity;
  const auto make = [&](cmodel::StreamScope scope) -> std::unique_ptr<cmodel::Device> {
    if (arguments.scaling.any()) return std::make_unique<ScalingRun>(config, scope, arguments.scaling, options);
    return std::make_unique<cmodel::CycleModel>(config, scope, options);
  };
  const auto take = [&](const cmodel::Device& device) {
    if (const auto* model = dynamic_cast<const cmodel::CycleModel*>(&device)) return result.counts.take(*model);
    const auto& several = dynamic_cast<const ScalingRun&>(device);
    result.scalings = several.scalings();
    result.counts.take(several, result.scalings.back());
  };
  if (!arguments.stream.empty()) {
    if (config.culls()) {
      ProgressBar bar("culling", watching(arguments.common));
      cmodel::NullPixels nowhere;
      cmodel::Model model(config, cmodel::StreamScope::Whole, nowhere);
      model.log_culls(&culls.log);
      driver::feed_stream(arguments.stream, model, {.threads = 1, .progress = bar.callback()});
      culls.counts = model.culls();
    }
    ProgressBar bar("cycles", watching(arguments.common));
    const auto device = make(cmodel::StreamScope::Whole);
    result.header = driver::feed_stream(arguments.stream, *device, {.threads = 1, .progress = bar.callback()});
    take(*device);
    result.traffic.energy_violation = "a stream's pixels are not computed here; use its scene";
  } else if (arguments.gaussians.file) {
    const auto scene = build(arguments.gaussians, describe_for_device(arguments.gaussians, arguments.scene));
    output.remark(remarks(*scene.cloud));
    result.scene = summary(scene);
    const auto frame = compile(scene, config, arguments.common, output);
    ProgressBar bar("cycles", watching(arguments.common));
    const auto device = make(cmodel::StreamScope::Subset);
    frame.emit([&](std::span<const cmodel::Beat> beats) { device->consume(beats); }, bar.callback());
    device->finish();
    take(*device);
    result.traffic.drawn = frame.report().drawn;
    activity = {.mode = cmodel::Mode::SampleAdditive,
                .ellipses = true,
                .counters = driver::render_gaussians(frame, {.threads = arguments.common.threads}).counters};
  } else {
    const auto scene = build(arguments.scene);
    output.remark(remarks(scene));
    result.scene = summary(scene);
    // With bands of whole tiles, so that all hidden splats are found.
    const auto drawn = driver::render(
        scene, config, {.threads = arguments.common.threads, .band_rows = config.tile_height, .progress = {}});
    if (!config.culls()) result.hidden_share = hidden_share(drawn);
    activity = {.mode = driver::mode_of(scene.description),
                .ellipses = driver::draws_ellipses(scene, config),
                .counters = drawn.counters};
    result.traffic.drawn = drawn.report.voxels - drawn.report.vanished_voxels;
    if (config.culls()) {
      ProgressBar bar("culling", watching(arguments.common));
      const int threads = arguments.common.threads;
      culls = driver::run_culls(driver::CompiledFrame(scene, config, threads),
                                driver::terminations(scene, config, threads), threads, bar.callback());
    }
    if (arguments.cull_table) {
      ProgressBar bar("cull table", watching(arguments.common));
      result.cull_table = driver::compare_culling(
          scene, config, static_cast<std::uint64_t>(arguments.fetch >= 0 ? arguments.fetch : kLatency),
          arguments.common.threads, bar.callback());
    }
    ProgressBar bar("cycles", watching(arguments.common));
    driver::run_device(
        scene, config, [&](cmodel::PixelSink&) { return make(cmodel::StreamScope::Subset); },
        {.threads = arguments.common.threads, .progress = bar.callback()}, take);
  }
  if (config.culls()) result.culls = culls.counts;
  FrameTraffic& traffic = result.traffic;
  traffic.in = result.counts.sent;
  traffic.bytes_out = result.counts.pixel_beats * static_cast<std::uint64_t>(config.lanes) * cmodel::kPixelBytes;
  if (traffic.energy_violation.empty()) traffic.energy_violation = analysis::energy_violation(config, activity.mode);
  if (traffic.energy_violation.empty()) {
    activity.bytes_in = traffic.bytes_in();
    activity.bytes_out = traffic.bytes_out;
    traffic.energy = analysis::energy(config, activity);
  }
  if (!arguments.trace.empty()) write_text_file(arguments.trace, trace.text());
  if (arguments.timeline) result.timeline = timeline.json();
  output.line(to_text(result));
  result.seconds = output.seconds();
  output.json(to_json(result));
  output.note_time("counted");
  return ExitCode::Pass;
}

void declare(Options& options, CyclesArguments& to) {
  declare(options, to.scene);
  declare(options, to.gaussians);
  options.group("Scene");
  options.word("--stream", to.stream, "FILE", "use a recorded stream instead of a scene");
  options.group("Engine");
  declare(options, to.config, "hardware configuration, a name or a TOML file");
  options.word("--input", to.input, "PATTERN",
               "valid pattern of the source: always, every-N, alternate-N, random-PERCENT, burst-N");
  options.values(pattern_words);
  options.word("--ready", to.ready, "PATTERN", "ready pattern of the sink, as for --input");
  options.values(pattern_words);
  options.integer("--seed", to.seed, 0, 2'000'000'000, "N", "seed of the patterns");
  options.group("Culling");
  options.integer("--fetch", to.fetch, 1, 1'000'000, "CYCLES",
                  "use a source that reads a memory of this latency and skips hidden cull groups");
  options.flag("--cull-table", to.cull_table,
               "compare all settings of cull.map, sending every beat and with --fetch (default 40)");
  options.group("Several devices");
  declare(options, to.scaling);
  options.group("Output");
  options.word("--trace", to.trace, "FILE", "write a timeline as JSON for ui.perfetto.dev; 1 us stands for one cycle");
  options.flag("--timeline", to.timeline, "add each sheet's and tile's cycles to the JSON, for `report` to draw");
  declare(options, to.common);
  options.example("fastsplat cycles --volume shells:64 --size 256 --config base --trace shells.json",
                  "cycles, how they are spent, and a timeline for ui.perfetto.dev");
  options.example("fastsplat cycles --stream shells.fss --config tiny --ready random-50",
                  "cycles of a recorded stream with a sink that is ready half of the time");
  options.example("fastsplat cycles --volume shells:64 --size 256 --devices 1,2,4 --clock 100 --json cycles.json",
                  "frames per second at 100 MHz with 1, 2 and 4 devices");
}

}  // namespace

const Subcommand subcommands::cycles{
    "cycles", "count the clock cycles of a scene or stream on the device, and show how they are spent",
    subcommand<CyclesArguments, declare, run>};

}  // namespace fastsplat::cli
