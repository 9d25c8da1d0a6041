#include "driver/splat_quantiser.hpp"

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
                               const Slices& slices, const scene::SheetPlan& plan)
    : scene_(scene),
      sets_(sets),
      slices_(slices),
      plan_(plan),
      position_(target(Site::Position, config)),
      whole_(target(Site::Whole, config)),
      carried_(target(Site::Carried, config)),
      carries_(driver::carries(scene.description.method, config)),
      exposed_(scene.amplitude * (is_xray(scene) ? scene.xray_scale : 1.0)) {
  if (carries_) shown_.emplace(config, scene.kernel);
}

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

}  // namespace fastsplat::driver
