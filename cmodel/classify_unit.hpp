// Unit "classify": a pixel's density and its differences to the neighbours' become what a sheet of colours would hold
// there (docs/numerics.md, section 6.2). Pure steps on tables that the driver loads.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cmodel/classify_tables.hpp"
#include "cmodel/config.hpp"
#include "cmodel/lane.hpp"
#include "cmodel/stream_layout.hpp"

namespace fastsplat::cmodel {

/// Differences of density words: right less left, below less above, behind less before; to both sides, so that one to
/// one side counts twice.
struct DensitySlope {
  std::int64_t x = 0, y = 0, z = 0;
};

class ClassifyUnit {
 public:
  explicit ClassifyUnit(const Config& config);

  /// The words of a checked load_table record of one of its tables.
  void load(Table table, std::span<const std::uint32_t> words);

  /// Density (U si.sf) of pixel (x,y) of the image in sheet `sheet`: R, G, B, tau as section 6 takes them from a sheet.
  SheetWord operator()(std::uint32_t density, const DensitySlope& slope, std::int32_t x, std::int32_t y,
                       std::uint32_t sheet) const;

 private:
  /// A table in linear segments, words of f fraction bits: its value at segment i, `rest` of 2^rest_bits on.
  class Lines {
   public:
    Lines(int frac_bits, int rest_bits);
    /// `first` of a table of several channels, `step` words from one entry to the next.
    std::int64_t at(std::span<const std::uint32_t> words, std::int64_t position, std::size_t first = 0,
                    std::size_t step = 1) const;

   private:
    int rest_bits_;
    Narrowing fall_;
  };
  struct Normal;  ///< g, and what makes its length 1

  std::int64_t facing(const Normal& normal, std::size_t vector) const;
  std::int64_t tilt(std::size_t axis, std::int32_t pixel) const;

  int sheet_frac_bits_;
  std::int64_t top_;  ///< density 1.0
  std::vector<std::uint32_t> classify_, root_, glint_, light_, sheets_;
  Lines colour_lines_, tau_lines_, root_lines_, glint_lines_;
  Narrowing across_, along_, tilt_, length_, share_, matt_, lit_, product_;
};

}  // namespace fastsplat::cmodel
