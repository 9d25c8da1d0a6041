// SPDX-License-Identifier: Apache-2.0
#include "analysis/errors/ranges.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "analysis/errors/derived_ranges.hpp"

namespace fastsplat::analysis {
namespace {

using cmodel::Config;
using cmodel::Narrowing;
using cmodel::Range;
using cmodel::Ranges;
using cmodel::Rounding;
using cmodel::Site;

double value_of(const cmodel::WideSum& sum) {
  constexpr double kWord = 18446744073709551616.0;  // 2^64
  return static_cast<double>(static_cast<std::int64_t>(sum.high)) * kWord + static_cast<double>(sum.low);
}

/// Few bits may hide between large halves of opposite sign: converts the sum's magnitude first, then its sign.
double signed_value_of(const cmodel::WideSum& sum) {
  if (!sum.negative()) return value_of(sum);
  cmodel::WideSum minus{~sum.low, ~sum.high};
  minus += {1, 0};
  return -value_of(minus);
}

const char* text_of(Rounding rounding) {
  return rounding == Rounding::TRN ? "trn" : rounding == Rounding::RND ? "rnd" : "rnd_conv";
}

SiteRange site_range(Site site, const Narrowing& narrowing, const Range& range) {
  SiteRange out;
  out.site = site;
  out.format = format_text(narrowing.to());
  out.rounding = text_of(narrowing.rounding());
  out.dropped_bits = narrowing.dropped_bits();
  out.values = range.count;
  out.zeros = range.leading[0];
  out.inexact = range.inexact;
  out.saturated = range.overflow;
  out.least = std::ldexp(static_cast<double>(range.least), -narrowing.from_frac());
  out.greatest = std::ldexp(static_cast<double>(range.greatest), -narrowing.from_frac());
  if (const std::uint64_t kept = range.count - range.overflow; kept > 0) {
    const double ulp = std::ldexp(1.0, -narrowing.dropped_bits()), n = static_cast<double>(kept);
    out.lost = {signed_value_of(range.error) * ulp / n, std::sqrt(value_of(range.error_squares) / n) * ulp};
  }
  out.theory = uniform_loss(narrowing.rounding(), narrowing.dropped_bits());
  out.head = range.headroom(narrowing);
  out.tail = range.idle_tail(narrowing);
  out.missing = range.missing_bits(narrowing);
  for (std::size_t bit = range.leading.size(); bit-- > 1;) {
    if (range.leading[bit] > 0)
      out.histogram.emplace_back(static_cast<int>(bit) - 1 - narrowing.from_frac(), range.leading[bit]);
  }
  return out;
}

/// A key and the sites whose words it shapes: heads give its integer bits, tails its fraction bits.
struct Signal {
  const char* key;
  int Config::*member;
  bool head;
  std::vector<Site> sites;
};
const std::vector<Signal>& signals() {
  static const std::vector<Signal> all{
      {"position.int_bits", &Config::position_int_bits, true, {Site::Snap}},
      {"sheet.int_bits", &Config::sheet_int_bits, true, {Site::Product, Site::Sum, Site::SumOver}},
      {"sheet.frac_bits", &Config::sheet_frac_bits, false, {Site::Product, Site::Sum, Site::SumOver}},
      {"opacity.frac_bits", &Config::opacity_frac_bits, false, {Site::Fall}},
      {"composite.frac_bits",
       &Config::composite_frac_bits,
       false,
       {Site::SlabColour, Site::SlabOpacity, Site::AddedColour, Site::AddedOpacity, Site::Light, Site::Absorbed,
        Site::Over}},
      {"pixel.int_bits", &Config::pixel_int_bits, true, {Site::PixelOut, Site::PixelSum}},
      {"pixel.frac_bits", &Config::pixel_frac_bits, false, {Site::PixelOut, Site::PixelSum}},
  };
  return all;
}

std::optional<Need> need(const Config& config, const Config& wide, const Signal& signal, const Ranges& ranges) {
  Need out{signal.key, config.*signal.member, 0, 0, {}, {}};
  std::optional<int> spare;
  double greatest = 0.0;
  for (const Site site : signal.sites) {
    const Range& range = ranges.at(site);
    if (range.count == 0) continue;
    const Narrowing narrowing = cmodel::narrowing(wide, site);
    const int of_site = signal.head ? range.headroom(narrowing) : range.idle_tail(narrowing);
    spare = std::min(spare.value_or(of_site), of_site);
    for (const std::int64_t end : {range.least, range.greatest})
      greatest = std::max(greatest, std::ldexp(std::abs(static_cast<double>(end)), -narrowing.from_frac()));
  }
  if (!spare) return std::nullopt;
  const cmodel::ConfigKey& key = *cmodel::find_key(signal.key);
  out.needs = std::max(key.min, wide.*signal.member - *spare);
  out.why = signal.head
                ? fmt::format("the largest value is {:.6g}", greatest)
                : (out.needs < out.has ? fmt::format("the last {} bits are 0 in every word", out.has - out.needs)
                                       : std::string("every bit is needed"));
  // A value that no configuration allows is replaced by the nearest allowed one.
  const int step = out.needs > out.has ? -1 : 1;
  const auto sound = [&](int value) {
    Config changed = config;
    changed.*signal.member = value;
    const auto wrong = cmodel::first_violation(changed);
    if (wrong) out.limit = fmt::format("{} {}", wrong->where, wrong->what);
    return !wrong;
  };
  out.possible = out.needs;
  while (out.possible != out.has && !sound(out.possible)) out.possible += step;
  return out;
}

}  // namespace

Lost uniform_loss(Rounding rounding, int dropped) {
  if (dropped == 0) return {};
  const double step = std::ldexp(1.0, -dropped);  // of a value, in the word's last place
  const double spread = (1.0 - step * step) / 12.0;
  const double mean = rounding == Rounding::TRN ? -0.5 * (1.0 - step) : rounding == Rounding::RND ? 0.5 * step : 0.0;
  // Halves to even: a tie above an even word goes down, a tie above an odd word up. All else is as half up.
  const double squares = rounding == Rounding::RND_CONV ? spread + 0.25 * step * step : spread + mean * mean;
  return {mean, std::sqrt(squares)};
}

bool cut(const Ranges& ranges) {
  for (const Site site : {Site::Product, Site::Sum, Site::SumOver, Site::PixelOut, Site::PixelSum}) {
    if (ranges.at(site).overflow > 0) return true;
  }
  return false;
}

Config roomy(const Config& config) {
  Config out = config;
  out.sheet_int_bits = std::min(8, 32 - config.sheet_frac_bits);
  out.pixel_int_bits = std::min(8, 32 - config.pixel_frac_bits);
  return out;
}

RangesReport ranges_report(const Config& config, const Ranges& ranges, const Ranges& wide) {
  RangesReport out;
  out.config = config;
  const Config wide_config = cut(ranges) ? roomy(config) : config;
  for (std::size_t i = 0; i < cmodel::kSiteCount; ++i) {
    const Site site = static_cast<Site>(i);
    if (ranges.at(site).count > 0)
      out.sites.push_back(site_range(site, cmodel::narrowing(config, site), ranges.at(site)));
  }
  for (const Signal& signal : signals()) {
    const auto found = signal.head ? need(config, wide_config, signal, wide) : need(config, config, signal, ranges);
    if (found) out.needs.push_back(*found);
  }
  return out;
}

}  // namespace fastsplat::analysis
