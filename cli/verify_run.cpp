// SPDX-License-Identifier: Apache-2.0
#include "cli/verify_run.hpp"

#include <fmt/format.h>

#include <limits>

#include "base/error.hpp"
#include "base/hash_text.hpp"
#include "cli/names.hpp"
#include "cli/volume_json.hpp"
#include "driver/config/config_file.hpp"
#include "driver/files/stream_file.hpp"
#include "driver/tiles/compile.hpp"

namespace fastsplat::cli {
namespace {

/// UserError (Usage) if the configuration's RTL does not have the fault.
const testbench::PlantedFault& fault_of(const VerifyArguments& arguments, const cmodel::Config& config) {
  const auto& fault = testbench::planted_fault_from(arguments.fault);
  const std::string name = testbench::breakable_config(fault);
  const auto breakable = cmodel::config_hash(driver::load_config(name));
  if (fault.where == testbench::PlantedFault::Where::Rtl && cmodel::config_hash(config) != breakable) {
    throw_usage({.where = "--fault " + arguments.fault,
                 .what = "exists only in the RTL of configuration " + name,
                 .expected = hash_text(breakable),
                 .got = config.name + " " + hash_text(cmodel::config_hash(config)),
                 .fix = "leave out --config, or plant a fault at the ports of any configuration (see --fault list)"});
  }
  return fault;
}

Checked verify_one(cmodel::BeatSource source, const testbench::VerifyOptions& options, const char* campaign) {
  Checked out;
  out.result = out.failed = testbench::verify(source, options);
  if (out.result.coverage) out.coverage[campaign] = *out.result.coverage;
  for (const auto& divergence : out.result.check.kept) out.kept.push_back({.run = 0, .divergence = divergence});
  out.source = std::move(source);
  out.options = options;
  return out;
}

constexpr auto kLastSeed = static_cast<std::uint64_t>(std::numeric_limits<long>::max());
/// A stream is built completely before it runs, at about 150 bytes per splat.
constexpr int kMostSplats = 10'000'000;

void check_numbers(const VerifyArguments& arguments) {
  // --seed must accept every seed of the run, because a failure's replay line names it.
  const auto more = static_cast<std::uint64_t>(arguments.seeds) - 1;
  if (arguments.seed > kLastSeed - more) {
    throw_usage({.where = fmt::format("--seed {} --seeds {}", arguments.seed, arguments.seeds),
                 .what = "the last seeds exceed the limit of --seed",
                 .expected = fmt::format("--seed of at most {}", kLastSeed - more),
                 .got = std::to_string(arguments.seed),
                 .fix = "lower --seed or --seeds"});
  }
  if (arguments.random.value_or(0) > kMostSplats) {
    throw_usage({.where = "--random",
                 .what = "streams of this many splats do not fit into memory",
                 .expected = fmt::format("at most {}", kMostSplats),
                 .got = std::to_string(*arguments.random),
                 .fix = "lower --random and raise --seeds"});
  }
}

}  // namespace

void declare(Options& options, VerifyArguments& to) {
  options.group("Stimulus");
  options.word("--stream", to.stream, "FILE", "verify a recorded stream, .fss");
  options.integer("--random", to.random, 1, 1'000'000'000, "N", "verify random streams of about N splats per seed");
  options.word("--class", to.stimulus, "NAME", "random: stimulus class (all)");
  options.values(stimulus_words);
  options.integer("--seed", to.seed, 0, std::numeric_limits<long>::max(), "S",
                  "seed of random streams, patterns and reset fill");
  options.integer("--seeds", to.seeds, 1, 1'000'000, "N", "random: runs with seeds S, S+1, ...");
  options.integer("--jobs", to.jobs, 0, 1024, "N",
                  "random: streams in parallel, as --threads; results do not depend on it");
  options.group("Device");
  declare(options, to.config, "hardware configuration with RTL");
  options.word("--ready", to.ready, "PATTERN",
               "ready pattern of the sink: always, every-N, alternate-N, random-PERCENT, burst-N; random: all uses "
               "each in turn");
  options.values(ready_words);
  options.word("--input", to.input, "PATTERN", "valid pattern of the source, as above");
  options.values(pattern_words);
  options.choice("--fill", to.fill, {"zero", "one", "random"}, "zero|one|random",
                 "content of registers and memories before reset");
  options.integer("--reset-after", to.reset_after, 1, 2'000'000'000, "N",
                  "warm reset after N beats, then the whole stream");
  options.word("--fault", to.fault, "NAME", "plant a fault on purpose to see a failure; list: print all faults");
  options.values([] {
    auto names = testbench::planted_fault_names();
    names.emplace_back("list");
    return names;
  });
  options.group("Output");
  options.word("--coverage", to.coverage, "FILE", "write functional coverage as JSON, added to the content of FILE");
  options.word(
      "--failure", to.failure, "PREFIX",
      "write a failure's small stream to PREFIX.fss, its waveform to PREFIX.fst, its GTKWave view to PREFIX.gtkw");
  options.integer("--all-mismatches", to.all_mismatches, 1, 100'000, "N",
                  "continue after a mismatch, and print the first N mismatches in one table");
  options.word("--save-stream", to.save_stream, "FILE",
               "random: write the stream, .fss; with several streams, # in the name become their numbers");
  options.word("--junit", to.junit, "FILE", "write the result as JUnit XML, one case per stream");
  declare(options, to.wave);
  declare(options, to.scene);
  declare(options, to.gaussians);
  declare(options, to.common);
  options.example("fastsplat verify --random 1000 --seed 7 --config tiny --ready random-50",
                  "RTL against model on random streams, every tap compared");
  options.example("fastsplat verify --stream shells.fss --config tiny --coverage book.json",
                  "a recorded stream, accumulating coverage");
  options.example("fastsplat verify --random 100000 --seeds 100 --jobs 2 --config tiny --json night.json",
                  "an overnight campaign", Example::Slow);
}

Source source_from(const VerifyArguments& arguments) {
  const auto& scene = arguments.scene;
  const bool has_scene = scene.file || scene.volume || arguments.gaussians.file;
  if (!arguments.gaussians.file) refuse_without_gaussians(arguments.gaussians);
  const int given = (has_scene ? 1 : 0) + (arguments.stream.empty() ? 0 : 1) + (arguments.random ? 1 : 0);
  if (given != 1) {
    throw_usage({.where = {},
                 .what = given == 0 ? "nothing to verify" : "more than one thing to verify",
                 .expected = "one of --random N, --stream FILE, --volume NAME, --scene FILE or --gaussians FILE",
                 .got = {},
                 .fix = "for example --random 1000"});
  }
  if (!has_scene && !(scene == SceneFlags{})) {
    throw_usage({.where = arguments.random ? "--random" : "--stream",
                 .what = "cannot be combined with a scene's flags",
                 .expected = {},
                 .got = {},
                 .fix = "leave them out, or verify a scene with --volume NAME or --scene FILE"});
  }
  if (!arguments.random && (arguments.seeds != 1 || arguments.stimulus != "all" || arguments.ready == "all")) {
    throw_usage({.where = {},
                 .what = "--seeds, --class and --ready all require --random",
                 .expected = {},
                 .got = {},
                 .fix = "add --random N, or leave them out"});
  }
  check_numbers(arguments);
  if (!arguments.random && !arguments.save_stream.empty()) {
    throw_usage({.where = "--save-stream",
                 .what = "applies to random streams only",
                 .expected = {},
                 .got = {},
                 .fix = "add --random N, or write the stream of a scene with `fastsplat stream record`"});
  }
  if (!arguments.fault.empty() && !arguments.coverage.empty()) {
    throw_usage({.where = "--coverage",
                 .what = "cannot be combined with --fault: a broken device covers nothing",
                 .expected = {},
                 .got = {},
                 .fix = "leave out --fault or --coverage"});
  }
  if (arguments.jobs && arguments.common.threads != 0 && *arguments.jobs != arguments.common.threads) {
    throw_usage({.where = "--jobs",
                 .what = "contradicts --threads, which means the same",
                 .expected = std::to_string(arguments.common.threads),
                 .got = std::to_string(*arguments.jobs),
                 .fix = "use one of them"});
  }
  return has_scene ? Source::Scene : arguments.random ? Source::Random : Source::Stream;
}

std::uint64_t stream_count(const VerifyArguments& arguments, Source source) {
  if (source != Source::Random) return 1;
  return static_cast<std::uint64_t>(arguments.seeds) *
         (arguments.stimulus == "all" ? testbench::stimulus_classes().size() : 1);
}

testbench::VerifyOptions options_from(const VerifyArguments& arguments, const cmodel::Config& config) {
  testbench::VerifyOptions options{.config = config,
                                   .ready = arguments.ready,
                                   .input = arguments.input,
                                   .fill = testbench::reset_fill_from(arguments.fill),
                                   .seed = arguments.seed,
                                   .reset_after = static_cast<std::uint64_t>(arguments.reset_after.value_or(0)),
                                   .wave = {},
                                   .coverage = !arguments.coverage.empty(),
                                   .device = {}};
  if (!arguments.fault.empty()) options.device = testbench::with_fault(fault_of(arguments, config), config);
  if (arguments.all_mismatches) {
    options.stop_after = std::numeric_limits<std::uint64_t>::max();
    options.keep = static_cast<std::size_t>(*arguments.all_mismatches);
  }
  if (options.ready != "all") testbench::Pattern(options.ready, 0);  // rejects unknown patterns before any work
  testbench::Pattern(options.input, 0);
  if (arguments.stimulus != "all") testbench::stimulus_class_from(arguments.stimulus);
  return options;
}

testbench::CampaignOptions campaign_from(const VerifyArguments& arguments, const testbench::VerifyOptions& options) {
  testbench::CampaignOptions campaign{.verify = options,
                                      .splats = static_cast<std::uint64_t>(*arguments.random),
                                      .seeds = static_cast<std::uint64_t>(arguments.seeds),
                                      .keep_going = arguments.all_mismatches.has_value(),
                                      .as_files = !arguments.save_stream.empty(),
                                      .threads = arguments.jobs.value_or(arguments.common.threads),
                                      .progress = {}};
  if (arguments.stimulus != "all") campaign.classes = {testbench::stimulus_class_from(arguments.stimulus)};
  return campaign;
}

Checked verify_stream(const VerifyArguments& arguments, const testbench::VerifyOptions& options) {
  const std::string path = arguments.stream;
  Checked out;
  driver::naming(path, [&] {
    out = verify_one([path](const cmodel::BeatSink& sink) { driver::read_beats(path, sink); }, options, "stream");
  });
  // Same check as in replay and cycles; a device's failure is reported first.
  const auto verdict = out.result.verdict;
  if (verdict == testbench::Verdict::Pass || verdict == testbench::Verdict::NothingCompared)
    driver::require_covered(path);
  return out;
}

Checked verify_random(const VerifyArguments& arguments, const testbench::VerifyOptions& options,
                      const Progress& progress) {
  auto campaign = campaign_from(arguments, options);
  campaign.progress = progress;
  const auto result = testbench::run_campaign(campaign);
  Checked out;
  out.result = result.total;
  out.streams = result.streams;
  out.resets_late = result.resets_late;
  out.by_seed = result.by_seed;
  out.by_stream = result.by_stream;
  out.kept = result.kept;
  for (const auto& [which, coverage] : result.coverage) out.coverage[testbench::to_string(which)] = coverage;
  if (result.failed || result.streams == 1) {
    auto run = testbench::make_run(campaign, result.failed.value_or(0));
    if (result.failure) out.failed = *result.failure;
    out.source = testbench::source_of(std::move(run.beats));
    out.options = run.options;
  }
  return out;
}

Checked verify_scene(const VerifyArguments& arguments, testbench::VerifyOptions options, const Progress& progress,
                     const Output& output) {
  options.scope = cmodel::StreamScope::Subset;
  const auto emitting = [&](auto compiled) -> cmodel::BeatSource {
    return [compiled, progress](const cmodel::BeatSink& sink) { compiled->emit(sink, progress); };
  };
  cmodel::BeatSource source;
  if (arguments.gaussians.file) {
    const auto scene = build(arguments.gaussians, describe_for_device(arguments.gaussians, arguments.scene));
    output.remark(remarks(*scene.cloud));
    source = emitting(
        std::make_shared<const driver::GaussianFrame>(compile(scene, options.config, arguments.common, output)));
  } else {
    const auto scene = build(arguments.scene);
    output.remark(remarks(*scene.volume));
    source = emitting(std::make_shared<const driver::CompiledFrame>(scene, options.config));
  }
  Checked out = verify_one(source, options, "scene");
  // Without splats, the pixels are equal even if the device is wrong.
  if (out.result.verdict == testbench::Verdict::Pass && out.result.counters.splats == 0)
    out.result.verdict = testbench::Verdict::NothingCompared;
  return out;
}

}  // namespace fastsplat::cli
