#include "cli/process.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
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
  // The system would call a child of `plan run` by the link that it was started by, exe.
  ::prctl(PR_SET_NAME, "fastsplat");
  // Opened the wrong way round, so that using them fails as it would have.
  if (::fcntl(STDIN_FILENO, F_GETFD) < 0) ::open("/dev/null", O_WRONLY);
  if (::fcntl(STDOUT_FILENO, F_GETFD) < 0) ::open("/dev/null", O_RDONLY);
  if (::fcntl(STDERR_FILENO, F_GETFD) < 0) ::open("/dev/null", O_RDONLY);

  ::signal(SIGPIPE, SIG_IGN);
  ::signal(SIGXFSZ, SIG_IGN);

  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction action {};
    // Whoever started us with the signal ignored (nohup, a background job) meant it.
    if (::sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN) continue;
    action = {};
    action.sa_handler = end_on_signal;
    ::sigaction(signal, &action, nullptr);
  }
}

}  // namespace fastsplat::cli
