// fastsplat verify: a scene, a recorded stream or random streams through the RTL, beside the model.
#include "testbench/check/verify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "analysis/provenance.hpp"
#include "base/hash_text.hpp"
#include "base/version.hpp"
#include "cli/image_output.hpp"
#include "cli/output.hpp"
#include "cli/progress_bar.hpp"
#include "cli/rtl_run.hpp"
#include "cli/scene_flags.hpp"
#include "cli/verbs/verbs.hpp"
#include "driver/compile.hpp"
#include "driver/config_file.hpp"
#include "driver/stream_file.hpp"
#include "testbench/coverage/coverage_book.hpp"
#include "testbench/stimulus/campaign.hpp"
#include "testbench/triage/failure.hpp"

namespace fastsplat::cli {
namespace {

struct Arguments {
  Common common;
  SceneFlags scene;
  std::string stream;            ///< a .fss file; empty for none
  std::optional<int> random;     ///< splats per seed
  std::uint64_t seed = 1;        ///< of the first run
  int seeds = 1;                 ///< seed, seed+1, ...
  std::string stimulus = "all";  ///< stimulus class
  std::string config = "base", ready = "always", input = "always", fill = "random";
  std::optional<int> reset_after;  ///< beats before a warm reset
  std::string coverage;            ///< where functional coverage is added up; empty for none
  std::string failure;             ///< where a failure's stream and waveform go, without ending; empty: by source
};

using Json = nlohmann::ordered_json;

constexpr int kShrinkRuns = 400;

enum class Source { Scene, Stream, Random };

Source source_from(const Arguments& arguments) {
  const auto& scene = arguments.scene;
  const bool has_scene = scene.file || scene.volume;
  const int given = (has_scene ? 1 : 0) + (arguments.stream.empty() ? 0 : 1) + (arguments.random ? 1 : 0);
  if (given != 1) {
    throw_usage({.where = {},
                 .what = given == 0 ? "verify what?" : "more than one thing to verify",
                 .expected = "one of --random N, --stream FILE, --volume NAME or --scene FILE",
                 .got = {},
                 .fix = "for example --random 1000"});
  }
  if (!has_scene && !(scene == SceneFlags{})) {
    throw_usage({.where = arguments.random ? "--random" : "--stream",
                 .what = "a scene's flags mean nothing here",
                 .expected = {},
                 .got = {},
                 .fix = "leave them out, or verify a scene with --volume NAME or --scene FILE"});
  }
  if (!arguments.random && (arguments.seeds != 1 || arguments.stimulus != "all" || arguments.ready == "all")) {
    throw_usage({.where = {},
                 .what = "--seeds, --class and --ready all belong to --random",
                 .expected = {},
                 .got = {},
                 .fix = "add --random N, or leave them out"});
  }
  return has_scene ? Source::Scene : arguments.random ? Source::Random : Source::Stream;
}

/// Where a failure's files go, without ending: never onto the stream that is verified.
std::string failure_prefix(const Arguments& arguments) {
  if (!arguments.failure.empty()) return arguments.failure;
  if (arguments.stream.empty()) return "verify-failure";
  return std::filesystem::path(arguments.stream).replace_extension().string() + "-smaller";
}

testbench::VerifyOptions options_from(const Arguments& arguments, const cmodel::Config& config) {
  testbench::VerifyOptions options{.config = config,
                                   .ready = arguments.ready,
                                   .input = arguments.input,
                                   .fill = testbench::reset_fill_from(arguments.fill),
                                   .seed = arguments.seed,
                                   .reset_after = static_cast<std::uint64_t>(arguments.reset_after.value_or(0)),
                                   .wave = {},
                                   .coverage = !arguments.coverage.empty(),
                                   .device = {}};
  if (options.ready != "all") testbench::Pattern(options.ready, 0);  // an unknown pattern is told before any work
  testbench::Pattern(options.input, 0);
  return options;
}

/// A result with what it takes to look into a failure.
struct Checked {
  testbench::VerifyResult result;
  std::uint64_t streams = 1;
  testbench::VerifyResult failed;
  std::map<std::string, testbench::Coverage> coverage;  ///< by campaign
  testbench::BeatSource source;                         ///< of the failed stream
  testbench::VerifyOptions options;
};

Checked verify_one(testbench::BeatSource source, const testbench::VerifyOptions& options, const char* campaign) {
  Checked out;
  out.result = out.failed = testbench::verify(source, options);
  if (out.result.coverage) out.coverage[campaign] = *out.result.coverage;
  out.source = std::move(source);
  out.options = options;
  return out;
}

Checked verify_random(const Arguments& arguments, const testbench::VerifyOptions& options, const Progress& progress) {
  testbench::CampaignOptions campaign{.verify = options,
                                      .splats = static_cast<std::uint64_t>(*arguments.random),
                                      .seeds = static_cast<std::uint64_t>(arguments.seeds),
                                      .threads = arguments.common.threads,
                                      .progress = progress};
  if (arguments.stimulus != "all") campaign.classes = {testbench::stimulus_class_from(arguments.stimulus)};
  const auto result = testbench::run_campaign(campaign);
  Checked out;
  out.result = result.total;
  out.streams = result.streams;
  for (const auto& [which, coverage] : result.coverage) out.coverage[testbench::to_string(which)] = coverage;
  if (result.failed) {
    auto run = testbench::make_run(campaign, *result.failed);
    out.failed = *result.failure;
    out.source = testbench::source_of(std::move(run.beats));
    out.options = run.options;
  }
  return out;
}

Checked verify_scene(const Arguments& arguments, testbench::VerifyOptions options, const Progress& progress) {
  options.scope = cmodel::StreamScope::Subset;
  const auto scene = build(arguments.scene);
  const auto compiled = std::make_shared<const driver::CompiledFrame>(scene, options.config);
  const testbench::BeatSource source = [compiled, progress](const testbench::BeatSink& sink) {
    sink(compiled->preamble());
    const int tiles = compiled->grid().count();
    for (int tile = 0; tile < tiles; ++tile) {
      compiled->emit_tile(tile, sink);
      if (progress) progress(static_cast<std::size_t>(tile) + 1, static_cast<std::size_t>(tiles));
    }
  };
  Checked out = verify_one(source, options, "scene");
  // Pixels of a device that was given no splat are equal whatever is wrong with it.
  if (out.result.verdict == testbench::Verdict::Pass && out.result.counters.splats == 0)
    out.result.verdict = testbench::Verdict::NothingCompared;
  return out;
}

void report_failure(const Checked& checked, const Arguments& arguments, const Output& output, Json& json) {
  const std::string stream = failure_prefix(arguments) + ".fss", waveform = failure_prefix(arguments) + ".fst";
  const auto report = testbench::investigate(checked.source, checked.options, checked.failed, waveform, kShrinkRuns);
  driver::write_beats(stream, testbench::write_document(checked.options.config, report.document));
  const std::string replay = testbench::replay_line(stream, arguments.config, report.options);
  output.line("first divergence: " + report.original);
  output.line(fmt::format("shrunk from {} to {} splats in {} runs{}", grouped(report.shrink.splats_before),
                          grouped(report.shrink.splats_after), report.shrink.runs,
                          report.shrink.finished ? "" : " (there may be a smaller one)"));
  output.line("smallest stream: " + report.divergence);
  if (!report.operands.empty()) output.line("  " + report.operands);
  output.line(fmt::format("waveform: {} (cycles {} to {})", waveform, report.wave_from, report.wave_to));
  output.line("replay: " + replay);
  json["failure"] = {{"first", report.original},
                     {"smallest", report.divergence},
                     {"operands", report.operands},
                     {"splats_before", report.shrink.splats_before},
                     {"splats_after", report.shrink.splats_after},
                     {"shrink_runs", report.shrink.runs},
                     {"stream", stream},
                     {"waveform", waveform},
                     {"wave_from", report.wave_from},
                     {"wave_to", report.wave_to},
                     {"replay", replay}};
}

/// What the coverage file holds so far: read before any work, for it may be of another configuration.
testbench::CoverageBook earlier_coverage(const std::string& path, const cmodel::Config& config) {
  auto book = testbench::CoverageBook::of(config);
  if (!path.empty() && std::filesystem::exists(path)) book.merge(testbench::read_book(path));
  return book;
}

/// Adds the run's coverage to it, and says how much of the configuration's that is.
void save_coverage(const Checked& checked, const std::string& path, testbench::CoverageBook book, const Output& output,
                   Json& json) {
  book.streams += checked.streams;
  book.splats += checked.result.counters.splats;
  book.comparisons += checked.result.check.comparisons;
  book.cycles += checked.result.check.cycles_rtl.value_or(0);
  testbench::Coverage all;
  for (const auto& [campaign, coverage] : checked.coverage) book.campaigns[campaign].merge(coverage);
  for (const auto& [campaign, coverage] : book.campaigns) all.merge(coverage);
  testbench::write_book(path, book);
  const auto hit = std::count_if(all.bins().begin(), all.bins().end(), [](const auto& bin) { return bin.hits > 0; });
  output.line(fmt::format("coverage: {} of {} bins hit, in {}", hit, all.bins().size(), path));
  json["coverage"] = {{"bins", all.bins().size()}, {"hit", hit}};
}

ExitCode run(const Arguments& arguments) {
  const Output output(arguments.common);
  const Source source = source_from(arguments);
  check_outputs({.images = {},
                 .maps = {},
                 .raws = {},
                 .others = {failure_prefix(arguments) + ".fss", failure_prefix(arguments) + ".fst",
                            arguments.common.json, arguments.coverage},
                 .inputs = arguments.stream.empty() ? std::vector<std::string>{} : std::vector{arguments.stream}});
  const auto config = driver::load_config(arguments.config);
  check_has_rtl(config);
  const auto options = options_from(arguments, config);
  auto coverage = earlier_coverage(arguments.coverage, config);
  const std::string hash = hash_text(cmodel::config_hash(config));
  const std::string seed = fmt::format("seed {}", arguments.seed);
  // The seed comes first, so that it is known whatever happens next, and last, where the eye is.
  arguments.common.json == "-" ? output.note(seed) : output.line(seed);

  Checked checked;
  {
    ProgressBar bar("verifying", watching(arguments.common));
    switch (source) {
      case Source::Scene:
        checked = verify_scene(arguments, options, bar.callback());
        break;
      case Source::Stream:
        checked = verify_one([&](const testbench::BeatSink& sink) { driver::read_beats(arguments.stream, sink); },
                             options, "stream");
        break;
      case Source::Random:
        checked = verify_random(arguments, options, bar.callback());
        break;
    }
  }
  const auto& result = checked.result;
  Json json{{"verb", "verify"},
            {"version", program_version()},
            {"verdict", testbench::to_string(result.verdict)},
            {"comparisons", result.check.comparisons},
            {"mismatches", result.check.mismatches},
            {"streams", checked.streams},
            {"splats", result.counters.splats},
            {"windows", result.counters.windows},
            {"cycles_rtl", optional_json(result.check.cycles_rtl)},
            {"cycles_model", optional_json(result.check.cycles_model)},
            {"seed", arguments.seed},
            {"seeds", arguments.seeds},
            {"config", config.name},
            {"config_hash", hash},
            {"ready", arguments.ready},
            {"input", arguments.input},
            {"fill", arguments.fill},
            {"by_tap", by_tap_json(result.check)}};
  output.line(fmt::format("{}: configuration {} {}, {} comparisons, {} mismatches",
                          testbench::to_string(result.verdict), config.name, hash, grouped(result.check.comparisons),
                          grouped(result.check.mismatches)));
  output.line(fmt::format("{}, {}, {}, {}", counted(checked.streams, "stream"),
                          counted(result.counters.splats, "splat"), counted(result.counters.windows, "window"),
                          counted(result.check.cycles_rtl.value_or(result.last_cycle), "cycle")));
  if (source == Source::Scene && result.verdict == testbench::Verdict::NothingCompared) {
    output.warn(
        "no splat of the scene reached the device; try a larger --opacity-scale or --xray-exposure, another --tf or "
        "another --zoom");
  }
  if (result.verdict == testbench::Verdict::Mismatch || result.verdict == testbench::Verdict::Simulation)
    report_failure(checked, arguments, output, json);
  if (!arguments.coverage.empty() && result.verdict == testbench::Verdict::Pass)
    save_coverage(checked, arguments.coverage, std::move(coverage), output, json);
  json["seconds"] = output.seconds();
  output.json(json.dump(2));
  arguments.common.json == "-" ? output.note(seed) : output.line(seed);
  return testbench::exit_code(result.verdict);
}

void declare(Options& options, Arguments& to) {
  options.group("Stimulus");
  options.word("--stream", to.stream, "FILE", "a recorded stream, .fss");
  options.integer("--random", to.random, 1, 1'000'000'000, "N", "random streams of about N splats per seed");
  options.word("--class", to.stimulus, "NAME", "random: stimulus class (all; an unknown one lists them)");
  options.integer("--seed", to.seed, 0, std::numeric_limits<long>::max(), "S",
                  "of random streams, patterns and reset fill");
  options.integer("--seeds", to.seeds, 1, 1'000'000, "N", "random: runs with seeds S, S+1, ...");
  options.group("Device");
  options.word("--config", to.config, "NAME|FILE", "hardware configuration with RTL");
  options.word("--ready", to.ready, "PATTERN",
               "when pixels are taken: always, every-N, never-N, random-PERCENT, burst-N; random: all takes turns");
  options.word("--input", to.input, "PATTERN", "when beats are offered, a pattern as above");
  options.choice("--fill", to.fill, {"zero", "one", "random"}, "zero|one|random",
                 "what registers and memories hold before reset");
  options.integer("--reset-after", to.reset_after, 1, 2'000'000'000, "N",
                  "warm reset after N beats, then the whole stream");
  options.group("Output");
  options.word("--coverage", to.coverage, "FILE", "functional coverage as JSON, added to what FILE holds");
  options.word("--failure", to.failure, "PREFIX", "a failure's small stream and waveform: PREFIX.fss and PREFIX.fst");
  declare(options, to.scene);
  declare(options, to.common);
  options.example("fastsplat verify --random 1000 --seed 7 --config tiny --ready random-50");
}

}  // namespace

const Verb verbs::verify{"verify", "the RTL beside the model: every tap, pixel and counter compared",
                         verb<Arguments, declare, run>};

}  // namespace fastsplat::cli
