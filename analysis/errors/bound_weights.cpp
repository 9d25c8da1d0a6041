// SPDX-License-Identifier: Apache-2.0
#include "analysis/errors/bound_weights.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "driver/tiles/gaussian_windows.hpp"

namespace fastsplat::analysis {
namespace {

/// The channel in which a splat has most.
std::size_t brightest(const golden::Sums& value) {
  return static_cast<std::size_t>(std::ranges::max_element(value) - value.begin());
}

}  // namespace

KnownSplats::KnownSplats(const stages::Chain& chain, const stages::Mixture& mixture, const Roundings& roundings,
                         int threads)
    : known(chain.staged(mixture, false, threads)) {
  if (!roundings.radius || !chain.shaped()) return;
  stages::Mixture with = mixture;
  with.set(stages::Step::Radius);
  device = chain.staged(with, false, threads);
}

WeightBound::WeightBound(const stages::Chain& chain, const stages::Mixture& known, const Roundings& roundings,
                         const KnownSplats& splats)
    : chain_(chain),
      known_(known),
      r_(roundings),
      splats_(splats),
      exact_(r_.place == 0.0 && r_.ellipse_place == 0.0 && !r_.radius && r_.distance == 0.0 && r_.index == 0.0 &&
             r_.weight == 0.0),
      entries_(chain.config().radial_entries),
      weights_(chain.scene().kernel, chain.config()) {}

double WeightBound::Form::greatest(double dx, double dy, double place) const {
  // A convex function is greatest at a corner.
  double most = 0.0;
  for (const double x : {dx - place, dx + place}) {
    for (const double y : {dy - place, dy + place}) most = std::max(most, at(x, y));
  }
  return most;
}

double WeightBound::Form::least(double dx, double dy, double place) const {
  if (place == 0.0) return std::max(0.0, at(dx, dy));
  if (std::abs(dx) <= place && std::abs(dy) <= place) return 0.0;
  // The least lies on an edge: a parabola along it.
  double least = std::numeric_limits<double>::infinity();
  for (const double side : {-place, place}) {
    const double x = dx + side, y = std::clamp(-b * x / (2.0 * c), dy - place, dy + place);
    least = std::min(least, at(x, y));
    const double below = dy + side, beside = std::clamp(-b * below / (2.0 * a), dx - place, dx + place);
    least = std::min(least, at(beside, below));
  }
  return std::max(0.0, least);
}

void WeightBound::begin(std::size_t i) {
  splat_ = &splats_.known.splats[i];
  shape_ = splats_.known.shape(i);
  const stages::StagedSplat* const drawn = splats_.drawn(i);
  ratio_ = 1.0;
  clipped_ = std::numeric_limits<double>::infinity();
  if (shape_ != nullptr && shape_->own) {
    const stages::StagedShape& device = drawn != nullptr ? splats_.device.shapes[i] : *shape_;
    own_ = {.a = shape_->a, .b = shape_->b, .c = shape_->c};
    drawn_ = {.a = device.a, .b = device.b, .c = device.c};
    place_ = r_.ellipse_place;
    if (drawn != nullptr) {
      const std::size_t c = brightest(splat_->value);
      if (splat_->value[c] > 0.0) ratio_ = drawn->value[c] / splat_->value[c];
    }
    moved_ = drawn != nullptr;
    near_x_ = std::ceil(splat_->x - place_ - device.reach_x);
    near_y_ = std::ceil(splat_->y - place_ - device.reach_y);
    reach_x_ = std::max(shape_->reach_x, device.reach_x) + place_ + device.beyond;
    reach_y_ = std::max(shape_->reach_y, device.reach_y) + place_ + device.beyond;
    // The centre's pixel may be one beside the known one.
    if (shape_->tiles != nullptr && r_.distance > 0.0) clipped_ = driver::gaussian_reach(chain_.config()) - 2.0;
    return;
  }
  shape_ = nullptr;
  double set = splat_->radius;
  if (r_.radius) {
    const auto& sets = chain_.steps().sets();
    set = sets.radius(sets.nearest(set));
  }
  moved_ = set != splat_->radius;
  const double own = entries_ / (splat_->radius * splat_->radius), theirs = entries_ / (set * set);
  own_ = {.a = own, .b = 0.0, .c = own};
  drawn_ = {.a = theirs, .b = 0.0, .c = theirs};
  ratio_ = (splat_->radius / set) * (splat_->radius / set);
  place_ = r_.place;
  reach_x_ = reach_y_ = std::max(splat_->radius, set) + place_ + stages::more_reach(chain_.config());
}

driver::Extent WeightBound::extent() const {
  const auto from = [](double at, double far) { return static_cast<std::int32_t>(std::ceil(at - far)); };
  const auto to = [](double at, double far) { return static_cast<std::int32_t>(std::floor(at + far)) + 1; };
  const std::int32_t bottom = to(splat_->y, reach_y_);
  return {from(splat_->x, reach_x_), to(splat_->x, reach_x_), from(splat_->y, reach_y_), bottom, bottom};
}

double WeightBound::coefficients(int x, int y) const {
  const double i = std::max(0.0, x - near_x_), j = std::max(0.0, y - near_y_);
  return r_.coefficient * (1.0 + i + i * i + j + j * j + i * j);
}

Touch WeightBound::at(int x, int y) const {
  Touch out;
  const double dx = x - splat_->x, dy = y - splat_->y;
  const double known = std::max(0.0, own_.at(dx, dy));
  if (known < entries_) out.weight = weights_.weight(known, known_);
  const auto range = [&](const Form& form, double more, double ratio) {
    const double low = std::max(0.0, form.least(dx, dy, place_) - more), high = form.greatest(dx, dy, place_) + more;
    const double greatest = low < entries_ ? ratio * weights_.weight(low, {}) : 0.0,
                 least = high < entries_ ? ratio * weights_.weight(high, {}) : 0.0;
    return std::max({greatest - out.weight, out.weight - least, 0.0});
  };
  out.by_place = place_ > 0.0 ? range(own_, 0.0, 1.0) : 0.0;
  double so_far = out.by_place;
  if (moved_) {
    const double with = range(drawn_, 0.0, ratio_);
    out.by_radius = std::max(0.0, with - so_far);
    so_far = std::max(so_far, with);
  }
  const double lookup = r_.index + (shape_ != nullptr ? coefficients(x, y) : r_.distance);
  if (lookup > 0.0) {
    double with = range(drawn_, lookup, ratio_);
    if (std::max(std::abs(dx), std::abs(dy)) >= clipped_) with = std::max(with, out.weight);
    out.by_lookup = std::max(0.0, with - so_far);
    so_far = std::max(so_far, with);
  }
  if (r_.weight > 0.0 && out.weight + so_far > 0.0) out.by_weight = ratio_ * r_.weight;
  out.error = so_far + out.by_weight;
  return out;
}

}  // namespace fastsplat::analysis
