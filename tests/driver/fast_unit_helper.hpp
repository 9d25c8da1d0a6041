// SPDX-License-Identifier: Apache-2.0
// Whole frames by the fast unit and the plain one: words, counters and report, with every kind of vector instruction of
// this processor.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "driver/tiles/gaussian_frame.hpp"
#include "driver/tiles/render.hpp"
#include "scene/scene.hpp"

namespace fastsplat::driver {

/// The vector targets one by one, and the processor's own choice at the end.
class Targets {
 public:
  Targets();
  ~Targets() { choose(0); }
  void choose(std::uint64_t target);
  const std::vector<std::uint64_t>& all() const { return all_; }

 private:
  std::vector<std::uint64_t> all_;
};

class UnitsCompared {
 public:
  /// A frame with every target, with and without counters; other threads and heights of bands each time. A scene that
  /// the configuration cannot draw is skipped.
  void frame(const std::string& name, const std::string& what, const scene::SceneDescription& description,
             const cmodel::Config& config);
  void gaussians(const std::string& what, const GaussianFrame& frame);
  /// Prints the figures; expects no difference, and at least one tile drawn by the fast unit for every `name`.
  void finish() const;
  std::size_t combinations() const { return combinations_; }
  std::uint64_t redone() const;
  std::size_t pictures() const { return pictures_; }  ///< drawn without counters
  std::size_t left_out() const { return left_out_; }  ///< records of Gaussians that pictures do not have

 private:
  void add(const std::string& name, const std::string& what, const char* difference, const cmodel::Frame& frame,
           const UnitReport& units);

  Targets targets_;
  std::size_t combinations_ = 0, frames_ = 0, pictures_ = 0, left_out_ = 0, different_ = 0, words_ = 0;
  std::map<std::string, UnitReport> units_;
  std::map<std::string, int> drawn_with_;
};

}  // namespace fastsplat::driver
