// SPDX-License-Identifier: Apache-2.0
#include "analysis/sweep/metric.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace fastsplat::plan {
namespace {

using Json = nlohmann::ordered_json;

std::string with_word(std::string text, const std::string& word) {
  const auto star = text.find('*');
  return star == std::string::npos ? text : text.replace(star, 1, word);
}

/// Collects the numbers at `rest` of a path, below `json`.
void collect(const Json& json, const std::string& rest, const Metric& metric, std::vector<Figure>& to) {
  if (rest.empty()) {
    if (!json.is_number()) return;
    const auto same = [&](const Figure& figure) { return figure.metric.name == metric.name; };
    const double value = json.get<double>();
    if (std::isfinite(value) && std::none_of(to.begin(), to.end(), same)) to.push_back({metric, value});
    return;
  }
  const auto slash = rest.find('/');
  const std::string element = rest.substr(0, slash), after = slash == std::string::npos ? "" : rest.substr(slash + 1);
  if (element == "*" && json.is_object()) {
    for (const auto& [key, value] : json.items()) {
      Metric own = metric;
      own.name = with_word(own.name, key);
      own.title = with_word(own.title, key);
      collect(value, after, own, to);
    }
  } else if (element.starts_with('*') && json.is_array()) {
    const std::string key = element.substr(1);
    for (const auto& value : json) {
      if (!value.is_object() || !value.contains(key) || !value[key].is_string()) continue;
      Metric own = metric;
      own.name = with_word(own.name, value[key]);
      own.title = with_word(own.title, value[key]);
      collect(value, after, own, to);
    }
  } else if (json.is_object() && json.contains(element)) {
    collect(json[element], after, metric, to);
  }
}

}  // namespace

const char* to_string(Better better) {
  switch (better) {
    case Better::Less:
      return "less";
    case Better::More:
      return "more";
    case Better::Neither:
      break;
  }
  return "";
}

const std::vector<Metric>& known_metrics() {
  using enum Better;
  static const std::vector<Metric> known{
      {"psnr_db", "PSNR against golden", "dB", More, "compare/psnr_db"},
      {"max_abs_lsb", "largest error", "LSB", Less, "compare/max_abs_lsb"},
      {"p99_lsb", "99th percentile of the error", "LSB", Less, "compare/p99_lsb"},
      {"rmse_lsb", "root mean square error", "LSB", Less, "compare/rmse_lsb"},
      {"mean_abs_lsb", "mean error", "LSB", Less, "compare/mean_abs_lsb"},
      {"bias_lsb", "bias", "LSB", Neither, "compare/bias_lsb"},
      {"ssim", "structural similarity", "", More, "compare/ssim"},
      {"floor_psnr_db", "PSNR of golden rounded once", "dB", Neither, "compare/floor/psnr_db"},
      {"error_rms_lsb8", "error, rms", "LSB of 8 bit", Less, "errors/total/rms_lsb8"},
      {"error_max_lsb8", "largest error", "LSB of 8 bit", Less, "errors/total/max_lsb8"},
      {"error_bias_lsb8", "bias", "LSB of 8 bit", Neither, "errors/total/bias_lsb8"},
      {"share_*", "share of step *", "", Neither, "errors/steps/*name/share"},
      {"bound_*_lsb8", "largest bound, * known", "LSB of 8 bit", Less,
       "errors bound/levels/*known/greatest_bound_lsb8"},
      {"bound_error_lsb8", "largest error", "LSB of 8 bit", Less, "errors bound/levels/*known/greatest_error_lsb8"},
      {"cost", "cost of the device", "full adders", Less, "render/config/cost/total"},
      {"cost", "cost of the device", "full adders", Less, "cycles/config/cost/total"},
      {"cost", "cost of the device", "full adders", Less, "errors/config/cost/total"},
      {"cost", "cost of the device", "full adders", Less, "errors bound/config/cost/total"},
      {"storage_bits", "memory", "bit", Less, "render/config/cost/storage_bits"},
      {"storage_bits", "memory", "bit", Less, "cycles/config/cost/storage_bits"},
      {"multiplier_bits", "multiplier cells", "", Less, "render/config/cost/multiplier_bits"},
      {"multiplier_bits", "multiplier cells", "", Less, "cycles/config/cost/multiplier_bits"},
      {"xc7_*", "7-series: *", "cells", Less, "render/config/synthesis/xc7/*"},
      {"ecp5_*", "ECP5: *", "cells", Less, "render/config/synthesis/ecp5/*"},
      {"ice40_*", "iCE40: *", "cells", Less, "render/config/synthesis/ice40/*"},
      {"gates_*", "CMOS gates: *", "", Less, "render/config/synthesis/gates/*"},
      {"gates_*", "CMOS gates: *", "", Less, "cycles/config/synthesis/gates/*"},
      {"xc7_*", "7-series: *", "cells", Less, "cycles/config/synthesis/xc7/*"},
      {"ecp5_*", "ECP5: *", "cells", Less, "cycles/config/synthesis/ecp5/*"},
      {"ice40_*", "iCE40: *", "cells", Less, "cycles/config/synthesis/ice40/*"},
      {"area_*", "area model, 7-series: *", "cells", Less, "render/config/area/*"},
      {"area_*", "area model, 7-series: *", "cells", Less, "cycles/config/area/*"},
      {"table_bits", "tables of the index, a radius set", "bit", Less, "render/config/index_cost/table_bits"},
      {"table_bits", "tables of the index, a radius set", "bit", Less, "cycles/config/index_cost/table_bits"},
      {"splat_cycles", "cycles a splat of the index", "cycles", Less, "render/config/index_cost/cycles_per_splat"},
      {"cycles", "cycles of the frame", "cycles", Less, "cycles/cycles/actual"},
      {"frame_cycles", "cycles of the frame on all devices", "cycles", Less, "cycles/scaling/frame_cycles"},
      {"frame_ms", "time of the frame", "ms", Less, "cycles/scaling/milliseconds"},
      {"fps", "frames a second", "fps", More, "cycles/scaling/fps"},
      {"actual_to_ideal", "actual / ideal cycles", "", Less, "cycles/actual_to_ideal"},
      {"utilisation", "windows a cycle", "", More, "cycles/utilisation"},
      {"splats_per_cycle", "splats a cycle", "", More, "cycles/splats_per_cycle"},
      {"bytes_in", "bytes of the stream", "bytes", Less, "cycles/traffic/bytes_in"},
      {"bytes_out", "bytes of pixels", "bytes", Less, "cycles/traffic/bytes_out"},
      {"energy_low_uj", "energy of the frame, at least", "uJ", Less, "cycles/energy/low_uj"},
      {"energy_high_uj", "energy of the frame, at most", "uJ", Less, "cycles/energy/high_uj"},
      {"hidden_share", "splats on terminated blocks", "", Neither, "cycles/hidden_share"},
      {"cycles_*", "cycles: *", "cycles", Neither, "cycles/cycles/account/*"},
      {"vanished_share", "vanished voxels", "", Less, "render/driver/vanished_share"},
      {"saturated_records", "saturated records", "", Less, "render/driver/saturated_records"},
      {"sheet_saturated", "saturated sheet words", "", Less, "render/counters/sheet_saturated"},
      {"pixel_saturated", "saturated pixel words", "", Less, "render/counters/pixel_saturated"},
      {"mismatches", "mismatches of RTL and model", "", Less, "verify/mismatches"},
      {"comparisons", "comparisons of RTL and model", "", Neither, "verify/comparisons"},
      {"verified_splats", "splats", "", Neither, "verify/splats"},
      {"verified_cycles", "cycles simulated", "cycles", Neither, "verify/cycles_rtl"},
      {"bins_hit", "coverage bins hit", "", More, "verify/coverage/hit"},
      {"bins", "coverage bins", "", Neither, "verify/coverage/bins"},
  };
  return known;
}

std::vector<Figure> figures(const Json& results, const std::vector<Metric>& metrics) {
  std::vector<Figure> out;
  for (const Metric& metric : metrics) collect(results, metric.path, metric, out);
  return out;
}

}  // namespace fastsplat::plan
