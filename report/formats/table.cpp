// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>

#include "report/figures.hpp"
#include "report/formats/output_format.hpp"

namespace fastsplat::report {
namespace {

/// Rows made from objects; columns are in order of first appearance.
class Rows {
 public:
  void begin() { table_.rows.emplace_back(table_.columns.size()); }
  void put(const std::string& column, const Json& value) {
    const auto found = std::find(table_.columns.begin(), table_.columns.end(), column);
    const auto at = static_cast<std::size_t>(found - table_.columns.begin());
    if (found == table_.columns.end()) table_.columns.push_back(column);
    auto& row = table_.rows.back();
    if (row.size() <= at) row.resize(at + 1);
    row[at] = value;
  }
  /// All members of an object; nested ones as "outer.inner".
  void put_all(const Json& object, const std::string& before = {}) {
    for (const auto& [name, value] : object.items()) {
      if (value.is_object()) {
        put_all(value, before + name + ".");
      } else {
        put(before + name, value);
      }
    }
  }
  Table take() {
    for (auto& row : table_.rows) row.resize(table_.columns.size());
    return std::move(table_);
  }

 private:
  Table table_;
};

/// A list of objects, one row each.
Table list(const Figures& f, const std::string& place) {
  Rows rows;
  std::size_t at = 0;
  for (const Json& entry : f.list(place)) {
    if (!entry.is_object()) f.damaged(place + "/" + std::to_string(at), "an object");
    rows.begin();
    rows.put_all(entry);
    ++at;
  }
  return rows.take();
}

/// One row per number of an object: its key in column `name`, its value in column `value`.
Table members(const Json& object, const char* name, const char* value) {
  Rows rows;
  for (const auto& [key, number] : object.items()) {
    rows.begin();
    rows.put(name, key);
    rows.put(value, number);
  }
  return rows.take();
}

Table compare(const Figures& f) {
  Rows rows;
  const Json& floor = f.at("floor");
  for (const auto& [name, value] : floor.items()) {
    if (value.is_object()) continue;
    rows.begin();
    rows.put("figure", name);
    rows.put("value", f.at(name));
    rows.put("floor", value);
  }
  return rows.take();
}

Table cycles(const Figures& f) {
  Rows rows;
  const double actual = f.number("cycles/actual");
  for (const auto& [name, count] : f.at("cycles/account").items()) {
    rows.begin();
    rows.put("cycles", name);
    rows.put("count", count);
    rows.put("share", actual > 0.0 ? Json(f.number("cycles/account/" + name) / actual) : Json(nullptr));
  }
  return rows.take();
}

Table errors(const Figures& f) { return list(f, "steps"); }
Table errors_file(const Figures& f) { return list(f, "parts"); }
Table bound(const Figures& f) { return list(f, "levels"); }
Table ranges(const Figures& f) { return list(f, "sites"); }
Table propose(const Figures& f) { return list(f, "keys"); }
Table family(const Figures& f) { return list(f, "cells"); }
Table plan(const Figures& f) { return list(f, "rows"); }
/// Seeds of a campaign; without seeds, the taps.
Table verify(const Figures& f) {
  return f.find("by_seed") != nullptr ? list(f, "by_seed") : members(f.at("by_tap"), "tap", "comparisons");
}

/// A row per bin of each campaign.
Table coverage(const Figures& f) {
  Rows rows;
  for (const auto& [campaign, bins] : f.at("campaigns").items()) {
    for (const auto& [bin, hits] : bins.items()) {
      rows.begin();
      rows.put("campaign", campaign);
      rows.put("bin", bin);
      rows.put("hits", hits);
    }
  }
  return rows.take();
}

/// A row per testpoint and configuration, with its weakest bin.
Table closure(const Figures& f) {
  Rows rows;
  for (const Json& point : f.list("testpoints")) {
    for (const Json& on : point.at("configurations")) {
      const Json& hits = on.at("hits");
      const auto weakest = std::min_element(hits.begin(), hits.end());
      rows.begin();
      rows.put("testpoint", point.at("name"));
      rows.put("configuration", on.at("config"));
      rows.put("hit", on.at("hit"));
      rows.put("bins", on.at("all"));
      rows.put("fewest_hits", weakest == hits.end() ? Json(nullptr) : *weakest);
    }
  }
  return rows.take();
}

/// A device's counters; empty for engines without counters.
Table counters(const Figures& f) {
  const Json* counters = f.find("counters");
  return counters != nullptr && counters->is_object() ? members(*counters, "counter", "count") : Table{};
}

}  // namespace

Table table_of(const Result& result) {
  using TableOf = Table (*)(const Figures&);
  static const std::map<std::string, TableOf> all{{"closure", closure},
                                                  {"compare", compare},
                                                  {"coverage", coverage},
                                                  {"cycles", cycles},
                                                  {"errors", errors},
                                                  {"errors bound", bound},
                                                  {"errors ranges", ranges},
                                                  {"errors propose", propose},
                                                  {"errors file", errors_file},
                                                  {"family", family},
                                                  {"plan", plan},
                                                  {"verify", verify},
                                                  {"stream replay", counters},
                                                  {"render", counters},
                                                  {"stream record", counters}};
  const auto found = all.find(result.subcommand);
  return found == all.end() ? Table{} : found->second(Figures(result));
}

}  // namespace fastsplat::report
