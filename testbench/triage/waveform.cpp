// SPDX-License-Identifier: Apache-2.0
#include "testbench/triage/waveform.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <vector>

#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "base/unfinished.hpp"

namespace fastsplat::testbench {
namespace {

constexpr int kUnwanted = 2;  ///< exit code of a child whose run was a different one

/// No cycle takes more than one beat, so no more of them come before the last cycle that is wanted.
std::vector<cmodel::Beat> wanted_beats(const BeatSource& source, const VerifyOptions& options) {
  const std::uint64_t most = std::max(options.wave_to, options.reset_after);
  std::vector<cmodel::Beat> taken;
  source([&](std::span<const cmodel::Beat> beats) {
    const auto part = beats.first(static_cast<std::size_t>(std::min<std::uint64_t>(beats.size(), most - taken.size())));
    taken.insert(taken.end(), part.begin(), part.end());
  });
  return taken;
}

/// Drives a device as verify() does. A failing device ends the run; its cycles are in the waveform.
void drive(std::span<const cmodel::Beat> beats, const VerifyOptions& options) {
  cmodel::NullPixels none;
  const RtlOptions driven = rtl_options(options);
  const auto device = options.device ? options.device(none, driven) : make_rtl_device(options.config, none, driven);
  try {
    if (options.reset_after > 0) {
      device->consume(
          beats.first(static_cast<std::size_t>(std::min<std::uint64_t>(options.reset_after, beats.size()))));
      device->warm_reset(options.reset_cycles);
    }
    for (std::size_t i = 0; i < beats.size() && device->cycles() < options.wave_to; ++i)
      device->consume({&beats[i], 1});
    if (device->cycles() < options.wave_to) device->finish();
  } catch (const UserError& error) {
    if (error.code() != ExitCode::Simulation) throw;
  }
}

/// Runs in the child, which must not touch the parent's buffers and handlers.
[[noreturn]] void write_and_leave(const BeatSource& source, std::span<const cmodel::Beat> beats,
                                  const VerifyOptions& options, const WantedRun& wanted_run, pid_t parent) {
  end_with_parent(parent);
  for (const int signal : {SIGBUS, SIGSEGV, SIGABRT, SIGINT, SIGTERM, SIGHUP}) ::signal(signal, SIG_DFL);
  int code = 1;
  try {
    if (!wanted_run) drive(beats, options);
    code = !wanted_run || wanted_run(verify(source, options)) ? 0 : kUnwanted;
  } catch (...) {
  }
  ::_exit(code);
}

std::string cannot_write(const std::filesystem::path& path, const std::string& reason) {
  return one_line({.where = path.string(),
                   .what = "cannot write the waveform: " + reason,
                   .expected = {},
                   .got = {},
                   .fix = "choose a folder with more space, then run the command again"});
}

/// Whether a user has saved the view in GTKWave.
bool saved_by_a_user(const std::filesystem::path& view) {
  std::ifstream file(view);
  std::string line;
  return std::getline(file, line) && line != kWaveViewMark;
}

void write_view(const std::filesystem::path& waveform, const std::string& ports,
                const std::optional<WaveFocus>& focus) {
  const auto view = std::filesystem::path(waveform).replace_extension(".gtkw");
  if (saved_by_a_user(view)) return;
  std::ifstream names(ports);
  write_text_file(view, wave_view(waveform.filename().string(), names, focus));
}

}  // namespace

std::string write_waveform(const BeatSource& source, const VerifyOptions& options, const WantedRun& wanted_run,
                           const std::optional<WaveFocus>& focus) {
  try {
    AtomicFile file(options.wave);
    VerifyOptions run = options;
    run.wave = file.temporary();
    const std::vector<cmodel::Beat> beats = wanted_run ? std::vector<cmodel::Beat>{} : wanted_beats(source, options);
    const UnfinishedPath names(file.temporary().string() + ".hier");  // the writer keeps it until it is done
    const std::string port_names = file.temporary().string() + ".ports";
    const UnfinishedPath ports(port_names);
    const pid_t parent = ::getpid(), child = ::fork();
    if (child < 0) return cannot_write(options.wave, std::strerror(errno));
    if (child == 0) write_and_leave(source, beats, run, wanted_run, parent);
    const int status = HelperProcess(child).wait();
    if (WIFEXITED(status) && WEXITSTATUS(status) == kUnwanted) {
      return one_line({.where = options.wave.string(),
                       .what = "no waveform: the simulation that writes it does not show this failure",
                       .expected = {},
                       .got = {},
                       .fix = "registers hold other words before reset in that simulation: look for registers that are "
                              "never reset, and try --fill zero or one"});
    }
    if (status != 0) return cannot_write(options.wave, "the writing process ended early");
    file.commit();
    write_view(options.wave, port_names, focus);
    return {};
  } catch (const UserError& error) {
    return error.what();
  }
}

}  // namespace fastsplat::testbench
