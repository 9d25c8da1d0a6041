// SPDX-License-Identifier: Apache-2.0
// Writes a tile's records as beats, in blocks.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "cmodel/stream/device.hpp"
#include "cmodel/stream/record_sink.hpp"
#include "driver/tiles/compile.hpp"

namespace fastsplat::driver {

class BeatWriter final : public cmodel::RecordSink {
 public:
  /// Keeps a reference to `sink`. `hides`: see CompiledFrame::emit_tile().
  explicit BeatWriter(const cmodel::BeatSink& sink, Hides hides = {}) : sink_(sink), hides_(std::move(hides)) {
    beats_.reserve(kBlock + 512);
  }
  void begin_tile(const cmodel::BeginTile& tile) override { append(beats_, tile); }
  void begin_sheet(const cmodel::BeginSheet& sheet) override { append(beats_, sheet); }
  void splats(std::span<const cmodel::SplatRecord> records) override {
    for (const cmodel::SplatRecord& record : records) beats_.push_back(to_beat(record));
    if (beats_.size() >= kBlock) flush();
  }
  void ellipses(std::span<const cmodel::EllipseRecord> records) override {
    for (const cmodel::EllipseRecord& record : records) beats_.push_back(to_beat(record));
    if (beats_.size() >= kBlock) flush();
  }
  void cull_blocks(std::span<const cmodel::CullBlock> records) override {
    for (const cmodel::CullBlock& record : records) append(beats_, record);
  }
  bool would_hide(const cmodel::CullBlock& set) override {
    if (!hides_) return false;
    flush();  // the answer depends on all earlier beats
    return hides_(set);
  }
  void end_sheet(const cmodel::EndSheet& sheet) override { append(beats_, sheet); }
  void end_tile(const cmodel::EndTile& tile) override {
    append(beats_, tile);
    flush();
  }

 private:
  void flush() {
    if (beats_.empty()) return;
    sink_(beats_);
    beats_.clear();
  }

  static constexpr std::size_t kBlock = 4096;
  const cmodel::BeatSink& sink_;
  const Hides hides_;
  std::vector<cmodel::Beat> beats_;
};

}  // namespace fastsplat::driver
