// SPDX-License-Identifier: Apache-2.0
// Flags that parse but make no sense together (exit 2), and help, through the program itself; parse_test.cpp has the
// rest.
#include <gtest/gtest.h>

#include "tests/process/process_helper.hpp"

namespace fastsplat::cli_test {
namespace {

struct Misuse {
  const char* name;
  std::vector<std::string> arguments;
  std::vector<std::string> said;
};
void PrintTo(const Misuse& misuse, std::ostream* out) { *out << misuse.name; }

class Usage : public ::testing::TestWithParam<Misuse> {};

TEST_P(Usage, IsOneLineWithTheFix) { expect_error(fastsplat(GetParam().arguments), 2, GetParam().said); }

INSTANTIATE_TEST_SUITE_P(
    Render, Usage,
    ::testing::Values(
        Misuse{"no_output", {"render", "--volume", "shells:8"}, {"nothing to write", "--out"}},
        Misuse{"antialias_of_nothing_but_slabs",
               {"render", "--volume", "shells:8", "--size", "1", "--zoom", "0.000001", "--antialias", "on",
                "--slab-width", "0.01", "-o", "a.exr"},
               {"anti-aliasing", "4096", "--zoom"}},
        Misuse{"circles_wider_than_the_picture",
               {"render", "--volume", "shells:8", "--size", "16", "--perspective", "--depth-of-field", "sheets",
                "--aperture", "100000", "-o", "a.exr"},
               {"aperture", "16 pixels"}},
        Misuse{"size_zero", {"render", "--size", "0", "-o", "a.exr"}, {"--size", "'0'"}},
        Misuse{"size_negative", {"render", "--size", "-5", "-o", "a.exr"}, {"--size", "'-5'"}},
        Misuse{"size_half", {"render", "--size", "64x", "-o", "a.exr"}, {"--size", "'64x'"}},
        Misuse{"size_thrice", {"render", "--size", "6x4x2", "-o", "a.exr"}, {"--size", "'6x4x2'"}},
        Misuse{"size_huge", {"render", "--size", "99999999999", "-o", "a.exr"}, {"--size", "16384"}},
        Misuse{"engine_unknown", {"render", "--engine", "goldn", "-o", "a.exr"}, {"did you mean 'golden'"}},
        Misuse{"engine_rtl",
               {"render", "--engine", "rtl", "--config", "tiny", "--set", "snap.phases=1", "-o", "a.exr"},
               {"snap.phases", "the RTL needs a phase bit", "cmodel"}},
        Misuse{"golden_config", {"render", "--config", "base", "-o", "a.exr"}, {"--engine cmodel"}},
        Misuse{"golden_set", {"render", "--set", "radial.entries=256", "-o", "a.exr"}, {"--set", "--engine cmodel"}},
        Misuse{"set_mistyped",
               {"cycles", "--volume", "shells:8", "--set", "radial.entires=256"},
               {"--set radial.entires=256", "did you mean 'radial.entries'"}},
        Misuse{"golden_raw", {"render", "--raw", "a.exr"}, {"--engine cmodel"}},
        Misuse{"method_unknown", {"render", "--method", "xrai", "-o", "a.exr"}, {"xray"}},
        Misuse{"slab_opacity_unknown", {"render", "--slab-opacity", "aditive", "-o", "a.exr"}, {"additive"}},
        Misuse{"shading_maybe", {"render", "--shading", "maybe", "-o", "a.exr"}, {"--shading", "off or on"}},
        Misuse{"golden_index", {"render", "--index", "rlut", "-o", "a.exr"}, {"--index", "--engine cmodel"}},
        Misuse{"kernel_both_ways", {"render", "--kernel", "smooth", "--kernel-a", "2", "-o", "a.exr"}, {"--kernel"}},
        Misuse{"kernel_radius_out_of_range", {"render", "--kernel-radius", "99", "-o", "a.exr"}, {"8"}},
        Misuse{"projection_both_ways",
               {"render", "--perspective", "--orthographic", "-o", "a.exr"},
               {"cannot be combined with"}},
        Misuse{"fov_orthographic", {"render", "--fov", "30", "-o", "a.exr"}, {"--perspective"}},
        Misuse{"aperture_without_depth_of_field",
               {"render", "--perspective", "--aperture", "5", "-o", "a.exr"},
               {"--aperture", "--depth-of-field"}},
        Misuse{"aperture_negative",
               {"render", "--perspective", "--depth-of-field", "splats", "--aperture", "-5", "-o", "a.exr"},
               {"--aperture"}},
        Misuse{"focus_behind_the_eye",
               {"render", "--perspective", "--depth-of-field", "splats", "--aperture", "5", "--focus", "-9999", "-o",
                "a.exr"},
               {"behind the eye"}},
        Misuse{"depth_of_field_orthographic",
               {"render", "--depth-of-field", "splats", "--aperture", "5", "-o", "a.exr"},
               {"perspective"}},
        Misuse{"motion_two_numbers", {"render", "--motion-translate", "1,2", "-o", "a.exr"}, {"X,Y,Z"}},
        Misuse{"motion_orbit_too_far", {"render", "--motion-orbit", "90", "-o", "a.exr"}, {"-30..30"}},
        Misuse{"texture_amplitude_out_of_range",
               {"render", "--texture", "wood", "--texture-amplitude", "1.5", "-o", "a.exr"},
               {"--texture-amplitude", "0..1"}},
        Misuse{"texture_unknown", {"render", "--texture", "marbel", "-o", "a.exr"}, {"did you mean 'marble'"}},
        Misuse{"texture_scale_zero", {"render", "--texture", "wood", "--texture-scale", "0", "-o", "a.exr"}, {"0.001"}},
        Misuse{"texture_scale_without_texture",
               {"render", "--texture-scale", "5", "-o", "a.exr"},
               {"--texture-scale has no effect", "--texture wood"}},
        Misuse{"splat_frame_without_texture",
               {"render", "--splat-frame", "3", "-o", "a.exr"},
               {"--splat-frame has no effect", "--splat-texture"}},
        Misuse{"gradients_without_post", {"render", "--gradients", "splats", "-o", "a.exr"}, {"--classify post"}},
        Misuse{"bump_pre_classified",
               {"render", "--volume", "point:4", "--bump", "noise", "-o", "a.exr"},
               {"--bump:", "--classify post"}},
        Misuse{"bump_without_slope", {"render", "--bump", "checker", "-o", "a.exr"}, {"--bump", "marble"}},
        Misuse{"texture_at_pixels_of_axis_sheets",
               {"render", "--volume", "point:4", "--texture", "wood", "--method", "axis_aligned", "-o", "a.exr"},
               {"texture.where", "--texture-where voxel"}},
        Misuse{
            "post_on_device",
            {"render", "--engine", "cmodel", "--classify", "post", "--volume", "point:4", "--size", "8", "-o", "a.exr"},
            {"--classify:", "--engine golden"}},
        Misuse{"antialias_on_device",
               {"render", "--engine", "cmodel", "--antialias", "on", "--volume", "point:4", "-o", "a.exr"},
               {"--antialias:", "--engine golden"}},
        Misuse{"ellipse_by_rays",
               {"render", "--method", "raycast", "--perspective", "--footprint", "ellipse", "--volume", "point:4", "-o",
                "a.exr"},
               {"--footprint:", "ray caster"}},
        Misuse{"ellipse_of_parallel_rays",
               {"render", "--footprint", "ellipse", "--volume", "point:4", "-o", "a.exr"},
               {"--footprint", "--perspective"}},
        Misuse{"zoom_zero", {"render", "--zoom", "0", "-o", "a.exr"}, {"zoom"}},
        Misuse{"zoom_negative", {"render", "--zoom", "-1", "-o", "a.exr"}, {"zoom"}},
        Misuse{"slab_width_zero", {"render", "--slab-width", "0", "-o", "a.exr"}, {"slab"}},
        Misuse{"culling_on_device",
               {"render", "--engine", "cmodel", "--culling", "blocks", "--freeze", "0.01", "--volume", "point:4", "-o",
                "a.exr"},
               {"--culling:", "--engine golden"}},
        Misuse{"culling_without_sheets",
               {"render", "--method", "westover", "--freeze", "0.01", "-o", "a.exr"},
               {"--freeze:", "westover", "image_aligned"}},
        Misuse{
            "culling_without_freezing", {"render", "--culling", "splats", "-o", "a.exr"}, {"--culling:", "--freeze"}},
        Misuse{"culling_blocks_of_ellipses",
               {"render", "--culling", "blocks", "--freeze", "0.01", "--perspective", "--footprint", "ellipse", "-o",
                "a.exr"},
               {"--culling:", "--culling splats"}},
        Misuse{"theta_without_average",
               {"render", "--culling", "splats", "--freeze", "0.01", "--culling-theta", "0.9", "-o", "a.exr"},
               {"--culling-theta", "--culling-test average"}},
        Misuse{"slab_width_of_xray",
               {"render", "--method", "xray", "--slab-width", "2", "-o", "a.exr"},
               {"--slab-width does not apply to xray", "--method image_aligned"}},
        Misuse{"slab_opacity_by_rays",
               {"render", "--method", "raycast", "--slab-opacity", "exponential", "-o", "a.exr"},
               {"--slab-opacity does not apply to raycast"}},
        Misuse{"exposure_of_slabs", {"render", "--xray-exposure", "2", "-o", "a.exr"}, {"--method xray"}},
        Misuse{"opacity_under_automatic_exposure",
               {"render", "--method", "xray", "--opacity-scale", "2", "-o", "a.exr"},
               {"--opacity-scale has no effect", "--xray-exposure"}},
        Misuse{"ellipse_orthographic", {"render", "--footprint", "ellipse", "-o", "a.exr"}, {"--perspective"}},
        Misuse{"pinhole_in_focus",
               {"render", "--perspective", "--depth-of-field", "splats", "-o", "a.exr"},
               {"--depth-of-field has no effect", "--aperture"}},
        Misuse{"slab_width_of_xray_recorded",
               {"stream", "record", "--method", "xray", "--slab-width", "2", "-o", "a.fss"},
               {"--slab-width does not apply to xray"}},
        Misuse{"rate_of_no_video", {"render", "--rate", "12", "-o", "a.png"}, {"--rate", "--video"}},
        Misuse{"rate_of_an_orbit_without_video",
               {"render", "--orbit", "0..90", "--frames", "3", "--rate", "12", "-o", "a.#.png"},
               {"--rate", "--video"}},
        Misuse{"memory_of_a_still",
               {"render", "--engine", "cmodel", "--keep-memory", "12", "-o", "a.png"},
               {"--keep-memory", "--orbit"}},
        Misuse{"memory_with_counters",
               {"render", "--engine", "cmodel", "--orbit", "0..90", "--frames", "3", "--keep-memory", "12", "--json",
                "-", "-o", "a.#.png"},
               {"--keep-memory", "--json"}},
        Misuse{"memory_of_golden",
               {"render", "--orbit", "0..90", "--frames", "3", "--keep-memory", "12", "-o", "a.#.png"},
               {"--keep-memory", "--engine cmodel"}},
        Misuse{"number_of_a_still", {"render", "-o", "g#.png"}, {"g#.png", "--orbit", "remove the #"}},
        Misuse{
            "number_of_a_still_raw", {"render", "--engine", "cmodel", "--raw", "g#.exr"}, {"g#.exr", "remove the #"}},
        Misuse{"opacity_negative", {"render", "--opacity-scale", "-1", "-o", "a.exr"}, {"opacity"}},
        Misuse{"ending_unknown", {"render", "-o", "a.jpg"}, {"a.jpg", ".exr"}},
        Misuse{"ending_missing", {"render", "-o", "a"}, {".exr"}},
        Misuse{"raw_not_exr", {"render", "--engine", "cmodel", "--raw", "a.png"}, {"a.png", ".exr"}},
        Misuse{"same_name_twice", {"render", "-o", "a.exr", "-o", "./a.exr"}, {"two outputs"}},
        Misuse{"raycast_on_device",  // N-8-63
               {"render", "--volume", "point:4", "--engine", "cmodel", "--method", "raycast", "-o", "a.exr"},
               {"raycast"}},
        Misuse{"stream_not_fss", {"stream", "record", "-o", "a.bin"}, {".fss"}}));

INSTANTIATE_TEST_SUITE_P(
    Compare, Usage,
    ::testing::Values(
        Misuse{"limit_negative", {"compare", "a", "b", "--max-lsb", "-1"}, {"--max-lsb", "-1"}},
        Misuse{"limit_nan", {"compare", "a", "b", "--min-psnr", "nan"}, {"--min-psnr"}},
        Misuse{"bits_zero", {"compare", "a", "b", "--lsb-bits", "0"}, {"--lsb-bits"}},
        Misuse{"peak_zero", {"compare", "a", "b", "--peak", "0"}, {"--peak"}},
        Misuse{"map_not_a_png", {"compare", "a", "b", "--map", "m.exr"}, {"m.exr", ".png"}},
        Misuse{"map_over_input", {"compare", "a", "b.png", "--map", "./b.png"}, {"an input and an output"}},
        Misuse{"map_and_heat_alike", {"compare", "a", "b", "--map", "m.png", "--heat", "m.png"}, {"two outputs"}}));

TEST(Help, IsOnStdoutAndSucceeds) {
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--help"},
                                                    {"-h"},
                                                    {"help"},
                                                    {"help", "render"},
                                                    {"render", "--help"},
                                                    {"stream", "--help"},
                                                    {"stream", "record", "-h"},
                                                    {"help", "config", "show"},
                                                    {"render", "--size", "9", "--help"}}) {
    const auto result = fastsplat(arguments);
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_NE(result.out.find("Usage: fastsplat"), std::string::npos) << result.out;
    EXPECT_EQ(result.err, "");
  }
}

TEST(Help, NamesEveryVerbAndTheExitCodes) {
  const auto text = fastsplat({"help"}).out;
  for (const std::string subcommand :
       {"render", "compare", "volume", "stream", "cycles", "config", "doctor", "130 interrupted"}) {
    EXPECT_NE(text.find(subcommand), std::string::npos) << subcommand;
  }
}

TEST(Version, IsOneLine) {
  const auto result = fastsplat({"--version"});
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(result.out.rfind("fastsplat ", 0), 0u) << result.out;
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 1);
}

TEST(Usage, NegativeNumbersAreValuesNotFlags) {
  for (const std::string value : {"-30", "-.5", "+3", "-1e1"}) {
    expect_success(
        fastsplat({"render", "--volume", "point:4", "--size", "4", "--azimuth", value, "--json", "-", "--quiet"}));
  }
}

}  // namespace
}  // namespace fastsplat::cli_test
