// SPDX-License-Identifier: Apache-2.0
// Unknown names exit with 2, missing files with 3; suggestions are close; the machine's programs are listed.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/process/process_helper.hpp"

namespace fastsplat::cli_test {
namespace {

std::vector<std::string> still(const std::vector<std::string>& more) {
  std::vector<std::string> words{"render", "--size", "8", "-o", "/tmp/never.exr"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST(Names, UnknownNamesAreUsageErrors) {
  const std::vector<std::vector<std::string>> commands{still({"--scene", "demo:nope"}),
                                                       still({"--tf", "nope"}),
                                                       still({"--volume", "nope"}),
                                                       still({"--volume", "nope:64"}),
                                                       still({"--volume", "shells:0"}),
                                                       still({"--volume", "shells:x"}),
                                                       still({"--volume", "shells:1.5"}),
                                                       still({"--engine", "cmodel", "--config", "nope"}),
                                                       {"config", "show", "nope"},
                                                       {"config", "check", "nope"},
                                                       {"config", "diff", "base", "nope"},
                                                       {"volume", "info", "nope"},
                                                       {"volume", "info", "shells:0"},
                                                       {"volume", "convert", "nope", "/tmp/never.nrrd"},
                                                       {"cycles", "--volume", "nope"},
                                                       {"stream", "record", "--tf", "nope", "-o", "/tmp/never.fss"},
                                                       {"verify", "--random", "9", "--class", "nope"}};
  for (const auto& command : commands) {
    SCOPED_TRACE(command[0] + " ... " + command.back());
    expect_error(fastsplat(command), 2, {});
  }
  std::printf("[figure] names that are none, exit 2 = %zu\n", commands.size());
}

TEST(Names, AFileThatIsMissingOrBadIsAFile) {
  const TempFolder folder;
  const auto scene = folder.write("scene.toml", "volume = \"shells:0\"\n");
  const std::vector<std::vector<std::string>> commands{still({"--scene", folder / "nope.toml"}),
                                                       still({"--tf", folder / "nope.toml"}),
                                                       still({"--volume", folder / "nope.nrrd"}),
                                                       still({"--scene", scene}),
                                                       still({"--engine", "cmodel", "--config", folder / "nope.toml"}),
                                                       {"config", "check", "nope.toml"},
                                                       {"volume", "info", "./nope"}};
  for (const auto& command : commands) {
    SCOPED_TRACE(command[0] + " ... " + command.back());
    expect_error(fastsplat(command), 3, {});
  }
}

TEST(Names, HintsAreNear) {
  const auto hint = [](const std::vector<std::string>& command) { return fastsplat(command).err; };
  for (const auto& command : {still({"--tf", "nope"}), still({"--volume", "nope"}), still({"--index", "rlut"}),
                              still({"--engine", "cmodel", "--config", "ours"})})
    EXPECT_EQ(hint(command).find("did you mean"), std::string::npos) << hint(command);
  EXPECT_NE(hint(still({"--tf", "bonne"})).find("did you mean 'bone'"), std::string::npos);
  EXPECT_NE(hint(still({"--elevtion", "3"})).find("did you mean '--elevation'"), std::string::npos);
}

TEST(Names, DoctorLooksAtEveryLibraryAndProgram) {
  const auto json = nlohmann::json::parse(fastsplat({"doctor", "--json", "-"}).out);
  for (const auto& [name, version] : json.at("libraries").items()) {
    const std::string text = version;
    EXPECT_TRUE(std::isdigit(static_cast<unsigned char>(text.empty() ? '.' : text[0]))) << name << " " << text;
  }
  EXPECT_TRUE(json.at("libraries").contains("libnifti2"));
  const auto& verilator = json.at("programs").at("verilator");
  EXPECT_TRUE(verilator.at("found").get<bool>());
  EXPECT_EQ(verilator.at("version").get<std::string>().find_first_not_of("0123456789."), std::string::npos);
  int found = 0;
  for (const char* name : {"ffmpeg", "verilator", "yosys", "z3", "node", "chromium", "slurm", "parallel", "ccache"}) {
    const auto& program = json.at("programs").at(name);
    EXPECT_FALSE(program.at("for").get<std::string>().empty()) << name;
    EXPECT_EQ(program.at("get").get<std::string>().rfind("apt-get install ", 0), 0u) << name;
    found += program.at("found").get<bool>() ? 1 : 0;
  }
  std::printf("[figure] programs = %zu, found = %d (limit > 0)\n", json.at("programs").size(), found);
  EXPECT_GT(found, 0);
  // Without the programs they are reported missing.
  Surroundings bare;
  bare.environment = {"PATH=/nonexistent"};
  const auto without = nlohmann::json::parse(fastsplat({"doctor", "--json", "-"}, bare).out);
  EXPECT_FALSE(without.at("programs").at("ffmpeg").at("found").get<bool>());
  std::string missing = without.at("missing").dump();
  EXPECT_NE(missing.find("apt-get install ffmpeg"), std::string::npos) << missing;
  EXPECT_NE(missing.find("apt-get install verilator"), std::string::npos) << missing;
}

// A program that hangs with a child, another program of the same name, one that fails, one with an odd version.
TEST(Names, DoctorAsksProgramsAndDoesNotWaitForThem) {
  const TempFolder folder;
  const auto program = [&](const std::string& name, const std::string& body) {
    std::filesystem::permissions(folder.write(name, "#!/bin/sh\n" + body + "\n"), std::filesystem::perms::owner_all);
  };
  program("ffmpeg", "sleep 987.25 & wait");
  program("parallel", "echo 'parallel: invalid option' >&2; exit 1");
  program("z3", "exit 3");
  program("yosys", "echo 'Yosys 9.81+7 (git sha1 1234)'");
  Surroundings here;
  here.environment = {"PATH=" + folder.path().string() + ":/usr/bin:/bin"};
  const auto doctor = fastsplat({"doctor", "--json", "-"}, here);
  expect_success(doctor);
  const auto programs = nlohmann::json::parse(doctor.out).at("programs");
  EXPECT_NE(programs.at("ffmpeg").at("problem").get<std::string>().find("within 5 s"), std::string::npos);
  EXPECT_EQ(programs.at("ffmpeg").at("path"), folder / "ffmpeg");
  EXPECT_TRUE(programs.at("parallel").contains("problem"));
  EXPECT_TRUE(programs.at("z3").contains("problem"));
  EXPECT_EQ(programs.at("yosys").at("version"), "9.81");
  EXPECT_FALSE(programs.at("yosys").contains("problem"));
  EXPECT_TRUE(programs.at("node").at("found").get<bool>());
  EXPECT_NE(run_words({"pgrep", "-f", "^sleep 987[.]25$"}).code, 0) << "what hung is still there";
}

}  // namespace
}  // namespace fastsplat::cli_test
