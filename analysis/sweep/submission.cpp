// SPDX-License-Identifier: Apache-2.0
#include "analysis/sweep/submission.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <regex>

#include "base/error.hpp"
#include "base/fnv1a.hpp"
#include "base/hash_text.hpp"
#include "base/number_text.hpp"
#include "base/shell_word.hpp"

namespace fastsplat::plan {

std::string job_name(const std::string& plan_name, const std::string& plan_hash, const std::filesystem::path& results) {
  std::string name = "fs-";  // a digit at the beginning is refused by SGE
  for (const char c : plan_name.substr(0, 40)) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
    name += plain ? c : '_';
  }
  const auto hash = fnv1a(fnv1a(kFnv1aStart, plan_hash), results.string());
  return name + "-" + hash_text(hash).substr(0, 8);
}

std::vector<JobArray> arrays_of(const Submission& submission) {
  std::vector<JobArray> arrays;
  for (const std::size_t shard : submission.to_do) {
    const std::size_t number = (shard - 1) / submission.array_max + 1;
    const std::size_t first = (number - 1) * submission.array_max + 1;
    if (arrays.empty() || arrays.back().number != number) {
      arrays.push_back({.number = number,
                        .first = first,
                        .length = std::min(submission.array_max, submission.shards + 1 - first),
                        .tasks = {}});
    }
    arrays.back().tasks.push_back(shard - first);
  }
  return arrays;
}

std::string index_ranges(const std::vector<std::size_t>& rising) {
  std::string text;
  for (std::size_t i = 0; i < rising.size();) {
    std::size_t last = i;
    while (last + 1 < rising.size() && rising[last + 1] == rising[last] + 1) ++last;
    text += (text.empty() ? "" : ",") + std::to_string(rising[i]);
    if (last > i) text += "-" + std::to_string(rising[last]);
    i = last + 1;
  }
  return text;
}

std::string run_line(const Submission& s, const std::string& shard) {
  return fmt::format("{} plan run {} --shard {}/{} --results {} --jobs {} --threads {} --quiet", shell_word(s.program),
                     shell_word(s.plan), shard, s.shards, shell_word(s.results), s.jobs, s.threads);
}

std::string merge_line(const Submission& s) {
  return fmt::format("{} plan merge {} --results {} -o {}", shell_word(s.program), shell_word(s.plan),
                     shell_word(s.results), shell_word(s.merged));
}

std::string lost_line(const Submission& s, const std::string& engine) {
  return fmt::format("{} plan submit {} --engine {} --results {} --shards {} --array-max {} --lost",
                     shell_word(s.program), shell_word(s.plan), engine, shell_word(s.results), s.shards, s.array_max);
}

std::string check_lines(const Submission& s) {
  return fmt::format(
      "for needed in {} {} {}; do\n  [ -r \"$needed\" ] && continue\n  echo \"$(uname -n) cannot read $needed: put "
      "program, plan and results into folders that all machines share\" >&2\n  exit 3\ndone\ncd {} || exit 3\n",
      shell_word(s.program), shell_word(s.plan), shell_word(s.results), shell_word(s.folder));
}

std::string merge_lines(const Submission& s, const std::string& engine) {
  return check_lines(s) +
         fmt::format(
             "# A network folder shows files of other machines up to a minute late.\ncase $(stat -f -c %T {} "
             "2>/dev/null) in nfs*) sleep 65 ;; esac\n{}\ncode=$?\n# 0: all passed, 1: a case failed, which is a "
             "result. Otherwise list tasks without results, with their logs.\n[ $code -le 1 ] || {} >&2\nexit $code\n",
             shell_word(s.results), merge_line(s), lost_line(s, engine));
}

std::string log_stem(const Submission& s, std::size_t shard) {
  return fmt::format("array-{}_{}.", (shard - 1) / s.array_max + 1, (shard - 1) % s.array_max);
}

long seconds_from(const std::string& time) {
  // Minutes; minutes:seconds; hours:minutes:seconds; days-hours[:minutes[:seconds]].
  static const std::regex form(R"((?:(\d{1,5})-)?(\d{1,7})(?::(\d{1,2}))?(?::(\d{1,2}))?)");
  std::smatch part;
  const auto number = [&](int i) { return part[i].matched ? *integer_from<long>(part[i].str()) : 0L; };
  long seconds = 0;
  if (std::regex_match(time, part, form)) {
    if (part[1].matched) {
      seconds = ((number(1) * 24 + number(2)) * 60 + number(3)) * 60 + number(4);
    } else if (part[4].matched) {
      seconds = (number(2) * 60 + number(3)) * 60 + number(4);
    } else {
      seconds = number(2) * 60 + number(3);
    }
  }
  if (seconds > 0) return seconds;
  throw_usage({.where = "--time",
               .what = "not a duration",
               .expected = "minutes, h:mm:ss or days-hours",
               .got = time,
               .fix = "for example --time 90 or --time 1:30:00"});
}

}  // namespace fastsplat::plan
