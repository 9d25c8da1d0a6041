// The command line, parsed: what the flags become, and what is said when words make no sense.
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "cli/arguments.hpp"

namespace fastsplat::cli {
namespace {

Command parsed(const std::vector<std::string>& words) {
  std::vector<const char*> all{"fastsplat"};
  for (const auto& word : words) all.push_back(word.c_str());
  all.push_back(nullptr);
  return parse(static_cast<int>(all.size()) - 1, all.data());
}

struct Misuse {
  const char* name;
  std::vector<std::string> arguments;
  std::vector<std::string> said;
};
void PrintTo(const Misuse& misuse, std::ostream* out) { *out << misuse.name; }

class Usage : public ::testing::TestWithParam<Misuse> {};

TEST_P(Usage, IsOneLineWithTheFix) {
  try {
    parsed(GetParam().arguments);
    FAIL() << "was accepted";
  } catch (const UserError& error) {
    EXPECT_EQ(error.code(), ExitCode::Usage);
    const std::string said = error.what();
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
    EXPECT_FALSE(error.parts().fix.empty()) << said;
    for (const auto& word : GetParam().said)
      EXPECT_NE(said.find(word), std::string::npos) << "'" << word << "' is not in: " << said;
  }
}

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

TEST(Parse, FlagsReachTheirFields) {
  const auto command = parsed({"render",
                               "--volume",
                               "ch2bet",
                               "--tf=mri-head",
                               "--size",
                               "640x480",
                               "--azimuth",
                               "-30",
                               "--elevation",
                               "+5",
                               "--roll",
                               "-.5",
                               "--zoom",
                               "1e0",
                               "--perspective",
                               "--fov",
                               "40",
                               "--method",
                               "xray",
                               "--xray-sheets",
                               "3",
                               "--shading",
                               "off",
                               "--engine",
                               "cmodel",
                               "--config",
                               "tiny",
                               "-o",
                               "a.exr",
                               "-ob.png",
                               "--out",
                               "c.tif",
                               "--raw",
                               "r.exr",
                               "--json",
                               "-",
                               "--quiet",
                               "--threads",
                               "2"});
  const auto& render = std::get<RenderArguments>(command);
  EXPECT_EQ(render.scene.volume, "ch2bet");
  EXPECT_EQ(render.scene.transfer_function, "mri-head");
  EXPECT_EQ(render.scene.size, "640x480");
  EXPECT_EQ(render.scene.settings.at("--azimuth"), "-30");
  EXPECT_EQ(render.scene.settings.at("--elevation"), "+5");
  EXPECT_EQ(render.scene.settings.at("--roll"), "-.5");
  EXPECT_EQ(render.scene.settings.at("--zoom"), "1e0");
  EXPECT_TRUE(render.scene.perspective);
  EXPECT_EQ(render.scene.settings.at("--fov"), "40");
  EXPECT_EQ(render.scene.settings.at("--xray-sheets"), "3");
  EXPECT_EQ(render.scene.settings.at("--shading"), "off");
  EXPECT_FALSE(render.scene.settings.contains("--slab-width"));
  EXPECT_EQ(render.engine, "cmodel");
  EXPECT_EQ(render.config, "tiny");
  EXPECT_EQ(render.out, (std::vector<std::string>{"a.exr", "b.png", "c.tif"}));
  EXPECT_EQ(render.raw, "r.exr");
  EXPECT_EQ(render.common.json, "-");
  EXPECT_TRUE(render.common.quiet);
  EXPECT_EQ(render.common.threads, 2);
}

TEST(Parse, LimitsOfCompareAreAbsentUnlessGiven) {
  const auto plain = std::get<CompareArguments>(parsed({"compare", "a", "b"}));
  EXPECT_FALSE(plain.min_psnr || plain.max_lsb || plain.max_mean_lsb || plain.max_rmse_lsb || plain.max_bias_lsb ||
               plain.max_p99_lsb || plain.min_ssim);
  EXPECT_EQ(plain.lsb_bits, 8);
  const auto all = std::get<CompareArguments>(
      parsed({"compare", "--min-psnr", "1", "a", "--max-lsb", "2", "--max-mean-lsb", "3", "b", "--max-rmse-lsb", "4",
              "--max-bias-lsb", "5", "--max-p99-lsb", "6", "--min-ssim", "7", "--lsb-bits", "10"}));
  EXPECT_EQ(all.ref, "a");
  EXPECT_EQ(all.test, "b");
  EXPECT_EQ(all.min_psnr, 1.0);
  EXPECT_EQ(all.max_lsb, 2.0);
  EXPECT_EQ(all.max_mean_lsb, 3.0);
  EXPECT_EQ(all.max_rmse_lsb, 4.0);
  EXPECT_EQ(all.max_bias_lsb, 5.0);
  EXPECT_EQ(all.max_p99_lsb, 6.0);
  EXPECT_EQ(all.min_ssim, 7.0);
  EXPECT_EQ(all.lsb_bits, 10);
}

TEST(Parse, ADoubleDashEndsTheFlags) {
  const auto compare = std::get<CompareArguments>(parsed({"compare", "--", "--a.exr", "-b.exr"}));
  EXPECT_EQ(compare.ref, "--a.exr");
  EXPECT_EQ(compare.test, "-b.exr");
}

TEST(Parse, EveryVerbHasItsArguments) {
  EXPECT_TRUE(std::holds_alternative<VolumeInfoArguments>(parsed({"volume", "info", "v"})));
  EXPECT_TRUE(
      std::holds_alternative<VolumeConvertArguments>(parsed({"volume", "convert", "v", "w.nrrd", "--type", "u8"})));
  EXPECT_TRUE(std::holds_alternative<StreamRecordArguments>(parsed({"stream", "record", "-o", "s.fss"})));
  EXPECT_TRUE(std::holds_alternative<StreamDumpArguments>(parsed({"stream", "dump", "s.fss", "--limit", "3"})));
  EXPECT_TRUE(std::holds_alternative<StreamReplayArguments>(parsed({"stream", "replay", "s.fss"})));
  EXPECT_TRUE(std::holds_alternative<CyclesArguments>(parsed({"cycles", "--stream", "s.fss", "--ready", "every-3"})));
  EXPECT_TRUE(std::holds_alternative<ConfigListArguments>(parsed({"config", "list"})));
  EXPECT_TRUE(std::holds_alternative<ConfigShowArguments>(parsed({"config", "show", "base"})));
  EXPECT_TRUE(std::holds_alternative<ConfigCheckArguments>(parsed({"config", "check", "f.toml"})));
  EXPECT_TRUE(std::holds_alternative<DoctorArguments>(parsed({"doctor"})));
  EXPECT_TRUE(std::holds_alternative<TextArguments>(parsed({"--version"})));
  EXPECT_TRUE(std::holds_alternative<TextArguments>(parsed({"render", "--help"})));
}

TEST(Parse, HelpNamesEveryFlagOfAVerb) {
  const auto text = std::get<TextArguments>(parsed({"help", "compare"})).text;
  for (const std::string flag :
       {"--lsb-bits", "--min-psnr", "--max-lsb", "--map", "--heat", "--json", "--quiet", "--threads"}) {
    EXPECT_NE(text.find(flag), std::string::npos) << flag;
  }
}

}  // namespace
}  // namespace fastsplat::cli
