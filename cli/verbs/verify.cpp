// fastsplat verify: a scene, a recorded stream or random streams through the RTL, beside the model.
#include "testbench/check/verify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "analysis/provenance.hpp"
#include "base/hash_text.hpp"
#include "base/version.hpp"
#include "cli/config_flags.hpp"
#include "cli/names.hpp"
#include "cli/output.hpp"
#include "cli/output_names.hpp"
#include "cli/progress_bar.hpp"
#include "cli/replay_line.hpp"
#include "cli/rtl_run.hpp"
#include "cli/scene_flags.hpp"
#include "cli/verbs/verbs.hpp"
#include "cli/volume_json.hpp"
#include "driver/compile.hpp"
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
  ConfigFlags config;
  std::string ready = "always", input = "always", fill = "random";
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

/// Where a failure's files go, without ending: never onto the stream that is verified, and not onto those of an earlier
/// failure unless they were named.
std::string failure_prefix(const Arguments& arguments) {
  if (!arguments.failure.empty()) return arguments.failure;
  const std::string stem = arguments.stream.empty()
                               ? "verify-failure"
                               : std::filesystem::path(arguments.stream).replace_extension().string() + "-smaller";
  std::error_code ignored;
  const auto is_there = [&](const std::string& name) {
    return std::filesystem::exists(name + ".fss", ignored) || std::filesystem::exists(name + ".fst", ignored);
  };
  std::string name = stem;
  for (int number = 2; is_there(name); ++number) name = fmt::format("{}-{}", stem, number);
  return name;
}

std::vector<std::string> inputs_of(const Arguments& arguments, Source source) {
  auto inputs = inputs_of_config(arguments.config.config.value_or(""));
  if (source == Source::Stream) inputs.push_back(arguments.stream);
  return source == Source::Scene ? joined(inputs, cli::inputs_of(arguments.scene)) : inputs;
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
  if (arguments.stimulus != "all") testbench::stimulus_class_from(arguments.stimulus);
  return options;
}

/// A result with what it takes to look into a failure.
struct Checked {
  testbench::VerifyResult result;
  std::uint64_t streams = 1, resets_late = 0;
  testbench::VerifyResult failed;
  std::vector<testbench::SeedResult> by_seed;           ///< of random streams
  std::map<std::string, testbench::Coverage> coverage;  ///< by campaign
  cmodel::BeatSource source;                            ///< of the failed stream
  testbench::VerifyOptions options;
};

Checked verify_one(cmodel::BeatSource source, const testbench::VerifyOptions& options, const char* campaign) {
  Checked out;
  out.result = out.failed = testbench::verify(source, options);
  if (out.result.coverage) out.coverage[campaign] = *out.result.coverage;
  out.source = std::move(source);
  out.options = options;
  return out;
}

Checked verify_stream(const Arguments& arguments, const testbench::VerifyOptions& options) {
  const std::string path = arguments.stream;
  Checked out;
  driver::naming(path, [&] {
    out = verify_one([path](const cmodel::BeatSink& sink) { driver::read_beats(path, sink); }, options, "stream");
  });
  // As replay and cycles have it; a device that is wrong is told first.
  const auto verdict = out.result.verdict;
  if (verdict == testbench::Verdict::Pass || verdict == testbench::Verdict::NothingCompared)
    driver::require_covered(path);
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
  out.resets_late = result.resets_late;
  out.by_seed = result.by_seed;
  for (const auto& [which, coverage] : result.coverage) out.coverage[testbench::to_string(which)] = coverage;
  if (result.failed) {
    auto run = testbench::make_run(campaign, *result.failed);
    out.failed = *result.failure;
    out.source = testbench::source_of(std::move(run.beats));
    out.options = run.options;
  }
  return out;
}

Checked verify_scene(const Arguments& arguments, testbench::VerifyOptions options, const Progress& progress,
                     const Output& output) {
  options.scope = cmodel::StreamScope::Subset;
  const auto scene = build(arguments.scene);
  output.remark(remarks(*scene.volume));
  const auto compiled = std::make_shared<const driver::CompiledFrame>(scene, options.config);
  const cmodel::BeatSource source = [compiled, progress](const cmodel::BeatSink& sink) {
    compiled->emit(sink, progress);
  };
  Checked out = verify_one(source, options, "scene");
  // Pixels of a device that was given no splat are equal whatever is wrong with it.
  if (out.result.verdict == testbench::Verdict::Pass && out.result.counters.splats == 0)
    out.result.verdict = testbench::Verdict::NothingCompared;
  return out;
}

/// A failure in words, with the files that show it again.
struct Failure {
  testbench::FailureReport report;
  std::string stream, waveform, replay;  ///< empty where there is none
  std::vector<std::string> unwritten;    ///< why there is none
};

/// What cannot be written does not take the failure away.
Failure investigate(const Checked& checked, const Arguments& arguments, const std::string& prefix) {
  Failure failure{.report = {}, .stream = prefix + ".fss", .waveform = prefix + ".fst", .replay = {}, .unwritten = {}};
  failure.report =
      testbench::investigate(checked.source, checked.options, checked.failed, failure.waveform, kShrinkRuns);
  if (!failure.report.no_waveform.empty()) {
    failure.unwritten.push_back(failure.report.no_waveform);
    failure.waveform.clear();
  }
  try {
    driver::write_beats(failure.stream, testbench::write_document(checked.options.config, failure.report.document));
    failure.replay = replay_line(failure.stream, arguments.config, failure.report.options);
  } catch (const UserError& error) {
    failure.unwritten.push_back(error.what());
    failure.stream.clear();
  }
  return failure;
}

std::string to_text(const Failure& failure) {
  const auto& report = failure.report;
  return fmt::format("shrunk from {} to {} splats in {} runs{}\n", grouped(report.shrink.splats_before),
                     grouped(report.shrink.splats_after), report.shrink.runs,
                     report.shrink.finished ? "" : " (there may be a smaller one)") +
         "smallest stream: " + report.divergence + "\n" +
         (report.operands.empty() ? "" : "  " + report.operands + "\n") +
         (failure.waveform.empty()
              ? ""
              : fmt::format("waveform: {} (cycles {} to {})\n", failure.waveform, report.wave_from, report.wave_to)) +
         (failure.replay.empty() ? "" : "replay: " + failure.replay + "\n");
}

Json to_json(const Failure& failure) {
  const auto& report = failure.report;
  return {{"first", report.original},
          {"smallest", report.divergence},
          {"operands", report.operands},
          {"splats_before", report.shrink.splats_before},
          {"splats_after", report.shrink.splats_after},
          {"shrink_runs", report.shrink.runs},
          {"stream", failure.stream},
          {"waveform", failure.waveform},
          {"wave_from", report.wave_from},
          {"wave_to", report.wave_to},
          {"replay", failure.replay},
          {"unwritten", failure.unwritten}};
}

/// What the coverage file holds may be of another configuration, or no coverage: told before any work.
void check_coverage(const std::string& path, const cmodel::Config& config) {
  if (path.empty() || !std::filesystem::exists(path)) return;
  testbench::CoverageBook::of(config).merge(testbench::read_book(path));
}

/// How much of the configuration's coverage is hit, this run's added to what the file held.
struct Gain {
  std::string path;
  std::size_t bins = 0, hit = 0;
};

Gain save_coverage(const Checked& checked, const std::string& path, const cmodel::Config& config) {
  auto book = testbench::CoverageBook::of(config);
  book.streams += checked.streams;
  book.splats += checked.result.counters.splats;
  book.comparisons += checked.result.check.comparisons;
  book.cycles += checked.result.check.cycles_rtl.value_or(0);
  testbench::Coverage all;
  for (const auto& [campaign, coverage] : checked.coverage) book.campaigns[campaign].merge(coverage);
  for (const auto& [campaign, coverage] : testbench::add_to_book(path, book).campaigns) all.merge(coverage);
  const auto hit = std::count_if(all.bins().begin(), all.bins().end(), [](const auto& bin) { return bin.hits > 0; });
  return {.path = path, .bins = all.bins().size(), .hit = static_cast<std::size_t>(hit)};
}

std::string to_text(const Gain& gain) {
  return fmt::format("coverage: {} of {} bins hit, in {}\n", gain.hit, gain.bins, gain.path);
}

/// Everything said about a run.
struct Result {
  const Arguments& arguments;
  cmodel::Config config;
  std::uint64_t streams = 0, resets_late = 0;
  testbench::VerifyResult run;
  std::vector<testbench::SeedResult> by_seed;
  std::optional<Failure> failure;
  std::optional<Gain> coverage;
  double seconds = 0.0;
};

/// Verdict and counts.
std::string to_text(const Result& result) {
  const auto& run = result.run;
  return fmt::format("{}: configuration {} {}, {} comparisons, {} mismatches\n", testbench::to_string(run.verdict),
                     result.config.name, hash_text(cmodel::config_hash(result.config)), grouped(run.check.comparisons),
                     grouped(run.check.mismatches)) +
         fmt::format("{}, {}, {}, {}\n", counted(result.streams, "stream"), counted(run.counters.splats, "splat"),
                     counted(run.counters.windows, "window"),
                     counted(run.check.cycles_rtl.value_or(run.last_cycle), "cycle"));
}

/// Seeds that failed and the first others: a result is to stay small.
void add_seeds(Json& json, const std::vector<testbench::SeedResult>& by_seed) {
  constexpr std::size_t kMost = 2000;
  if (by_seed.empty()) return;
  std::size_t left_out = 0;
  Json rows = Json::array();
  for (const auto& [seed, verdict, streams, splats, comparisons, mismatches, cycles] : by_seed) {
    if (verdict == testbench::Verdict::Pass && rows.size() >= kMost) {
      ++left_out;
      continue;
    }
    rows.push_back({{"seed", seed},
                    {"verdict", testbench::to_string(verdict)},
                    {"streams", streams},
                    {"splats", splats},
                    {"comparisons", comparisons},
                    {"mismatches", mismatches},
                    {"cycles", cycles}});
  }
  json["by_seed"] = std::move(rows);
  json["by_seed_left_out"] = left_out;
}

Json to_json(const Result& result) {
  const auto& [arguments, config, streams, resets_late, run, by_seed, failure, coverage, seconds] = result;
  Json json{{"verb", "verify"},
            {"version", program_version()},
            {"verdict", testbench::to_string(run.verdict)},
            {"comparisons", run.check.comparisons},
            {"mismatches", run.check.mismatches},
            {"streams", streams},
            {"splats", run.counters.splats},
            {"windows", run.counters.windows},
            {"cycles_rtl", optional_json(run.check.cycles_rtl)},
            {"cycles_model", optional_json(run.check.cycles_model)},
            {"seed", arguments.seed},
            {"seeds", arguments.seeds},
            {"config", config.name},
            {"config_hash", hash_text(cmodel::config_hash(config))},
            {"ready", arguments.ready},
            {"input", arguments.input},
            {"fill", arguments.fill},
            {"by_tap", by_tap_json(run.check)}};
  add_seeds(json, by_seed);
  if (resets_late > 0) json["resets_late"] = resets_late;
  if (failure) json["failure"] = to_json(*failure);
  if (coverage) json["coverage"] = {{"bins", coverage->bins}, {"hit", coverage->hit}};
  json["seconds"] = seconds;
  return json;
}

ExitCode run(const Arguments& arguments) {
  const Output output(arguments.common);
  const Source source = source_from(arguments);
  const std::string prefix = failure_prefix(arguments);
  check_outputs({.images = {},
                 .maps = {},
                 .raws = {},
                 .others = {prefix + ".fss", prefix + ".fst", arguments.common.json, arguments.coverage},
                 .inputs = inputs_of(arguments, source)});
  const auto config = load(arguments.config);
  testbench::require_rtl(config);
  const auto options = options_from(arguments, config);
  check_coverage(arguments.coverage, config);
  const std::string seed = fmt::format("seed {}", arguments.seed);
  // The seed comes first, so that it is known whatever happens next, and last, where the eye is.
  arguments.common.json == "-" ? output.note(seed) : output.line(seed);

  Checked checked;
  {
    ProgressBar bar("verifying", watching(arguments.common));
    switch (source) {
      case Source::Scene:
        checked = verify_scene(arguments, options, bar.callback(), output);
        break;
      case Source::Stream:
        checked = verify_stream(arguments, options);
        break;
      case Source::Random:
        checked = verify_random(arguments, options, bar.callback());
        break;
    }
  }
  Result result{.arguments = arguments,
                .config = config,
                .streams = checked.streams,
                .resets_late = checked.resets_late,
                .run = checked.result,
                .by_seed = checked.by_seed,
                .failure = {},
                .coverage = {}};
  const auto verdict = result.run.verdict;
  output.line(to_text(result));  // what follows takes time
  if (source == Source::Scene && verdict == testbench::Verdict::NothingCompared) {
    output.warn(
        "no splat of the scene reached the device; try a larger --opacity-scale or --xray-exposure, another --tf or "
        "another --zoom");
  }
  if (verdict == testbench::Verdict::Mismatch || verdict == testbench::Verdict::Simulation) {
    std::error_code ignored;
    for (const std::string& name : {prefix + ".fss", prefix + ".fst"}) {
      if (std::filesystem::exists(name, ignored)) output.note(name + " of an earlier failure is replaced");
    }
    output.line("first divergence: " + testbench::first_divergence(checked.failed, config));
    result.failure = investigate(checked, arguments, prefix);
    output.line(to_text(*result.failure));
    for (const auto& why : result.failure->unwritten) output.warn(why);
  }
  if (result.resets_late > 0) {
    output.warn(fmt::format("--reset-after {}: {} of {} is shorter, and was reset after its last beat",
                            *arguments.reset_after, grouped(result.resets_late), counted(result.streams, "stream")));
  }
  if (!arguments.coverage.empty() && verdict == testbench::Verdict::Pass) {
    result.coverage = save_coverage(checked, arguments.coverage, config);
    output.line(to_text(*result.coverage));
  }
  result.seconds = output.seconds();
  output.json(to_json(result));
  arguments.common.json == "-" ? output.note(seed) : output.line(seed);
  return testbench::exit_code(verdict);
}

void declare(Options& options, Arguments& to) {
  options.group("Stimulus");
  options.word("--stream", to.stream, "FILE", "a recorded stream, .fss");
  options.integer("--random", to.random, 1, 1'000'000'000, "N", "random streams of about N splats per seed");
  options.word("--class", to.stimulus, "NAME", "random: stimulus class (all; an unknown one lists them)");
  options.values(stimulus_words);
  options.integer("--seed", to.seed, 0, std::numeric_limits<long>::max(), "S",
                  "of random streams, patterns and reset fill");
  options.integer("--seeds", to.seeds, 1, 1'000'000, "N", "random: runs with seeds S, S+1, ...");
  options.group("Device");
  declare(options, to.config, "hardware configuration with RTL");
  options.word("--ready", to.ready, "PATTERN",
               "when pixels are taken: always, every-N, alternate-N, random-PERCENT, burst-N; random: all takes turns");
  options.values(ready_words);
  options.word("--input", to.input, "PATTERN", "when beats are offered, a pattern as above");
  options.values(pattern_words);
  options.choice("--fill", to.fill, {"zero", "one", "random"}, "zero|one|random",
                 "what registers and memories hold before reset");
  options.integer("--reset-after", to.reset_after, 1, 2'000'000'000, "N",
                  "warm reset after N beats, then the whole stream");
  options.group("Output");
  options.word("--coverage", to.coverage, "FILE", "functional coverage as JSON, added to what FILE holds");
  options.word("--failure", to.failure, "PREFIX", "a failure's small stream and waveform: PREFIX.fss and PREFIX.fst");
  declare(options, to.scene);
  declare(options, to.common);
  options.example("fastsplat verify --random 1000 --seed 7 --config tiny --ready random-50",
                  "RTL against model on random streams, every tap compared");
  options.example("fastsplat verify --stream shells.fss --config tiny --coverage book.json",
                  "on a recorded stream, coverage added up");
  options.example("fastsplat verify --random 100000 --seeds 100 --config tiny --json night.json", "a night's campaign",
                  Example::Slow);
}

}  // namespace

const Verb verbs::verify{"verify", "the RTL beside the model: every tap, pixel and counter compared",
                         verb<Arguments, declare, run>};

}  // namespace fastsplat::cli
