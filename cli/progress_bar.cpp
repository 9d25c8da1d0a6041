// SPDX-License-Identifier: Apache-2.0
#include "cli/progress_bar.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>

#include "cli/output.hpp"

namespace fastsplat::cli {
namespace {

using namespace std::chrono_literals;

void put(const std::string& text) {
  [[maybe_unused]] const auto ignored = ::write(STDERR_FILENO, text.data(), text.size());
}

int columns() {
  winsize size{};
  return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

}  // namespace

ProgressBar::ProgressBar(std::string label, Watching watching, Clock::time_point start)
    : label_(std::move(label)), visible_(watching == Watching::IfTerminal && stderr_is_terminal()), start_(start) {}

ProgressBar::~ProgressBar() { erase(); }

void ProgressBar::erase() {
  const std::scoped_lock lock(mutex_);
  if (drawn_) put("\r\033[K");
  drawn_ = false;
}

Progress ProgressBar::callback() {
  if (!visible_) return {};
  return [this](std::size_t done, std::size_t total) { show(done, total); };
}

Progress step_of(const Progress& whole, std::size_t step, std::size_t steps) {
  if (!whole) return {};
  return [whole, step, steps](std::size_t done, std::size_t total) { whole(step * total + done, steps * total); };
}

void ProgressBar::show(std::size_t done, std::size_t total) {
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock.owns_lock()) return;  // another thread is drawing: do not wait
  const auto now = std::chrono::steady_clock::now();
  if (drawn_ && now - last_ < 100ms) return;
  last_ = now;
  drawn_ = true;
  const double share = total == 0 ? 0.0 : std::min(1.0, static_cast<double>(done) / static_cast<double>(total));
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const int room = columns() - static_cast<int>(label_.size()) - 20;
  std::string bar;
  if (room >= 10) {
    const auto width = static_cast<std::size_t>(std::min(room, 40));
    const auto full = static_cast<std::size_t>(share * static_cast<double>(width));
    bar = "[" + std::string(full, '#') + std::string(width - full, '.') + "] ";
  }
  put(fmt::format("\r{} {}{:3.0f}% {:5.1f} s\033[K", label_, bar, 100.0 * share, elapsed));
}

}  // namespace fastsplat::cli
