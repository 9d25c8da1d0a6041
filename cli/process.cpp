// SPDX-License-Identifier: Apache-2.0
#include "cli/process.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <csignal>

#include "base/unfinished.hpp"

namespace fastsplat::cli {
namespace {

extern "C" void end_on_signal(int signal) {
  remove_unfinished_files();
  if (::isatty(STDERR_FILENO) == 1) {
    [[maybe_unused]] const auto ignored = ::write(STDERR_FILENO, "\n", 1);  // leave the progress line
  }
  ::_exit(128 + signal);
}

}  // namespace

void prepare_process() {
  // Opened in the wrong direction, so that using them still fails.
  if (::fcntl(STDIN_FILENO, F_GETFD) < 0) ::open("/dev/null", O_WRONLY);
  if (::fcntl(STDOUT_FILENO, F_GETFD) < 0) ::open("/dev/null", O_RDONLY);
  if (::fcntl(STDERR_FILENO, F_GETFD) < 0) ::open("/dev/null", O_RDONLY);

  ::signal(SIGPIPE, SIG_IGN);
  ::signal(SIGXFSZ, SIG_IGN);

  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction action {};
    // Keep signals that the parent ignored on purpose (nohup, a background job).
    if (::sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN) continue;
    action = {};
    action.sa_handler = end_on_signal;
    ::sigaction(signal, &action, nullptr);
  }
}

}  // namespace fastsplat::cli
