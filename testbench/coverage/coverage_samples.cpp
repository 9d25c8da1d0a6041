// SPDX-License-Identifier: Apache-2.0
#include "testbench/coverage/coverage_samples.hpp"

#include <algorithm>
#include <cstdlib>

#include "cmodel/cycles/cycle_stages.hpp"

namespace fastsplat::testbench {
namespace {

/// Beyond four cycles a pixel is read from memory again; bins go up to twice that.
constexpr std::uint64_t kForwarded = 4, kSampleDistances = 8;

}  // namespace

SampleCoverage::SampleCoverage(const cmodel::Config& config, Coverage& coverage)
    : lanes_(config.lanes),
      coverage_(coverage),
      columns_(static_cast<std::size_t>(config.tile_width)),
      written_(columns_ * static_cast<std::size_t>(config.tile_height)) {
  const auto distances = [&](const char* prefix, std::uint64_t to) {
    const Id first = coverage.bins().size();
    for (std::uint64_t d = cmodel::stages::kHazard; d <= to; ++d)
      coverage.declare("sample", prefix + std::to_string(d));
    return first;
  };
  distance_ = distances("distance_", kSampleDistances);
  whole_ = distances("whole_window_", kForwarded);
  part_ = distances("part_of_window_", kForwarded);
  beside_ = coverage.bins().size();
  for (const char* name : {"next_on_the_left", "next_on_the_right", "next_above", "next_below"})
    coverage.declare("sample", name);
  corner_ = coverage.declare("sample", "waits_for_a_corner");
}

void SampleCoverage::begin_tile(int width, int height) {
  width_ = width;
  height_ = height;
  written_.assign(written_.size(), 0);
  last_ = 0;
}

void SampleCoverage::window(const cmodel::TapRecord& record) {
  if (last_ != 0 && record.tag != tag_) neighbour(record);
  distance(record);
  last_ = record.cycle;
  tag_ = record.tag;
  x_ = record.x;
  y_ = record.y;
}

void SampleCoverage::neighbour(const cmodel::TapRecord& record) {
  const int dx = record.x - x_, dy = record.y - y_;
  if (record.cycle == last_ + 1) {
    // One pixel nearer, and it would have waited.
    if (std::abs(dy) < lanes_ && std::abs(dx) == lanes_) coverage_.hit(beside_ + (dx < 0 ? 0 : 1));
    if (std::abs(dx) < lanes_ && std::abs(dy) == lanes_) coverage_.hit(beside_ + (dy < 0 ? 2 : 3));
  }
  if (record.cycle == last_ + cmodel::stages::kHazard && std::abs(dx) == lanes_ - 1 && std::abs(dy) == lanes_ - 1)
    coverage_.hit(corner_);
}

void SampleCoverage::distance(const cmodel::TapRecord& record) {
  std::uint64_t nearest = kSampleDistances + 1, met = 0, inside = 0;
  for (int y = std::max(0, record.y); y < std::min(height_, record.y + lanes_); ++y) {
    for (int x = std::max(0, record.x); x < std::min(width_, record.x + lanes_); ++x) {
      std::uint64_t& written = written_[static_cast<std::size_t>(y) * columns_ + static_cast<std::size_t>(x)];
      ++inside;
      const std::uint64_t before = record.cycle - written;
      if (written != 0 && before <= nearest) {
        met = before == nearest ? met + 1 : 1;
        nearest = before;
      }
      written = record.cycle;
    }
  }
  if (nearest > kSampleDistances) return;
  coverage_.hit(distance_ + nearest - cmodel::stages::kHazard);
  if (nearest <= kForwarded) coverage_.hit((met == inside ? whole_ : part_) + nearest - cmodel::stages::kHazard);
}

}  // namespace fastsplat::testbench
