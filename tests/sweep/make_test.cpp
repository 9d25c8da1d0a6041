// SPDX-License-Identifier: Apache-2.0
// Expanded specifications: the cases, their order, and the inputs of their names.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <set>

#include "base/error.hpp"
#include "base/json_text.hpp"
#include "tests/sweep/plan_helper.hpp"

namespace fastsplat::plan_test {
namespace {

using ::testing::HasSubstr;

std::vector<std::string> axes_of(const plan::Plan& plan) {
  std::vector<std::string> out;
  for (const auto& one : plan.cases) {
    out.emplace_back();
    for (const auto& [name, value] : one.axes)
      out.back() += (out.back().empty() ? "" : " ") + name + "=" + plan::to_text(value);
  }
  return out;
}

TEST(PlanMake, CrossesAxesAndZipsInTheFilesOrder) {
  const Folder folder;
  const auto plan = plan_of(folder,
                            "kind = \"cycles\"\n[axes]\nn = {from = 1, to = 4, times = 2}\na.b = [8]\n"
                            "[[zip]]\naxis = \"view\"\nlabel = [\"x\", \"y\"]\nvolume = [\"v1\", \"v2\"]\n");
  EXPECT_EQ(axes_of(plan), (std::vector<std::string>{"n=1 a.b=8 view=x volume=v1", "n=1 a.b=8 view=y volume=v2",
                                                     "n=2 a.b=8 view=x volume=v1", "n=2 a.b=8 view=y volume=v2",
                                                     "n=4 a.b=8 view=x volume=v1", "n=4 a.b=8 view=y volume=v2"}));
  std::printf("[figure] cases = %zu (limit = 6)\n", plan.cases.size());
  EXPECT_EQ(plan::command_of(plan.cases[0]), "fastsplat cycles --set a.b=8 --n 1 --volume v1");
}

TEST(PlanMake, ComparesWithOneGoldenPictureOfAScene) {
  const Folder folder;
  const auto plan = plan_of(
      folder, "kind = \"compare\"\n[constants]\nmin-psnr = 48\n[axes]\nvolume = [\"v\", \"w\"]\na.b = [1, 2]\n");
  ASSERT_EQ(plan.cases.size(), 4u);
  std::set<std::string> shared;
  for (const auto& one : plan.cases) shared.insert(one.steps[0].shared);
  EXPECT_EQ(shared.size(), 2u);
  const std::string golden = plan.cases[0].steps[0].shared;
  EXPECT_EQ(
      plan::command_of(plan.cases[0]),
      "fastsplat render --volume v --engine golden --out " + golden +
          " && fastsplat render --set a.b=1 --volume v --engine cmodel --no-counters --out model.exr && fastsplat "
          "compare " +
          golden + " model.exr --min-psnr 48");
}

TEST(PlanMake, NamesAreStableAndUnique) {
  const Folder folder;
  const auto ids = [&](const std::string& spec) {
    std::set<std::string> out;
    for (const auto& one : plan_of(folder, spec).cases) out.insert(one.id);
    return out;
  };
  const auto first = ids("kind = \"cycles\"\n[axes]\nn = [1, 2]\n");
  EXPECT_EQ(first, ids("name = \"other\"\nkind = \"cycles\"\n[axes]\nn = [2, 1]\n")) << "of the case alone";
  const auto more = ids("kind = \"cycles\"\n[axes]\nn = [1, 2, 3]\n");
  for (const auto& id : first) EXPECT_TRUE(more.contains(id)) << "a plan that grew keeps its cases";
  for (const char* other : {"kind = \"verify\"\n[axes]\nn = [1, 2]\n", "kind = \"cycles\"\n[axes]\nn = [3, 4]\n",
                            "kind = \"cycles\"\n[constants]\nx.y = 1\n[axes]\nn = [1, 2]\n",
                            "kind = \"cycles\"\n[constants]\nvolume = \"v\"\n[axes]\nn = [1, 2]\n"}) {
    for (const auto& id : ids(other)) EXPECT_FALSE(first.contains(id)) << other;
  }
  // The inputs of the names, and nothing else: the commands are the same.
  auto changed = vocabulary();
  changed.content = [](const plan::Settings&, const std::vector<std::string>&) { return plan::Content{"other", "s"}; };
  for (const auto& one :
       plan::make(plan::read_spec(folder.write("s.toml", "kind = \"cycles\"\n[axes]\nn = [1, 2]\n")), changed)
           .plan.cases)
    EXPECT_FALSE(first.contains(one.id));
}

TEST(PlanMake, RefusesSettingsWithoutEffectWithTheLine) {
  const Folder folder;
  const std::pair<const char*, const char*> wrong[] = {
      {"kind = \"cycles\"\n[axes]\nn = []\n", "spec.toml:3:5: n has no value"},
      {"kind = \"cycles\"\n[axes]\nn = [1, 1]\n", "spec.toml:3:9: n has the value 1 twice"},
      {"kind = \"cycles\"\n[axes]\nm = [1]\n", "m is not a flag of cycles"},
      {"kind = \"cycles\"\n[axes]\nn = {from = 4, to = 1}\n", "spec.toml:3:5: the range of n is empty or invalid"},
      {"kind = \"cycles\"\n[constants]\nn = 1\n[axes]\nn = [1]\n", "spec.toml:5:5: n is set twice"},
      {"kind = \"cycles\"\n[[zip]]\nn = [1, 2]\nvolume = [\"v\"]\n", "spec.toml:4:10: volume has 1 values (expected 2"},
      {"kind = \"cycles\"\nkidn = 1\n", "spec.toml:2:8: unknown key 'kidn'; did you mean 'kind'?"},
      {"[axes]\nn = [1]\n", "the key 'kind' is missing"},
      {"kind = \"cycles\"\n", "has no axis"},
      {"kind = \"cycles\"\n[axes]\njson = [\"x\"]\n", "json cannot be set"},
      {"kind = \"cycles\"\n[axes]\nn = [\"{x}\"]\n", "words in braces"},
      {"kind = \"cycles\"\n[axes]\nmap = [\"/x.png\"]\n", "map cannot be set"},
      {"kind = \"cycles\"\n[[zip]]\naxis = \"n\"\nlabel = [\"a\"]\nn = [1]\n",
       "spec.toml:3:8: axis = \"n\" names the label column, but n is also a setting"},
      {"kind = \"cycles\"\n[constants]\nn = 1\n[[zip]]\naxis = \"n\"\nlabel = [\"a\"]\nvolume = [\"v\"]\n",
       "spec.toml:5:8: axis = \"n\" names the label column"},
      // A name in a specification must not hide a figure.
      {"kind = \"cycles\"\n[[zip]]\naxis = \"cycles\"\nlabel = [1]\nn = [1]\n",
       "spec.toml:3:8: 'cycles' is the name of a built-in column"},
      {"kind = \"cycles\"\n[[zip]]\naxis = \"status\"\nlabel = [1]\nn = [1]\n",
       "'status' is the name of a built-in column"},
      {"kind = \"cycles\"\n[axes]\nn = [1]\n[[metrics]]\nname = \"cycles\"\npath = \"cycles/x\"\n",
       "spec.toml:5:8: 'cycles' is the name of a built-in column"},
      {"kind = \"cycles\"\n[axes]\nn = [1]\n[[metrics]]\nname = \"n\"\npath = \"cycles/x\"\n", "n is set twice"},
      {"kind = \"cycles\"\n[[zip]]\naxis = \"cycles_input\"\nlabel = [1]\nn = [1]\n", "'cycles_input' is the name"},
      {"kind = \"cycls\"\n[axes]\nn = [1]\n", "spec.toml: unknown kind 'cycls'"},
      {"kind = \"cycles\"\n[axes]\nn = [1\n", "not valid TOML"},
  };
  for (const auto& [spec, words] : wrong)
    EXPECT_THAT(error_of([&, &text = spec] { plan_of(folder, text); }), HasSubstr(words)) << spec;
  std::printf("[figure] wrong_specifications = %zu (limit > 0)\n", std::size(wrong));
}

TEST(PlanMake, OmitsRefusedCasesOnRequestOnly) {
  const Folder folder;
  auto picky = vocabulary();
  picky.check = [](const plan::Words& words) {
    if (words.back() == "2") throw_usage({.where = "--n", .what = "no", .expected = {}, .got = {}, .fix = {}});
  };
  const auto make = [&](const std::string& head) {
    return plan::make(plan::read_spec(folder.write("s.toml", head + "kind = \"cycles\"\n[axes]\nn = [1, 2, 3]\n")),
                      picky);
  };
  EXPECT_THAT(error_of([&] { make(""); }), HasSubstr("n=2: --n: no"));
  const auto made = make("refused = \"leave out\"\n");
  EXPECT_EQ(made.plan.cases.size(), 2u);
  EXPECT_EQ(made.left_out, std::vector<std::string>{"n=2: --n: no"});
}

TEST(PlanMake, ChangedFilesAreRefused) {
  const Folder folder;
  const std::string text = json_text(plan::to_json(plan_of(folder, "kind = \"cycles\"\n[axes]\nn = [1, 2]\n")), 1);
  EXPECT_EQ(plan::read_plan(folder.write("p.json", text)).cases.size(), 2u);
  std::string changed = text;
  changed.replace(changed.rfind("\"2\""), 3, "\"7\"");
  EXPECT_THAT(error_of([&] { plan::read_plan(folder.write("p.json", changed)); }), HasSubstr("was changed"));
  EXPECT_THAT(error_of([&] { plan::read_plan(folder.write("p.json", text.substr(0, 200))); }), HasSubstr("not a plan"));
  EXPECT_THAT(error_of([&] { plan::read_plan(folder.write("p.toml", "kind = \"compare\"\n")); }),
              HasSubstr("make a plan of it with 'fastsplat plan make'"));
  EXPECT_THAT(error_of([&] { plan::shard_from("3/2"); }), HasSubstr("invalid shard"));
}

/// Even with every hash recomputed, a foreign plan runs nothing but commands that plan make writes.
TEST(PlanMake, AForgedPlanIsRefused) {
  const Folder folder;
  const auto honest = plan_of(folder, "kind = [\"compare\", \"verify\"]\n[axes]\nn = [1, 2]\n");
  EXPECT_EQ(error_of([&] { plan::require_made(honest, vocabulary(), "p.json"); }), "");
  const auto read_forged = [&](const std::function<void(plan::Case&)>& forge) {
    plan::Plan forged = honest;
    forge(forged.cases[1]);
    forged.cases[1].id = plan::id_of(forged.cases[1]);
    const auto read = plan::read_plan(folder.write("p.json", json_text(plan::to_json(forged), 1)));
    plan::require_made(read, vocabulary(), "p.json");
  };
  const std::function<void(plan::Case&)> forges[] = {
      [](plan::Case& one) {
        one.steps[0].words = {"volume", "convert", "in.nrrd", "/somewhere/out.nrrd"};
      },
      [](plan::Case& one) {
        one.steps[0].words.insert(one.steps[0].words.end(), {"--out", "/somewhere/out.exr"});
      },
      [](plan::Case& one) { one.steps.push_back(one.steps[0]); },
      [](plan::Case& one) { one.steps.pop_back(); },
      [](plan::Case& one) { one.steps[1].result = ""; },
      [](plan::Case& one) { one.kind = "cycles"; },
      [](plan::Case& one) {
        one.settings = {{"n", std::int64_t{7}}};
      },
      [](plan::Case& one) {
        one.settings.push_back({"out", std::string("/somewhere/out.exr")});
      },
  };
  for (const auto& forge : forges)
    EXPECT_THAT(error_of([&] { read_forged(forge); }), HasSubstr("was not written by `fastsplat plan make`"));
  const char* const outside[] = {"../../x.exr", "/x.exr", "..", "a/b.exr"};
  for (const std::string name : outside) {
    EXPECT_THAT(error_of([&] { read_forged([&](plan::Case& one) { one.steps[1].words.back() = "{" + name + "}"; }); }),
                HasSubstr("the file '" + name + "' is outside its folder"));
    EXPECT_THAT(error_of([&] { read_forged([&](plan::Case& one) { one.steps[0].shared = name; }); }),
                HasSubstr("is outside its folder"));
  }
  std::printf("[figure] forged plans refused = %zu\n", std::size(forges) + 2 * std::size(outside));
}

}  // namespace
}  // namespace fastsplat::plan_test
