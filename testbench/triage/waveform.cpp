#include "testbench/triage/waveform.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>

#include "base/atomic_file.hpp"
#include "base/error.hpp"

namespace fastsplat::testbench {
namespace {

/// In the child: neither the parent's buffers nor its handlers are its business.
[[noreturn]] void write_and_leave(const BeatSource& source, const VerifyOptions& options) {
  for (const int signal : {SIGBUS, SIGSEGV, SIGABRT, SIGINT, SIGTERM, SIGHUP}) ::signal(signal, SIG_DFL);
  int code = 1;
  try {
    verify(source, options);
    code = 0;
  } catch (...) {
  }
  ::_exit(code);
}

std::string cannot_write(const std::filesystem::path& path, const std::string& reason) {
  return one_line({.where = path.string(),
                   .what = "cannot write the waveform: " + reason,
                   .expected = {},
                   .got = {},
                   .fix = "choose a folder with more space (--failure), then run the replay"});
}

}  // namespace

std::string write_waveform(const BeatSource& source, const VerifyOptions& options) {
  try {
    AtomicFile file(options.wave);
    VerifyOptions run = options;
    run.wave = file.temporary();
    const pid_t child = ::fork();
    if (child < 0) return cannot_write(options.wave, std::strerror(errno));
    if (child == 0) write_and_leave(source, run);
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (status != 0) {
      std::error_code ignored;
      std::filesystem::remove(file.temporary().string() + ".hier", ignored);  // what the writer leaves half-way
      return cannot_write(options.wave, "the writer ended early");
    }
    file.commit();
    return {};
  } catch (const UserError& error) {
    return error.what();
  }
}

}  // namespace fastsplat::testbench
