// SPDX-License-Identifier: Apache-2.0
// A random stream, and the inputs, outputs and counters of a correct device for it, in the form of the C interface.
#pragma once

#include <vector>

#include "cmodel/numbers/config.hpp"
#include "testbench/capi/fastsplat.h"
#include "tests/check/raw_replay_helper.hpp"

namespace fastsplat::test {

struct Truth {
  cmodel::Config config;
  std::vector<cmodel::Beat> beats;
  std::vector<RawEvent> events;
  std::vector<std::uint64_t> counters;  ///< FASTSPLAT_COUNTERS_ALL
};

constexpr std::uint64_t kFirstBeat = 4;

/// For the built-in configuration `name`; 30 splats of class "mixed".
const Truth& truth_of(const std::string& name);

const std::uint32_t* words_of(const std::vector<cmodel::Beat>& beats);

/// Reports all events to the checker in order; `given` selects the optional arguments (FASTSPLAT_GIVEN_...). Returns
/// the first status that is not FASTSPLAT_OK, or FASTSPLAT_OK.
fastsplat_status report_all(const std::vector<RawEvent>& events, fastsplat_checker* checker, std::uint32_t given = ~0U);

/// Handles that destroy themselves. If one cannot be created, the test fails.
struct Config {
  explicit Config(const char* name);
  ~Config();
  fastsplat_config* handle = nullptr;
};
struct Model {
  explicit Model(const Config& config, std::uint32_t taps = FASTSPLAT_ALL_TAPS, std::uint32_t scope = FASTSPLAT_WHOLE);
  ~Model();
  fastsplat_model* handle = nullptr;
};
struct Checker {
  explicit Checker(const Config& config, const fastsplat_checker_options* options = nullptr);
  ~Checker();
  fastsplat_checker* handle = nullptr;
};

}  // namespace fastsplat::test
