// SPDX-License-Identifier: Apache-2.0
#include "driver/splats/splat_quantiser.hpp"

#include <cassert>
#include <cmath>

namespace fastsplat::driver {
namespace {

bool is_xray(const scene::Scene& scene) { return scene.description.method == scene::Method::XRay; }

}  // namespace

bool carries(scene::Method method, const cmodel::Config& config) {
  switch (static_cast<cmodel::Carry>(config.rounding_carry)) {
    case cmodel::Carry::Off:
      return false;
    case cmodel::Carry::XRay:
      return method == scene::Method::XRay;
    case cmodel::Carry::On:
      break;
  }
  return true;
}

SplatQuantiser::SplatQuantiser(const scene::Scene& scene, const cmodel::Config& config, const RadiusSets& sets,
                               const Slices& slices, const scene::SheetPlan& plan,
                               const scene::TexturedSplats* textures)
    : scene_(scene),
      sets_(sets),
      textures_(textures),
      slices_(slices),
      plan_(plan),
      config_(config),
      position_(target(Site::Position, config)),
      centre_(target(Site::EllipseCentre, config)),
      whole_(target(Site::Whole, config)),
      carried_(target(Site::Carried, config)),
      shrink_(target(Site::Shrink, config)),
      carries_(driver::carries(scene.description.method, config)),
      exposed_(scene.amplitude * (is_xray(scene) ? scene.xray_scale : 1.0)) {
  if (carries_) shown_.emplace(config, scene.kernel);
  if (draws_ellipses(scene, config)) shaper_.emplace(scene);
}

CentreRule SplatQuantiser::centre_rule() const {
  const scene::Camera& camera = scene_.camera;
  const auto axis = [](const glm::dvec3& v) { return std::array{v.x, v.y, v.z}; };
  const scene::ScreenPoint middle = camera.project(glm::dvec3(0.0));
  const Target& deep = slices_.depth_target();
  assert(position_.rounding != Target::Rounding::Up && deep.rounding == Target::Rounding::Nearest);
  return {.forward = axis(camera.direction()),
          .right = axis(camera.right()),
          .down = axis(camera.down()),
          .middle_x = middle.x,
          .middle_y = middle.y,
          .scale = camera.scale_at(0.0),
          .eye = camera.eye_distance(),
          .unit = scene_.volume->kernel_unit(),
          .first = plan_.slabs.first,
          .position_scale = position_.scale,
          .position_bias = position_.rounding == Target::Rounding::Nearest ? 0.5 : 0.0,
          .depth_scale = deep.scale,
          .depth_bias = 0.5};
}

SplatQuantiser::Shaped SplatQuantiser::shaped(const scene::Splat& splat, std::uint32_t line,
                                              RoundingCarry* carry) const {
  const scene::RealSplat real = scene::real_splat(scene_, splat);
  std::array<double, 4> values{};
  for (std::size_t c = 0; c < 4; ++c) values[c] = real.material[c] * exposed_;
  const scene::ShapedSplat shape = (*shaper_)(splat, real, values);

  Shaped out;
  out.ellipse.shrink = quantise_to<std::uint32_t>(1.0 / shape.depth_growth, shrink_);
  const scene::ScreenShape& s = shape.shape;
  const double radius = scene_.kernel.radius() * std::sqrt(s.xx);
  const bool circle = s.xy == 0.0 && s.xx == s.yy;
  if (circle && std::abs(radius - sets_.radius(0)) <= kSameRadius * radius) {
    out.result = carry != nullptr ? (*this)(real, *carry, carry->next(line, splat.sheet)) : (*this)(real);
    return out;
  }
  const scene::ScreenShape footprint = drawn_footprint(s, scene_.kernel.radius());
  const double square = scene_.kernel.radius() * scene_.kernel.radius();
  // Along an axis only the other one grows.
  out.widened = footprint.xx != square * s.xx || footprint.yy != square * s.yy;
  const double fainter = out.widened ? std::sqrt(square * square * s.determinant() / footprint.determinant()) : 1.0;
  for (std::size_t c = 0; c < 4; ++c) values[c] = shape.value[c] * fainter;
  out.ellipse.shape = ellipse_words(config_, footprint);
  out.reach = reach(config_, out.ellipse.shape);
  out.result.splat = {.x = quantise_to<std::int32_t>(real.at.x, centre_),
                      .y = quantise_to<std::int32_t>(real.at.y, centre_),
                      .depth = depth(real.depth, real.sheet),
                      .set = kOwnShape,
                      .words = {}};
  if (carry != nullptr) {
    RoundingCarry::Line& carried = carry->next(line, splat.sheet);
    colour(
        values, [&](double value, std::size_t channel) { return (*carry)(value, carried, channel); }, out.result);
  } else {
    colour(
        values, [this](double value, std::size_t) { return quantise(value, whole_); }, out.result);
  }
  return out;
}

bool draws_ellipses(const scene::Scene& scene, const cmodel::Config& config) {
  const scene::SceneDescription& d = scene.description;
  return config.has_ellipses() && (d.footprint.shape == scene::FootprintShape::Ellipse || d.footprint.antialias ||
                                   !d.motion.none() || d.lens.depth_of_field == scene::DepthOfField::Splats);
}

std::int32_t SplatQuantiser::depth(double depth, int sheet) const {
  switch (plan_.use) {
    case scene::SheetUse::Sliced:
      return slices_.quantise_depth(depth - plan_.slabs.first);
    case scene::SheetUse::GridSheet:
      return sheet;
    case scene::SheetUse::OneSheet:
    case scene::SheetUse::None:
      break;
  }
  return 0;
}

}  // namespace fastsplat::driver
