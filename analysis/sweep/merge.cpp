// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "analysis/sweep/coverage_sum.hpp"
#include "analysis/sweep/merged.hpp"
#include "base/error.hpp"

namespace fastsplat::plan {
namespace {

namespace fs = std::filesystem;

std::string list_of(const std::vector<std::string>& names) {
  constexpr std::size_t kShown = 3;
  const std::vector<std::string> shown(names.begin(),
                                       names.begin() + static_cast<std::ptrdiff_t>(std::min(kShown, names.size())));
  return fmt::format("{}{}", fmt::join(shown, ", "),
                     names.size() > kShown ? fmt::format(" and {} more", names.size() - kShown) : "");
}

std::string described(const Case& one) {
  std::string text = one.id + " (";
  for (const auto& [name, value] : one.axes) text += (text.ends_with('(') ? "" : " ") + name + "=" + to_text(value);
  return text + ")";
}

void refuse_foreign(const Plan& plan, const fs::path& folder) {
  std::set<std::string> ids;
  for (const Case& one : plan.cases) ids.insert(one.id);
  std::vector<std::string> foreign;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const fs::path name = entry.path().filename();
    if (entry.is_regular_file() && name.extension() == ".json" && !ids.contains(name.stem().string()))
      foreign.push_back(name.string());
  }
  if (foreign.empty()) return;
  std::ranges::sort(foreign);
  throw_input({.where = folder.string(),
               .what = fmt::format("contains {} of plan {}: {}",
                                   foreign.size() == 1 ? "a file that is not a result" : "files that are not results",
                                   plan.name, list_of(foreign)),
               .expected = {},
               .got = {},
               .fix = "remove them, or skip them with --allow-foreign"});
}

void refuse_missing(const Plan& plan, const fs::path& folder, const std::vector<const Case*>& missing) {
  std::vector<std::string> names;
  for (const Case* one : missing) names.push_back(described(*one));
  throw_input({.where = folder.string(),
               .what = fmt::format("{} of {} results missing: {}", missing.size(), plan.cases.size(), list_of(names)),
               .expected = {},
               .got = {},
               .fix = "make them with `fastsplat plan run`, or merge available results with --partial"});
}

/// Refuses results of a program other than `program`.
void require_own(const Case& one, const CaseResult& result, const fs::path& path, const std::string& program) {
  const auto why = foreign(result, one, program);
  if (why.empty()) return;
  throw_input({.where = path.string(),
               .what = why,
               .expected = fmt::format("case {} by program {}", one.id, program),
               .got = {},
               .fix = "replace such results with `fastsplat plan run --again`"});
}

/// Collects every figure in its column; columns are in the order of the known metrics.
class Columns {
 public:
  explicit Columns(const Plan& plan) : wanted_(known_metrics()) {
    wanted_.insert(wanted_.end(), plan.metrics.begin(), plan.metrics.end());
  }

  void add(const CaseResult& result, Row& row) {
    for (const Metric& metric : wanted_) {
      for (const Figure& figure : figures(result.results, {metric})) {
        if (row.metric(figure.metric.name)) continue;  // already found under another path
        row.metrics.emplace_back(figure.metric.name, figure.value);
        found_[&metric].try_emplace(figure.metric.name, figure.metric);
        order_.try_emplace(figure.metric.name, order_.size());
      }
    }
  }

  std::vector<Metric> metrics() const {
    std::vector<Metric> out;
    for (const Metric& metric : wanted_) {
      const auto found = found_.find(&metric);
      if (found == found_.end()) continue;
      std::vector<Metric> own;
      for (const auto& [name, one] : found->second) own.push_back(one);
      std::ranges::sort(own, {}, [&](const Metric& one) { return order_.at(one.name); });
      for (const Metric& one : own) {
        if (std::ranges::find(out, one.name, &Metric::name) == out.end()) out.push_back(one);
      }
    }
    return out;
  }

 private:
  std::vector<Metric> wanted_;
  std::map<const Metric*, std::map<std::string, Metric>> found_;
  std::map<std::string, std::size_t> order_;
};

}  // namespace

Merged merge(const Plan& plan, const fs::path& results, const MergeOptions& options) {
  if (!options.allow_foreign) refuse_foreign(plan, results);
  Merged out{.name = plan.name,
             .title = plan.title,
             .hash = plan.hash,
             .program = {},
             .axes = plan.axes,
             .metrics = {},
             .rows = {},
             .missing = {},
             .coverage = {}};
  std::vector<const Case*> missing;
  Columns columns(plan);
  CoverageSum coverage;
  for (const Case& one : plan.cases) {
    const fs::path path = result_path(results, one.id);
    std::error_code ignored;
    if (!fs::exists(path, ignored)) {
      missing.push_back(&one);
      continue;
    }
    CaseResult result;
    try {
      result = read_result(path);
    } catch (const UserError&) {
      if (!options.partial) throw;
      missing.push_back(&one);
      continue;
    }
    if (out.program.empty()) out.program = result.program;
    require_own(one, result, path, out.program);
    Row row{.id = one.id,
            .kind = one.kind,
            .status = result.status,
            .message = result.message,
            .axes = one.axes,
            .metrics = {},
            .content = one.content,
            .program = result.program,
            .command = command_of(one)};
    columns.add(result, row);
    out.rows.push_back(std::move(row));
    if (!result.coverage.is_null()) coverage.add(result.coverage, path.string());
  }
  if (!missing.empty() && (!options.partial || out.rows.empty())) refuse_missing(plan, results, missing);
  for (const Case* one : missing) out.missing.push_back(one->id);
  out.metrics = columns.metrics();
  out.coverage = coverage.books();
  return out;
}

}  // namespace fastsplat::plan
