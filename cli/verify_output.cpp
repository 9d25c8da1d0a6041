// SPDX-License-Identifier: Apache-2.0
#include "cli/verify_output.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/hash_text.hpp"
#include "base/version.hpp"
#include "cli/replay_line.hpp"
#include "cli/rtl_run.hpp"
#include "cli/text_table.hpp"
#include "driver/files/stream_file.hpp"

namespace fastsplat::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kShrinkRuns = 400;
/// Most rows of a list, to keep results small.
constexpr std::size_t kMost = 2000;

const char* where(const testbench::PlantedFault& fault) {
  return fault.where == testbench::PlantedFault::Where::Rtl ? "rtl" : "ports";
}

/// Adds failed seeds and the first others, to keep results small.
void add_seeds(Json& json, const std::vector<testbench::SeedResult>& by_seed) {
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

/// Adds failed streams and the first others.
void add_streams(Json& json, const std::vector<testbench::StreamResult>& by_stream) {
  if (by_stream.empty()) return;
  std::size_t left_out = 0;
  Json rows = Json::array();
  for (const auto& stream : by_stream) {
    if (stream.verdict == testbench::Verdict::Pass && rows.size() >= kMost) {
      ++left_out;
      continue;
    }
    rows.push_back({{"seed", stream.seed},
                    {"class", testbench::to_string(stream.which)},
                    {"ready", stream.ready},
                    {"input", stream.input},
                    {"verdict", testbench::to_string(stream.verdict)},
                    {"splats", stream.splats},
                    {"comparisons", stream.comparisons},
                    {"mismatches", stream.mismatches},
                    {"cycles", stream.cycles}});
  }
  json["by_stream"] = std::move(rows);
  json["by_stream_left_out"] = left_out;
}

Json failure_json(const Failure& failure) {
  const auto& report = failure.report;
  return {{"first", report.original},
          {"smallest", report.divergence},
          {"operands", report.operands},
          {"module", report.place ? report.place->module : ""},
          {"instance", report.place ? report.place->instance : ""},
          {"splats_before", report.shrink.splats_before},
          {"splats_after", report.shrink.splats_after},
          {"shrink_runs", report.shrink.runs},
          {"stream", failure.stream},
          {"waveform", failure.waveform},
          {"wave_from", report.wave_from},
          {"wave_to", report.wave_to},
          {"replay", failure.replay},
          {"follow", failure.follow},
          {"unwritten", failure.unwritten}};
}

/// {"snap": n, ..., "other": n}; "other": mismatches of tiles, counters and cycles, which have no tap.
Json mismatches_by_tap(const testbench::CheckReport& check) {
  Json json;
  std::uint64_t other = check.mismatches;
  for (int tap = 0; tap < cmodel::kTapCount; ++tap) {
    const auto count = check.mismatches_by_tap[static_cast<std::size_t>(tap)];
    json[cmodel::to_string(static_cast<cmodel::Tap>(tap))] = count;
    other -= count;
  }
  json["other"] = other;
  return json;
}

Json mismatch_json(const VerifyReport& report, const testbench::StreamDivergence& kept) {
  const auto row = testbench::row_of(report.config, kept.divergence);
  const auto number = [](const auto& value) { return value ? Json(*value) : Json(nullptr); };
  Json json;
  if (!report.by_stream.empty()) {
    json["seed"] = report.by_stream[kept.run].seed;
    json["class"] = testbench::to_string(report.by_stream[kept.run].which);
  }
  json.update({{"tap", row.tap},
               {"tile", number(row.tile)},
               {"sheet", number(row.sheet)},
               {"splat", number(row.splat)},
               {"x", row.x},
               {"y", row.y},
               {"cycle", number(row.cycle)},
               {"what", row.what},
               {"expected", row.expected},
               {"got", row.got}});
  return json;
}

}  // namespace

Failure investigate(const Checked& checked, const VerifyArguments& arguments, const ConfigFlags& config,
                    const std::string& prefix) {
  Failure failure;
  if (!prefix.empty()) {
    failure.stream = prefix + ".fss";
    failure.waveform = prefix + ".fst";
  }
  failure.report =
      testbench::investigate(checked.source, checked.options, checked.failed, failure.waveform, kShrinkRuns);
  if (!failure.report.no_waveform.empty()) {
    failure.unwritten.push_back(failure.report.no_waveform);
    failure.waveform.clear();
  }
  if (failure.stream.empty()) return failure;
  try {
    driver::write_beats(failure.stream, testbench::write_document(checked.options.config, failure.report.document));
    failure.replay = replay_line(failure.stream, config, failure.report.options, arguments.fault);
    if (failure.report.pixel) failure.follow = pixel_line(failure.stream, config, *failure.report.pixel);
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
                     report.shrink.finished ? "" : " (a smaller one may exist)") +
         "smallest stream: " + report.divergence + "\n" +
         (report.operands.empty() ? "" : "  " + report.operands + "\n") +
         (report.stopped_by.empty() ? "" : "  then " + report.stopped_by + "\n") +
         (report.place ? fmt::format("look at: {} ({})\n", report.place->instance, report.place->module) : "") +
         (failure.waveform.empty()
              ? ""
              : fmt::format("waveform: {} (cycles {} to {})\n", failure.waveform, report.wave_from, report.wave_to)) +
         (failure.follow.empty() ? "" : "model's words: " + failure.follow + "\n") +
         (failure.replay.empty() ? "" : "replay: " + failure.replay + "\n");
}

std::string in_short(testbench::Verdict verdict, const Failure& failure, const std::string& fault) {
  std::string text = fault.empty() ? "" : "planted fault " + fault + ": ";
  text += fmt::format("{}: {}", testbench::to_string(verdict), failure.report.original);
  for (const auto& why : failure.unwritten) text += "; " + why;
  if (!failure.waveform.empty()) text += "; waveform: " + failure.waveform;
  if (!failure.replay.empty()) text += "; replay: " + failure.replay;
  return text;
}

std::string to_text(const Gain& gain) {
  return fmt::format("coverage: {} of {} bins hit, in {}\n", gain.hit, gain.bins, gain.path);
}

std::string saved_text(const std::vector<SavedStream>& saved, std::size_t streams) {
  const std::string count = counted(streams, "stream");
  return fmt::format("saved: {}; replay of {}: {}",
                     saved.size() == streams ? count : fmt::format("{} of {}", grouped(saved.size()), count),
                     saved.back().file, saved.back().replay);
}

std::string planted_text(const VerifyArguments& arguments) {
  if (arguments.fault.empty()) return {};
  const auto& fault = testbench::planted_fault_from(arguments.fault);
  return fmt::format("planted fault {} ({}): {}\n", fault.name,
                     fault.where == testbench::PlantedFault::Where::Rtl ? "in the RTL" : "at the ports", fault.meaning);
}

std::string to_text(const VerifyReport& result) {
  const auto& run = result.run;
  return planted_text(result.arguments) +
         fmt::format("{}: configuration {} {}, {} comparisons, {}\n", testbench::to_string(run.verdict),
                     result.config.name, hash_text(cmodel::config_hash(result.config)), grouped(run.check.comparisons),
                     mismatches_text(run.check)) +
         fmt::format("{}, {}, {}, {}\n", counted(result.streams, "stream"), counted(run.counters.splats, "splat"),
                     counted(run.counters.windows, "window"),
                     counted(run.check.cycles_rtl.value_or(run.last_cycle), "cycle"));
}

std::string mismatches_text(const VerifyReport& report) {
  if (!report.arguments.all_mismatches || report.run.check.mismatches == 0) return {};
  const bool campaign = !report.by_stream.empty();
  TextTable table;
  if (campaign) table.columns = {"seed", "class"};
  for (const char* name : {"tap", "tile", "sheet", "splat", "at", "cycle", "what", "expected", "got"})
    table.columns.emplace_back(name);
  const auto number = [](const auto& value) { return value ? fmt::format("{}", *value) : std::string("-"); };
  for (const auto& kept : report.kept) {
    const auto row = testbench::row_of(report.config, kept.divergence);
    std::vector<std::string> cells;
    if (campaign) {
      const auto& stream = report.by_stream[kept.run];
      cells = {fmt::format("{}", stream.seed), testbench::to_string(stream.which)};
    }
    for (std::string cell : {std::string(row.tap), number(row.tile), number(row.sheet), number(row.splat),
                             fmt::format("({},{})", row.x, row.y), number(row.cycle), row.what, row.expected, row.got})
      cells.push_back(std::move(cell));
    table.rows.push_back(std::move(cells));
  }
  std::string text = fmt::format(
      "{} of {}:\n", grouped(report.kept.size()),
      grouped(report.run.check.mismatches) + (report.run.check.mismatches == 1 ? " mismatch" : " mismatches"));
  if (!report.kept.empty()) text += to_text(table);
  text += "by tap:";
  const Json by_tap = mismatches_by_tap(report.run.check);
  for (const auto& [tap, count] : by_tap.items())
    text += fmt::format(" {} {}{}", tap, grouped(count.get<std::uint64_t>()), tap == "other" ? "\n" : ",");
  for (const auto& difference : report.run.check.differences) text += "other: " + difference + "\n";
  return text;
}

nlohmann::ordered_json to_json(const VerifyReport& result) {
  const auto& arguments = result.arguments;
  const auto& config = result.config;
  const auto& run = result.run;
  Json json{{"verb", "verify"},
            {"version", program_version()},
            {"verdict", testbench::to_string(run.verdict)},
            {"comparisons", run.check.comparisons},
            {"mismatches", run.check.mismatches},
            {"stopped", run.check.stopped},
            {"streams", result.streams},
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
  if (!arguments.fault.empty()) {
    const auto& fault = testbench::planted_fault_from(arguments.fault);
    json["planted_fault"] = {{"name", fault.name}, {"where", where(fault)}, {"meaning", fault.meaning}};
  }
  add_seeds(json, result.by_seed);
  add_streams(json, result.by_stream);
  if (result.resets_late > 0) json["resets_late"] = result.resets_late;
  if (arguments.all_mismatches) {
    json["mismatches_by_tap"] = mismatches_by_tap(run.check);
    Json rows = Json::array();
    for (const auto& kept : result.kept) rows.push_back(mismatch_json(result, kept));
    json["all_mismatches"] = std::move(rows);
  }
  if (result.failure) json["failure"] = failure_json(*result.failure);
  for (const auto& [file, replay] : result.saved) json["saved"].push_back({{"stream", file}, {"replay", replay}});
  if (!result.unwritten.empty()) json["unwritten"] = result.unwritten;
  if (!result.wave.file.empty()) json["wave"] = to_json(result.wave);
  if (const auto& coverage = result.coverage) json["coverage"] = {{"bins", coverage->bins}, {"hit", coverage->hit}};
  json["seconds"] = result.seconds;
  return json;
}

std::string fault_list_text() {
  TextTable table{.columns = {"fault", "where", "what is broken"}, .rows = {}};
  for (const auto& fault : testbench::planted_faults()) table.rows.push_back({fault.name, where(fault), fault.meaning});
  return to_text(table) + fmt::format(
                              "rtl: in the RTL of configuration {0} (SAMPLE_: {1}, CULL_: {2}, POST_: {3}), which "
                              "becomes the default of --config; ports: in any configuration\n",
                              testbench::kBreakableConfig, testbench::kBreakableSamples, testbench::kBreakableCull,
                              testbench::kBreakablePost);
}

nlohmann::ordered_json fault_list_json() {
  Json faults = Json::array();
  for (const auto& fault : testbench::planted_faults())
    faults.push_back({{"name", fault.name}, {"where", where(fault)}, {"meaning", fault.meaning}});
  return {{"verb", "verify --fault list"}, {"version", program_version()}, {"faults", std::move(faults)}};
}

}  // namespace fastsplat::cli
