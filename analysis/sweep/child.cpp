// SPDX-License-Identifier: Apache-2.0
#include "analysis/sweep/child.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>

#include "base/machine_error.hpp"

namespace fastsplat::plan {
namespace {

constexpr timespec kSoon{.tv_sec = 0, .tv_nsec = 100'000'000};
constexpr int kPatience = 50;  ///< number of kSoon between TERM and KILL
constexpr off_t kMostErrors = 1 << 16;

/// The last error line, or the last line of all.
std::string last_message(int descriptor) {
  const off_t size = ::lseek(descriptor, 0, SEEK_END);
  const off_t from = std::max<off_t>(0, size - kMostErrors);
  std::string text(static_cast<std::size_t>(std::max<off_t>(0, size - from)), '\0');
  const ssize_t read = ::pread(descriptor, text.data(), text.size(), from);
  text.resize(static_cast<std::size_t>(std::max<ssize_t>(0, read)));
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  const std::string mark = "fastsplat: error: ";
  const auto error = text.rfind(mark);
  if (error != std::string::npos) {
    text.erase(0, error + mark.size());
    return text.substr(0, text.find('\n'));
  }
  const auto line = text.rfind('\n');
  return line == std::string::npos ? text : text.substr(line + 1);
}

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
}

/// What the child does.
[[noreturn]] void become(const Program& program, const Words& words, int errors, const sigset_t& mask, pid_t parent) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(128 + SIGKILL);
  const int nothing = ::open("/dev/null", O_RDWR);
  ::dup2(nothing, STDIN_FILENO);
  ::dup2(nothing, STDOUT_FILENO);
  ::dup2(errors, STDERR_FILENO);
  ::setenv(kReportMachine, "1", 1);
  ::sigprocmask(SIG_SETMASK, &mask, nullptr);
  const int code = program(words);
  std::fflush(nullptr);
  ::_exit(code);
}

}  // namespace

Children::Children() {
  sigemptyset(&taken_);
  for (const int signal : {SIGCHLD, SIGINT, SIGTERM, SIGHUP}) sigaddset(&taken_, signal);
  ::sigprocmask(SIG_BLOCK, &taken_, &before_);
}

Children::~Children() {
  end_all();
  // Discards repetitions of the stop signal that signal() already reports.
  while (signal_ != 0 && ::sigtimedwait(&taken_, nullptr, &kSoon) == signal_) {
  }
  ::sigprocmask(SIG_SETMASK, &before_, nullptr);
}

pid_t Children::start(const Program& program, const Words& words) {
  std::fflush(nullptr);  // or parent and child would both write it
  const int errors = ::memfd_create("stderr", MFD_CLOEXEC);
  const pid_t parent = ::getpid();
  const pid_t pid = errors < 0 ? -1 : ::fork();
  if (pid == 0) become(program, words, errors, before_, parent);
  if (pid < 0) {
    const int reason = errno;
    if (errors >= 0) ::close(errors);
    throw_machine({.where = "fastsplat",
                   .what = std::string("cannot be started: ") + std::strerror(reason),
                   .expected = {},
                   .got = {},
                   .fix = "use fewer --jobs"});
  }
  ::setpgid(pid, pid);  // set by parent and child, whichever runs first
  running_.push_back({pid, errors});
  return pid;
}

std::optional<Ended> Children::reap() {
  for (auto child = running_.begin(); child != running_.end(); ++child) {
    int status = 0;
    rusage usage{};
    if (::wait4(child->pid, &status, WNOHANG, &usage) != child->pid) continue;
    Ended ended{.pid = child->pid,
                .exit_code = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status),
                .cpu_seconds = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime),
                .message = last_message(child->errors)};
    ended.signal = ended.exit_code > 128 ? ended.exit_code - 128 : 0;
    ::close(child->errors);
    running_.erase(child);
    return ended;
  }
  return std::nullopt;
}

std::optional<Ended> Children::wait() {
  while (true) {
    if (auto ended = reap()) {
      // A signal that ends a child often reaches this process a moment later: then the child has no result.
      if (ended->signal == 0) return ended;
      sigset_t stops = taken_;
      sigdelset(&stops, SIGCHLD);
      for (int tries = 0; tries < 10; ++tries) {
        const int signal = ::sigtimedwait(&stops, nullptr, &kSoon);
        if (signal <= 0) continue;
        signal_ = signal;
        return std::nullopt;
      }
      return ended;
    }
    const int signal = ::sigwaitinfo(&taken_, nullptr);
    if (signal > 0 && signal != SIGCHLD) {
      signal_ = signal;
      return std::nullopt;
    }
  }
}

void Children::end_all() {
  for (const Child& child : running_) ::kill(-child.pid, SIGTERM);
  for (int tries = 0; !running_.empty(); ++tries) {
    if (reap()) continue;
    if (tries == kPatience) {
      for (const Child& child : running_) ::kill(-child.pid, SIGKILL);
    }
    ::sigtimedwait(&taken_, nullptr, &kSoon);
  }
}

}  // namespace fastsplat::plan
