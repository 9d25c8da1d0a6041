// SPDX-License-Identifier: Apache-2.0
#include "testbench/stimulus/campaign.hpp"

#include <algorithm>
#include <atomic>
#include <mutex>

#include "base/parallel/parallel.hpp"
#include "testbench/coverage/coverage_collector.hpp"

namespace fastsplat::testbench {
namespace {

void add(VerifyResult& total, const VerifyResult& part) {
  total.check.comparisons += part.check.comparisons;
  total.check.mismatches += part.check.mismatches;
  total.check.stopped = total.check.stopped || part.check.stopped;
  for (std::size_t i = 0; i < part.check.by_tap.size(); ++i) {
    total.check.by_tap[i] += part.check.by_tap[i];
    total.check.mismatches_by_tap[i] += part.check.mismatches_by_tap[i];
  }
  total.counters += part.counters;
  total.last_cycle += part.last_cycle;
  const auto add_to = [](std::optional<std::uint64_t>& sum, const std::optional<std::uint64_t>& more) {
    if (more) sum = sum.value_or(0) + *more;
  };
  add_to(total.check.cycles_rtl, part.check.cycles_rtl);
  add_to(total.check.cycles_model, part.check.cycles_model);
}

void add(std::vector<SeedResult>& seeds, std::uint64_t seed, const VerifyResult& part) {
  if (seeds.empty() || seeds.back().seed != seed) seeds.push_back({.seed = seed});
  SeedResult& to = seeds.back();
  ++to.streams;
  to.splats += part.counters.splats;
  to.comparisons += part.check.comparisons;
  to.mismatches += part.check.mismatches;
  to.cycles += part.check.cycles_rtl.value_or(0);
  if (to.verdict == Verdict::Pass) to.verdict = part.verdict;
}

StreamDocument as_file(const StreamDocument& document) {
  StreamDocument out = arranged(document);
  std::int64_t pixels = 0;
  for (const auto& tile : out.tiles) pixels += std::int64_t{tile.begin.width} * std::int64_t{tile.begin.height};
  if (pixels == std::int64_t{out.width} * out.height) return out;
  throw_usage({.where = "a random stream",
               .what = "has more tiles than fit into the image of a file",
               .expected = {},
               .got = std::to_string(out.tiles.size()) + " tiles",
               .fix = "use fewer splats with --random, or another --class"});
}

}  // namespace

std::size_t run_count(const CampaignOptions& options) {
  return static_cast<std::size_t>(options.seeds) * options.classes.size();
}

CampaignRun make_run(const CampaignOptions& options, std::size_t index) {
  const std::size_t classes = options.classes.size(), which = index % classes;
  CampaignRun run{.which = options.classes[which], .options = options.verify, .beats = {}};
  run.options.seed += index / classes;
  const std::uint64_t share = options.splats / classes + (which < options.splats % classes ? 1 : 0);
  Stimulus stimulus = make_stimulus(options.verify.config, run.which, run.options.seed, share);
  if (options.as_files) stimulus.document = as_file(stimulus.document);
  if (run.options.ready == "all") {
    // Over the seeds each class meets each pattern.
    const auto patterns = Pattern::examples();
    run.options.ready = patterns[(which + index / classes) % patterns.size()];
  }
  if (run.options.input == "all") {
    // In reverse, so that over the seeds the pairs change as well.
    const auto patterns = Pattern::examples();
    run.options.input = patterns[(which + (patterns.size() - 1) * (index / classes)) % patterns.size()];
  }
  if (!stimulus.ready.empty() && run.options.ready == "always") run.options.ready = stimulus.ready;
  if (!stimulus.input.empty() && run.options.input == "always") run.options.input = stimulus.input;
  if (run.options.reset_after == 0) run.options.reset_after = stimulus.reset_after;
  run.beats = write_document(options.verify.config, stimulus.document);
  run.reset_late = run.options.reset_after > run.beats.size();
  if (run.reset_late) run.options.reset_after = run.beats.size();
  return run;
}

CampaignResult run_campaign(const CampaignOptions& options) {
  const std::size_t count = run_count(options);
  std::vector<std::optional<VerifyResult>> results(count);
  std::vector<StreamResult> streams(count);
  std::vector<char> late(count, 0);
  std::atomic<std::size_t> next = 0, done = 0;
  std::atomic<std::size_t> failed = count;  ///< the first run that did not pass
  std::mutex reporting;
  parallel_for(count, options.threads, [&](std::size_t) {
    // In order, whichever thread takes it: a failure is known as early as possible.
    const std::size_t i = next++;
    if (i > failed) return;
    CampaignRun run = make_run(options, i);
    streams[i] = {.seed = run.options.seed, .which = run.which, .ready = run.options.ready, .input = run.options.input};
    late[i] = run.reset_late;
    results[i] = verify(source_of(std::move(run.beats)), run.options);
    if (results[i]->verdict != Verdict::Pass && !options.keep_going) {
      for (std::size_t first = failed; i < first && !failed.compare_exchange_weak(first, i);) {
      }
    }
    ++done;
    if (options.progress) {
      const std::lock_guard lock(reporting);
      options.progress(done, count);
    }
  });

  CampaignResult out;
  out.total.verdict = Verdict::Pass;
  // Runs behind the failed one do not count: with another number of threads they might not have begun.
  for (std::size_t i = 0; i < count && i <= failed; ++i) {
    add(out.total, *results[i]);
    add(out.by_seed, options.verify.seed + i / options.classes.size(), *results[i]);
    streams[i].verdict = results[i]->verdict;
    streams[i].splats = results[i]->counters.splats;
    streams[i].comparisons = results[i]->check.comparisons;
    streams[i].mismatches = results[i]->check.mismatches;
    streams[i].cycles = results[i]->check.cycles_rtl.value_or(0);
    for (const auto& divergence : results[i]->check.kept)
      if (out.kept.size() < options.verify.keep) out.kept.push_back({.run = i, .divergence = divergence});
    ++out.streams;
    out.resets_late += late[i] != 0 ? 1 : 0;
    if (results[i]->coverage) out.coverage[options.classes[i % options.classes.size()]].merge(*results[i]->coverage);
    if (results[i]->verdict == Verdict::Pass || out.failed) continue;
    out.failed = i;
    out.failure = results[i];
    out.total.verdict = results[i]->verdict;
    out.total.check.detector = results[i]->check.detector;
    out.total.check.first = results[i]->check.first;
    out.total.check.differences = results[i]->check.differences;
    out.total.error = results[i]->error;
  }
  streams.resize(out.streams);
  out.by_stream = std::move(streams);
  if (out.streams == 0) out.total.verdict = Verdict::NothingCompared;
  return out;
}

}  // namespace fastsplat::testbench
