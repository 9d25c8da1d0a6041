// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/compare.hpp"
#include "analysis/figures.hpp"
#include "base/json_text.hpp"

namespace fastsplat::analysis {
namespace {

using Json = nlohmann::ordered_json;

// JSON has no NaN and no infinity.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json figures_json(const Figures& figures) {
  Json percentile;
  for (std::size_t p = 0; p < percentiles().size(); ++p) {
    percentile[percentiles()[p].name] = number(figures.percentiles_lsb[p]);
  }
  return {{"psnr_db", number(figures.psnr_db)},
          {"identical", figures.max_abs_lsb == 0},
          {"max_abs_lsb", number(figures.max_abs_lsb)},
          {"mean_abs_lsb", number(figures.mean_abs_lsb)},
          {"rmse_lsb", number(figures.rmse_lsb)},
          {"bias_lsb", number(figures.bias_lsb)},
          {"p99_lsb", number(figures.percentiles_lsb[3])},
          {"ssim", number(figures.ssim)},
          {"percentiles_lsb", percentile}};
}

Json place_json(const Place& place) {
  return {{"x", place.x},
          {"y", place.y},
          {"channel", place.channel},
          {"ref", number(place.ref)},
          {"test", number(place.test)},
          {"error_lsb", number(place.error_lsb)}};
}

Json histogram_json(const std::vector<std::uint64_t>& counts) {
  Json bins = Json::array();
  for (std::size_t bin = 0; bin < counts.size(); ++bin) {
    const bool open_ended = bin == 256;
    bins.push_back({{"from_lsb", bin == 0 ? 0.0 : static_cast<double>(bin) - 0.5},
                    {"to_lsb", open_ended ? Json(nullptr) : Json(static_cast<double>(bin) + 0.5)},
                    {"count", counts[bin]}});
  }
  return bins;
}

Json cluster_json(const Cluster& cluster) {
  return {{"x0", cluster.x0},
          {"y0", cluster.y0},
          {"x1", cluster.x1},
          {"y1", cluster.y1},
          {"pixels", cluster.pixels},
          {"max_lsb", number(cluster.max_lsb)},
          {"sum_lsb", number(cluster.sum_lsb)},
          {"worst", place_json(cluster.worst)}};
}

}  // namespace

std::string to_json(const CompareReport& report) {
  Json json{{"schema", "fastsplat.compare/1"},
            {"verdict", report.pass ? "pass" : "fail"},
            {"width", report.width},
            {"height", report.height},
            {"channels", report.channels},
            {"values", report.values},
            {"nonfinite", {{"ref", report.nonfinite_ref}, {"test", report.nonfinite_test}}},
            {"lsb_bits", report.options.lsb_bits},
            {"peak", report.options.peak}};
  json.update(figures_json(report.figures));
  json["floor"] = figures_json(report.floor);
  json["worst"] = report.values > 0 ? place_json(report.worst) : Json(nullptr);
  json["histogram"] = histogram_json(report.histogram);
  json["cluster_threshold_lsb"] = number(report.cluster_threshold_lsb);
  json["clusters"] = Json::array();
  for (const auto& cluster : report.clusters) json["clusters"].push_back(cluster_json(cluster));
  json["limits"] = Json::array();
  for (const auto& limit : report.limits) {
    json["limits"].push_back(
        {{"name", limit.name}, {"limit", number(limit.limit)}, {"got", number(limit.got)}, {"ok", limit.ok}});
  }
  return json_text(json, 2) + "\n";
}

}  // namespace fastsplat::analysis
