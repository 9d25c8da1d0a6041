// SPDX-License-Identifier: Apache-2.0
// The device model: decode -> snap -> weights by index kind -> sheet buffer -> compositor -> pixel out.
#pragma once

#include <cstdint>
#include <vector>

#include "cmodel/classify/density_stage.hpp"
#include "cmodel/composite/compositor.hpp"
#include "cmodel/composite/pixel_out.hpp"
#include "cmodel/cull/cull_tests.hpp"
#include "cmodel/cull/terminations.hpp"
#include "cmodel/decode/stream_decode.hpp"
#include "cmodel/numbers/config.hpp"
#include "cmodel/numbers/observers.hpp"
#include "cmodel/splat/ellipse_unit.hpp"
#include "cmodel/splat/sheet_buffer.hpp"
#include "cmodel/splat/snap.hpp"
#include "cmodel/splat/weight_unit.hpp"
#include "cmodel/stream/device.hpp"

namespace fastsplat::cmodel {

class Model final : public Device {
 public:
  /// `pixels` receives every finished tile. `taps` and `ranges` (of all narrowing sites) may be null, at no cost. All
  /// must outlive the model.
  Model(const Config& config, StreamScope scope, PixelSink& pixels, TapSink* taps = nullptr, Ranges* ranges = nullptr);

  void consume(std::span<const Beat> beats) override;
  void finish() override { decode_.finish(); }
  const Counters& counters() const override { return counters_; }

  /// Logs the results of all cull tests from now on; null: no log. Must outlive the model.
  void log_culls(CullLog* log) { cull_.log(log); }
  /// Notes terminated pixels of sheets that are composited (modes 0 and 1) from now on. Must outlive the model.
  void note_terminations(Terminations* map) { terminations_ = map; }
  const CullCounts& culls() const { return cull_.counts(); }
  /// Whether a cull group with this rectangle would be hidden in the open sheet: its splats may then be left out.
  bool would_hide(const CullBlock& set) const { return cull_.would_hide(set); }

 private:
  /// `Observer` counts saturation and records ranges if requested.
  template <class Observer>
  void take(const Record& record, Observer& observer);
  void load(const LoadTable& table);
  void begin_tile(const BeginTile& tile);
  template <class Observer>
  void splat(const SplatRecord& record, Observer& observer);
  template <class Unit, class Observer>
  void splat(const SplatRecord& record, Unit& unit, Observer& observer);
  template <class Observer>
  void ellipse(const EllipseRecord& record, Observer& observer);
  template <class Record, class Observer>
  void window(const Record& record, std::int32_t x, std::int32_t y, Observer& observer);
  /// Modes 4 and 5: composites the window's products at once (N-6-12).
  template <class Record, class Observer>
  void samples(const Record& record, std::int32_t x, std::int32_t y, Observer& observer);
  /// What to composite at a pixel of the ended sheet: its sums, tinted if the frame has a pattern (N-6.3-8).
  SheetWord sums(int x, int y) const;
  template <class Observer>
  void end_sheet(Observer& observer);
  /// Modes 8 and 9: composites the waiting sheet, which `step` of densities_ classifies.
  template <class Observer, class Step>
  void classify(Observer& observer, Step step);
  template <class Observer>
  void end_tile(Observer& observer);
  void tap(Tap kind, std::uint32_t tag, std::int32_t x, std::int32_t y, std::span<const std::uint32_t> payload) const;
  /// The four words at(x, y) of each pixel of the window whose first pixel is (x,y), row by row; 0 outside the tile and
  /// `halo` pixels around it.
  template <class At>
  std::span<const std::uint32_t> gather(std::int32_t x, std::int32_t y, At at, int halo = 0);

  Config config_;
  StreamDecode decode_;
  Snap snap_;
  WeightUnit unit_;
  EllipseUnit ellipse_;
  RadialTable radial_;  ///< of ellipses
  SheetBuffer sheet_;
  Lane lane_;  ///< for modes 4 and 5
  DensityStage densities_;
  Compositor compositor_;
  PixelOut pixel_out_;
  CullTests cull_;
  Terminations* terminations_ = nullptr;
  Counters counters_;
  PixelSink& pixels_;
  TapSink* taps_;
  Ranges* ranges_;
  BeginFrame frame_;
  BeginTile tile_;
  int halo_ = 0;  ///< halo of its sheets, pixels
  std::uint32_t sheet_number_ = 0;
  std::vector<std::uint32_t> weights_;  ///< of the current window, P*P
  std::vector<std::uint32_t> scratch_;  ///< a tap's payload, P*P*4
};

}  // namespace fastsplat::cmodel
