// SPDX-License-Identifier: Apache-2.0
#include "analysis/errors/bound_band.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fastsplat::analysis {
namespace {

/// exp(-tau) (exp(by) - 1), 0 <= by <= tau: in this order no factor overflows, however large tau is.
double dimmed_growth(double tau, double by) { return std::exp(by - tau) * -std::expm1(-by); }

/// Largest change of the opacity 1 - exp(-tau) if tau changes by at most `error` and stays at 0 or above.
double opacity_change(double tau, double dims, double error) {
  return std::max(dimmed_growth(tau, std::min(error, tau)), dims * -std::expm1(-error));
}

/// Largest difference between this change and dims times that of tau.
double beyond_linear(double tau, double dims, double error) {
  const double less = std::min(error, tau);
  return std::max(dimmed_growth(tau, less) - dims * less, dims * (error + std::expm1(-error)));
}

}  // namespace

BoundBand::BoundBand(const stages::Chain& chain, const stages::Mixture& known, const Roundings& roundings,
                     std::span<const stages::StagedSplat> splats, golden::Rows rows, int width)
    : chain_(chain),
      known_(known),
      r_(roundings),
      splats_(splats),
      rows_(rows),
      width_(width),
      sheets_(chain.steps().sheets()),
      xray_(chain.scene().description.method == scene::Method::XRay),
      additive_(chain.scene().description.slab_opacity == scene::SlabOpacity::Additive),
      entries_(chain.config().radial_entries),
      weights_(chain.scene().kernel, chain.config()),
      cells_(static_cast<std::size_t>(sheets_) * static_cast<std::size_t>(rows.end - rows.first) *
             static_cast<std::size_t>(width)) {
  const std::size_t pixels = static_cast<std::size_t>(rows.end - rows.first) * static_cast<std::size_t>(width);
  upper_.assign(pixels, 1.0);
  lower_.assign(pixels, 1.0);
  closed_.assign(pixels, 0);
  total_.assign(pixels, Sums{});
  greatest_.assign(pixels, Sums{});
}

void BoundBand::run(const stages::BandBins& bins, int band) {
  fill_sheets(bins, band);
  look_through();
  for (int sheet = 0; sheet < sheets_; ++sheet) {
    for (const std::uint32_t i : bins.bin(band, sheet)) add(splats_[i]);
    finish(sheet);
  }
  for (std::size_t at = 0; at < total_.size(); ++at) {
    for (std::size_t c = 0; c < 4; ++c) {
      if (closed_[at] == 0 && !(total_[at][c] <= greatest_[at][c])) greatest_[at][c] = total_[at][c];  // NaN stays NaN
    }
  }
}

void BoundBand::fill_sheets(const stages::BandBins& bins, int band) {
  for (int sheet = 0; sheet < bins.sheets(); ++sheet) {
    for (const std::uint32_t i : bins.bin(band, sheet)) fill(splats_[i]);
  }
}

void BoundBand::fill(const stages::StagedSplat& splat) {
  weights_.rasterise(splat, nullptr, known_, false, rows_, width_);
  chain_.steps().shares(splat, known_, shares_);
  for (const auto& span : weights_.spans()) {
    const auto weights = weights_.weights(span);
    for (std::size_t s = 0; s < shares_.size(); ++s) {
      SheetCell* at = &cell(splat.first + static_cast<int>(s), span.x, span.y);
      for (std::size_t p = 0; p < weights.size(); ++p) {
        for (std::size_t c = 0; c < 4; ++c) at[p].sums[c] += weights[p] * shares_[s][c];
      }
    }
  }
}

void BoundBand::look_through() {
  if (xray_) return;
  for (int y = rows_.first; y < rows_.end; ++y) {
    for (int x = 0; x < width_; ++x) {
      double transmittance = 1.0;
      for (int sheet = 0; sheet < sheets_; ++sheet) {
        SheetCell& at = cell(sheet, x, y);
        at.transmittance = transmittance;
        const double tau = at.sums[3];
        if (additive_) {
          at.opacity = std::min(1.0, tau);
        } else {
          at.dims = std::exp(-tau);
          at.opacity = -std::expm1(-tau);
          at.factor = tau > 0.0 ? at.opacity / tau : 1.0;
        }
        transmittance *= 1.0 - at.opacity;
      }
      Sums behind{};
      for (int sheet = sheets_ - 1; sheet >= 0; --sheet) {
        SheetCell& at = cell(sheet, x, y);
        at.behind = behind;
        const double tau = at.sums[3];
        for (std::size_t c = 0; c < 3; ++c) {
          at.colour[c] = tau > 0.0 ? at.sums[c] / tau : behind[c];  // any value will do if the sheet is empty
          const double shown = additive_ ? std::min(1.0, at.sums[c]) : at.sums[c] * at.factor;
          behind[c] = shown + (1.0 - at.opacity) * behind[c];
        }
        at.colour[3] = 1.0;
        behind[3] = at.opacity + (1.0 - at.opacity) * behind[3];
      }
    }
  }
}

BoundBand::Touch BoundBand::touch(const stages::StagedSplat& splat, double dx, double dy) const {
  Touch out;
  const double own = entries_ / (splat.radius * splat.radius);
  const double at = (dx * dx + dy * dy) * own;
  if (at < entries_) out.weight = weights_.weight(at, known_);
  const auto range = [&](double place, double scale, double more, double ratio) {
    const auto near = [&](double d) { return std::max(0.0, std::abs(d) - place); };
    const auto far = [&](double d) { return std::abs(d) + place; };
    const double low = std::max(0.0, (near(dx) * near(dx) + near(dy) * near(dy)) * scale - more),
                 high = (far(dx) * far(dx) + far(dy) * far(dy)) * scale + more;
    const double greatest = low < entries_ ? ratio * weights_.weight(low, {}) : 0.0,
                 least = high < entries_ ? ratio * weights_.weight(high, {}) : 0.0;
    return std::max({greatest - out.weight, out.weight - least, 0.0});
  };
  out.by_place = r_.place > 0.0 ? range(r_.place, own, 0.0, 1.0) : 0.0;
  double so_far = out.by_place, scale = own, ratio = 1.0;
  if (r_.radius) {
    const auto& sets = chain_.steps().sets();
    const double set = sets.radius(sets.nearest(splat.radius));
    scale = entries_ / (set * set);
    ratio = (splat.radius / set) * (splat.radius / set);
    if (set != splat.radius) {
      const double with = range(r_.place, scale, 0.0, ratio);
      out.by_radius = std::max(0.0, with - so_far);
      so_far = std::max(so_far, with);
    }
  }
  if (r_.lookup > 0.0) {
    const double with = range(r_.place, scale, r_.lookup, ratio);
    out.by_lookup = std::max(0.0, with - so_far);
    so_far = std::max(so_far, with);
  }
  if (r_.weight > 0.0 && out.weight + so_far > 0.0) out.by_weight = ratio * r_.weight;
  out.error = so_far + out.by_weight;
  return out;
}

void BoundBand::slice(const stages::StagedSplat& splat) {
  const stages::SplatSteps& steps = chain_.steps();
  Sliced& s = sliced_;
  steps.shares(splat, known_, s.value);
  s.first = splat.first;
  // The device's words contain this factor. Here the weights contain all of it, so errors of words are divided by it.
  double ratio = 1.0;
  if (r_.radius) {
    const auto& sets = steps.sets();
    const double of_set = splat.radius / sets.radius(sets.nearest(splat.radius));
    ratio = of_set * of_set;
  }
  for (std::size_t c = 0; c < 4; ++c)
    s.whole_error[c] = r_.emission / ratio + std::max(0.0, splat.value[c] - r_.largest_whole / ratio);
  if (!steps.sliced() || r_.shares_known) {  // whole splats, or shares that are known
    s.part.assign(s.size(), steps.sliced() ? 0.0 : 1.0);
    s.cut.assign(s.size() + 1, 0.0);
    s.word.assign(s.size() + 1, 0.0);
  } else {
    if (r_.depth > 0.0) {  // the device's splat may begin a slab earlier, or end one later
      if (s.first > 0) s.value.insert(s.value.begin(), Sums{}), --s.first;
      if (s.first + static_cast<int>(s.size()) < steps.sheets()) s.value.push_back(Sums{});
    }
    s.part.clear();
    s.cut.clear();
    s.word.clear();
    const double radius = chain_.scene().kernel.radius();
    for (std::size_t i = 0; i <= s.size(); ++i) {
      const int boundary = s.first + static_cast<int>(i);
      if (i > 0) s.part.push_back(steps.phi(splat, boundary, known_) - steps.phi(splat, boundary - 1, known_));
      const bool end = boundary == 0 || boundary == steps.sheets();
      const double near = std::max(0.0, std::abs(steps.behind(splat, boundary, known_)) - r_.depth);
      const bool inside = !end && near < radius;
      // The kernel falls off to both sides, so its profile is greatest where the boundary comes nearest to the centre.
      s.cut.push_back(inside ? r_.depth * chain_.scene().kernel.profile(near) + r_.phi : 0.0);
      s.word.push_back((inside ? r_.share : i == s.size() ? r_.last_share : 0.0) / ratio);
    }
  }
  s.share_error.assign(s.size(), Sums{});
  s.over.assign(s.size(), Sums{});
  for (std::size_t m = 0; m < s.size(); ++m) {
    for (std::size_t c = 0; c < 4; ++c) {
      const double error =
          s.whole_error[c] * s.part[m] + (s.cut[m] + s.cut[m + 1]) * splat.value[c] + s.word[m] + s.word[m + 1];
      s.over[m][c] = std::max(0.0, s.value[m][c] + error - r_.largest_share / ratio);
      s.share_error[m][c] = error + s.over[m][c];
    }
  }
}

void BoundBand::add(const stages::StagedSplat& splat) {
  const double set =
      r_.radius ? chain_.steps().sets().radius(chain_.steps().sets().nearest(splat.radius)) : splat.radius;
  const double reach = std::max(splat.radius, set) + r_.place;
  const auto clip = [](double at, int low, int high) {
    return static_cast<int>(std::clamp(at, static_cast<double>(low), static_cast<double>(high)));
  };
  const int left = clip(std::ceil(splat.x - reach), 0, width_),
            right = clip(std::floor(splat.x + reach) + 1.0, 0, width_),
            top = clip(std::ceil(splat.y - reach), rows_.first, rows_.end),
            bottom = clip(std::floor(splat.y + reach) + 1.0, rows_.first, rows_.end);
  bool seen = false;
  for (int y = top; y < bottom && !seen; ++y) {
    for (int x = left; x < right && !seen; ++x) seen = closed_[pixel(x, y)] == 0;
  }
  if (!seen) return;
  slice(splat);
  const bool geometry = r_.place == 0.0 && r_.lookup == 0.0 && r_.weight == 0.0 && !r_.radius;
  if (geometry) {
    weights_.rasterise(splat, nullptr, known_, false, {top, bottom}, width_);
    for (const auto& span : weights_.spans()) {
      const auto weights = weights_.weights(span);
      for (std::size_t p = 0; p < weights.size(); ++p) {
        const int x = span.x + static_cast<int>(p);
        if (closed_[pixel(x, span.y)] == 0 && weights[p] > 0.0) add_pixel(splat, {.weight = weights[p]}, x, span.y);
      }
    }
    return;
  }
  for (int y = top; y < bottom; ++y) {
    for (int x = left; x < right; ++x) {
      if (closed_[pixel(x, y)] != 0) continue;
      const Touch t = touch(splat, x - splat.x, y - splat.y);
      if (t.weight + t.error > 0.0) add_pixel(splat, t, x, y);
    }
  }
}

BoundBand::Effect BoundBand::effect(const SheetCell& at, std::size_t c) const {
  if (xray_) return {1.0, 0.0};
  if (c == 3) return {0.0, (1.0 - at.behind[3]) * at.dims};
  return {at.factor, (at.colour[c] - at.behind[c]) * at.dims - at.colour[c] * at.factor};
}

void BoundBand::add_pixel(const stages::StagedSplat& splat, const Touch& touch, int x, int y) {
  const Sliced& s = sliced_;
  const double greatest = touch.weight + touch.error;  // largest weight of the device
  const std::size_t n = s.size(), at = pixel(x, y);
  for (std::size_t c = 0; c < 4; ++c) {
    // An unknown acts on all sheets alike: signed sums. T is that of the known mixture.
    double weight_sum = 0.0, colour_sum = 0.0, tau_sum = 0.0;
    double cuts = 0.0, words = 0.0, products = 0.0, absolute = 0.0;
    Effect before{};
    for (std::size_t m = 0; m <= n; ++m) {
      SheetCell* const here = m < n ? &cell(s.first + static_cast<int>(m), x, y) : nullptr;
      const Effect one = here != nullptr ? effect(*here, c) : Effect{};
      const double t = here != nullptr ? here->transmittance : 0.0;
      const Effect now{t * one.colour, t * one.tau};
      // A boundary moves a share from one sheet to the other.
      cuts += s.cut[m] * std::abs(before.of(splat.value, c) - now.of(splat.value, c));
      words += s.word[m] * (std::abs(before.colour - now.colour) + std::abs(before.tau - now.tau));
      before = now;
      if (here == nullptr) break;
      weight_sum += now.of(s.value[m], c);
      colour_sum += now.colour * s.part[m];
      tau_sum += now.tau * s.part[m];
      // Rounding cannot take more than the product itself.
      const auto product = [&](std::size_t channel) {
        return std::min(r_.product, (s.value[m][channel] + s.share_error[m][channel]) * greatest);
      };
      const double rounded = one.colour * product(c) + std::abs(one.tau) * product(3);
      const double over = greatest * (one.colour * s.over[m][c] + std::abs(one.tau) * s.over[m][3]);
      products += t * rounded;
      words += t * over / std::max(greatest, 1e-300);
      const double moved =
          touch.error * std::abs(one.of(s.value[m], c)) + rounded + over +
          greatest * (s.part[m] * (one.colour * s.whole_error[c] + std::abs(one.tau) * s.whole_error[3]) +
                      (s.cut[m] + s.cut[m + 1]) * std::abs(one.of(splat.value, c)) +
                      (s.word[m] + s.word[m + 1]) * (one.colour + std::abs(one.tau)));
      here->moved[c] += moved;
      absolute += t * moved;
    }
    const double weights = std::abs(weight_sum);
    const double emission = greatest * (std::abs(colour_sum) * s.whole_error[c] + std::abs(tau_sum) * s.whole_error[3]);
    const double all = touch.error * weights + emission + greatest * (cuts + words) + products;
    total_[at][c] += all;
    cell(s.first + static_cast<int>(n) - 1, x, y).straddling[c] += std::max(0.0, absolute - all);
    term(Term::Place, touch.by_place * weights);
    term(Term::Radius, touch.by_radius * weights);
    term(Term::Lookup, touch.by_lookup * weights);
    term(Term::Weight, touch.by_weight * weights);
    term(Term::Emission, emission);
    term(Term::Depth, greatest * cuts);
    term(Term::Share, greatest * words);
    term(Term::Product, products);
  }
  if (xray_) return;
  for (std::size_t m = 0; m < n; ++m) {
    SheetCell& here = cell(s.first + static_cast<int>(m), x, y);
    const auto product = [&](std::size_t channel) {
      return std::min(r_.product, (s.value[m][channel] + s.share_error[m][channel]) * greatest);
    };
    here.tau_error += touch.error * s.value[m][3] + greatest * s.share_error[m][3] + product(3);
    for (std::size_t c = 0; c < 3; ++c) {
      const double colour = here.colour[c];
      here.spread[c] += touch.error * std::abs(s.value[m][c] - colour * s.value[m][3]) +
                        greatest * (s.share_error[m][c] + colour * s.share_error[m][3]) + product(c) +
                        colour * product(3);
    }
  }
}

void BoundBand::finish(int sheet) {
  if (xray_) return;
  for (int y = rows_.first; y < rows_.end; ++y) {
    for (int x = 0; x < width_; ++x) {
      const std::size_t at = pixel(x, y);
      if (closed_[at] == 0) finish_pixel(sheet, cell(sheet, x, y), at, x, y);
    }
  }
}

void BoundBand::finish_pixel(int sheet, SheetCell& here, std::size_t at, int x, int y) {
  const double upper = upper_[at], lower = lower_[at];
  // The device may terminate here: it then lacks what lies behind, seen through the remaining transmittance.
  if (lower < r_.freeze) {
    const double left = std::min(r_.freeze, upper);
    for (std::size_t c = 0; c < 4; ++c) {
      const double shown =
          c == 3 ? here.opacity : (additive_ ? std::min(1.0, here.sums[c]) : here.sums[c] * here.factor);
      const double unseen = left * (shown + (1.0 - here.opacity) * here.behind[c]);
      double amid = 0.0;
      for (int s = sheet; s < std::min(sheets_, sheet + chain_.steps().reach() + 2); ++s)
        amid += cell(s, x, y).straddling[c];
      const double candidate = total_[at][c] + amid + unseen;
      if (!(candidate <= greatest_[at][c])) greatest_[at][c] = candidate;
      if (upper < r_.freeze) term(Term::Freeze, unseen + amid);
    }
    if (upper < r_.freeze) {
      closed_[at] = 1;
      return;
    }
  }
  const double tau = here.sums[3];
  double most = tau + here.tau_error;
  if (most <= 0.0 &&
      here.sums[0] + here.sums[1] + here.sums[2] + here.spread[0] + here.spread[1] + here.spread[2] <= 0.0)
    return;
  // Sums that may saturate are off by up to their excess.
  const double cut = std::max(0.0, most - r_.largest_sum);
  const double tau_error = here.tau_error + cut;
  const double off = std::max(upper - here.transmittance, here.transmittance - lower);
  for (std::size_t c = 0; c < 4; ++c) {
    const bool alpha = c == 3;
    const double contrast = alpha ? 1.0 - here.behind[3] : std::abs(here.colour[c] - here.behind[c]);
    const double spread_known = alpha ? 0.0 : here.spread[c];
    const double sum_error = alpha ? tau_error : here.colour[c] * tau_error + spread_known;
    const double sum_most = here.sums[c] + sum_error;
    const double sum_cut = std::max(0.0, sum_most - r_.largest_sum);
    const double spread = spread_known + (alpha ? 0.0 : sum_cut + here.colour[c] * cut);
    double second = 0.0;
    if (additive_) {
      if (most > 1.0 || sum_most > 1.0) second = sum_error + here.behind[c] * tau_error;
    } else {
      second = contrast * beyond_linear(tau, here.dims, tau_error) + spread * std::min(0.5 * tau_error, 1.0);
    }
    const double sheet_cut = spread - spread_known + contrast * cut;
    const double behind = alpha ? 1.0 - here.behind[3] : here.behind[c];  // light uncovered by a rounding of opacity
    const double table = r_.factor * (tau * contrast + spread + contrast * tau_error);
    const double slab = (alpha ? 0.0 : std::min(r_.slab, sum_most)) + behind * std::min(r_.slab, most);
    const double composite =
        (alpha ? 0.0 : std::min(r_.composite, upper * sum_most)) + behind * std::min(r_.composite, upper * most);
    const double through = off * here.moved[c];
    total_[at][c] += through + upper * (second + sheet_cut + table + slab) + composite;
    term(Term::Transmittance, through);
    term(Term::SecondOrder, upper * second);
    term(Term::Sheet, upper * sheet_cut);
    term(Term::Factor, upper * table);
    term(Term::Slab, upper * slab);
    term(Term::Composite, composite);
  }
  const double opacity_error =
      (additive_ ? tau_error : opacity_change(tau, here.dims, tau_error)) + r_.factor * most + r_.slab;
  upper_[at] = std::min(upper, upper * std::min(1.0, 1.0 - here.opacity + opacity_error) + r_.composite);
  lower_[at] = std::max(0.0, lower * std::max(0.0, 1.0 - here.opacity - opacity_error) - r_.composite);
}

}  // namespace fastsplat::analysis
