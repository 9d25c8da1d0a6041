// SPDX-License-Identifier: Apache-2.0
#include "testbench/coverage/coverage_collector.hpp"

#include <algorithm>

namespace fastsplat::testbench {
namespace {

/// False for counters that cannot rise, because the configuration's largest operands do not overflow.
bool reachable(const cmodel::Config& config, const std::string& counter) {
  if (counter == "snap_saturated")
    return cmodel::narrowing(config, cmodel::Site::Snap)(config.position_format().max).overflow;
  if (counter == "product_saturated")
    return cmodel::narrowing(config, cmodel::Site::Product)(config.colour_format().max * config.weight_format().max)
        .overflow;
  return true;
}

}  // namespace

CoverageCollector::CoverageCollector(const cmodel::Config& config, cmodel::StreamScope scope, CoverageRun run)
    : config_(config),
      scope_(scope),
      run_(run),
      decode_(config, scope),
      stream_(config, coverage_),
      splats_(config, coverage_),
      composite_(config, coverage_, splats_),
      times_(config, run_.sliced, coverage_),
      resets_(config, coverage_),
      model_(config, scope, pixels_, &taps_) {
  cmodel::Counters{}.for_each([&](const char* name, std::uint64_t, const char*) {
    if (reachable(config_, name)) coverage_.declare("counter", name);
  });
  if (config_.culls()) cull_.emplace(config_, coverage_);
}

Coverage CoverageCollector::declare(const cmodel::Config& config) {
  return CoverageCollector(config, cmodel::StreamScope::Subset, {}).coverage();
}

void CoverageCollector::interrupted(std::span<const cmodel::Beat> beats, std::uint64_t first_beat,
                                    std::uint64_t cycle) {
  cmodel::CycleModel model(config_, cmodel::StreamScope::Subset,
                           {.input = run_.source,
                            .output = run_.sink,
                            .first_beat = first_beat,
                            .sliced = run_.sliced,
                            .taps = nullptr,
                            .spans = &resets_});
  model.consume(beats);
  resets_.reset(cycle);
}

void CoverageCollector::start(std::uint64_t first_beat) {
  cycles_.emplace(config_, scope_,
                  cmodel::CycleOptions{.input = run_.source,
                                       .output = run_.sink,
                                       .first_beat = first_beat,
                                       .sliced = run_.sliced,
                                       .taps = &times_,
                                       .spans = &times_,
                                       .culls = &culls_});
  model_.log_culls(&culls_);
}

void CoverageCollector::before(const cmodel::Record& record) {
  stream_.on_record(record);
  if (const auto* splat = std::get_if<cmodel::SplatRecord>(&record)) {
    splats_.splat(*splat);
  } else if (const auto* ellipse = std::get_if<cmodel::EllipseRecord>(&record)) {
    splats_.ellipse(*ellipse);
  } else if (const auto* tile = std::get_if<cmodel::BeginTile>(&record)) {
    mode_ = tile->mode;
    splats_.begin_tile(*tile);
    composite_.begin_tile(*tile);
    times_.begin_tile(*tile);
  } else if (const auto* table = std::get_if<cmodel::LoadTable>(&record)) {
    splats_.load(*table);
    composite_.load(*table);
  }
}

void CoverageCollector::consume(std::span<const cmodel::Beat> beats) {
  for (const auto& beat : beats) {
    const cmodel::Record* record = decode_.feed(beat);
    if (record != nullptr) before(*record);
    model_.consume({&beat, 1});
    if (cull_ && record != nullptr) cull_->after(*record, model_.culls(), culls_);
    cycles_->consume({&beat, 1});
  }
}

void CoverageCollector::finish() {
  decode_.finish();
  model_.finish();
  cycles_->finish();
  times_.stalls(cycles_->stalls());
  if (cull_) cull_->finish(cycles_->account());
  counter_bins();
}

void CoverageCollector::counter_bins() {
  model_.counters().for_each([&](const char* name, std::uint64_t value, const char*) {
    if (value > 0) coverage_.hit(coverage_.declare("counter", name), value);
  });
}

}  // namespace fastsplat::testbench
