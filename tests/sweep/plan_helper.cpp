// SPDX-License-Identifier: Apache-2.0
#include "tests/sweep/plan_helper.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "base/error.hpp"

namespace fastsplat::plan_test {

namespace fs = std::filesystem;

Folder::Folder() {
  std::string name = (fs::temp_directory_path() / "fastsplat-plan-XXXXXX").string();
  path_ = ::mkdtemp(name.data());
}

Folder::~Folder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

fs::path Folder::write(const std::string& name, const std::string& text) const {
  std::ofstream(path_ / name, std::ios::binary) << text;
  return path_ / name;
}

std::string read(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

std::vector<std::pair<std::string, std::string>> results_in(const fs::path& folder) {
  std::vector<std::pair<std::string, std::string>> out;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".json") out.emplace_back(entry.path().filename().string(), read(entry.path()));
  }
  std::ranges::sort(out);
  return out;
}

plan::Vocabulary vocabulary() {
  return {.flags_of = [](const std::string& subcommand) -> std::vector<std::string> {
            if (subcommand == "cycls")
              throw_usage({.where = {}, .what = "unknown subcommand", .expected = {}, .got = {}, .fix = {}});
            if (subcommand == "compare") return {"--json", "--min-psnr"};
            return {"--json", "--n", "--bad", "--config", "--set", "--volume"};
          },
          .check = [](const plan::Words&) {},
          .content =
              [](const plan::Settings& settings, const std::vector<std::string>&) {
                plan::Content content{.config_hash = "c", .scene_hash = "s"};
                for (const auto& [name, value] : settings)
                  (name == "volume" ? content.scene_hash : content.config_hash) += name + plan::to_text(value);
                return content;
              }};
}

std::string script(const Folder& folder, const std::string& before) {
  const auto path = folder.write("program", "#!/bin/sh\n" + before + R"(
echo "$*" >> ")" + (folder / "log").string() + R"("
n=0; json=; out=; book=
while [ $# -gt 0 ]; do
  case "$1" in
    --n) n=$2;; --json) json=$2;; --out) out=$2;; --coverage) book=$2;;
  esac
  shift
done
[ "$n" = 66 ] && kill -9 $$
[ -e "$(dirname "$0")/mended" ] || case "$n" in  # until then the machine is in the way
  70|75|126|139) echo "fastsplat: error: out: cannot write: No space left on device" >&2; exit $n;;
  71) exit 0;;
  72) echo '{"verb": "cyc' > "$json"; exit 0;;
  73) exit 1;;
esac
[ "$n" = 99 ] && { echo "fastsplat: error: --n: no such n" >&2; exit 2; }
[ -n "$out" ] && echo picture > "$out"
[ -n "$book" ] && echo '{"format": "fastsplat coverage 1", "config": "tiny", "config_hash": "77", "streams": 1, "splats": '$n', "comparisons": 1, "cycles": 1, "campaigns": {"all": {"a.b": '$n', "only.'$n'": 1}}}' > "$book"
[ -n "$json" ] && echo '{"verb": "cycles", "cycles": {"actual": '$n'}, "mismatches": '$n', "seconds": '$(date +%s.%N)'}' > "$json"
[ "$n" = 13 ] && exit 1
exit 0
)");
  fs::permissions(path, fs::perms::owner_all);
  return path.string();
}

plan::Program executed(const std::string& script) {
  return [script](const plan::Words& words) {
    std::vector<char*> argv{const_cast<char*>("fastsplat")};
    for (const auto& word : words) argv.push_back(const_cast<char*>(word.c_str()));
    argv.push_back(nullptr);
    ::execv(script.c_str(), argv.data());
    return 126;
  };
}

plan::Plan plan_of(const Folder& folder, const std::string& spec) {
  return plan::make(plan::read_spec(folder.write("spec.toml", spec)), vocabulary()).plan;
}

plan::RunSummary run(const Folder& folder, const plan::Plan& plan, const std::string& program,
                     const std::string& results, plan::Shard shard, std::size_t jobs) {
  return plan::run(
      plan,
      {.results = folder / results, .program = executed(program), .program_hash = "p", .shard = shard, .jobs = jobs});
}

}  // namespace fastsplat::plan_test
