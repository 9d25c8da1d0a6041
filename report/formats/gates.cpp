// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "report/figures.hpp"
#include "report/formats/output_format.hpp"

namespace fastsplat::report {
namespace {

using GatesOf = std::vector<Gate> (*)(const Figures&);

/// For sums of doubles that were each rounded once.
constexpr double kSumTolerance = 1e-6;

Status held(bool ok) { return ok ? Status::Pass : Status::Fail; }

/// A text member of an object; throws if it is missing.
std::string member(const Figures& f, const Json& object, const std::string& place, const char* key) {
  if (!object.is_object() || !object.contains(key) || !object[key].is_string()) f.damaged(place + "/" + key, "a text");
  return object[key].get<std::string>();
}

/// "3.2"; "none" for null, which stands for non-finite values.
std::string number_text(const Json& value) {
  return value.is_number() ? fmt::format("{:.6g}", value.get<double>()) : value.is_null() ? "none" : value.dump();
}

std::vector<Gate> compare(const Figures& f) {
  std::vector<Gate> gates;
  std::size_t at = 0;
  for (const Json& limit : f.list("limits")) {
    const std::string place = fmt::format("limits/{}", at++);
    const std::string name = member(f, limit, place, "name");
    gates.push_back(
        {.name = name,
         .status = held(f.flag(place + "/ok")),
         .message = fmt::format("{} is {}, required is {} {}", name, number_text(f.at(place + "/got")),
                                name.starts_with("min_") ? "at least" : "at most", number_text(f.at(place + "/limit"))),
         .command = {}});
  }
  return gates;
}

Status status_of(const std::string& verdict) {
  if (verdict == "pass") return Status::Pass;
  return verdict == "mismatch" || verdict == "nothing compared" || verdict == "fault not seen" ? Status::Fail
                                                                                               : Status::Error;
}

std::string compared(const Figures& f, const std::string& place) {
  return fmt::format("{}: {} comparisons, {} mismatches", f.text(place + "verdict"), f.count(place + "comparisons"),
                     f.count(place + "mismatches"));
}

/// A gate per stream of a campaign (per seed for results without streams), or one for results without seeds; then one
/// for the cycles. The failure's details belong to the first gate that failed.
std::vector<Gate> verify(const Figures& f) {
  std::vector<Gate> gates;
  const std::string list = f.find("by_stream") != nullptr ? "by_stream" : "by_seed";
  if (const Json* rows = f.find(list)) {
    for (std::size_t at = 0; at < rows->size(); ++at) {
      const std::string place = fmt::format("{}/{}/", list, at);
      const std::string stimulus = list == "by_stream" ? " " + f.text(place + "class") : "";
      gates.push_back({.name = fmt::format("{} seed {}{}", f.text("config"), f.count(place + "seed"), stimulus),
                       .status = status_of(f.text(place + "verdict")),
                       .message = compared(f, place),
                       .command = {}});
    }
  }
  if (gates.empty()) {
    gates.push_back({.name = f.text("config") + " taps",
                     .status = status_of(f.text("verdict")),
                     .message = compared(f, ""),
                     .command = {}});
  }
  const auto failed =
      std::find_if(gates.begin(), gates.end(), [](const Gate& gate) { return gate.status != Status::Pass; });
  if (failed != gates.end() && f.find("failure") != nullptr) {
    for (const char* part : {"failure/first", "failure/smallest", "failure/operands"}) {
      if (const std::string text = f.text(part); !text.empty()) failed->message += "\n" + text;
    }
    failed->command = f.text("failure/replay");
  }
  const Json &rtl = f.at("cycles_rtl"), &model = f.at("cycles_model");
  if (!rtl.is_null() && !model.is_null()) {
    gates.push_back({.name = f.text("config") + " cycles",
                     .status = held(f.count("cycles_rtl") == f.count("cycles_model")),
                     .message = fmt::format("{} cycles of the RTL, {} of the model", rtl.dump(), model.dump()),
                     .command = {}});
  }
  if (f.find("planted_fault") != nullptr) {
    const std::string planted =
        fmt::format("planted fault {} ({}): ", f.text("planted_fault/name"), f.text("planted_fault/meaning"));
    for (Gate& gate : gates)
      if (gate.status != Status::Pass) gate.message = planted + gate.message;
  }
  return gates;
}

std::vector<Gate> cycles(const Figures& f) {
  std::uint64_t sum = 0;
  for (const auto& [name, unused] : f.at("cycles/account").items()) sum += f.count("cycles/account/" + name);
  const std::uint64_t actual = f.count("cycles/actual");
  return {{.name = "ideal + losses = actual",
           .status = held(sum == actual),
           .message = fmt::format("the account sums to {} of {} cycles", sum, actual),
           .command = {}}};
}

std::vector<Gate> errors(const Figures& f) {
  double share = 0.0, bias = 0.0;
  const std::size_t steps = f.list("steps").size();
  for (std::size_t at = 0; at < steps; ++at) {
    share += f.number(fmt::format("steps/{}/share", at));
    bias += f.number(fmt::format("steps/{}/increment/bias_lsb8", at));
  }
  const double total = f.number("total/bias_lsb8");
  // Without an error, the shares are undefined.
  const bool errs = f.number("total/rms_lsb8") > 0.0;
  return {{.name = "shares of the steps = 1",
           .status = held(!errs || std::abs(share - 1.0) <= kSumTolerance),
           .message = fmt::format("the shares of {} steps sum to {:.9g}", steps, share),
           .command = {}},
          {.name = "biases of the steps = bias",
           .status = held(std::abs(bias - total) <= kSumTolerance * (1.0 + std::abs(total))),
           .message = fmt::format("they sum to {:.9g} LSB of 8 bits; the picture's bias is {:.9g}", bias, total),
           .command = {}}};
}

std::vector<Gate> bound(const Figures& f) {
  std::vector<Gate> gates;
  const std::size_t levels = f.list("levels").size();
  for (std::size_t at = 0; at < levels; ++at) {
    const std::string place = fmt::format("levels/{}", at);
    const std::uint64_t over = f.count(place + "/over");
    gates.push_back({.name = "known: " + f.text(place + "/known"),
                     .status = held(over == 0),
                     .message = fmt::format("{} of {} values over the bound", over, f.count(place + "/values")),
                     .command = {}});
  }
  return gates;
}

std::vector<Gate> propose(const Figures& f) {
  return {{.name = f.text("target"),
           .status = held(f.flag("met")),
           .message = fmt::format("after {} configurations", f.count("judged")),
           .command = {}}};
}

/// "lanes 8, tile 128".
std::string axes_text(const Json& axes) {
  std::string text;
  for (const auto& [name, value] : axes.items())
    text += (text.empty() ? "" : ", ") + name + " " + (value.is_string() ? value.get<std::string>() : value.dump());
  return text;
}

std::vector<Gate> plan(const Figures& f) {
  std::vector<Gate> gates;
  const Json& rows = f.list("rows");
  for (std::size_t at = 0; at < rows.size(); ++at) {
    const std::string place = fmt::format("rows/{}", at);
    const std::string status = f.text(place + "/status");
    if (status != "pass" && status != "fail" && status != "error") f.damaged(place + "/status", "pass, fail or error");
    const Json& axes = f.at(place + "/axes");
    const Json* message = f.find(place + "/message");
    const std::string kind = f.text(place + "/kind");
    gates.push_back(
        {.name = axes.is_object() && !axes.empty() ? kind + ": " + axes_text(axes) : kind + " " + f.text(place + "/id"),
         .status = status == "pass"   ? Status::Pass
                   : status == "fail" ? Status::Fail
                                      : Status::Error,
         .message = message != nullptr && message->is_string() ? message->get<std::string>() : status,
         .command = f.text(place + "/command")});
  }
  return gates;
}

/// A gate per testpoint that was run, then gates for everything else that may be open.
std::vector<Gate> closure(const Figures& f) {
  std::vector<Gate> gates;
  const auto findings = [&](const std::string& name, const std::string& place, const std::string& held_text) {
    const std::size_t open = f.list(place).size();
    std::string text;
    for (std::size_t at = 0; at < open; ++at)
      text += (text.empty() ? "" : "\n") + f.text(fmt::format("{}/{}", place, at));
    gates.push_back({.name = name, .status = held(open == 0), .message = open ? text : held_text, .command = {}});
  };
  const std::size_t points = f.list("testpoints").size();
  for (std::size_t at = 0; at < points; ++at) {
    const std::string place = fmt::format("testpoints/{}/", at);
    const std::string status = f.text(place + "status");
    if (status == "not run") continue;
    gates.push_back({.name = f.text(place + "name"),
                     .status = held(status != "open"),
                     .message = fmt::format("{}: {} of {} bins hit, {} tests", status, f.count(place + "bins/hit"),
                                            f.count(place + "bins/all"), f.list(place + "tests").size()),
                     .command = {}});
  }
  findings("bins and tests", "open/testpoints", "none open");
  findings("lines and branches", "open/lines",
           fmt::format("{} of {} reached, {} excused", f.count("lines/reached"), f.count("lines/all"),
                       f.count("lines/excused")));
  findings("campaigns", "open/campaigns", "all passed");
  return gates;
}

}  // namespace

std::vector<Gate> gates_of(const Result& result) {
  static const std::map<std::string, GatesOf> all{
      {"closure", closure}, {"compare", compare},    {"verify", verify},          {"cycles", cycles},
      {"errors", errors},   {"errors bound", bound}, {"errors propose", propose}, {"plan", plan}};
  const Verdict verdict = verdict_of(result);
  const auto found = all.find(result.subcommand);
  std::vector<Gate> gates;
  if (found != all.end()) gates = found->second(Figures(result));
  // A failure that no gate shows needs one, and a result without gates gets one.
  const bool shown =
      std::any_of(gates.begin(), gates.end(), [](const Gate& gate) { return gate.status != Status::Pass; });
  const bool failed = verdict.status == Status::Fail || verdict.status == Status::Error;
  if (gates.empty() || (failed && !shown))
    gates.push_back({.name = "verdict",
                     .status = failed ? verdict.status : Status::Pass,
                     .message = verdict.sentence,
                     .command = {}});
  for (Gate& gate : gates) {
    if (gate.command.empty()) gate.command = command_of(result);
  }
  return gates;
}

}  // namespace fastsplat::report
