// SPDX-License-Identifier: Apache-2.0
#include "base/called.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <optional>

#include "base/error.hpp"
#include "base/machine_error.hpp"
#include "base/unfinished.hpp"

namespace fastsplat {
namespace {

using Clock = std::chrono::steady_clock;

[[noreturn]] void become(char* const* words, pid_t parent, int out, int err) {
  ::setpgid(0, 0);
  end_with_parent(parent);
  const int nothing = ::open("/dev/null", O_RDONLY);
  ::dup2(nothing, STDIN_FILENO);
  ::dup2(out, STDOUT_FILENO);
  ::dup2(err, STDERR_FILENO);
  ::signal(SIGPIPE, SIG_DFL);  // ignored in this process, but not for clients
  ::signal(SIGXFSZ, SIG_DFL);
  ::execvp(words[0], words);
  ::_exit(127);
}

/// Appends the available bytes to `to`; false at the end or on an error.
bool drain(int from, std::string& to) {
  std::array<char, 4096> buffer{};
  const ssize_t got = ::read(from, buffer.data(), buffer.size());
  if (got > 0) to.append(buffer.data(), static_cast<std::size_t>(got));
  return got > 0 || (got < 0 && errno == EINTR);
}

}  // namespace

std::string Called::last_words() const {
  for (std::string text : {err, out}) {
    while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
    if (text.empty()) continue;
    const auto line = text.rfind('\n');
    return line == std::string::npos ? text : text.substr(line + 1);
  }
  return code == 127 ? "it is not installed" : code == 124 ? "timed out" : "exit code " + std::to_string(code);
}

Called call(const std::vector<std::string>& words, int seconds, const Heard& heard) {
  std::vector<char*> argv;
  for (const auto& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  std::array<int, 2> out{-1, -1}, err{-1, -1};
  const bool piped = ::pipe2(out.data(), O_CLOEXEC) == 0 && ::pipe2(err.data(), O_CLOEXEC) == 0;
  const pid_t parent = ::getpid(), child = piped ? ::fork() : -1;
  if (child == 0) become(argv.data(), parent, out[1], err[1]);
  const int reason = errno;
  std::optional<HelperProcess> helper;
  if (child > 0) {
    ::setpgid(child, child);  // the child may not have done it yet
    helper.emplace(child, HelperProcess::Leads::Group);
  }
  for (const int end : {out[1], err[1]}) ::close(end);

  Called called;
  bool late = false;
  std::array<pollfd, 2> ends{{{out[0], POLLIN, 0}, {err[0], POLLIN, 0}}};
  const auto deadline = Clock::now() + (seconds == 0 ? std::chrono::hours(1000) : std::chrono::seconds(seconds));
  while (child > 0 && (ends[0].fd >= 0 || ends[1].fd >= 0)) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
    if (left <= 0) {
      late = true;
      ::kill(-child, SIGKILL);
      break;
    }
    ::poll(ends.data(), ends.size(), static_cast<int>(std::min<long long>(left, 1000)));
    if (ends[0].revents != 0) {
      if (!drain(out[0], called.out)) ends[0].fd = -1;
      if (heard) heard(called.out);
    }
    if (ends[1].revents != 0 && !drain(err[0], called.err)) ends[1].fd = -1;
  }
  for (const int end : {out[0], err[0]}) ::close(end);
  if (child < 0) {
    throw_machine({.where = words[0],
                   .what = std::string("cannot be started: ") + std::strerror(reason),
                   .expected = {},
                   .got = {},
                   .fix = "close other programs first"});
  }
  const int status = helper->wait();
  called.code = late ? 124 : WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return called;
}

}  // namespace fastsplat
