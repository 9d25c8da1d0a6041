// SPDX-License-Identifier: Apache-2.0
#include "report/report.hpp"

#include <algorithm>

#include "base/json_text.hpp"
#include "base/version.hpp"
#include "report/album.hpp"
#include "report/file_names.hpp"
#include "report/page.hpp"

namespace fastsplat::report {
namespace {

std::vector<Verdict> verdicts_of(const std::vector<Result>& results) {
  std::vector<Verdict> verdicts;
  for (const Result& result : results) verdicts.push_back(verdict_of(result));
  return verdicts;
}

/// The worst pixel of the first compare that has one, else the middle of the first picture.
Focus focus_of(const std::vector<Result>& results, const Album& album) {
  for (const Result& result : results) {
    const Json::json_pointer x("/worst/x"), y("/worst/y");
    if (result.subcommand == "compare" && result.json.contains(x) && result.json.contains(y))
      return {.x = result.json.at(x).get<int>(), .y = result.json.at(y).get<int>()};
  }
  if (album.pictures.empty()) return {};
  return {.x = album.pictures.front().width / 2, .y = album.pictures.front().height / 2};
}

}  // namespace

Json page_data(const std::vector<Result>& results) {
  const auto verdicts = verdicts_of(results);
  const Verdict whole = verdicts.empty() ? Verdict{} : verdict_of(verdicts);
  Json data{{"schema", "fastsplat.report/1"},
            {"program", "fastsplat " + program_version()},
            {"made", Json::array()},
            {"verdict", {{"status", to_string(whole.status)}, {"sentence", whole.sentence}, {"items", Json::array()}}},
            {"results", Json::array()}};
  for (std::size_t i = 0; i < results.size(); ++i) {
    data["made"].push_back(command_of(results[i]));
    data["verdict"]["items"].push_back({{"verb", results[i].subcommand},
                                        {"file", results[i].file.string()},
                                        {"status", to_string(verdicts[i].status)},
                                        {"sentence", verdicts[i].sentence}});
    data["results"].push_back(results[i].json);
  }
  return data;
}

Report make_report(const Request& request) {
  std::vector<NamedPicture> named;
  for (std::size_t i = 0; i < request.results.size(); ++i) {
    for (NamedPicture& one : pictures_of(request.results[i])) {
      if (!one.tie.empty()) one.tie = std::to_string(i) + "." + one.tie;
      named.push_back(std::move(one));
    }
  }
  named.insert(named.end(), request.pictures.begin(), request.pictures.end());
  const Album album = load_album(named);

  Json data = page_data(request.results);
  const std::size_t text = filled(page_template(), json_text(data, -1), {}).size();
  // A picture's description, mostly its scene, takes less than 3000 bytes.
  const std::size_t others = text + 3000 * album.pictures.size();
  const Pages pages =
      fit(album, focus_of(request.results, album), request.most_bytes - std::min(request.most_bytes, others));

  Report report;
  report.remarks = album.missing;
  report.remarks.insert(report.remarks.end(), pages.remarks.begin(), pages.remarks.end());
  data["pictures"] = pages.entries;
  data["remarks"] = report.remarks;
  report.html = filled(page_template(), json_text(without_folders(data), -1), pages.blocks);
  if (const auto verdicts = verdicts_of(request.results); !verdicts.empty()) report.verdict = verdict_of(verdicts);
  report.pictures = pages.entries.size();
  return report;
}

}  // namespace fastsplat::report
