// SPDX-License-Identifier: Apache-2.0
// Which combinations are valid: the techniques of each method and engine, their requirements and exclusions, and where
// a setting has an effect. All rules are in one table (capability_table.cpp).
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "scene/scene.hpp"

namespace fastsplat::scene {

struct Setting;

/// A set of methods, one bit each.
using Methods = unsigned;
constexpr Methods only(Method method) { return 1u << static_cast<unsigned>(method); }
inline constexpr Methods kAllMethods = (1u << 5) - 1;

/// Features of an engine beyond adding circles of the splats' own scale to sheets.
enum class Feature : unsigned {
  None,
  Footprints = 1,
  Pixels = 2,
  Freezing = 4,
  Details = 8,
  Densities = 16,
  Patterns = 32
};

/// The abilities of an engine.
struct Offers {
  const char* engine;  ///< "golden", "device"
  Methods methods;
  unsigned features;                     ///< Features, or'ed
  const char* footprints_fix = nullptr;  ///< how to get Feature::Footprints from another engine of its kind
  Methods methods_elsewhere = 0u;        ///< methods of another engine of its kind, and how to get it
  const char* methods_fix = "";
  const char* densities_fix = nullptr;  ///< how to get Feature::Densities, likewise
  const char* details_fix = nullptr;    ///< how to get Feature::Details, likewise
  const char* patterns_fix = nullptr;   ///< how to get Feature::Patterns, likewise
};
inline constexpr Offers kOffersAll{"golden", kAllMethods, 63u};

/// Properties of a scene, in the order in which an engine is checked for them: rows of the table. Not all are
/// techniques; the last ones are requirements of techniques.
enum class Technique {
  Ellipse,
  Antialias,
  SplatTexture,
  Translation,
  Orbit,
  Lens,
  LensOnSplats,
  LensOnSheets,
  PostClassified,
  GradientSplats,
  SolidTexture,
  VoxelTexture,
  PixelTexture,
  Bumps,
  Culling,
  Blocks,
  Freezing,
  AverageTest,
  Perspective,
  Shading,
  Aperture,
  Exposure,
};

/// Where a setting has an effect. Has no default, so a setting without it does not compile.
class Capability {
 public:
  /// `probe`: a value other than the default, as a flag's text, that changes the picture wherever the setting has an
  /// effect.
  static constexpr Capability everywhere(const char* probe) { return Capability(probe); }
  /// Only with some methods. `why` names what the others lack ("has no slabs"), `fix` is the suggestion.
  static constexpr Capability with_methods(Methods methods, const char* why, const char* fix, const char* probe) {
    Capability c(probe);
    c.methods = methods, c.why = why, c.fix = fix;
    return c;
  }
  /// Only while `technique` is on.
  static constexpr Capability of(Technique technique, const char* probe) {
    Capability c(probe);
    c.needs[0] = technique;
    return c;
  }
  /// Turns `technique` on; turning it off is always valid.
  static constexpr Capability turns_on(Technique technique, const char* probe) {
    Capability c(probe);
    c.turns = technique;
    return c;
  }
  /// Additionally requires `technique`.
  constexpr Capability and_with(Technique technique) const {
    Capability c = *this;
    c.needs[c.needs[0] ? 1 : 0] = technique;
    return c;
  }
  /// Changes the work but, by design, not the picture.
  constexpr Capability same_picture() const {
    Capability c = *this;
    c.changes_picture = false;
    return c;
  }

  const char* probe;
  std::optional<Technique> turns;
  std::optional<Technique> needs[2];
  Methods methods = kAllMethods;
  const char* why = "";
  const char* fix = "";
  bool changes_picture = true;

 private:
  explicit constexpr Capability(const char* text) : probe(text) {}
};

/// A setting that the user gave by its flag, or by its key in a file ("scene.toml:3:9").
struct Given {
  const Setting* setting;
  std::string place{};  ///< empty: by its flag
};

/// Why an engine cannot render the scene: the first active technique that the method or the engine lacks, whose
/// requirement is missing, or that meets an exclusion. `description.shading` may be -1; it then counts as possibly on.
std::optional<ErrorParts> refusal(const SceneDescription& description, const Offers& offers);
/// Why a given setting would change nothing in the scene. The function above checks combinations of techniques.
std::optional<ErrorParts> refusal(const Given& given, const SceneDescription& description);

/// Throws UserError (Usage) if the engine cannot render the scene.
void check_capability(const SceneDescription& description, const Offers& offers);
/// The same with resolved shading.
void check_capability(const Scene& scene, const Offers& offers);
/// The given settings that would change nothing.
std::vector<Given> idle_of(const std::vector<Given>& given, const SceneDescription& description);
/// Throws UserError (Usage for a flag, Input for a file) about the first of `idle`, settings without effect.
void refuse_idle(const std::vector<Given>& idle, const SceneDescription& description);

/// The table of the guide, as Markdown: every setting with a requirement or limited to some methods or engines.
std::string capability_guide(std::span<const Offers> engines);

}  // namespace fastsplat::scene
