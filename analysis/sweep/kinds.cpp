// SPDX-License-Identifier: Apache-2.0
#include "analysis/sweep/kinds.hpp"

#include <algorithm>

namespace fastsplat::plan {

std::vector<StepOfKind> steps_of(const std::string& kind) {
  if (kind == "compare") {
    return {{.subcommand = "render",
             .files = {},
             .outputs = {"--engine", "golden", "--out", "{golden.exr}"},
             .takes_device = false,
             .has_result = false,
             .shared = "golden.exr"},
            {.subcommand = "render",
             .files = {},
             .outputs = {"--engine", "cmodel", "--no-counters", "--out", "{model.exr}"}},
            {.subcommand = "compare", .files = {"{golden.exr}", "{model.exr}"}, .outputs = {}}};
  }
  if (kind == "render") return {{.subcommand = "render", .files = {}, .outputs = {"--out", "{picture.exr}"}}};
  if (kind == "verify") {
    return {{.subcommand = "verify",
             .files = {},
             .outputs = {"--coverage", "{coverage.json}", "--failure", "{failure}"},
             .coverage = true}};
  }
  return {{.subcommand = kind, .files = {}, .outputs = {}}};
}

bool is_given_by_run(const std::string& flag) {
  constexpr const char* kGiven[] = {
      "json", "quiet", "threads", "jobs", "out", "coverage", "failure", "junit", "wave", "save-stream", "set",
      // files that would lie outside the case's folder
      "map", "heat", "trace", "blame", "journal", "raw", "video", "save-scene", "man-pages", "markdown", "csv"};
  return std::ranges::find(kGiven, flag) != std::end(kGiven);
}

}  // namespace fastsplat::plan
