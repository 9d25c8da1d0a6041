// SPDX-License-Identifier: Apache-2.0
// The list itself. To add a setting, add its field to SceneDescription and one entry here. Its key, flag, limits, saved
// scene, refusals, line in the guide and tests follow. A new technique is a row of capability_table.cpp.
#include <array>

#include "scene/settings.hpp"

namespace fastsplat::scene {
namespace {

using D = SceneDescription;

constexpr Methods kWithSheets = only(Method::ImageAligned) | only(Method::AxisAligned) | only(Method::Westover);

constexpr double kDegrees = 3600.0;
constexpr double kMotion = 1e4;  // mm
constexpr double kOrbit = 30.0;  // degrees: the path is taken as straight, 3.4 % of the radius off an arc of 30 degrees

const std::vector<std::string>& shading_names() {
  static const std::vector<std::string> names = {"auto", "off", "on"};
  return names;
}

const std::vector<std::string>& projection_names() {
  static const std::vector<std::string> names = {"orthographic", "perspective"};
  return names;
}

const std::vector<std::string>& fit_names() {
  static const std::vector<std::string> names = {"sphere", "content"};
  return names;
}

const std::vector<std::string>& order_names() {
  static const std::vector<std::string> names = {"pre", "post"};
  return names;
}

const std::vector<std::string>& gradient_names() {
  static const std::vector<std::string> names = {"central", "splats"};
  return names;
}

const std::vector<std::string>& where_names() {
  static const std::vector<std::string> names = {"voxel", "pixel"};
  return names;
}

// References to the enums that are settings.
Method& method(D& d) { return d.method; }
Projection& projection(D& d) { return d.camera.projection; }
Fit& fit(D& d) { return d.camera.fit; }
SlabOpacity& slab_opacity(D& d) { return d.slab_opacity; }
FootprintShape& footprint_shape(D& d) { return d.footprint.shape; }
DepthOfField& depth_of_field(D& d) { return d.lens.depth_of_field; }
ClassifyOrder& classify_order(D& d) { return d.classify; }
GradientKind& gradients(D& d) { return d.gradients; }
SolidKind& texture_kind(D& d) { return d.texture.kind; }
TextureWhere& texture_where(D& d) { return d.texture.where; }
SolidKind& bump_kind(D& d) { return d.bump.kind; }

/// A choice kept in an enum whose values are positions in names().
template <auto Of>
constexpr Choice choice(const std::vector<std::string>& (*names)()) {
  return {names, [](const D& d) { return static_cast<int>(Of(const_cast<D&>(d))); },
          [](D& d, int at) {
            auto& value = Of(d);
            value = static_cast<std::remove_reference_t<decltype(value)>>(at);
          }};
}

const std::array kSettings{
    Setting{"", "method", "--method", "Method", "NAME",
            "raycast (golden only), xray, westover, axis_aligned, image_aligned", choice<method>(method_names),
            Capability::everywhere("axis_aligned")},
    Setting{"", "shading", "--shading", "Scene", "on|off|auto", "auto: as the transfer function requests",
            Choice{shading_names, [](const D& d) { return d.shading + 1; }, [](D& d, int at) { d.shading = at - 1; }},
            Capability::everywhere("off")},
    Setting{"", "crop", "--crop", "Scene", "A..B,C..D,E..F",
            "draw only these voxels, both ends included; or the 3-D Gaussians whose centres are in this box",
            Box{[](D& d) -> VoxelBox& { return d.crop; }}, Capability::everywhere("1..7,0..9,2..8")},
    Setting{"", "opacity_scale", "--opacity-scale", "Scene", "NUMBER", "factor on every extinction",
            Real{1e-6, 1e6, [](D& d) -> double& { return d.opacity_scale; }},
            Capability::everywhere("3").and_with(Technique::Exposure)},

    Setting{"camera", "projection", "", "", "", "", choice<projection>(projection_names),
            Capability::everywhere("perspective")},
    Setting{"camera", "azimuth", "--azimuth", "Camera", "DEGREES",
            "degrees about the vertical axis; 0 looks from the front",
            Real{-kDegrees, kDegrees, [](D& d) -> double& { return d.camera.azimuth; }}, Capability::everywhere("47")},
    Setting{"camera", "elevation", "--elevation", "Camera", "DEGREES", "degrees, positive looks down",
            Real{-kDegrees, kDegrees, [](D& d) -> double& { return d.camera.elevation; }},
            Capability::everywhere("-20")},
    Setting{"camera", "roll", "--roll", "Camera", "DEGREES", "degrees about the view axis",
            Real{-kDegrees, kDegrees, [](D& d) -> double& { return d.camera.roll; }}, Capability::everywhere("25")},
    Setting{"camera", "zoom", "--zoom", "Camera", "NUMBER", "1 fits the volume's bounding sphere",
            Real{1e-6, 1e6, [](D& d) -> double& { return d.camera.zoom; }}, Capability::everywhere("1.5")},
    Setting{"camera", "fit", "--fit", "Camera", "sphere|content",
            "what zoom 1 fits: the bounding sphere or the non-empty voxels", choice<fit>(fit_names),
            Capability::everywhere("content")},
    Setting{"camera", "fov", "--fov", "Camera", "DEGREES", "degrees across the smaller side (perspective)",
            Real{1.0, 150.0, [](D& d) -> double& { return d.camera.fov; }},
            Capability::of(Technique::Perspective, "60")},

    Setting{"culling", "block", "--culling-block", "Culling", "VOXELS", "edge of the smallest block",
            Integer{2, 256, [](D& d) -> int& { return d.culling.block; }},
            Capability::of(Technique::Blocks, "2").same_picture()},
    Setting{"culling", "freeze", "--freeze", "Culling", "NUMBER",
            "early-termination threshold on transmittance; 0: never",
            Real{0.0, 0.999, [](D& d) -> double& { return d.culling.freeze; }},
            Capability::turns_on(Technique::Freezing, "0.4")},
    Setting{"culling", "mode", "--culling", "Culling", "NAME",
            "what is tested for visibility before splatting: off, splats or blocks",
            Choice{culling_mode_names, [](const D& d) { return static_cast<int>(d.culling.mode); },
                   [](D& d, int at) { d.culling.mode = static_cast<CullingMode>(at); }},
            Capability::turns_on(Technique::Culling, "splats").same_picture()},
    Setting{"culling", "test", "--culling-test", "Culling", "NAME",
            "hidden when every pixel is opaque (count) or their mean is (average)",
            Choice{visibility_test_names, [](const D& d) { return static_cast<int>(d.culling.test); },
                   [](D& d, int at) { d.culling.test = static_cast<VisibilityTest>(at); }},
            Capability::of(Technique::Culling, "average")},
    Setting{"culling", "theta", "--culling-theta", "Culling", "NUMBER",
            "mean opacity required by --culling-test average",
            Real{0.0, 0.99, [](D& d) -> double& { return d.culling.theta; }},
            Capability::of(Technique::AverageTest, "0.05").and_with(Technique::Culling)},

    Setting{"display", "background", "--background", "Output", "R,G,B",
            "background colour in .png and .tif, linear, 0..1 each",
            Triple{0.0, 1.0, [](D& d) -> glm::dvec3& { return d.display.background; }},
            Capability::everywhere("0.2,0.5,0.9")},

    Setting{"image", "width", "", "", "", "", Integer{1, kMaxImageSide, [](D& d) -> int& { return d.width; }},
            Capability::everywhere("17")},
    Setting{"image", "height", "", "", "", "", Integer{1, kMaxImageSide, [](D& d) -> int& { return d.height; }},
            Capability::everywhere("17")},

    Setting{"kernel", "a", "--kernel-a", "Scene", "NUMBER", "a of the kernel exp(-a r^2)",
            Real{0.1, 20.0, [](D& d) -> double& { return d.kernel_a; }}, Capability::everywhere("1.2")},
    Setting{"kernel", "radius", "--kernel-radius", "Scene", "NUMBER", "kernel's radius R in voxels",
            Real{0.5, 8.0, [](D& d) -> double& { return d.kernel_radius; }}, Capability::everywhere("1.5")},

    Setting{"slabs", "opacity", "--slab-opacity", "Method", "NAME", "additive or exponential",
            choice<slab_opacity>(slab_opacity_names),
            Capability::with_methods(kWithSheets, "gives sheets no opacity",
                                     "use --method image_aligned, axis_aligned or westover", "additive")},
    Setting{"slabs", "width", "--slab-width", "Method", "VOXELS", "image-aligned: slab width in voxels",
            Real{0.01, 64.0, [](D& d) -> double& { return d.slab_width; }},
            Capability::with_methods(only(Method::ImageAligned), "has no slabs", "use --method image_aligned", "2.3")},

    Setting{"raycast", "end", "--ray-end", "Method", "NUMBER",
            "ray caster: transmittance below which a ray ends; 0: exact",
            Real{0.0, 0.999, [](D& d) -> double& { return d.ray_end; }},
            Capability::with_methods(only(Method::RayCast), "casts no rays", "use --method raycast", "0.4")},

    Setting{"xray", "exposure", "--xray-exposure", "Method", "NUMBER",
            "X-ray: pixel = exposure * integral; 0 automatic",
            Real{0.0, 1e9, [](D& d) -> double& { return d.xray_exposure; }},
            Capability::with_methods(only(Method::XRay), "has no exposure", "use --method xray", "0.07")},
    Setting{"xray", "invert", "--xray-invert", "Method", "on|off", "X-ray: dark on bright in .png and .tif, like film",
            Switch{[](D& d) -> bool& { return d.display.invert; }},
            Capability::with_methods(only(Method::XRay), "has no film to invert", "use --method xray", "on")},
    Setting{"xray", "sheets", "--xray-sheets", "Method", "N", "X-ray: number of sheets",
            Integer{1, 65535, [](D& d) -> int& { return d.xray_sheets; }},
            Capability::with_methods(only(Method::XRay), "has no number of sheets", "use --method xray", "5")
                .same_picture()},

    Setting{"footprint", "shape", "--footprint", "Footprint", "NAME",
            "circle, or ellipse: the kernel's sphere as perspective shows it",
            choice<footprint_shape>(footprint_shape_names),
            Capability::turns_on(Technique::Ellipse, "ellipse").and_with(Technique::Perspective)},
    Setting{
        "footprint", "antialias", "--antialias", "Footprint", "on|off", "widen kernels to at least one pixel per voxel",
        Switch{[](D& d) -> bool& { return d.footprint.antialias; }}, Capability::turns_on(Technique::Antialias, "on")},

    Setting{"splat_texture", "amplitude", "--splat-texture", "Footprint", "0..1",
            "detail inside every splat: 0 none, 1 from zero to twice the footprint",
            Real{0.0, 1.0, [](D& d) -> double& { return d.footprint.texture.amplitude; }},
            Capability::turns_on(Technique::SplatTexture, "0.7")},
    Setting{"splat_texture", "phases", "--splat-phases", "Footprint", "N", "pictures in a textured splat's cycle",
            Integer{2, 64, [](D& d) -> int& { return d.footprint.texture.phases; }},
            Capability::of(Technique::SplatTexture, "5")},
    Setting{"splat_texture", "frame", "--splat-frame", "Footprint", "N", "number of the picture shown; cycles",
            Integer{0, 1'000'000'000, [](D& d) -> int& { return d.footprint.texture.frame; }},
            Capability::of(Technique::SplatTexture, "3")},
    Setting{"splat_texture", "scale", "--splat-scale", "Footprint", "VOXELS", "size of a textured splat's detail",
            Real{0.1, 4.0, [](D& d) -> double& { return d.footprint.texture.scale; }},
            Capability::of(Technique::SplatTexture, "0.9")},

    Setting{"motion", "translate", "--motion-translate", "Footprint", "X,Y,Z",
            "motion blur: the volume's path while the shutter is open, mm",
            Triple{-kMotion, kMotion, [](D& d) -> glm::dvec3& { return d.motion.translate; }},
            Capability::turns_on(Technique::Translation, "2,1,0")},
    Setting{"motion", "orbit", "--motion-orbit", "Footprint", "DEGREES",
            "motion blur: the camera's path in azimuth while the shutter is open",
            Real{-kOrbit, kOrbit, [](D& d) -> double& { return d.motion.orbit; }},
            Capability::turns_on(Technique::Orbit, "20")},

    Setting{"lens", "depth_of_field", "--depth-of-field", "Footprint", "NAME",
            "off; splats: widen each to its circle of confusion; sheets: filter each with its",
            choice<depth_of_field>(depth_of_field_names),
            Capability::turns_on(Technique::Lens, "splats").and_with(Technique::Aperture)},
    Setting{"lens", "aperture", "--aperture", "Footprint", "MM", "the lens's diameter",
            Real{0.0, 1e6, [](D& d) -> double& { return d.lens.aperture; }}, Capability::of(Technique::Lens, "9")},
    Setting{"lens", "focus", "--focus", "Footprint", "MM",
            "depth in focus, from the volume's centre; positive is farther",
            Real{-1e6, 1e6, [](D& d) -> double& { return d.lens.focus; }},
            Capability::of(Technique::Lens, "2").and_with(Technique::Aperture)},

    Setting{"classify", "order", "--classify", "Technique", "pre|post",
            "classify voxels (pre) or densities in every pixel (post)", choice<classify_order>(order_names),
            Capability::turns_on(Technique::PostClassified, "post")},
    Setting{"classify", "gradients", "--gradients", "Technique", "central|splats",
            "post: differences of densities, or splatted derivatives", choice<gradients>(gradient_names),
            Capability::of(Technique::PostClassified, "splats").and_with(Technique::Shading)},

    Setting{"texture", "kind", "--texture", "Technique", "NAME",
            "solid texture: none, stripes, marble, wood, noise, checker", choice<texture_kind>(solid_kind_names),
            Capability::turns_on(Technique::SolidTexture, "checker")},
    Setting{"texture", "where", "--texture-where", "Technique", "voxel|pixel", "where colours are tinted",
            choice<texture_where>(where_names), Capability::of(Technique::SolidTexture, "voxel")},
    Setting{"texture", "scale", "--texture-scale", "Technique", "MM", "one unit of the pattern",
            Real{1e-3, 1e6, [](D& d) -> double& { return d.texture.scale; }},
            Capability::of(Technique::SolidTexture, "3")},
    Setting{"texture", "amplitude", "--texture-amplitude", "Technique", "NUMBER", "strength: 0 none, 1 full",
            Real{0.0, 1.0, [](D& d) -> double& { return d.texture.amplitude; }},
            Capability::of(Technique::SolidTexture, "0.5")},

    Setting{"bump", "kind", "--bump", "Technique", "NAME", "bump mapping: none, stripes, marble, wood, noise",
            choice<bump_kind>(smooth_kind_names), Capability::turns_on(Technique::Bumps, "marble")},
    Setting{"bump", "scale", "--bump-scale", "Technique", "MM", "one unit of the pattern",
            Real{1e-3, 1e6, [](D& d) -> double& { return d.bump.scale; }}, Capability::of(Technique::Bumps, "4")},
    Setting{"bump", "amplitude", "--bump-amplitude", "Technique", "NUMBER",
            "height of the pattern, in units of its scale",
            Real{0.0, 10.0, [](D& d) -> double& { return d.bump.amplitude; }}, Capability::of(Technique::Bumps, "0.9")},
};

}  // namespace

std::span<const Setting> settings() { return kSettings; }

}  // namespace fastsplat::scene
