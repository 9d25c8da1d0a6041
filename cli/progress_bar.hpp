// SPDX-License-Identifier: Apache-2.0
// A one-line progress bar; drawn on terminals only.
#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>

#include "base/progress.hpp"
#include "cli/common.hpp"

namespace fastsplat::cli {

enum class Watching { IfTerminal, Never };
inline Watching watching(const Common& common) { return common.quiet ? Watching::Never : Watching::IfTerminal; }

/// Progress of one of `steps` equal steps of a whole, the first being 0; empty if `whole` is.
Progress step_of(const Progress& whole, std::size_t step, std::size_t steps);

class ProgressBar {
 public:
  using Clock = std::chrono::steady_clock;
  /// `start`: origin of the elapsed time shown.
  ProgressBar(std::string label, Watching watching, Clock::time_point start = Clock::now());
  ~ProgressBar();  ///< erases the line
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Progress callback; empty if the bar is not shown. Must not outlive the bar.
  Progress callback();
  /// Erases the line, for a message; the next progress draws it again.
  void erase();

 private:
  void show(std::size_t done, std::size_t total);

  std::string label_;
  bool visible_;
  bool drawn_ = false;
  std::mutex mutex_;
  Clock::time_point start_;
  Clock::time_point last_{};
};

}  // namespace fastsplat::cli
