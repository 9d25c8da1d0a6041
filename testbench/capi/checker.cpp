// SPDX-License-Identifier: Apache-2.0
// The checker of the C interface.
#include <memory>

#include "testbench/capi/checker_run.hpp"
#include "testbench/capi/config_handle.hpp"
#include "testbench/capi/guard.hpp"
#include "testbench/capi/handles.hpp"

struct fastsplat_checker {
  fastsplat::capi::CheckerSetup setup;
  std::unique_ptr<fastsplat::capi::CheckerRun> run = std::make_unique<fastsplat::capi::CheckerRun>(setup);
  mutable std::string text = {};  ///< the text returned last
};

namespace fastsplat::capi {
namespace {

template <class Checker>
Checker& live(const char* call, Checker* checker) {
  require_live(call, checker, Kind::Checker);
  return *checker;
}

CheckerSetup setup_of(const char* call, const cmodel::Config& config, const fastsplat_checker_options* options) {
  CheckerSetup setup{.config = config, .patterns = {}};
  if (options == nullptr) return setup;
  require_size(call, sizeof *options, options->struct_size);
  require_scope(call, options->scope);
  if (options->scope == FASTSPLAT_SUBSET) setup.scope = cmodel::StreamScope::Subset;
  if (options->stop_after > 0) setup.stop_after = options->stop_after;
  setup.verdicts = options->verdicts != 0;
  const auto text = [](const char* pattern) { return pattern == nullptr ? "always" : pattern; };
  setup.patterns = testbench::patterns_of(text(options->input_pattern), text(options->output_pattern), options->seed);
  return setup;
}

/// The text of `say`, kept with the checker; "" if the checker is not a live one.
template <class Say>
const char* kept_text(const fastsplat_checker* checker, const char* function, Say say) {
  const char* out = "";
  guarded(function, [&](const char* call) {
    const auto& of = live(call, checker);
    of.text = say(*of.run);
    out = of.text.c_str();
    return FASTSPLAT_OK;
  });
  return out;
}

}  // namespace

extern "C" FASTSPLAT_API fastsplat_status fastsplat_checker_create(const fastsplat_config* config,
                                                                   const fastsplat_checker_options* options,
                                                                   fastsplat_checker** out) {
  return guarded(__func__, [&](const char* call) {
    require(call, "out", out);
    auto checker = std::make_unique<fastsplat_checker>(
        fastsplat_checker{.setup = setup_of(call, config_of(call, config), options)});
    born(checker.get(), Kind::Checker);
    *out = checker.release();
    return FASTSPLAT_OK;
  });
}

extern "C" FASTSPLAT_API fastsplat_status fastsplat_checker_destroy(fastsplat_checker* checker) {
  return guarded(__func__, [&](const char* call) {
    if (checker == nullptr) return FASTSPLAT_OK;
    bury(call, checker, Kind::Checker);
    delete checker;
    return FASTSPLAT_OK;
  });
}

extern "C" FASTSPLAT_API fastsplat_status fastsplat_checker_reset(fastsplat_checker* checker) {
  return guarded(__func__, [&](const char* call) {
    auto& of = live(call, checker);
    of.run = std::make_unique<CheckerRun>(of.setup);
    return FASTSPLAT_OK;
  });
}

extern "C" FASTSPLAT_API fastsplat_status fastsplat_checker_start(fastsplat_checker* checker,
                                                                  std::uint64_t first_beat) {
  return guarded(__func__, [&](const char* call) {
    live(call, checker).run->start(call, first_beat);
    return FASTSPLAT_OK;
  });
}

extern "C" FASTSPLAT_API fastsplat_status fastsplat_checker_took(fastsplat_checker* checker, const std::uint32_t* words,
                                                                 std::size_t beats) {
  return guarded(__func__, [&](const char* call) {
    auto& of = live(call, checker);
    if (beats > 0) require(call, "words", words);
    of.run->took(call, words, beats);
    return FASTSPLAT_OK;
  });
}

extern "C" FASTSPLAT_API fastsplat_status fastsplat_checker_port_words(const fastsplat_checker* checker,
                                                                       std::uint32_t port, std::size_t* out) {
  return guarded(__func__, [&](const char* call) {
    const auto& of = live(call, checker);
    require(call, "out", out);
    if (port >= FASTSPLAT_PORTS) unknown_port(call, port);
    *out = port_words(of.setup.config, port);
    return FASTSPLAT_OK;
  });
}

extern "C" FASTSPLAT_API fastsplat_status fastsplat_checker_showed(fastsplat_checker* checker,
                                                                   const fastsplat_shown* shown) {
  return guarded(__func__, [&](const char* call) {
    auto& of = live(call, checker);
    require_size(call, sizeof *shown, require(call, "shown", shown)->struct_size);
    of.run->showed(call, *shown);
    return FASTSPLAT_OK;
  });
}

extern "C" FASTSPLAT_API fastsplat_status fastsplat_checker_stopped(const fastsplat_checker* checker,
                                                                    std::int32_t* stopped) {
  return guarded(__func__, [&](const char* call) {
    const auto& of = live(call, checker);
    *require(call, "stopped", stopped) = of.run->stopped() ? 1 : 0;
    return FASTSPLAT_OK;
  });
}

extern "C" FASTSPLAT_API fastsplat_status fastsplat_checker_finish(fastsplat_checker* checker,
                                                                   const std::uint64_t* values, std::size_t count) {
  return guarded(__func__, [&](const char* call) -> fastsplat_status {
    auto& of = live(call, checker);
    if (count > 0) require(call, "values", values);
    of.run->finish(call, {values, count});
    if (of.run->verdict() == FASTSPLAT_VERDICT_PASS) return FASTSPLAT_OK;
    const std::string first = of.run->first_mismatch();
    return fail(FASTSPLAT_FAILED, (of.run->summary() + (first.empty() ? "" : "; " + first)).c_str());
  });
}

extern "C" FASTSPLAT_API fastsplat_status fastsplat_checker_report(const fastsplat_checker* checker,
                                                                   fastsplat_report* out) {
  return guarded(__func__, [&](const char* call) {
    const auto& of = live(call, checker);
    require_size(call, sizeof *out, require(call, "out", out)->struct_size);
    const auto report = of.run->report();
    out->verdict = of.run->verdict();
    out->detector = report.detector ? static_cast<std::int32_t>(*report.detector) : -1;
    out->comparisons = report.comparisons;
    out->mismatches = report.mismatches;
    std::copy(report.by_tap.begin(), report.by_tap.end(), out->by_tap);
    out->cycles_compared = report.cycles_rtl && report.cycles_model ? 1 : 0;
    out->cycles_device = report.cycles_rtl.value_or(0);
    out->cycles_model = report.cycles_model.value_or(0);
    return FASTSPLAT_OK;
  });
}

extern "C" FASTSPLAT_API const char* fastsplat_checker_first_mismatch(const fastsplat_checker* checker) {
  return kept_text(checker, __func__, [](const CheckerRun& run) { return run.first_mismatch(); });
}

extern "C" FASTSPLAT_API const char* fastsplat_checker_summary(const fastsplat_checker* checker) {
  return kept_text(checker, __func__, [](const CheckerRun& run) { return run.summary(); });
}

}  // namespace fastsplat::capi
