// The command line itself: verbs, flags, help, and what is said when they make no sense (exit 2).
#include <gtest/gtest.h>

#include "tests/cli/process_helper.hpp"

namespace fastsplat::cli_test {
namespace {

struct Misuse {
  const char* name;
  std::vector<std::string> arguments;
  std::vector<std::string> said;
};

class Usage : public ::testing::TestWithParam<Misuse> {};

TEST_P(Usage, IsOneLineWithTheFix) { expect_error(fastsplat(GetParam().arguments), 2, GetParam().said); }

INSTANTIATE_TEST_SUITE_P(
    CommandLine, Usage,
    ::testing::Values(
        Misuse{"nothing", {}, {"which verb", "render"}}, Misuse{"verb_mistyped", {"rendr"}, {"did you mean 'render'"}},
        Misuse{"verb_unknown", {"paint"}, {"unknown verb 'paint'"}},
        Misuse{"inner_verb_missing", {"stream"}, {"record, dump, replay"}},
        Misuse{"inner_verb_mistyped", {"volume", "inof"}, {"did you mean 'info'"}},
        Misuse{"flag_mistyped", {"render", "--sise", "9"}, {"--sise", "did you mean '--size'"}},
        Misuse{
            "flag_mistyped_behind_positionals", {"compare", "a", "b", "--max-lbs", "3"}, {"did you mean '--max-lsb'"}},
        Misuse{"short_flag_unknown", {"render", "-x"}, {"unknown flag -x"}},
        Misuse{"flag_before_verb", {"--size", "9", "render"}, {"unknown flag --size"}},
        Misuse{"value_missing_at_end", {"render", "--size"}, {"--size needs a value"}},
        Misuse{"value_missing_before_flag", {"render", "--json", "--quiet"}, {"--json needs a value"}},
        Misuse{"value_empty", {"render", "--size="}, {"--size needs a value"}},
        Misuse{"value_blank", {"render", "--size", ""}, {"--size needs a value"}},
        Misuse{"flag_twice", {"render", "--size", "9", "--size", "8"}, {"--size is given twice"}},
        Misuse{"flag_with_value", {"render", "--quiet=yes"}, {"--quiet takes no value"}},
        Misuse{"positional_missing", {"compare", "a.exr"}, {"TEST is required"}},
        Misuse{"positional_extra", {"compare", "a", "b", "c"}, {"unexpected 'c'"}},
        Misuse{"required_flag_missing", {"stream", "record", "--volume", "shells:8"}, {"--out is required"}},
        Misuse{"help_on_nothing", {"help", "redner"}, {"did you mean 'render'"}},
        Misuse{"number_nan", {"render", "--azimuth", "nan"}, {"--azimuth", "'nan'"}},
        Misuse{"number_infinite", {"render", "--zoom", "inf"}, {"--zoom", "'inf'"}},
        Misuse{"number_too_large", {"render", "--zoom", "1e999"}, {"--zoom", "'1e999'"}},
        Misuse{"number_with_tail", {"render", "--zoom", "2x"}, {"--zoom", "'2x'"}},
        Misuse{"number_hexadecimal", {"render", "--zoom", "0x10"}, {"--zoom", "'0x10'"}},
        Misuse{"integer_with_fraction", {"render", "--xray-sheets", "2.5"}, {"--xray-sheets", "integer"}},
        Misuse{"threads_negative", {"render", "--threads", "-1"}, {"--threads", "'-1'"}}));

INSTANTIATE_TEST_SUITE_P(
    Render, Usage,
    ::testing::Values(
        Misuse{"no_output", {"render", "--volume", "shells:8"}, {"nothing to write", "--out"}},
        Misuse{"size_zero", {"render", "--size", "0", "-o", "a.exr"}, {"--size", "'0'"}},
        Misuse{"size_negative", {"render", "--size", "-5", "-o", "a.exr"}, {"--size", "'-5'"}},
        Misuse{"size_half", {"render", "--size", "64x", "-o", "a.exr"}, {"--size", "'64x'"}},
        Misuse{"size_thrice", {"render", "--size", "6x4x2", "-o", "a.exr"}, {"--size", "'6x4x2'"}},
        Misuse{"size_huge", {"render", "--size", "99999999999", "-o", "a.exr"}, {"--size", "16384"}},
        Misuse{"engine_unknown", {"render", "--engine", "goldn", "-o", "a.exr"}, {"did you mean 'golden'"}},
        Misuse{"engine_rtl", {"render", "--engine", "rtl", "-o", "a.exr"}, {"not in this build", "cmodel"}},
        Misuse{"golden_config", {"render", "--config", "base", "-o", "a.exr"}, {"--engine cmodel"}},
        Misuse{"golden_raw", {"render", "--raw", "a.exr"}, {"--engine cmodel"}},
        Misuse{"method_unknown", {"render", "--method", "xrai", "-o", "a.exr"}, {"xray"}},
        Misuse{"slab_opacity_unknown", {"render", "--slab-opacity", "aditive", "-o", "a.exr"}, {"additive"}},
        Misuse{"shading_maybe", {"render", "--shading", "maybe", "-o", "a.exr"}, {"--shading", "on or off"}},
        Misuse{"index_unknown", {"render", "--index", "blit", "-o", "a.exr"}, {"--index", "rlut"}},
        Misuse{"kernel_both_ways", {"render", "--kernel", "smooth", "--kernel-a", "2", "-o", "a.exr"}, {"--kernel"}},
        Misuse{"kernel_radius_out_of_range", {"render", "--kernel-radius", "99", "-o", "a.exr"}, {"8"}},
        Misuse{"projection_both_ways",
               {"render", "--perspective", "--orthographic", "-o", "a.exr"},
               {"exclude each other"}},
        Misuse{"fov_orthographic", {"render", "--fov", "30", "-o", "a.exr"}, {"--perspective"}},
        Misuse{"zoom_zero", {"render", "--zoom", "0", "-o", "a.exr"}, {"zoom"}},
        Misuse{"zoom_negative", {"render", "--zoom", "-1", "-o", "a.exr"}, {"zoom"}},
        Misuse{"slab_width_zero", {"render", "--slab-width", "0", "-o", "a.exr"}, {"slab"}},
        Misuse{"opacity_negative", {"render", "--opacity-scale", "-1", "-o", "a.exr"}, {"opacity"}},
        Misuse{"ending_unknown", {"render", "-o", "a.jpg"}, {"a.jpg", ".exr"}},
        Misuse{"ending_missing", {"render", "-o", "a"}, {".exr"}},
        Misuse{"raw_not_exr", {"render", "--engine", "cmodel", "--raw", "a.png"}, {"a.png", ".exr"}},
        Misuse{"same_name_twice", {"render", "-o", "a.exr", "-o", "./a.exr"}, {"two results"}},
        Misuse{"raycast_on_device",
               {"render", "--volume", "point:4", "--engine", "cmodel", "--method", "raycast", "-o", "a.exr"},
               {"raycast"}},
        Misuse{"stream_not_fss", {"stream", "record", "-o", "a.bin"}, {".fss"}}));

INSTANTIATE_TEST_SUITE_P(
    Compare, Usage,
    ::testing::Values(Misuse{"limit_negative", {"compare", "a", "b", "--max-lsb", "-1"}, {"--max-lsb", "-1"}},
                      Misuse{"limit_nan", {"compare", "a", "b", "--min-psnr", "nan"}, {"--min-psnr"}},
                      Misuse{"bits_zero", {"compare", "a", "b", "--lsb-bits", "0"}, {"--lsb-bits"}},
                      Misuse{"peak_zero", {"compare", "a", "b", "--peak", "0"}, {"--peak"}},
                      Misuse{"map_not_an_image", {"compare", "a", "b", "--map", "m.txt"}, {"m.txt"}}));

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
  for (const std::string verb : {"render", "compare", "volume", "stream", "config", "doctor", "130 interrupted"}) {
    EXPECT_NE(text.find(verb), std::string::npos) << verb;
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
