// The steps of a splat before its pixels: position, snap, radius, emission, depth, phi, share.
#pragma once

#include <cstdint>
#include <vector>

#include "driver/radius_sets.hpp"
#include "driver/slices.hpp"
#include "driver/splat_quantiser.hpp"
#include "golden/splat/projected_splat.hpp"
#include "scene/scene.hpp"
#include "scene/sheet_plan.hpp"
#include "scene/splats.hpp"
#include "stages/real_narrowing.hpp"
#include "stages/step.hpp"

namespace fastsplat::stages {

/// A splat of a mixture.
struct StagedSplat {
  double x = 0.0, y = 0.0;  ///< centre, image pixels
  double radius = 0.0;      ///< support, pixels
  double z = 0.0;           ///< depth, kernel units: as golden's, or a multiple of 2^-zf behind the first boundary
  golden::Sums value{};     ///< R, G, B, tau of the whole splat
  int first = 0;            ///< nearest sheet that it reaches
};

/// The splats of a scene in traversal order, and the line of voxels that each lies on (scene::Traversal).
struct SplatList {
  explicit SplatList(const scene::Scene& scene);
  std::vector<scene::Splat> splats;
  std::vector<std::uint32_t> lines;
  int rows = 0, columns = 0;
};

/// What a frame's splats have in common, on either side. Keeps references to `scene` and `config`.
class SplatSteps {
 public:
  SplatSteps(const scene::Scene& scene, const cmodel::Config& config);

  /// In the order of the list. With `golden_units`, values are golden's: material times density, which golden's weights
  /// multiply by the kernel's peak; else the device's, X-ray exposure in them.
  std::vector<StagedSplat> staged(const SplatList& list, const Mixture& mixture, bool golden_units, int threads) const;

  /// What each sheet gets, from splat.first on.
  void shares(const StagedSplat& splat, const Mixture& mixture, std::vector<golden::Sums>& out) const;

  bool carries() const { return quantiser_.carries(); }  ///< what rounding takes of a splat, to the next
  int sheets() const { return plan_.slabs.count; }
  int reach() const;  ///< the most sheets that one splat reaches
  const driver::RadiusSets& sets() const { return sets_; }

  /// Of the kernel in front of boundary `boundary`: 0 before the first one, 1 behind the last.
  double phi(const StagedSplat& splat, int boundary, const Mixture& mixture) const;
  /// Where boundary `boundary` lies behind the splat's centre, kernel units.
  double behind(const StagedSplat& splat, int boundary, const Mixture& mixture) const;
  bool sliced() const { return plan_.use == scene::SheetUse::Sliced; }

 private:
  int first_sheet(const scene::RealSplat& splat, double z, const Mixture& mixture) const;

  const scene::Scene& scene_;
  const cmodel::Config& config_;
  scene::SheetPlan plan_;
  driver::Slices slices_;
  driver::RadiusSets sets_;
  driver::SplatQuantiser quantiser_;
  driver::Target position_, depth_, whole_, phi_word_;
  RealNarrowing snap_;
  bool xray_;
  double whole_ulp_, largest_share_, depth_ulp_;
  std::vector<double> boundary_;   ///< B_s 2^-zf
  std::vector<double> phi_table_;  ///< PHI 2^-hf
  std::vector<double> phi_real_;   ///< the same places, unrounded
};

}  // namespace fastsplat::stages
