// SPDX-License-Identifier: Apache-2.0
#include "analysis/sweep/slurm_client.hpp"

#include <algorithm>
#include <cctype>
#include <sstream>

#include "base/called.hpp"
#include "base/error.hpp"
#include "base/number_text.hpp"

namespace fastsplat::plan {
namespace {

/// Clients retry the controller for nine seconds, and look up names for longer.
constexpr int kSeconds = 60;

/// "sbatch: error: Batch job submission failed: Invalid partition name specified" without its prefix.
std::string reason_of(const Called& called) {
  std::string text = called.last_words();
  for (const char* before : {": error: ", ": fatal: "}) {
    const auto at = text.find(before);
    if (at != std::string::npos) text.erase(0, at + std::string(before).size());
  }
  return text;
}

[[noreturn]] void refused(const std::string& client, const Called& called, const std::string& fix) {
  throw_input({.where = client, .what = reason_of(called), .expected = {}, .got = {}, .fix = fix});
}

}  // namespace

std::size_t slurm_array_max() {
  const Called called = call({"scontrol", "show", "config"}, kSeconds);
  if (called.code != 0) refused("scontrol", called, "check that this machine reaches the cluster, or add --array-max");
  std::istringstream lines(called.out);
  for (std::string name, equals, value, line; std::getline(lines, line);) {
    std::istringstream words(line);
    if (!(words >> name >> equals >> value) || name != "MaxArraySize") continue;
    const auto most = integer_from<std::size_t>(value).value_or(0);
    if (most > 0) return most;
    throw_input({.where = "scontrol",
                 .what = "this site does not allow job arrays",
                 .expected = {},
                 .got = "MaxArraySize = " + value,
                 .fix = "use --engine script"});
  }
  throw_input({.where = "scontrol",
               .what = "does not print MaxArraySize",
               .expected = {},
               .got = {},
               .fix = "add --array-max"});
}

std::string slurm_queued(const std::string& names) {
  std::istringstream ids(call({"squeue", "--noheader", "--name=" + names, "--format=%F"}, kSeconds).out);
  std::string all;
  std::vector<std::string> seen;
  for (std::string id; ids >> id;) {
    if (std::find(seen.begin(), seen.end(), id) != seen.end()) continue;
    seen.push_back(id);
    all += (all.empty() ? "" : " ") + id;
  }
  return all;
}

std::string slurm_submit(const std::vector<std::string>& words) {
  const Called called = call(words, kSeconds);
  // "12", or "12;cluster" at sites with several clusters.
  const std::string id = called.out.substr(0, called.out.find_first_of(";\n"));
  const bool number = !id.empty() && std::all_of(id.begin(), id.end(), [](unsigned char c) { return std::isdigit(c); });
  if (called.code != 0 || !number)
    refused("sbatch", called, "nothing was queued: correct the problem and submit again");
  return id;
}

void slurm_cancel(const std::vector<std::string>& jobs) {
  std::vector<std::string> words{"scancel"};
  words.insert(words.end(), jobs.begin(), jobs.end());
  if (!jobs.empty()) call(words, kSeconds);
}

}  // namespace fastsplat::plan
