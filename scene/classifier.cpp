// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "scene/transfer_function.hpp"
#include "scene/value_range.hpp"

namespace fastsplat::scene {
namespace {

bool is_integer(volume::VoxelType type) { return type != volume::VoxelType::F32; }

/// Converts a domain's positions to values: value = zero + position * unit.
struct Scale {
  double zero, unit;
};

/// 0 at the span's low end, 1 at its high end. If all voxels are equal the span is empty; their value then counts as
/// the high end, so that they are visible.
Scale across(ValueSpan span) {
  if (span.high > span.low) return {span.low, span.high - span.low};
  return span.high > 0.0 ? Scale{0.0, span.high} : Scale{span.high - 1.0, 1.0};
}

Scale hounsfield(const volume::Volume& volume) {
  if (volume.water) return {*volume.water, 1.0};
  constexpr double kLeast = -1000.0, kGreatest = 3000.0;
  const Scale range = across({volume.min, volume.max});
  const double unit = range.unit / (kGreatest - kLeast);
  return {range.zero - kLeast * unit, unit};
}

Scale scale_of(Domain domain, const volume::Volume& volume) {
  switch (domain) {
    case Domain::Value:
      return {0.0, 1.0};
    case Domain::Range:
      return across({volume.min, volume.max});
    case Domain::Percentile:
      return across(shown_span(volume));
    case Domain::Hounsfield:
      return hounsfield(volume);
    case Domain::Content:
      return across({background_top(volume), volume.max});
  }
  assert(false);
  return {0.0, 1.0};
}

}  // namespace

TransferFunction resolved(const TransferFunction& tf, const volume::Volume& volume) {
  TransferFunction raw = tf;
  const Scale scale = scale_of(tf.domain, volume);
  for (auto& point : raw.points) point.at = scale.zero + point.at * scale.unit;
  raw.domain = Domain::Value;
  if (tf.reference_length_mm) raw.reference_length = *tf.reference_length_mm / volume.kernel_unit();
  raw.reference_length_mm.reset();
  return raw;
}

std::string remark_on(const TransferFunction& tf, const volume::Volume& volume) {
  if (tf.domain != Domain::Hounsfield || volume.built_in || volume.water) return {};
  return fmt::format(
      "transfer function '{}' is in Hounsfield units, but the values {:g} to {:g} are not: they are mapped to -1000 to "
      "3000 HU",
      tf.name, volume.min, volume.max);
}

Classifier::Classifier(const TransferFunction& tf, const volume::Volume& volume) : table_min_(volume.min) {
  TransferFunction raw = resolved(tf, volume);
  points_ = std::move(raw.points);
  reference_length_ = raw.reference_length;
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
  // The first point beyond the value. Of two at the same place the later one applies there and above.
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
