#include "driver/splat_quantiser.hpp"

namespace fastsplat::driver {

SplatQuantiser::SplatQuantiser(const scene::Scene& scene, const cmodel::Config& config, const RadiusSets& sets,
                               const Slices& slices, const scene::SheetPlan& plan)
    : scene_(scene),
      sets_(sets),
      slices_(slices),
      plan_(plan),
      position_(target(Site::Position, config)),
      whole_(target(Site::Whole, config)),
      exposed_(scene.amplitude * (scene.description.method == scene::Method::XRay ? scene.xray_scale : 1.0)) {}

std::int32_t SplatQuantiser::depth(const scene::RealSplat& splat) const {
  switch (plan_.use) {
    case scene::SheetUse::Sliced:
      return slices_.quantise_depth(splat.depth - plan_.slabs.first);
    case scene::SheetUse::GridSheet:
      return splat.sheet;
    case scene::SheetUse::OneSheet:
    case scene::SheetUse::None:
      break;
  }
  return 0;
}

QuantisedSplat SplatQuantiser::operator()(const scene::RealSplat& splat, bool& saturated) const {
  const double radius = pixel_radius(scene_, splat.at.scale);
  QuantisedSplat out{.x = quantise_to<std::int32_t>(splat.at.x, position_),
                     .y = quantise_to<std::int32_t>(splat.at.y, position_),
                     .depth = depth(splat),
                     .set = sets_.nearest(radius),
                     .words = {}};
  // The set's footprint is a little wider or narrower than the splat's own: as much is added in all.
  const double width_ratio = radius / sets_.radius(out.set);
  const double amplitude = exposed_ * width_ratio * width_ratio;
  for (std::size_t c = 0; c < 4; ++c) {
    const Quantised channel = quantise(splat.material[c] * amplitude, whole_);
    saturated = saturated || channel.saturated;
    out.words[c] = static_cast<std::uint32_t>(channel.word);
  }
  return out;
}

}  // namespace fastsplat::driver
