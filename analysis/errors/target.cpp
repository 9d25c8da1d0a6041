// SPDX-License-Identifier: Apache-2.0
#include "analysis/errors/target.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "analysis/compare.hpp"
#include "analysis/error_values.hpp"
#include "analysis/figures.hpp"
#include "base/error.hpp"
#include "base/number_text.hpp"

namespace fastsplat::analysis {
namespace {

constexpr int kBits = 8;

constexpr const char* kExpected = "psnr>=DB, max<=LSB, rms<=LSB or fps>=RATE with a number above 0";

[[noreturn]] void refuse(const std::string& text, const char* what) {
  throw_usage({.where = "--target",
               .what = what,
               .expected = kExpected,
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

bool Targets::met(const Fidelity& of) const {
  return std::ranges::all_of(pictures, [&](const Target& each) { return each.met(of); });
}

double Targets::excess(const Fidelity& of) const {
  double most = 0.0;
  for (const Target& each : pictures) most = std::max(most, each.excess(of));
  return most;
}

std::string Targets::text() const {
  std::string out;
  for (const Target& each : pictures) out += (out.empty() ? "" : ", ") + each.text;
  if (fps) out += (out.empty() ? "" : ", ") + fps_text;
  return out;
}

std::string Targets::reached(const Fidelity& of) const {
  std::string out;
  for (const Target& each : pictures) out += (out.empty() ? "" : ", ") + each.reached(of);
  return out;
}

Targets parse_targets(const std::vector<std::string>& texts) {
  struct Kind {
    const char* start;
    std::optional<Target::Figure> figure;
  };
  if (texts.empty()) {
    throw_usage({.where = "--target",
                 .what = "is required",
                 .expected = kExpected,
                 .got = {},
                 .fix = "for example --target 'psnr>=50' (quote it: the shell interprets > and <)"});
  }
  Targets out;
  std::set<std::string> seen;
  for (const std::string& text : texts) {
    bool known = false;
    for (const auto& [start, figure] : {Kind{"psnr>=", Target::Figure::Psnr}, Kind{"max<=", Target::Figure::Max},
                                        Kind{"rms<=", Target::Figure::Rms}, Kind{"fps>=", {}}}) {
      if (!text.starts_with(start)) continue;
      known = true;
      if (!seen.insert(start).second) refuse(text, "a second target of the same figure");
      const auto limit = number_from(std::string_view(text).substr(std::string_view(start).size()));
      if (!limit || !(*limit > 0.0)) refuse(text, "the limit is not a number above 0");
      if (figure == Target::Figure::Psnr && *limit > 300.0)
        refuse(text, "the limit exceeds the precision of float pictures");
      if (figure) {
        out.pictures.push_back({*figure, *limit, text});
      } else {
        out.fps = *limit;
        out.fps_text = text;
      }
    }
    if (!known) refuse(text, "not a target");
  }
  return out;
}

}  // namespace fastsplat::analysis
