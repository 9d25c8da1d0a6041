#include <algorithm>
#include <cassert>
#include <cmath>

#include "scene/transfer_function.hpp"

namespace fastsplat::scene {
namespace {

bool is_integer(volume::VoxelType type) { return type != volume::VoxelType::F32; }

struct Span {
  double low, high;
};

/// A volume of one value has no span; its value then counts as the top of one, so that it is visible.
Span non_empty(Span span) {
  if (span.high > span.low) return span;
  return span.high > 0.0 ? Span{0.0, span.high} : Span{span.high - 1.0, span.high};
}

constexpr double kLowRank = 0.005, kHighRank = 0.998;

/// The rank that a share of `count` voxels has among them.
std::size_t rank_of(double share, std::size_t count) {
  return static_cast<std::size_t>(share * static_cast<double>(count - 1));
}

/// percentile_span() of whole numbers, by counting them.
Span counted_percentile_span(const volume::Volume& volume) {
  std::vector<std::size_t> of_value(static_cast<std::size_t>(volume.max - volume.min) + 1, 0);
  for (const float v : volume.voxels) ++of_value[static_cast<std::size_t>(v - volume.min)];
  const std::size_t above = volume.voxels.size() - of_value[0];
  if (above == 0) return {volume.min, volume.max};
  const auto at_rank = [&](double share) {
    std::size_t left = rank_of(share, above), value = 1;
    while (left >= of_value[value]) left -= of_value[value++];
    return static_cast<double>(volume.min) + static_cast<double>(value);
  };
  return {at_rank(kLowRank), at_rank(kHighRank)};
}

/// Values at the 0.5 and 99.8 percent ranks of the voxels above the minimum.
Span percentile_span(const volume::Volume& volume) {
  if (is_integer(volume.stored)) return counted_percentile_span(volume);
  std::vector<float> values;
  values.reserve(volume.voxels.size());
  std::copy_if(volume.voxels.begin(), volume.voxels.end(), std::back_inserter(values),
               [&](float v) { return v > volume.min; });
  if (values.empty()) return {volume.min, volume.max};
  const auto at_rank = [&values](double share) {
    const auto rank = static_cast<std::ptrdiff_t>(rank_of(share, values.size()));
    std::nth_element(values.begin(), values.begin() + rank, values.end());
    return static_cast<double>(values[static_cast<std::size_t>(rank)]);
  };
  const double low = at_rank(kLowRank);
  return {low, at_rank(kHighRank)};
}

Span resolve(Domain domain, const volume::Volume& volume) {
  switch (domain) {
    case Domain::Value:
      return {0.0, 1.0};
    case Domain::Range:
      return non_empty({volume.min, volume.max});
    case Domain::Percentile:
      return non_empty(percentile_span(volume));
  }
  assert(false);
  return {0.0, 1.0};
}

}  // namespace

TransferFunction resolved(const TransferFunction& tf, const volume::Volume& volume) {
  TransferFunction raw = tf;
  const Span span = resolve(tf.domain, volume);
  for (auto& point : raw.points) point.at = span.low + point.at * (span.high - span.low);
  raw.domain = Domain::Value;
  return raw;
}

Classifier::Classifier(const TransferFunction& tf, const volume::Volume& volume)
    : points_(resolved(tf, volume).points), reference_length_(tf.reference_length), table_min_(volume.min) {
  assert(!points_.empty());
  if (!is_integer(volume.stored)) return;
  const auto entries = static_cast<std::size_t>(volume.max - volume.min) + 1;
  table_.reserve(entries);
  for (std::size_t i = 0; i < entries; ++i)
    table_.push_back(evaluate(static_cast<double>(table_min_) + static_cast<double>(i)));
}

Material Classifier::operator()(float value) const {
  if (table_.empty()) return evaluate(value);
  assert(value >= table_min_ && static_cast<std::size_t>(value - table_min_) < table_.size());
  return table_[static_cast<std::size_t>(value - table_min_)];
}

bool Classifier::transparent(double low, double high) const {
  const auto inside = [&](const ControlPoint& p) { return p.at >= low && p.at <= high && p.opacity > 0.0; };
  return !(evaluate(low).extinction > 0.0f) && !(evaluate(high).extinction > 0.0f) &&
         std::none_of(points_.begin(), points_.end(), inside);
}

Material Classifier::evaluate(double value) const {
  // The first point beyond the value: of two at the same place the later one rules there and above.
  const auto above =
      std::find_if(points_.begin(), points_.end(), [value](const ControlPoint& p) { return p.at > value; });
  const ControlPoint& high = above == points_.end() ? points_.back() : *above;
  const ControlPoint& low = above == points_.begin() ? points_.front() : *(above - 1);
  if (low.opacity == 0.0 && high.opacity == 0.0) return {};
  const double t = high.at > low.at ? std::clamp((value - low.at) / (high.at - low.at), 0.0, 1.0) : 0.0;
  const double opacity = low.opacity + t * (high.opacity - low.opacity);
  return {.colour = glm::vec3(low.colour + t * (high.colour - low.colour)),
          .extinction = static_cast<float>(-std::log1p(-opacity) / reference_length_)};
}

}  // namespace fastsplat::scene
