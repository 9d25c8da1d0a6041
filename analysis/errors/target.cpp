// SPDX-License-Identifier: Apache-2.0
#include "analysis/errors/target.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "analysis/compare.hpp"
#include "analysis/error_values.hpp"
#include "analysis/figures.hpp"
#include "base/error.hpp"
#include "base/number_text.hpp"

namespace fastsplat::analysis {
namespace {

constexpr int kBits = 8;

[[noreturn]] void refuse(const std::string& text, const char* what) {
  throw_usage({.where = "--target",
               .what = what,
               .expected = "psnr>=DB, max<=LSB or rms<=LSB with a number above 0",
               .got = "'" + text + "'",
               .fix = "for example --target 'psnr>=50' (quote it: the shell interprets > and <)"});
}

}  // namespace

double Fidelity::psnr_db() const {
  return rms_lsb == 0.0 ? std::numeric_limits<double>::infinity() : 20.0 * std::log10(lsb_per_unit(kBits) / rms_lsb);
}

Fidelity fidelity(const Image& ref, const Image& test, int threads) {
  const CompareOptions options{.lsb_bits = kBits, .threads = threads};
  check_comparable(ref, test, options);
  const ErrorSums sums = sum_errors(error_values(ref, test, options), threads);
  // Pictures with NaN or infinity meet no target.
  if (sums.count < ref.data.size()) return {std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
  return {std::sqrt(sums.sum_squares / static_cast<double>(sums.count)), sums.max_abs};
}

bool Target::met(const Fidelity& of) const {
  switch (figure) {
    case Figure::Psnr:
      return of.psnr_db() >= limit;
    case Figure::Max:
      return of.max_lsb <= limit;
    case Figure::Rms:
      break;
  }
  return of.rms_lsb <= limit;
}

double Target::excess(const Fidelity& of) const {
  switch (figure) {
    case Figure::Psnr:
      return of.rms_lsb / (lsb_per_unit(kBits) * std::pow(10.0, -limit / 20.0));
    case Figure::Max:
      return of.max_lsb / limit;
    case Figure::Rms:
      break;
  }
  return of.rms_lsb / limit;
}

std::string Target::reached(const Fidelity& of) const {
  switch (figure) {
    case Figure::Psnr:
      return fmt::format("PSNR {:.2f} dB", of.psnr_db());
    case Figure::Max:
      return fmt::format("max {:.4g} LSB8", of.max_lsb);
    case Figure::Rms:
      break;
  }
  return fmt::format("RMS {:.4g} LSB8", of.rms_lsb);
}

Target parse_target(const std::string& text) {
  struct Kind {
    const char* start;
    Target::Figure figure;
  };
  for (const auto& [start, figure] :
       {Kind{"psnr>=", Target::Figure::Psnr}, {"max<=", Target::Figure::Max}, {"rms<=", Target::Figure::Rms}}) {
    if (!text.starts_with(start)) continue;
    const auto limit = number_from(std::string_view(text).substr(std::string_view(start).size()));
    if (!limit || !(*limit > 0.0)) refuse(text, "the limit is not a number above 0");
    if (figure == Target::Figure::Psnr && *limit > 300.0)
      refuse(text, "the limit exceeds the precision of float pictures");
    return {figure, *limit, text};
  }
  refuse(text, "not a target");
}

}  // namespace fastsplat::analysis
