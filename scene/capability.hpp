// What goes with what: which techniques a method and an engine have, what each needs and excludes, where a setting has
// a meaning. One table (capability_table.cpp); what would be ignored is refused by the two functions of this header.
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

/// What an engine must have beyond circles of the splats' own scale that are added into sheets.
enum class Feature : unsigned {
  None,
  Footprints = 1,
  Pixels = 2,
  Freezing = 4,
  Details = 8,
  Densities = 16,
  Patterns = 32
};

/// What an engine has.
struct Offers {
  const char* engine;  ///< "golden", "device"
  Methods methods;
  unsigned features;                     ///< Features, or'ed
  const char* footprints_fix = nullptr;  ///< how to have Feature::Footprints, where another of its kind has it
  Methods methods_elsewhere = 0u;        ///< methods that another of its kind has, and how to have it
  const char* methods_fix = "";
  const char* densities_fix = nullptr;  ///< how to have Feature::Densities, likewise
  const char* details_fix = nullptr;    ///< how to have Feature::Details, likewise
  const char* patterns_fix = nullptr;   ///< how to have Feature::Patterns, likewise
};
inline constexpr Offers kOffersAll{"golden", kAllMethods, 63u};

/// What a scene has or has not, in the order in which an engine is asked for it: rows of the table. Not all are
/// techniques; the last are what techniques need.
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

/// Of a setting: where it has a meaning. There is none by default: a setting without one does not compile.
class Capability {
 public:
  /// `probe`: a value, as a flag's text, that is not the default and shows in the picture wherever the setting has a
  /// meaning.
  static constexpr Capability everywhere(const char* probe) { return Capability(probe); }
  /// Only with some methods. `why` says what the others lack ("has no slabs"), `fix` what to do about it.
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
  /// Turns `technique` on; turning it off is never in vain.
  static constexpr Capability turns_on(Technique technique, const char* probe) {
    Capability c(probe);
    c.turns = technique;
    return c;
  }
  /// Besides, only while this is on, too.
  constexpr Capability and_with(Technique technique) const {
    Capability c = *this;
    c.needs[c.needs[0] ? 1 : 0] = technique;
    return c;
  }
  /// Changes the work, and by design not the picture.
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

/// A setting that somebody gave: by its flag, or by its key in a file ("scene.toml:3:9").
struct Given {
  const Setting* setting;
  std::string place{};  ///< empty: by its flag
};

/// Why an engine cannot render the scene: the first technique that is on and that the method or the engine does not
/// have, that lacks what it needs or meets what it excludes. `description.shading` may still be -1: then it may be on.
std::optional<ErrorParts> refusal(const SceneDescription& description, const Offers& offers);
/// Why a setting that was given would change nothing in the scene; how techniques go together is the other's matter.
std::optional<ErrorParts> refusal(const Given& given, const SceneDescription& description);

/// UserError (Usage) where the engine cannot render the scene.
void check_capability(const SceneDescription& description, const Offers& offers);
/// The same with shading as it was resolved.
void check_capability(const Scene& scene, const Offers& offers);
/// Those of them that would change nothing.
std::vector<Given> idle_of(const std::vector<Given>& given, const SceneDescription& description);
/// UserError (Usage of a flag, Input of a file) about the first of them, which are idle in `description`.
void refuse_idle(const std::vector<Given>& idle, const SceneDescription& description);

/// The table of the guide, as Markdown: every setting that not all methods or engines have, or that needs something.
std::string capability_guide(std::span<const Offers> engines);

}  // namespace fastsplat::scene
