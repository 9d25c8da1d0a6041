// One line on a terminal that tells how far a long call has come; nothing anywhere else.
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

class ProgressBar {
 public:
  using Clock = std::chrono::steady_clock;
  /// `start`: since when the time shown is counted.
  ProgressBar(std::string label, Watching watching, Clock::time_point start = Clock::now());
  ~ProgressBar();  ///< wipes the line
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// For the call to report to; empty when nobody is watching. Must not outlive the bar.
  Progress callback();

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
