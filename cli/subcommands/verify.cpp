// SPDX-License-Identifier: Apache-2.0
// fastsplat verify: compares the RTL with the model on a scene, a recorded stream or random streams.
#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/atomic_file.hpp"
#include "base/machine_error.hpp"
#include "cli/failure_name.hpp"
#include "cli/frame_names.hpp"
#include "cli/output_names.hpp"
#include "cli/progress_bar.hpp"
#include "cli/replay_line.hpp"
#include "cli/result_writer.hpp"
#include "cli/rtl_run.hpp"
#include "cli/stream_config.hpp"
#include "cli/subcommands/subcommands.hpp"
#include "cli/verify_output.hpp"
#include "driver/files/stream_file.hpp"
#include "report/formats/output_formats.hpp"
#include "testbench/coverage/coverage_book.hpp"

namespace fastsplat::cli {
namespace {

/// Default prefix of a failure's files, without number; never the verified stream itself.
std::string failure_stem(const VerifyArguments& arguments) {
  return arguments.stream.empty() ? "verify-failure"
                                  : std::filesystem::path(arguments.stream).replace_extension().string() + "-smaller";
}

bool has_rtl_fault(const VerifyArguments& arguments) {
  return !arguments.fault.empty() &&
         testbench::planted_fault_from(arguments.fault).where == testbench::PlantedFault::Where::Rtl;
}

/// A fault in the RTL implies its configuration, unless one is given; so do 3-D Gaussians and streams.
ConfigFlags config_of(const VerifyArguments& arguments) {
  ConfigFlags config = arguments.config;
  if (arguments.gaussians.file && !has_rtl_fault(arguments)) return for_gaussians(config);
  if (!arguments.stream.empty() && !has_rtl_fault(arguments)) return for_stream(config, arguments.stream);
  if (arguments.fault.empty() || config.config) return config;
  if (has_rtl_fault(arguments))
    config.config = testbench::breakable_config(testbench::planted_fault_from(arguments.fault));
  return config;
}

/// Files of --save-stream, in the order of the streams.
std::vector<std::string> saved_names(const VerifyArguments& arguments, Source source) {
  if (arguments.save_stream.empty()) return {};
  if (!arguments.save_stream.ends_with(".fss")) {
    throw_usage({.where = "--save-stream " + arguments.save_stream,
                 .what = "the name of a stream file must end in .fss",
                 .expected = {},
                 .got = {},
                 .fix = "for example --save-stream random.fss"});
  }
  const std::uint64_t count = stream_count(arguments, source);
  if (count == 1) return {arguments.save_stream};
  constexpr std::uint64_t kMostFiles = 10'000;
  if (count > kMostFiles || arguments.save_stream.find('#') == std::string::npos) {
    throw_usage({.where = "--save-stream " + arguments.save_stream,
                 .what = fmt::format("the run has {}", counted(count, "stream")),
                 .expected = fmt::format("one, or up to {} and a name with #### for their numbers", kMostFiles),
                 .got = {},
                 .fix = "add --class NAME and leave --seeds at 1, or name random-####.fss"});
  }
  const FrameNames names(arguments.save_stream, static_cast<int>(count), "stream");
  std::vector<std::string> files;
  for (std::uint64_t i = 0; i < count; ++i) files.push_back(names(static_cast<int>(i)));
  return files;
}

void check_wave(const VerifyArguments& arguments, Source source) {
  range_of(arguments.wave);
  if (const auto count = stream_count(arguments, source); !arguments.wave.file.empty() && count > 1) {
    throw_usage({.where = "--wave",
                 .what = fmt::format("a waveform shows one stream, but the run has {}", counted(count, "stream")),
                 .expected = {},
                 .got = {},
                 .fix = "add --class NAME and leave --seeds at 1"});
  }
}

/// Named output files. Files of a failure are included only if named, because a passing run writes none.
std::vector<std::string> named_files(const VerifyArguments& arguments, const std::vector<std::string>& saved) {
  auto names = joined({arguments.common.json, arguments.coverage, arguments.junit, arguments.wave.file}, saved);
  return arguments.failure.empty() ? names : joined(names, failure_files(arguments.failure));
}

void check_files(const VerifyArguments& arguments, const ConfigFlags& config, Source source,
                 const std::vector<std::string>& named) {
  OutputNames names;
  names.others = named;
  names.inputs = inputs_of_config(config.config.value_or(""));
  if (source == Source::Stream) names.inputs.push_back(arguments.stream);
  if (source == Source::Scene)
    names.inputs = joined(joined(names.inputs, inputs_of(arguments.scene)), inputs_of(arguments.gaussians));
  if (arguments.gaussians.file) describe_for_device(arguments.gaussians, arguments.scene);  // refuses bad flags
  check_outputs(names);
}

/// Rejects, before any work, a coverage file that is invalid or belongs to another configuration.
void check_coverage(const std::string& path, const cmodel::Config& config) {
  if (path.empty() || !std::filesystem::exists(path)) return;
  testbench::read_book_for(path, config.name, cmodel::config_hash(config));
}

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

/// Saves the streams that ran: all of a passing campaign, or up to the failed one. Stops at the first write error.
std::vector<SavedStream> save_streams(const VerifyArguments& arguments, const Checked& checked,
                                      const ConfigFlags& config, const testbench::VerifyOptions& options,
                                      const std::vector<std::string>& names, ResultWriter& results) {
  std::vector<SavedStream> saved;
  if (names.empty()) return saved;
  const auto campaign = campaign_from(arguments, options);
  results.write([&] {
    for (std::size_t i = 0; i < checked.by_stream.size(); ++i) {
      const auto run = testbench::make_run(campaign, i);
      driver::write_beats(names[i], run.beats);
      saved.push_back({.file = names[i], .replay = replay_line(names[i], config, run.options, arguments.fault)});
    }
  });
  return saved;
}

bool failed(testbench::Verdict verdict) {
  return verdict == testbench::Verdict::Mismatch || verdict == testbench::Verdict::Simulation;
}

/// Reports the first divergence, then a shrunk one with its files; write errors become warnings. `named`: other files
/// of the command.
Failure look_into(const Checked& checked, const VerifyArguments& arguments, const ConfigFlags& config,
                  const std::vector<std::string>& named, const Output& output) {
  std::string prefix = arguments.failure, no_place;
  std::optional<FailureName> name;
  try {
    if (prefix.empty()) prefix = name.emplace(failure_stem(arguments), named).prefix();
  } catch (const UserError& error) {
    no_place = error.what();
  }
  std::error_code ignored;
  for (const std::string& file : failure_files(prefix)) {
    if (!prefix.empty() && std::filesystem::exists(file, ignored))
      output.note(file + " of an earlier failure will be replaced");
  }
  output.line("first divergence: " + testbench::first_divergence(checked.failed, checked.options.config));
  Failure failure = investigate(checked, arguments, config, prefix);
  if (!no_place.empty()) failure.unwritten.push_back(no_place);
  output.line(to_text(failure));
  for (const auto& why : failure.unwritten) output.warn(why);
  // Even with --quiet, a failure prints its reason.
  if (arguments.common.quiet) print_error(in_short(checked.failed.verdict, failure, arguments.fault));
  return failure;
}

void write_junit(const std::string& path, const nlohmann::ordered_json& json) {
  if (path.empty()) return;
  write_text_file(path, report::to_junit({{.file = path, .subcommand = "verify", .json = json}}));
}

ExitCode list_faults(const VerifyArguments& arguments) {
  const Output output(arguments.common);
  check_outputs({.others = {arguments.common.json}});
  output.line(fault_list_text());
  output.json(fault_list_json());
  return ExitCode::Pass;
}

Checked check(const VerifyArguments& arguments, Source source, const testbench::VerifyOptions& options,
              const Output& output) {
  ProgressBar bar("verifying", watching(arguments.common));
  if (source == Source::Scene) return verify_scene(arguments, options, bar.callback(), output);
  return source == Source::Stream ? verify_stream(arguments, options)
                                  : verify_random(arguments, options, bar.callback());
}

ExitCode verify_and_report(const VerifyArguments& arguments) {
  const Output output(arguments.common);
  const Source source = source_from(arguments);
  const ConfigFlags config_flags = config_of(arguments);
  const auto saved = saved_names(arguments, source);
  const auto named = named_files(arguments, saved);
  check_wave(arguments, source);
  refuse_display(arguments.scene);
  require_file("--junit", arguments.junit);
  require_file("--coverage", arguments.coverage);
  check_files(arguments, config_flags, source, named);
  const auto config = load(config_flags);
  const auto options = options_from(arguments, config);
  auto abilities = wanted_abilities(arguments.wave);
  for (auto& with : abilities) with.faults = has_rtl_fault(arguments);
  prepare_rtl(config, abilities, arguments.common);
  check_coverage(arguments.coverage, config);
  const std::string seed = fmt::format("seed {}", arguments.seed);
  // The seed is printed first, so that it is known if the run dies, and last, where it is seen.
  arguments.common.json == "-" ? output.note(seed) : output.line(seed);

  const Checked checked = check(arguments, source, options, output);
  VerifyReport result{.arguments = arguments,
                      .config = config,
                      .streams = checked.streams,
                      .resets_late = checked.resets_late,
                      .run = checked.result,
                      .by_seed = checked.by_seed,
                      .by_stream = checked.by_stream,
                      .kept = checked.kept,
                      .failure = {},
                      .coverage = {},
                      .saved = {},
                      .wave = {},
                      .unwritten = {}};
  if (!arguments.fault.empty() && result.run.verdict == testbench::Verdict::Pass)
    result.run.verdict = testbench::Verdict::FaultUnseen;
  const auto verdict = result.run.verdict;
  output.line(to_text(result));  // investigating takes time
  if (source == Source::Scene && verdict == testbench::Verdict::NothingCompared) {
    output.warn(
        "no splat of the scene reached the device; try a larger --opacity-scale or --xray-exposure, another --tf or "
        "another --zoom");
  }
  if (verdict == testbench::Verdict::FaultUnseen)
    output.warn(
        "this stimulus does not reveal the fault; try more splats, every --class, --ready all or --reset-after N");
  // As for a failure: even with --quiet, print why the run did not pass.
  if (arguments.common.quiet && verdict != testbench::Verdict::Pass && !failed(verdict))
    print_error(fmt::format("{}{}{}; {}", testbench::to_string(verdict), arguments.fault.empty() ? "" : ": ",
                            arguments.fault, seed));
  if (failed(verdict)) result.failure = look_into(checked, arguments, config_flags, named, output);
  if (const std::string rows = mismatches_text(result); !rows.empty()) output.line(rows);
  if (result.resets_late > 0) {
    output.warn(fmt::format("--reset-after {}: {} of {} {}", *arguments.reset_after, grouped(result.resets_late),
                            counted(result.streams, "stream"),
                            result.resets_late == 1 ? "is shorter, and was reset after its last beat"
                                                    : "are shorter, and were reset after their last beat"));
  }
  ResultWriter results;
  if (!arguments.coverage.empty() && verdict == testbench::Verdict::Pass)
    results.write([&] { result.coverage = save_coverage(checked, arguments.coverage, config); });
  if (result.coverage) output.line(to_text(*result.coverage));
  result.saved = save_streams(arguments, checked, config_flags, options, saved, results);
  if (!result.saved.empty()) output.line(saved_text(result.saved, checked.by_stream.size()));
  result.wave = write_wave(arguments.wave, checked.source, checked.options, checked.result.last_cycle);
  ExitCode code = print_wave(result.wave, testbench::exit_code(verdict), output);
  result.unwritten = results.unwritten();
  result.seconds = output.seconds();
  const auto json = to_json(result);
  results.write([&] { write_junit(arguments.junit, json); });
  results.write([&] { output.json(json); });
  code = results.report_failures(code, output);
  arguments.common.json == "-" ? output.note(seed) : output.line(seed);
  return code;
}

ExitCode run(const VerifyArguments& arguments) {
  if (arguments.fault == "list") return list_faults(arguments);
  try {
    return verify_and_report(arguments);
  } catch (const std::bad_alloc&) {
    if (!arguments.stream.empty()) {
      throw_machine({.where = arguments.stream,
                     .what = "not enough memory to verify this stream",
                     .expected = {},
                     .got = {},
                     .fix = "record it at a smaller --size"});
    }
    if (!arguments.random) throw;  // the scene takes the memory: handled as everywhere
    throw_machine({.where = fmt::format("--random {}", *arguments.random),
                   .what = "not enough memory for streams of this many splats",
                   .expected = {},
                   .got = {},
                   .fix = "lower --random and raise --seeds, or use fewer --jobs to hold fewer streams at once"});
  }
}

}  // namespace

const Subcommand subcommands::verify{"verify", "compare every tap, pixel and counter of the RTL with the model",
                                     subcommand<VerifyArguments, declare, run>};

}  // namespace fastsplat::cli
