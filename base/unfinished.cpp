// SPDX-License-Identifier: Apache-2.0
#include "base/unfinished.hpp"

#ifdef __linux__  // the lab starts no processes
#include <sys/prctl.h>
#endif
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>

namespace fastsplat {
namespace {

// The current paths and children, readable by a signal handler: fixed storage, no locks.
enum SlotState : int { Free, Claimed, Live };
struct Slot {
  std::atomic<int> state{Free};
  std::array<char, 4096> path{};
};
std::array<Slot, 64> unfinished;
std::array<std::atomic<pid_t>, 8> helpers;

// If all slots are taken or the path is too long, an interrupt leaves the file behind.
void remember(const std::string& path) {
  if (path.size() >= unfinished[0].path.size()) return;
  for (auto& slot : unfinished) {
    int expected = Free;
    if (!slot.state.compare_exchange_strong(expected, Claimed)) continue;
    std::memcpy(slot.path.data(), path.c_str(), path.size() + 1);
    slot.state = Live;
    return;
  }
}

void forget(const std::string& path) {
  for (auto& slot : unfinished) {
    if (slot.state == Live && path == slot.path.data()) slot.state = Free;
  }
}

}  // namespace

UnfinishedPath::UnfinishedPath(std::filesystem::path path) : path_(std::move(path)) { remember(path_.string()); }

UnfinishedPath::~UnfinishedPath() {
  if (kept_) return;
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
  forget(path_.string());
}

void UnfinishedPath::keep() {
  kept_ = true;
  forget(path_.string());
}

HelperProcess::HelperProcess(pid_t child, Leads leads)
    : child_(child), signalled_(leads == Leads::Group ? -child : child) {
  for (auto& helper : helpers) {
    pid_t none = 0;
    if (helper.compare_exchange_strong(none, signalled_)) return;
  }
}

HelperProcess::~HelperProcess() { forget(); }

void HelperProcess::forget() {
  for (auto& helper : helpers) {
    pid_t mine = signalled_;
    helper.compare_exchange_strong(mine, 0);
  }
}

int HelperProcess::wait() {
  // Forget the child before another process can get its number, or a signal would end that.
  siginfo_t ended{};
  while (::waitid(P_PID, static_cast<id_t>(child_), &ended, WEXITED | WNOWAIT) < 0 && errno == EINTR) {
  }
  forget();
  int status = 0;
  while (::waitpid(child_, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

void end_with_parent(pid_t parent) {
#ifdef __linux__
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
#endif
  if (::getppid() != parent) ::_exit(128 + SIGTERM);  // the parent ended before prctl()
}

void remove_unfinished_files() noexcept {
  for (auto& helper : helpers) {
    const pid_t signalled = helper;
    if (signalled == 0) continue;
    const pid_t child = signalled < 0 ? -signalled : signalled;
    bool ended = false;
    if (signalled < 0) {
      ::kill(signalled, SIGTERM);
      for (int tenths = 0; tenths < 50 && !ended; ++tenths) {
        ended = ::waitpid(child, nullptr, WNOHANG) != 0;
        constexpr timespec kTenth{0, 100'000'000};
        if (!ended) ::nanosleep(&kTenth, nullptr);
      }
    }
    ::kill(signalled, SIGKILL);
    while (!ended && ::waitpid(child, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
  for (auto& slot : unfinished) {
    if (slot.state == Live) ::unlink(slot.path.data());
  }
  // Then the folders, unless other files are in them.
  for (auto& slot : unfinished) {
    if (slot.state == Live) ::rmdir(slot.path.data());
  }
}

}  // namespace fastsplat
