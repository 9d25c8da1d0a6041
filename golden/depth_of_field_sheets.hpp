// SPDX-License-Identifier: Apache-2.0
// Depth of field by filtering sheets: each sheet's colour and opacity are spread over the circle of confusion of its
// depth before it is composited (docs/techniques/depth-of-field-sheets.md).
#pragma once

#include <map>

#include "golden/disc_filter.hpp"
#include "golden/frame_sweep.hpp"
#include "golden/sheet_geometry.hpp"

namespace fastsplat::golden {

/// Uses the circle of confusion at the middle of the sheet; a sheet whose circle is a point is unchanged. Nothing
/// spreads into the picture from outside.
class DepthOfFieldSheets final : public LayerFilter {
 public:
  /// UserError (Usage) if a circle is wider than the picture.
  DepthOfFieldSheets(const scene::Lens& lens, const SheetGeometry& geometry);

  bool leaves(int sheet) const override { return discs_.find(sheet) == discs_.end(); }
  int margin() const override { return margin_; }
  Run extent(int sheet, const LayerFrame& in, int y) const override;
  void row(int sheet, const LayerFrame& in, int y, int begin, std::span<Layer> out) const override;

 private:
  std::map<int, DiscFilter> discs_;  ///< by sheet
  int margin_ = 0;
};

}  // namespace fastsplat::golden
