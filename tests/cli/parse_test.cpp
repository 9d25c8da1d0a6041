// SPDX-License-Identifier: Apache-2.0
// The parsed command line: the values of flags, and the messages for wrong combinations.
#include <gtest/gtest.h>

#include <map>

#include "base/images/image_file.hpp"
#include "cli/command_line.hpp"
#include "cli/render_arguments.hpp"
#include "tests/process/process_helper.hpp"

namespace fastsplat::cli {
namespace {

Action parsed(const std::vector<std::string>& words, const std::vector<Subcommand>& subcommands = all_subcommands()) {
  std::vector<const char*> all{"fastsplat"};
  for (const auto& word : words) all.push_back(word.c_str());
  all.push_back(nullptr);
  return parse(static_cast<int>(all.size()) - 1, all.data(), subcommands);
}

template <class Arguments>
Arguments kept;

template <class Arguments>
ExitCode keep(const Arguments& arguments) {
  kept<Arguments> = arguments;
  return ExitCode::Pass;
}

/// The arguments that `words` fill in.
template <class Arguments, void (*declare)(Options&, Arguments&)>
Arguments filled(const std::vector<std::string>& words) {
  const std::vector<Subcommand> subcommands{Subcommand{"verb", "", subcommand<Arguments, declare, keep<Arguments>>}};
  EXPECT_EQ(parsed(words, subcommands)(), ExitCode::Pass);
  return kept<Arguments>;
}

std::string printed(const std::vector<std::string>& words) {
  ::testing::internal::CaptureStdout();
  EXPECT_EQ(parsed(words)(), ExitCode::Pass);
  return ::testing::internal::GetCapturedStdout();
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
    parsed(GetParam().arguments)();
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
        Misuse{"nothing", {}, {"requires a subcommand", "render"}},
        Misuse{"verb_mistyped", {"rendr"}, {"did you mean 'render'"}},
        Misuse{"verb_unknown", {"paint"}, {"unknown subcommand 'paint'"}},
        Misuse{"inner_verb_missing", {"stream"}, {"record, dump, replay"}},
        Misuse{"inner_verb_mistyped", {"volume", "inof"}, {"did you mean 'info'"}},
        Misuse{"flag_mistyped", {"render", "--sise", "9"}, {"--sise", "did you mean '--size'"}},
        Misuse{
            "flag_mistyped_behind_positionals", {"compare", "a", "b", "--max-lbs", "3"}, {"did you mean '--max-lsb'"}},
        Misuse{"flag_unknown", {"render", "--projection", "x"}, {"unknown flag --projection", "--help` lists"}},
        Misuse{"short_flag_unknown", {"render", "-x"}, {"unknown flag -x"}},
        Misuse{"flag_before_verb", {"--size", "9", "render"}, {"unknown flag --size"}},
        Misuse{"value_missing_at_end", {"render", "--size"}, {"--size needs a value"}},
        Misuse{"value_missing_before_flag", {"render", "--json", "--quiet"}, {"--json needs a value"}},
        Misuse{"value_empty", {"render", "--size="}, {"--size needs a value"}},
        Misuse{"value_blank", {"render", "--size", ""}, {"--size needs a value"}},
        Misuse{"flag_twice", {"render", "--size", "9", "--size", "8"}, {"--size is given twice"}},
        Misuse{"flag_with_value", {"render", "--quiet=yes"}, {"--quiet does not take a value"}},
        Misuse{"positional_missing", {"compare", "a.exr"}, {"TEST is required"}},
        Misuse{"positional_extra", {"compare", "a", "b", "c"}, {"unexpected 'c'"}},
        Misuse{"volume_without_flag", {"render", "a.nii.gz"}, {"unexpected 'a.nii.gz'", "give it with --volume"}},
        Misuse{
            "config_without_flag", {"verify", "a.toml"}, {"unexpected 'a.toml'", "give it with --scene or --config"}},
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
    Verify, Usage,
    ::testing::Values(
        Misuse{"seeds_past_the_last",
               {"verify", "--random", "9", "--config", "tiny", "--seed", "9223372036854775807", "--seeds", "2"},
               {"--seed 9223372036854775807 --seeds 2", "at most 9223372036854775806"}},
        Misuse{"more_splats_than_fit",
               {"verify", "--random", "10000001", "--config", "tiny"},
               {"--random", "at most 10000000", "lower --random and raise --seeds"}},
        Misuse{"junit_to_stdout",
               {"verify", "--random", "9", "--config", "tiny", "--junit", "-"},
               {"--junit -", "only --json", "name a file"}},
        Misuse{"coverage_to_stdout",
               {"verify", "--random", "9", "--config", "tiny", "--coverage", "-"},
               {"--coverage -", "name a file"}},
        Misuse{"background_of_no_picture",
               {"verify", "--volume", "shells:8", "--config", "tiny", "--background", "1,1,1"},
               {"--background", "writes no picture", "render"}},
        Misuse{"negative_of_no_picture",
               {"verify", "--volume", "shells:8", "--config", "tiny", "--method", "xray", "--xray-invert", "on"},
               {"--xray-invert", "writes no picture"}}));

INSTANTIATE_TEST_SUITE_P(
    OtherSubcommands, Usage,
    ::testing::Values(
        Misuse{"cycles_background",
               {"cycles", "--volume", "shells:8", "--background", "1,1,1"},
               {"--background", "writes no picture"}},
        Misuse{"record_background",
               {"stream", "record", "--volume", "shells:8", "--background", "1,1,1", "-o", "/nonexistent/a.fss"},
               {"--background", "writes no picture"}},
        Misuse{"timeline_without_json",
               {"cycles", "--volume", "shells:8", "--timeline"},
               {"--timeline", "--json FILE", "--trace FILE"}},
        Misuse{"trace_to_stdout", {"cycles", "--volume", "shells:8", "--trace", "-"}, {"--trace -", "name a file"}},
        Misuse{"report_junit_to_stdout", {"report", "a.json", "--junit", "-"}, {"--junit -", "name a file"}},
        Misuse{"report_csv_to_stdout", {"report", "a.json", "--csv", "-"}, {"--csv -", "name a file"}},
        Misuse{"report_markdown_to_stdout", {"report", "a.json", "--markdown", "-"}, {"--markdown -", "name a file"}}));

TEST(Parse, FlagsReachTheirFields) {
  const auto render = filled<RenderArguments, declare>({"verb",
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
  EXPECT_EQ(render.config.config, "tiny");
  EXPECT_EQ(render.out, (std::vector<std::string>{"a.exr", "b.png", "c.tif"}));
  EXPECT_EQ(render.raw, "r.exr");
  EXPECT_EQ(render.common.json, "-");
  EXPECT_TRUE(render.common.quiet);
  EXPECT_EQ(render.common.threads, 2);
}

/// A flag of every kind.
struct Everything {
  std::string first, second, word = "as it was", mode = "slow", must;
  std::optional<std::string> maybe_word, maybe_mode;
  std::vector<std::string> words;
  int integer = 1;
  std::uint64_t large = 1;
  std::optional<int> maybe_integer;
  double number = 0.5;
  std::optional<double> maybe_number;
  bool flag = false;
};

void declare_everything(Options& options, Everything& to) {
  options.positional("FIRST", to.first, "");
  options.positional("SECOND", to.second, "");
  options.group("Some");
  options.word("--word", to.word, "W", "");
  options.word("--maybe-word", to.maybe_word, "W", "");
  options.choice("--mode", to.mode, {"slow", "fast"}, "NAME", "");
  options.choice("--maybe-mode", to.maybe_mode, {"slow", "fast"}, "NAME", "");
  options.words("-w,--words", to.words, "W", "");
  options.integer("--integer", to.integer, -9, 9, "N", "");
  options.integer("--large", to.large, 0, std::numeric_limits<long>::max(), "N", "");
  options.integer("--maybe-integer", to.maybe_integer, 1, 9, "N", "");
  options.number("--number", to.number, "NUMBER", "");
  options.number("--maybe-number", to.maybe_number, "NUMBER", "");
  options.flag("--flag", to.flag, "");
}

TEST(Parse, MissingFlagsKeepTheirDefaults) {
  const auto to = filled<Everything, declare_everything>({"verb", "a", "b"});
  EXPECT_EQ(to.first, "a");
  EXPECT_EQ(to.second, "b");
  EXPECT_EQ(to.word, "as it was");
  EXPECT_EQ(to.mode, "slow");
  EXPECT_FALSE(to.maybe_word || to.maybe_mode || to.maybe_integer || to.maybe_number || to.flag);
  EXPECT_TRUE(to.words.empty());
  EXPECT_EQ(to.integer, 1);
  EXPECT_EQ(to.large, 1u);
  EXPECT_EQ(to.number, 0.5);
}

TEST(Parse, EveryKindOfValueReachesItsField) {
  const auto to = filled<Everything, declare_everything>({"verb",
                                                          "--word=x",
                                                          "a",
                                                          "--maybe-word",
                                                          "-y",
                                                          "--mode",
                                                          "fast",
                                                          "b",
                                                          "-wp",
                                                          "--words",
                                                          "q",
                                                          "--maybe-mode",
                                                          "slow",
                                                          "--flag",
                                                          "--integer",
                                                          "-9",
                                                          "--large",
                                                          "9223372036854775807",
                                                          "--maybe-integer",
                                                          "07",
                                                          "--number",
                                                          "-1e-3",
                                                          "--maybe-number",
                                                          "+2"});
  EXPECT_EQ(to.first, "a");
  EXPECT_EQ(to.second, "b");
  EXPECT_EQ(to.word, "x");
  EXPECT_EQ(to.maybe_word, "-y");
  EXPECT_EQ(to.mode, "fast");
  EXPECT_EQ(to.maybe_mode, "slow");
  EXPECT_EQ(to.words, (std::vector<std::string>{"p", "q"}));
  EXPECT_EQ(to.integer, -9);
  EXPECT_EQ(to.large, 9223372036854775807u);
  EXPECT_EQ(to.maybe_integer, 7);
  EXPECT_EQ(to.number, -1e-3);
  EXPECT_EQ(to.maybe_number, 2.0);
  EXPECT_TRUE(to.flag);
}

TEST(Parse, ADoubleDashEndsTheFlags) {
  const auto to = filled<Everything, declare_everything>({"verb", "--", "--a.exr", "-b.exr"});
  EXPECT_EQ(to.first, "--a.exr");
  EXPECT_EQ(to.second, "-b.exr");
}

// Each limit passes on equal images and fails where it is impossible or just missed.
TEST(Parse, EveryLimitOfCompareIsOne) {
  const cli_test::TempFolder folder;
  Image dark(8, 8), light(8, 8);
  for (float& value : light.data) value = 0.5f;
  images::write_image(folder / "dark.exr", dark, {}, {});
  images::write_image(folder / "light.exr", light, {}, {});
  const auto compare = [&](const char* test, const std::vector<std::string>& limit) {
    std::vector<std::string> words{"compare", folder / "dark.exr", folder / test, "--quiet"};
    words.insert(words.end(), limit.begin(), limit.end());
    return parsed(words)();
  };
  EXPECT_EQ(compare("light.exr", {}), ExitCode::Pass);
  for (const std::vector<std::string>& limit : {std::vector<std::string>{"--min-psnr", "48"},
                                                {"--max-lsb", "100"},
                                                {"--max-mean-lsb", "100"},
                                                {"--max-rmse-lsb", "100"},
                                                {"--max-bias-lsb", "100"},
                                                {"--max-p99-lsb", "100"},
                                                {"--min-ssim", "0.99"}}) {
    EXPECT_EQ(compare("light.exr", limit), ExitCode::Failed) << limit[0];
    EXPECT_EQ(compare("dark.exr", limit), ExitCode::Pass) << limit[0];
  }
  // One LSB of 1 bit is the whole range.
  EXPECT_EQ(compare("light.exr", {"--max-lsb", "100", "--lsb-bits", "1"}), ExitCode::Pass);
}

TEST(Parse, EveryVerbHasANameASummaryAndHelp) {
  int leaves = 0;
  for (const Subcommand& subcommand : all_subcommands()) {
    SCOPED_TRACE(subcommand.name);
    std::vector<std::string> words{"help"};
    std::istringstream names(subcommand.name);
    for (std::string word; names >> word;) words.push_back(word);
    const auto text = printed(words);
    EXPECT_NE(text.find(subcommand.summary), std::string::npos) << text;
    const std::string name = subcommand.name;
    if (subcommand.declare == nullptr || name == "help" || name == "completion") continue;  // these two have no result
    ++leaves;
    for (const char* flag : {"--json", "--quiet", "--threads"}) EXPECT_NE(text.find(flag), std::string::npos) << flag;
  }
  std::printf("[figure] verbs = %d (limit > 0)\n", leaves);
  EXPECT_GT(leaves, 0);
}

TEST(Parse, AWordMayBeAnotherVerbsName) {
  EXPECT_THROW(
      {
        try {
          parsed({"compare", "render", "verify"})();
        } catch (const UserError& error) {
          EXPECT_EQ(error.code(), ExitCode::Input) << error.what();  // a file that is not there
          throw;
        }
      },
      UserError);
}

TEST(Parse, HelpAndVersionPrint) {
  EXPECT_EQ(printed({"render", "--help"}), printed({"help", "render"}));
  EXPECT_EQ(printed({"--version"}).rfind("fastsplat ", 0), 0u);
  const auto text = printed({"help", "compare"});
  for (const std::string flag : {"--lsb-bits", "--min-psnr", "--max-lsb", "--map", "--heat"})
    EXPECT_NE(text.find(flag), std::string::npos) << flag;
}

}  // namespace
}  // namespace fastsplat::cli
