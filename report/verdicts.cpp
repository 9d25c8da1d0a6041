// SPDX-License-Identifier: Apache-2.0
#include "report/verdicts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace fastsplat::report {
namespace {

std::string grouped(std::uint64_t number) {
  std::string digits = std::to_string(number);
  for (int at = static_cast<int>(digits.size()) - 3; at > 0; at -= 3) digits.insert(static_cast<std::size_t>(at), ",");
  return digits;
}

std::string counted(std::uint64_t number, const char* what) {
  return grouped(number) + " " + what + (number == 1 ? "" : "s");
}

/// A limit such as "min_psnr_db" in words, with its unit.
std::string limit_text(const std::string& name, double value) {
  static const std::map<std::string, std::pair<const char*, const char*>> words{
      {"min_psnr_db", {"PSNR", " dB"}},
      {"max_abs_lsb", {"worst error", " LSB"}},
      {"max_mean_lsb", {"mean error", " LSB"}},
      {"max_rmse_lsb", {"rms error", " LSB"}},
      {"max_bias_lsb", {"bias", " LSB"}},
      {"max_p99_lsb", {"99th percentile", " LSB"}},
      {"min_ssim", {"SSIM", ""}},
      {"min_values", {"values compared", ""}},
      {"max_nonfinite", {"non-finite values", ""}}};
  const auto found = words.find(name);
  if (found == words.end()) return fmt::format("{} {:.6g}", name, value);
  return fmt::format("{} {:.4g}{}", found->second.first, value, found->second.second);
}

Verdict compare(const Figures& f) {
  const bool identical = f.flag("identical");
  const std::string psnr =
      identical ? "identical" : fmt::format("{:.1f} dB", f.at("psnr_db").is_null() ? 0.0 : f.number("psnr_db"));
  f.at("percentiles_lsb"), f.at("floor"), f.list("histogram"), f.list("clusters"), f.count("width"), f.count("height");
  if (f.text("verdict") == "pass") {
    if (identical) return {Status::Pass, "the pictures are identical"};
    return {Status::Pass, fmt::format("{}, worst error {:.3g} LSB of {} bits: within all limits", psnr,
                                      f.number("max_abs_lsb"), f.count("lsb_bits"))};
  }
  std::string failed;
  for (const Json& limit : f.list("limits")) {
    if (limit.value("ok", true)) continue;
    const auto number = [&](const char* key) {
      const auto found = limit.find(key);
      return found != limit.end() && found->is_number() ? found->get<double>() : 0.0;
    };
    const std::string name = limit.value("name", "");
    failed += (failed.empty() ? "" : ", ") + limit_text(name, number("got")) +
              fmt::format(" (required: {} {:.4g})", name.starts_with("min_") ? "at least" : "at most", number("limit"));
  }
  return {Status::Fail, failed.empty() ? "a limit failed" : failed};
}

Verdict verify_unplanted(const Figures& f) {
  const std::string verdict = f.text("verdict");
  const std::string of =
      fmt::format("{} of configuration {}", counted(f.count("comparisons"), "comparison"), f.text("config"));
  if (verdict == "pass")
    return {Status::Pass, fmt::format("RTL and model agree bit for bit: {}, {}, no difference", of,
                                      counted(f.count("splats"), "splat"))};
  if (verdict == "mismatch")
    return {Status::Fail, fmt::format("RTL and model differ {} times in {}", grouped(f.count("mismatches")), of)};
  if (verdict == "nothing compared") return {Status::Fail, "nothing was compared: " + of};
  if (verdict == "fault not seen") return {Status::Fail, "the planted fault was not seen: " + of + ", no difference"};
  return {Status::Error, fmt::format("the simulated device failed ({}) after {}", verdict, of)};
}

/// For a planted fault, the sentence names it.
Verdict verify(const Figures& f) {
  Verdict verdict = verify_unplanted(f);
  if (f.find("planted_fault") != nullptr)
    verdict.sentence = fmt::format("planted fault {} ({}): {}", f.text("planted_fault/name"),
                                   f.text("planted_fault/meaning"), verdict.sentence);
  return verdict;
}

Verdict render(const Figures& f) {
  const std::string engine = f.text("engine");
  if (const Json* frames = f.find("frames"))
    return {Status::Measured, fmt::format("{} by the {} engine", counted(frames->size(), "frame"), engine)};
  const bool gaussians = f.find("gaussians") != nullptr;
  const std::string scene = gaussians ? "gaussians/" : "scene/";
  return {Status::Measured,
          fmt::format("{} x {} pixels by the {} engine, {}", f.count(scene + "width"), f.count(scene + "height"),
                      engine, f.text(scene + (gaussians ? "name" : "volume")))};
}

Verdict replay(const Figures& f) {
  return {Status::Measured,
          fmt::format("{} x {} pixels replayed from {}", f.count("width"), f.count("height"), f.text("stream"))};
}

Verdict record(const Figures& f) { return {Status::Measured, "recorded " + f.text("stream")}; }

Verdict cycles(const Figures& f) {
  const auto actual = f.count("cycles/actual"), ideal = f.count("cycles/account/ideal");
  std::string loss = "nothing";
  std::uint64_t most = 0;
  for (const auto& [name, lost] : f.at("cycles/account").items()) {
    if (name == "ideal" || !lost.is_number_unsigned() || lost.get<std::uint64_t>() <= most) continue;
    most = lost.get<std::uint64_t>();
    loss = name;
  }
  std::replace(loss.begin(), loss.end(), '_', ' ');
  return {Status::Measured, fmt::format("{} cycles, {:.4g} times the ideal {}; largest loss: {}{}", grouped(actual),
                                        f.number("actual_to_ideal"), grouped(ideal), loss,
                                        most ? fmt::format(" ({})", grouped(most)) : "")};
}

Verdict errors(const Figures& f) {
  std::string step;
  double share = -1.0;
  for (const Json& entry : f.list("steps")) {
    if (!entry.contains("share") || !entry["share"].is_number() || entry["share"].get<double>() <= share) continue;
    share = entry["share"].get<double>();
    step = entry.value("name", "");
  }
  return {Status::Measured,
          fmt::format("rms error {:.3g} LSB of 8 bits; {}", f.number("total/rms_lsb8"),
                      step.empty() ? std::string("no step has an error")
                                   : fmt::format("{} has the largest share, {:.0f} %", step, 100 * share))};
}

Verdict errors_file(const Figures& f) {
  const double file = f.number("file/rms_lsb8"), device = f.number("device/rms_lsb8");
  return {Status::Measured,
          fmt::format("rms error {:.3g} LSB of 8 bits by the file, {:.3g} by the device, {:.3g} by both", file, device,
                      f.number("total/rms_lsb8"))};
}

Verdict bound(const Figures& f) {
  const Json& levels = f.list("levels");
  const bool holds = f.flag("holds");
  const std::string known = levels.empty() ? "" : levels.front().value("known", "");
  return {holds ? Status::Pass : Status::Fail,
          levels.empty()
              ? std::string(holds ? "the bound holds" : "an error exceeds its bound")
              : fmt::format("{}: at most {:.3g} LSB of 8 bits proved from the {}, {:.3g} seen",
                            holds ? "every error is below its bound" : "an error exceeds its bound",
                            f.number("levels/0/greatest_bound_lsb8"), known, f.number("levels/0/greatest_error_lsb8"))};
}

Verdict ranges(const Figures& f) {
  std::uint64_t saturated = 0, sites = 0;
  for (const Json& site : f.list("sites")) {
    ++sites;
    if (site.contains("saturated") && site["saturated"].is_number_unsigned())
      saturated += site["saturated"].get<std::uint64_t>();
  }
  return {Status::Measured,
          fmt::format("{} observed, {}", grouped(sites) + " narrowings",
                      saturated == 0 ? "nothing saturated" : counted(saturated, "value") + " saturated")};
}

Verdict propose(const Figures& f) {
  if (!f.flag("met")) return {Status::Fail, fmt::format("{} is not met by any tried configuration", f.text("target"))};
  if (f.find("speed/proposed/devices") != nullptr) {
    const std::uint64_t devices = f.count("speed/proposed/devices");
    return {Status::Pass, fmt::format("{} is met by {}", f.text("target"), counted(devices, "device"))};
  }
  const double from = f.number("cost_from/total"), to = f.number("cost/total");
  return {Status::Pass,
          fmt::format("{} is met at {:.0f} % of the cost", f.text("target"), from > 0 ? 100 * to / from : 100.0)};
}

Verdict family(const Figures& f) {
  return {Status::Measured, fmt::format("{} of the index measured", counted(f.list("cells").size(), "cell"))};
}

Verdict plan(const Figures& f) {
  std::uint64_t rows = 0, failed = 0, broken = 0;
  for (const Json& row : f.list("rows")) {
    ++rows;
    const std::string status = row.is_object() ? row.value("status", "") : "";
    failed += status == "fail" ? 1 : 0;
    broken += status == "error" ? 1 : 0;
  }
  const std::string name = f.text("name");
  if (rows == 0) return {Status::Error, "plan " + name + " has no cases"};
  if (broken > 0)
    return {Status::Error,
            fmt::format("{} of {} of plan {} ended with an error{}", grouped(broken), counted(rows, "case"), name,
                        failed ? fmt::format(", {} failed", grouped(failed)) : "")};
  if (failed > 0)
    return {Status::Fail, fmt::format("{} of {} of plan {} failed", grouped(failed), counted(rows, "case"), name)};
  return {Status::Pass, fmt::format("all {} of plan {} passed", counted(rows, "case"), name)};
}

Verdict coverage(const Figures& f) {
  std::map<std::string, bool> hit;  // by bin: hit in any campaign
  for (const auto& [campaign, bins] : f.at("campaigns").items())
    for (const auto& [bin, hits] : bins.items()) hit[bin] |= hits.get<std::uint64_t>() > 0;
  const auto hits = std::count_if(hit.begin(), hit.end(), [](const auto& bin) { return bin.second; });
  return {Status::Measured, fmt::format("configuration {}: {} of {} hit", f.text("config"),
                                        grouped(static_cast<std::uint64_t>(hits)), counted(hit.size(), "bin"))};
}

Verdict closure(const Figures& f) {
  const std::string verdict = f.text("verdict");
  if (verdict != "closed" && verdict != "open") f.damaged("verdict", "closed or open");
  std::size_t open = 0;
  std::string first;
  for (const char* part : {"open/campaigns", "open/testpoints", "open/lines"}) {
    const Json& findings = f.list(part);
    if (open == 0 && !findings.empty()) first = f.text(std::string(part) + "/0");
    open += findings.size();
  }
  if (verdict == "open")
    return {Status::Fail, fmt::format("coverage is open in {}{}", counted(open, "place"), open ? ": " + first : "")};
  std::string sentence = fmt::format("coverage is closed: {} of {} hit", grouped(f.count("bins/hit")),
                                     counted(f.count("bins/all"), "bin"));
  if (const auto lines = f.count("lines/all"); lines > 0)
    sentence += fmt::format(", {} of {} lines and branches reached, {} excused", grouped(f.count("lines/reached")),
                            grouped(lines), grouped(f.count("lines/excused")));
  if (const auto passed = f.count("tests/passed"); passed > 0)
    sentence += fmt::format(", {} of the plan passed", counted(passed, "test"));
  return {Status::Pass, sentence};
}

}  // namespace

const std::map<std::string, SentenceOf>& verdicts() {
  static const std::map<std::string, SentenceOf> all{
      {"closure", closure},      {"compare", compare},         {"coverage", coverage},  {"cycles", cycles},
      {"errors", errors},        {"errors file", errors_file}, {"errors bound", bound}, {"errors propose", propose},
      {"errors ranges", ranges}, {"family", family},           {"plan", plan},          {"render", render},
      {"stream record", record}, {"stream replay", replay},    {"verify", verify}};
  return all;
}

}  // namespace fastsplat::report
