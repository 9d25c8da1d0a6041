// SPDX-License-Identifier: Apache-2.0
#include "analysis/sweep/status.hpp"

#include "analysis/sweep/run.hpp"
#include "base/error.hpp"
#include "base/json_file.hpp"
#include "base/read_file.hpp"

namespace fastsplat::plan {
namespace {

namespace fs = std::filesystem;

double cpu_seconds_of(const fs::path& results, const std::string& id) {
  try {
    const auto json = parse_json<nlohmann::ordered_json>(read_text_file(results / kTimesFolder / (id + ".json")));
    return json.at("cpu_seconds").get<double>();
  } catch (const std::exception&) {
    return 0.0;  // for information only
  }
}

void count(const Case& one, const fs::path& results, const std::string& program, Count& to, std::string& trouble) {
  ++to.cases;
  const fs::path path = result_path(results, one.id);
  std::error_code ignored;
  if (!fs::exists(path, ignored)) {
    ++to.missing;
    return;
  }
  CaseResult result;
  try {
    result = read_result(path);
  } catch (const UserError& error) {
    ++to.again;
    trouble = error.what();
    return;
  }
  trouble = foreign(result, one, program);
  if (!trouble.empty()) {
    ++to.again;
    return;
  }
  if (const double seconds = cpu_seconds_of(results, one.id); seconds > 0.0) {
    to.cpu_seconds += seconds;
    ++to.timed;
  }
  trouble = result.message;
  ++(result.status == Status::Pass ? to.passed : result.status == Status::Fail ? to.failed : to.errors);
}

Count& operator+=(Count& to, const Count& from) {
  to.cases += from.cases;
  to.passed += from.passed;
  to.failed += from.failed;
  to.errors += from.errors;
  to.again += from.again;
  to.missing += from.missing;
  to.cpu_seconds += from.cpu_seconds;
  to.timed += from.timed;
  return to;
}

}  // namespace

PlanStatus status_of(const Plan& plan, const fs::path& results, const std::string& program, std::size_t shards) {
  PlanStatus out;
  out.shards.resize(shards);
  for (std::size_t at = 0; at < plan.cases.size(); ++at) {
    Count one;
    std::string trouble;
    count(plan.cases[at], results, program, one, trouble);
    if (!trouble.empty()) out.troubles.push_back(plan.cases[at].id + ": " + trouble);
    if (shards > 0) out.shards[at % shards] += one;
    out.all += one;
  }
  return out;
}

}  // namespace fastsplat::plan
