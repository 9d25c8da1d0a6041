// SPDX-License-Identifier: Apache-2.0
#include "analysis/errors/bound_layer.hpp"

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

double above(double value, double limit) { return std::max(0.0, value - limit); }

void add(Terms& terms, Term which, double amount) { terms[static_cast<std::size_t>(which)] += amount; }

}  // namespace

LayerBound::LayerBound(const stages::Chain& chain, const Roundings& roundings)
    : r_(roundings),
      xray_(chain.scene().description.method == scene::Method::XRay),
      additive_(chain.scene().description.slab_opacity == scene::SlabOpacity::Additive),
      brightest_(chain.gaussians() != nullptr ? std::numeric_limits<double>::infinity() : 1.0),
      device_brightest_(std::isinf(roundings.largest_slab) ? brightest_ : roundings.largest_slab),
      golden_freeze_(chain.scene().description.culling.freeze) {}

double LayerBound::shown(const Layer& layer, std::size_t c) const {
  if (c == 3) return layer.opacity;
  return additive_ ? std::min(brightest_, layer.sums[c]) : layer.sums[c] * layer.factor;
}

void LayerBound::look_through(std::span<Layer> layers, PixelBound& pixel) const {
  if (xray_) return;
  double transmittance = 1.0;
  std::size_t last = layers.size();  // golden's last layer
  for (std::size_t i = 0; i < layers.size(); ++i) {
    Layer& at = layers[i];
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
    if (transmittance < golden_freeze_) last = std::min(last, i);
  }
  Sums behind{};
  for (std::size_t i = layers.size(); i-- > 0;) {
    Layer& at = layers[i];
    at.behind = behind;
    if (i == last) {
      for (std::size_t c = 0; c < 4; ++c) pixel.unseen[c] = at.transmittance * (1.0 - at.opacity) * behind[c];
    }
    const double tau = at.sums[3];
    for (std::size_t c = 0; c < 4; ++c) {
      // Any colour will do if the layer is empty.
      at.colour[c] = c == 3 ? 1.0 : tau > 0.0 ? at.sums[c] / tau : behind[c];
      behind[c] = shown(at, c) + (1.0 - at.opacity) * behind[c];
    }
  }
}

Effect LayerBound::effect(const Layer& at, std::size_t c) const {
  if (xray_) return {1.0, 0.0};
  if (c == 3) return {0.0, (1.0 - at.behind[3]) * at.dims};
  return {at.factor, (at.colour[c] - at.behind[c]) * at.dims - at.colour[c] * at.factor};
}

void LayerBound::terminate(const Layer& layer, const Sums& amid, PixelBound& pixel, Terms& terms) const {
  const double left = std::min(r_.freeze, pixel.upper);
  for (std::size_t c = 0; c < 4; ++c) {
    const double behind = left * (shown(layer, c) + (1.0 - layer.opacity) * layer.behind[c]);
    // What the device lacks, golden may lack, too: the larger one counts.
    const double unseen = std::max(behind, pixel.unseen[c]);
    const double candidate = pixel.total[c] + amid[c] + unseen;
    if (!(candidate <= pixel.greatest[c])) pixel.greatest[c] = candidate;  // NaN stays NaN
    if (pixel.upper < r_.freeze) add(terms, Term::Freeze, unseen + amid[c]);
  }
  if (pixel.upper < r_.freeze) pixel.closed = true;
}

void LayerBound::end(PixelBound& pixel) const {
  if (pixel.closed) return;
  for (std::size_t c = 0; c < 4; ++c) {
    const double all = pixel.total[c] + pixel.unseen[c];
    if (!(all <= pixel.greatest[c])) pixel.greatest[c] = all;
  }
}

void LayerBound::finish(const Layer& here, const Sums& amid, PixelBound& pixel, Terms& terms) const {
  if (xray_ || pixel.closed) return;
  // The device may terminate here: it then lacks what lies behind, seen through the remaining transmittance.
  if (pixel.lower < r_.freeze) terminate(here, amid, pixel, terms);
  if (pixel.closed) return;
  const double tau = here.sums[3];
  const double most = tau + here.tau_error;
  if (most <= 0.0 &&
      here.sums[0] + here.sums[1] + here.sums[2] + here.spread[0] + here.spread[1] + here.spread[2] <= 0.0)
    return;
  const double upper = pixel.upper, lower = pixel.lower;
  // Sums that may saturate are off by up to their excess.
  const double cut = above(most, r_.largest_sum);
  const double tau_error = here.tau_error + cut;
  const double off = std::max(upper - here.transmittance, here.transmittance - lower);
  const double opacity_most = additive_ ? most : -std::expm1(-(tau + tau_error));
  const double opacity_over = above(opacity_most + r_.factor * most, 1.0);  // opacities end at 1
  for (std::size_t c = 0; c < 4; ++c) {
    const bool alpha = c == 3;
    const double contrast = alpha ? 1.0 - here.behind[3] : std::abs(here.colour[c] - here.behind[c]);
    const double spread_known = alpha ? 0.0 : here.spread[c];
    const double sum_error = alpha ? tau_error : here.colour[c] * tau_error + spread_known;
    const double sum_most = here.sums[c] + sum_error;
    const double sum_cut = above(sum_most, r_.largest_sum);
    const double spread = spread_known + (alpha ? 0.0 : sum_cut + here.colour[c] * cut);
    const double behind = alpha ? 1.0 - here.behind[3] : here.behind[c];  // light uncovered by an error of opacity
    double second = 0.0, ends = 0.0;                                      // ends: of the formats of a slab
    if (additive_) {
      // Both min(1, S) and the device's end take at most what exceeds them.
      const double opacity_end = std::min(tau_error, opacity_over);
      double colour_end = std::max(above(sum_most, device_brightest_), above(here.sums[c], brightest_));
      if (device_brightest_ == brightest_) colour_end = std::min(colour_end, sum_error);
      second = behind * opacity_end + (alpha ? 0.0 : colour_end);
    } else {
      second = contrast * beyond_linear(tau, here.dims, tau_error) + spread * std::min(0.5 * tau_error, 1.0);
      if (!alpha)
        ends = above(here.colour[c] * opacity_most + spread + r_.factor * sum_most, r_.largest_slab) +
               behind * opacity_over;
    }
    const double sheet_cut = spread - spread_known + contrast * cut;
    const double table = r_.factor * (tau * contrast + spread + contrast * tau_error);
    const double slab = (alpha ? 0.0 : std::min(r_.slab, sum_most)) + behind * std::min(r_.slab, most);
    const double composite =
        (alpha ? 0.0 : std::min(r_.composite, upper * sum_most)) + behind * std::min(r_.composite, upper * most);
    const double through = off * here.moved[c];
    pixel.total[c] += through + upper * (second + sheet_cut + table + slab + ends) + composite;
    add(terms, Term::Transmittance, through);
    add(terms, Term::SecondOrder, upper * second);
    add(terms, Term::Sheet, upper * sheet_cut);
    add(terms, Term::Factor, upper * table);
    add(terms, Term::Slab, upper * (slab + ends));
    add(terms, Term::Composite, composite);
  }
  const double opacity_error =
      (additive_ ? tau_error : opacity_change(tau, here.dims, tau_error)) + r_.factor * most + r_.slab;
  pixel.upper = std::min(upper, upper * std::min(1.0, 1.0 - here.opacity + opacity_error) + r_.composite);
  pixel.lower = std::max(0.0, lower * std::max(0.0, 1.0 - here.opacity - opacity_error) - r_.composite);
}

}  // namespace fastsplat::analysis
