// SPDX-License-Identifier: Apache-2.0
// A waveform of some cycles of a run, written where a failure of the writing does no harm.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "testbench/check/verify.hpp"
#include "testbench/triage/wave_view.hpp"

namespace fastsplat::testbench {

/// Whether a run is the one whose waveform is wanted.
using WantedRun = std::function<bool(const VerifyResult&)>;

/// Drives the device with `source` once more, as verify() does but without a checker, up to the last required cycle.
/// Keeps the cycles [wave_from, wave_to) of `options` in its `wave`, which appears whole or not at all. Returns the
/// reason if it is missing, else an empty text. A separate process writes it: the simulator's writer maps the file into
/// memory, so that a full disk would end the process that holds the result. With `wanted_run` the run is compared, too:
/// a different run, which began with other words in its registers, leaves no waveform.
/// Beside the waveform lies its view for GTKWave (wave_view.hpp), named alike with .gtkw at the end. One that a user
/// has saved stays as it is.
std::string write_waveform(const BeatSource& source, const VerifyOptions& options, const WantedRun& wanted_run = {},
                           const std::optional<WaveFocus>& focus = {});

}  // namespace fastsplat::testbench
