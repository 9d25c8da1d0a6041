// Techniques that look at the pixels of whole sheets: classification after splatting, textures at pixels, bumps. Only
// image-aligned sheets of the golden renderer have them; docs/techniques/ has a page for each.
#pragma once

#include "scene/scene.hpp"

namespace fastsplat::scene {

/// The first of them that is turned on, as its key in scene.toml ("classify.order"); empty if none is.
std::string pixel_technique_in_use(const SceneDescription& description);

/// UserError (Usage) unless they go together with the method and with each other. `shading` as resolved with the
/// transfer function.
void check_pixel_techniques(const SceneDescription& description, const Shading& shading);

}  // namespace fastsplat::scene
