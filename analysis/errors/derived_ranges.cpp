// SPDX-License-Identifier: Apache-2.0
#include "analysis/errors/derived_ranges.hpp"

#include <fmt/format.h>

#include <cmath>

#include "cmodel/numbers/observers.hpp"

namespace fastsplat::analysis {
namespace {

using cmodel::Config;
using cmodel::Site;

/// Largest words of the signals. No product of them reaches 2^58, so 64 bits hold every interval.
struct Largest {
  std::int64_t axis, entry, weight, colour, product, sheet, slab, one, composited;

  explicit Largest(const Config& c)
      : axis(c.axis_weight_format().max),
        entry(c.weight_format().max),
        weight(c.index() == cmodel::IndexKind::Separable && !c.has_ellipses() ? word(c, Site::AxisProduct, axis * axis)
                                                                              : entry),
        colour(c.colour_format().max),
        product(word(c, Site::Product, colour * weight)),
        sheet(c.sheet_format().max),
        slab(word(c, Site::AddedColour, sheet)),
        one(c.transmittance_format().max),
        composited(c.composited_format().max) {}

 private:
  static std::int64_t word(const Config& c, Site site, std::int64_t value) { return narrowing(c, site)(value).word; }
};

/// `value` as an interval 0..value, or -value..value.
DerivedRange interval(const Config& c, Site site, const Largest& l) {
  const auto up_to = [&](std::int64_t greatest, const char* formula, Width width = Width::Tight) {
    return DerivedRange{.site = site, .least = 0, .greatest = greatest, .formula = formula, .width = width};
  };
  switch (site) {
    case Site::Snap: {
      const cmodel::Format position = c.position_format();
      return {.site = site, .least = position.min, .greatest = position.max, .formula = "2^(pi-1) - 2^-pf"};
    }
    case Site::AxisProduct:
      return up_to(l.axis * l.axis, "min(1, E)^2");
    case Site::RadialFall: {
      const std::int64_t most = l.entry * ((std::int64_t{1} << c.rlut_guard_bits) - 1);
      return {.site = site, .least = -most, .greatest = most, .formula = "E (1 - 2^-g)"};
    }
    case Site::Product:
      return up_to(l.colour * l.weight, "V W");
    case Site::Sum:
      return up_to(l.sheet + l.product, "S + P", Width::Unbounded);
    case Site::Fall:
      return up_to(c.factor_format().max * ((std::int64_t{1} << c.opacity_remainder_bits()) - 1), "1 - 2^-b");
    case Site::SlabColour:
    case Site::SlabOpacity:
      return up_to(l.sheet * c.factor_format().max, "S 1");
    case Site::AddedColour:
    case Site::AddedOpacity:
      return up_to(l.sheet, "S");
    case Site::Light:
      return up_to(l.one * l.slab, "1 L");
    case Site::Absorbed:
      return up_to(l.one * l.one, "1 1");
    case Site::Over:
      return up_to(l.composited + l.slab, "C + L", Width::Unbounded);
    case Site::SumOver:
      return up_to(l.sheet + l.sheet, "S + S", Width::Unbounded);
    case Site::PixelOut:
      return up_to(l.composited, "C");
    case Site::PixelSum:
      break;
  }
  return up_to(l.sheet, "S");
}

bool has(const Config& config, Site site) {
  if (site == Site::AxisProduct) return config.index() == cmodel::IndexKind::Separable;
  return site != Site::RadialFall || config.interpolates();
}

}  // namespace

const char* to_string(Width width) {
  switch (width) {
    case Width::Tight:
      return "tight";
    case Width::Wasteful:
      return "wasteful";
    case Width::Saturates:
      return "saturates";
    case Width::Unbounded:
      break;
  }
  return "unbounded";
}

std::vector<DerivedRange> derived_ranges(const Config& config) {
  const Largest largest(config);
  std::vector<DerivedRange> out;
  for (std::size_t i = 0; i < cmodel::kSiteCount; ++i) {
    const Site site = static_cast<Site>(i);
    if (!has(config, site)) continue;
    DerivedRange derived = interval(config, site, largest);
    const cmodel::Narrowing narrowing = cmodel::narrowing(config, site);
    cmodel::Range ends;
    ends.least = derived.least, ends.greatest = derived.greatest;
    derived.spare = ends.headroom(narrowing);
    // Narrowing never decreases, so its ends decide.
    if (derived.width != Width::Unbounded) {
      const bool cut = narrowing(derived.least).overflow || narrowing(derived.greatest).overflow;
      derived.width = cut ? Width::Saturates : derived.spare > 0 ? Width::Wasteful : Width::Tight;
    }
    out.push_back(derived);
  }
  return out;
}

std::string format_text(const cmodel::Format& format) {
  if (format.word_bits == 0) return fmt::format("One.{}", format.frac_bits);
  return fmt::format("{} {}.{}", format.min < 0 ? 'S' : 'U', format.word_bits - format.frac_bits, format.frac_bits);
}

std::string interval_text(std::int64_t least, std::int64_t greatest, int frac_bits) {
  const auto value = [&](std::int64_t word) { return std::ldexp(static_cast<double>(word), -frac_bits); };
  return fmt::format("{:.6g}..{:.6g}", value(least), value(greatest));
}

std::string verdict(const DerivedRange& range) {
  return range.width == Width::Wasteful ? fmt::format("{} unused", range.spare) : to_string(range.width);
}

}  // namespace fastsplat::analysis
