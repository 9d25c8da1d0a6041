// SPDX-License-Identifier: Apache-2.0
#include "tests/capi/truth_helper.hpp"

#include <gtest/gtest.h>

#include <map>

#include "cmodel/cycles/cycle_model.hpp"
#include "cmodel/model.hpp"
#include "testbench/stimulus/stimulus.hpp"
#include "tests/cmodel/configs_helper.hpp"

namespace fastsplat::test {

const Truth& truth_of(const std::string& name) {
  static std::map<std::string, Truth> made;
  if (const auto found = made.find(name); found != made.end()) return found->second;
  Truth truth{.config = named_config(name), .beats = {}, .events = {}, .counters = {}};
  const auto stimulus = testbench::make_stimulus(truth.config, testbench::StimulusClass::Mixed, 3, 30);
  truth.beats = write_document(truth.config, stimulus.document);
  truth.events = replay(truth.config, truth.beats);
  cmodel::NullPixels none;
  cmodel::Model model(truth.config, cmodel::StreamScope::Whole, none);
  model.consume(truth.beats);
  const auto add = [&](const char*, std::uint64_t value, const char*) { truth.counters.push_back(value); };
  model.counters().for_each(add);
  cmodel::CycleModel cycles(truth.config, cmodel::StreamScope::Whole, {.first_beat = kFirstBeat});
  cycles.consume(truth.beats);
  cycles.finish();
  cycles.stalls().for_each(truth.config, add);
  return made.emplace(name, std::move(truth)).first->second;
}

const std::uint32_t* words_of(const std::vector<cmodel::Beat>& beats) { return beats.front().data(); }

fastsplat_status report_all(const std::vector<RawEvent>& events, fastsplat_checker* checker, std::uint32_t given) {
  for (const auto& event : events) {
    fastsplat_status status = FASTSPLAT_OK;
    if (event.beat) {
      status = fastsplat_checker_took(checker, event.beat->data(), 1);
    } else {
      fastsplat_shown shown{};
      shown.struct_size = sizeof shown;
      shown.port = static_cast<std::uint32_t>(event.tap.port);
      shown.cycle = event.tap.cycle;
      shown.tag = event.tap.tag;
      shown.x = event.tap.x;
      shown.y = event.tap.y;
      shown.mx = event.tap.mx;
      shown.my = event.tap.my;
      shown.block = event.tap.block;
      if (event.tap.keep) shown.given |= given & FASTSPLAT_GIVEN_KEEP;
      if (event.tap.tile) shown.given |= given & FASTSPLAT_GIVEN_TILE;
      shown.keep = event.tap.keep.value_or(0);
      shown.tile = event.tap.tile.value_or(0);
      shown.last = event.tap.last ? 1 : 0;
      shown.cut = event.tap.cut ? 1 : 0;
      shown.hidden = event.tap.hidden ? 1 : 0;
      shown.word_count = event.words.size();
      shown.words = event.words.data();
      status = fastsplat_checker_showed(checker, &shown);
    }
    if (status != FASTSPLAT_OK) return status;
  }
  return FASTSPLAT_OK;
}

Config::Config(const char* name) { EXPECT_EQ(fastsplat_config_named(name, &handle), FASTSPLAT_OK); }
Config::~Config() { EXPECT_EQ(fastsplat_config_destroy(handle), FASTSPLAT_OK); }

Model::Model(const Config& config, std::uint32_t taps, std::uint32_t scope) {
  EXPECT_EQ(fastsplat_model_create(config.handle, scope, taps, &handle), FASTSPLAT_OK) << fastsplat_last_error();
}
Model::~Model() { EXPECT_EQ(fastsplat_model_destroy(handle), FASTSPLAT_OK); }

Checker::Checker(const Config& config, const fastsplat_checker_options* options) {
  EXPECT_EQ(fastsplat_checker_create(config.handle, options, &handle), FASTSPLAT_OK) << fastsplat_last_error();
}
Checker::~Checker() { EXPECT_EQ(fastsplat_checker_destroy(handle), FASTSPLAT_OK); }

}  // namespace fastsplat::test
