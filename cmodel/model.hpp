// The device model: decode -> snap -> weights by the kind of index -> sheet buffer -> compositor -> pixel out.
#pragma once

#include <cstdint>
#include <vector>

#include "cmodel/classify/density_stage.hpp"
#include "cmodel/composite/compositor.hpp"
#include "cmodel/composite/pixel_out.hpp"
#include "cmodel/cull/cull_log.hpp"
#include "cmodel/cull/cull_sets.hpp"
#include "cmodel/cull/cull_unit.hpp"
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
  /// `pixels` takes every finished tile; `taps` and `ranges` (of all narrowing sites) may be null (no cost). All
  /// outlive the model.
  Model(const Config& config, StreamScope scope, PixelSink& pixels, TapSink* taps = nullptr, Ranges* ranges = nullptr);

  void consume(std::span<const Beat> beats) override;
  void finish() override { decode_.finish(); }
  const Counters& counters() const override { return counters_; }

  /// Where the answers of all tests go from now on; null: nowhere. Outlives the model.
  void log_culls(CullLog* log) { log_ = log; }
  const CullCounts& culls() const { return culls_; }
  /// Whether a set of this rectangle would be hidden in the open sheet: then its splats may be left out.
  bool would_hide(const CullBlock& set) const { return cull_.on() && cull_.hidden(box_of(set)); }

 private:
  /// `Observer` counts saturation, and watches ranges if there are any to watch.
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
  void cull_block(const CullBlock& record);
  /// The next splat belongs to a hidden set.
  bool swallowed(std::uint32_t tag);
  /// All windows of a splat: columns x rows of them from pixel (x,y) on. True if it is hidden; else asks for each.
  bool hidden(std::int32_t x, std::int32_t y, std::uint32_t columns, std::uint32_t rows);
  /// Of a splat that is not hidden, after hidden().
  bool window_hidden(std::size_t number) const { return !hidden_windows_.empty() && hidden_windows_[number] != 0; }
  void log(bool hidden) {
    if (log_ != nullptr) log_->tile(tile_.tile).add(hidden);
  }
  /// Mode bit "every sample": the window's products into the picture, at once.
  template <class Record, class Observer>
  void samples(const Record& record, std::int32_t x, std::int32_t y, Observer& observer);
  /// What is composited of a pixel of the sheet that has ended: its sums, tinted where the frame has a pattern.
  SheetWord sums(int x, int y) const;
  template <class Observer>
  void end_sheet(Observer& observer);
  /// Modes of densities: what `step` of densities_ makes of the sheet that waited goes into the picture.
  template <class Observer, class Step>
  void classify(Observer& observer, Step step);
  template <class Observer>
  void end_tile(Observer& observer);
  void tap(Tap kind, std::uint32_t tag, std::int32_t x, std::int32_t y, std::span<const std::uint32_t> payload) const;
  /// The four words `at` each pixel of the window whose first pixel is (x,y), in their order; 0 outside of the tile and
  /// so many pixels around it.
  template <class At>
  std::span<const std::uint32_t> gather(std::int32_t x, std::int32_t y, At at, int halo = 0);

  Config config_;
  StreamDecode decode_;
  Snap snap_;
  WeightUnit unit_;
  EllipseUnit ellipse_;
  RadialTable radial_;  ///< the ellipses'
  SheetBuffer sheet_;
  Lane lane_;  ///< of every sample
  DensityStage densities_;
  Compositor compositor_;
  PixelOut pixel_out_;
  CullUnit cull_;
  CullSets<bool> sets_;  ///< and whether each is hidden
  CullCounts culls_;
  CullLog* log_ = nullptr;
  std::vector<std::uint8_t> hidden_windows_;  ///< of the splat in flight; none if no test was made
  Counters counters_;
  PixelSink& pixels_;
  TapSink* taps_;
  Ranges* ranges_;
  BeginFrame frame_;
  BeginTile tile_;
  int rim_ = 0;  ///< pixels around the tile that its sheets hold
  std::uint32_t sheet_number_ = 0;
  std::vector<std::uint32_t> weights_;  ///< of the window in flight, P*P
  std::vector<std::uint32_t> scratch_;  ///< a tap's payload, P*P*4
};

}  // namespace fastsplat::cmodel
