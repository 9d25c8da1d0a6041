// SPDX-License-Identifier: Apache-2.0
#include "driver/splats/rounding_carry.hpp"

#include "cmodel/numbers/sites.hpp"
#include "cmodel/stream/records.hpp"
#include "driver/tables/tables.hpp"

namespace fastsplat::driver {
namespace {

/// Offset of a line's sum, spread evenly over -1/2..1/2 among neighbours (65536 over the plastic number, and over its
/// square), so that equal lines do not step all at once (N-8-41).
double shift(std::uint32_t row, std::uint32_t column) {
  const std::uint32_t word = 32768U + 49472U * row + 37345U * column;
  return static_cast<double>(word & 0xFFFFU) / 65536.0 - 0.5;
}

}  // namespace

ShownWords::ShownWords(const cmodel::Config& config, const scene::Kernel& kernel) {
  const cmodel::LoadTable radial = radial_table(config, kernel);
  const cmodel::Narrowing product = cmodel::narrowing(config, cmodel::Site::Product);
  const double unit =
      std::ldexp(1.0, config.colour_frac_bits + config.radial_frac_bits - config.sheet_frac_bits);  // of a product
  double all = 0.0;
  for (std::size_t t = 0; t < radial.words.size(); ++t) all += radial.words[t] * radial_area(config, t);
  for (std::size_t word = 0; word < shown_.size(); ++word) {
    double sum = 0.0;
    for (std::size_t t = 0; t < radial.words.size(); ++t)
      sum +=
          static_cast<double>(product(static_cast<std::int64_t>(word) * radial.words[t]).word) * radial_area(config, t);
    shown_[word] = all > 0.0 ? sum * unit / all : static_cast<double>(word);  // short weights may all be 0
  }
}

RoundingCarry::RoundingCarry(const Target& carried, const ShownWords& shown, int first_row, int end_row, int columns)
    : carried_(carried),
      shown_(shown),
      columns_(static_cast<std::uint32_t>(columns)),
      first_(static_cast<std::uint32_t>(first_row) * columns_),
      lines_(static_cast<std::size_t>(end_row - first_row) * columns_) {}

RoundingCarry::Line& RoundingCarry::next(std::uint32_t line, int slice) {
  Line& out = lines_[line - first_];
  if (slice != out.slice + 1) {
    out.rest.fill(0.5);
    out.run = 0;
  }
  out.slice = slice;
  // At the third splat: shorter runs already round at least as well as single splats, which an offset would spoil.
  if (++out.run == 3)
    for (double& rest : out.rest) rest += shift(line / columns_, line % columns_);
  return out;
}

}  // namespace fastsplat::driver
