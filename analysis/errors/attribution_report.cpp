// SPDX-License-Identifier: Apache-2.0
#include "analysis/errors/attribution_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/error_values.hpp"

namespace fastsplat::analysis {
namespace {

using Json = nlohmann::ordered_json;

/// Steps by share, the largest first.
std::vector<const StepError*> ranked(const Attribution& a) {
  std::vector<const StepError*> steps;
  for (const StepError& step : a.steps) steps.push_back(&step);
  std::ranges::stable_sort(steps, [](const auto* x, const auto* y) { return x->share > y->share; });
  return steps;
}

std::string answer(const Attribution& a, const std::optional<TriedSuggestion>& tried, int bits) {
  if (!(a.total.rms > 0.0)) return "no error: no step changes the picture\n";
  const auto steps = ranked(a);
  std::string text = fmt::format("{}: {:.0f} % of the error", steps[0]->set.name, 100.0 * steps[0]->share);
  for (std::size_t i = 1; i < steps.size() && steps[i]->share >= 0.1; ++i)
    text += fmt::format("; {}: {:.0f} %", steps[i]->set.name, 100.0 * steps[i]->share);
  text += "\n";
  if (!tried) return text;
  text += fmt::format("{} would {} the error: RMS {:.4f} -> {:.4f} LSB{}", tried->suggestion.changes,
                      tried->error.rms < 0.999 * a.total.rms ? "reduce" : "not reduce",
                      a.total.rms * lsb_per_unit(bits), tried->error.rms * lsb_per_unit(bits), bits);
  if (tried->costs) {
    const auto& [before, after] = *tried->costs;
    text += fmt::format(", storage {:+.1f} kbit, cost {:+.1f} %", (after.storage_bits - before.storage_bits) / 1000.0,
                        100.0 * (after.total() / before.total() - 1.0));
  }
  return text + "\n";
}

/// In percent, never "-0".
double percent(double share) { return std::abs(share) < 0.5e-4 ? 0.0 : 100.0 * share; }

std::string story(const PixelStory& s, int bits) {
  constexpr const char* kChannels[] = {"R", "G", "B", "A"};
  std::string text = fmt::format("{:<6} pixel ({}, {}) {}: {:+.3f} LSB{}, of it", s.which, s.x, s.y,
                                 kChannels[s.channel], s.error * lsb_per_unit(bits), bits);
  double listed = 0.0;
  for (std::size_t i = 0; i < std::min<std::size_t>(3, s.parts.size()); ++i) {
    text += fmt::format("{} {} {:+.3f}", i == 0 ? "" : ",", s.parts[i].first, s.parts[i].second * lsb_per_unit(bits));
    listed += s.parts[i].second;
  }
  return text + fmt::format(", all others {:+.3f}\n", (s.error - listed) * lsb_per_unit(bits));
}

Json amount_json(const Amount& amount) {
  return {{"rms_lsb8", amount.rms * lsb_per_unit(8)},        {"max_lsb8", amount.greatest * lsb_per_unit(8)},
          {"bias_lsb8", amount.bias * lsb_per_unit(8)},      {"rms_lsb16", amount.rms * lsb_per_unit(16)},
          {"max_lsb16", amount.greatest * lsb_per_unit(16)}, {"bias_lsb16", amount.bias * lsb_per_unit(16)}};
}

}  // namespace

std::optional<TriedSuggestion> try_suggestion(const ChainOf& chain_of, const cmodel::Config& config,
                                              const Attribution& attribution, bool gaussians, int threads) {
  for (const StepError* step : ranked(attribution)) {
    if (step->share <= 0.0) break;
    std::optional<Suggestion> found = suggestion(step->set.steps.back(), config, gaussians);
    if (!found) continue;
    TriedSuggestion out{step->set.name, std::move(*found), {}, {}};
    if (config.index() == cmodel::IndexKind::Rlut) out.costs = {cost(config), cost(out.suggestion.config)};
    const auto chain = chain_of(out.suggestion.config);
    out.error = amount_of(difference((*chain)(stages::Mixture::all_device(), threads), attribution.real));
    return out;
  }
  return std::nullopt;
}

std::string to_text(const Attribution& a, const std::optional<TriedSuggestion>& tried, int bits) {
  const double unit = lsb_per_unit(bits);
  std::string text = answer(a, tried, bits);
  text += fmt::format("error of {}: RMS {:.4f}, max {:.3f}, bias {:+.4f} LSB{}; floor of {} bits: RMS {:.4f}\n\n",
                      a.floats ? "floats (" + a.floats->text() + ")" : "the device", a.total.rms * unit,
                      a.total.greatest * unit, a.total.bias * unit, bits, bits,
                      (bits == 16 ? a.floor16 : a.floor8).rms * unit);
  const auto alone = [&](const std::string& columns) { return a.quick ? std::string{} : columns; };
  text += fmt::format("{:<15} {:<6} {:>8} {:>9} {:>9} {:>9} |{} {:>7}\n", "step", "by", "share", "RMS", "max", "bias",
                      alone(fmt::format(" {:>8} {:>9} | {:>9} |", "alone", "RMS", "left out")), "pixels");
  double sum = 0.0;
  for (const StepError& s : a.steps) {
    text += fmt::format("{:<15} {:<6} {:>6.2f} % {:>9.4f} {:>9.3f} {:>+9.4f} |{} {:>5.1f} %\n", s.set.name, s.set.by,
                        percent(s.share), s.increment.rms * unit, s.increment.greatest * unit, s.increment.bias * unit,
                        alone(fmt::format(" {:>6.2f} % {:>9.4f} | {:>9.4f} |", percent(s.only_share), s.only.rms * unit,
                                          s.without.rms * unit)),
                        100.0 * s.pixels_ruled);
    sum += s.share;
  }
  text += fmt::format("{:<15} {:<6} {:>6.2f} %{}\n", "remainder", "", percent(a.total.rms > 0.0 ? 1.0 - sum : 0.0),
                      alone(fmt::format("{:>30} | {:>6.2f} %", "", percent(a.only_remainder))));
  if (a.floats)
    text += fmt::format("sum {:.1f} %\n", 100.0 * sum);
  else
    text += fmt::format("sum {:.1f} %: driver {:.1f} %, device {:.1f} %{}\n",
                        100.0 * (a.driver_share + a.device_share + a.both_share), 100.0 * a.driver_share,
                        100.0 * a.device_share,
                        a.both_share != 0.0 ? fmt::format(", both together {:.1f} %", 100.0 * a.both_share) : "");
  if (!a.groups.empty()) {
    text += "groups (Shapley)";
    for (const GroupShare& group : a.groups) text += fmt::format("  {} {:.2f} %", group.name, 100.0 * group.share);
    text += "\n";
  }
  for (const PixelStory& s : a.stories) text += story(s, bits);
  return text;
}

Json to_json(const Attribution& a, const std::optional<TriedSuggestion>& tried) {
  Json json{{"schema", "fastsplat.errors/1"},
            {"frames", a.chains},
            {"total", amount_json(a.total)},
            {"floor_8", amount_json(a.floor8)},
            {"floor_16", amount_json(a.floor16)}};
  for (const StepError& s : a.steps) {
    Json steps = Json::array();
    for (const stages::Step step : s.set.steps) steps.push_back(stages::facts(step).name);
    json["steps"].push_back(
        {{"name", s.set.name},
         {"steps", steps},
         {"by", s.set.by},
         {"meaning", a.floats ? "as " + a.floats->text() : std::string(stages::facts(s.set.steps.back()).meaning)},
         {"keys", a.floats ? "" : stages::facts(s.set.steps.back()).keys},
         {"share", s.share},
         {"increment", amount_json(s.increment)},
         {"pixels_ruled", s.pixels_ruled}});
    if (a.quick) continue;
    json["steps"].back()["alone_share"] = s.only_share;
    json["steps"].back()["alone"] = amount_json(s.only);
    json["steps"].back()["left_out"] = amount_json(s.without);
  }
  if (a.floats) {
    json["floats"] = {{"operands", a.floats->operands.name},
                      {"sums", a.floats->sums.name},
                      {"centres", a.floats->tile_centres ? "tile" : "picture"},
                      {"subnormals", a.floats->subnormals}};
  } else {
    json["driver_share"] = a.driver_share;
    json["device_share"] = a.device_share;
    json["both_share"] = a.both_share;
  }
  if (!a.quick) json["alone_remainder"] = a.only_remainder;
  for (const GroupShare& group : a.groups) json["groups"][group.name] = group.share;
  json["pixels"] = Json::array();
  for (const PixelStory& s : a.stories) {
    Json parts;
    for (const auto& [name, part] : s.parts) parts[name] = part * lsb_per_unit(8);
    json["pixels"].push_back({{"which", s.which},
                              {"x", s.x},
                              {"y", s.y},
                              {"channel", s.channel},
                              {"error_lsb8", s.error * lsb_per_unit(8)},
                              {"parts_lsb8", parts}});
  }
  if (tried) {
    json["remedy"] = {
        {"step", tried->step}, {"changes", tried->suggestion.changes}, {"error", amount_json(tried->error)}};
    if (tried->costs) {
      json["remedy"]["cost_before"] = to_json(tried->costs->first);
      json["remedy"]["cost_after"] = to_json(tried->costs->second);
    }
  }
  return json;
}

Image to_image(const stages::Picture& picture) {
  Image image(picture.width, picture.height, 4);
  for (std::size_t i = 0; i < image.data.size(); ++i) image.data[i] = static_cast<float>(picture.pixels[i / 4][i % 4]);
  return image;
}

std::string file_word(const std::string& name) {
  std::string word = name;
  std::ranges::replace(word, '+', '-');
  return word;
}

}  // namespace fastsplat::analysis
