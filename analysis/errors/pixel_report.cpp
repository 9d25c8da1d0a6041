// SPDX-License-Identifier: Apache-2.0
#include "analysis/errors/pixel_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "analysis/error_values.hpp"
#include "base/error.hpp"
#include "driver/tiles/frame_head.hpp"

namespace fastsplat::analysis {
namespace {

using Json = nlohmann::ordered_json;
using stages::PixelTrace;
using stages::SheetTrace;
using stages::SplatTrace;

constexpr const char* kChannels[] = {"R", "G", "B", "A"};
constexpr double kShown = 0.00005;  ///< LSB: smaller parts would read 0.0000
constexpr std::size_t kSplats = 6;  ///< of the worst sheet, unless more are asked for

golden::Sums minus(const golden::Sums& a, const golden::Sums& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3]};
}

/// A quantity of the pixel: its value on either side, absent where the side does not have it.
struct Quantity {
  std::string name;
  std::optional<int> frac_bits;  ///< of its word; some have none
  std::optional<double> real, device;

  std::optional<double> word() const {
    if (!device || !frac_bits) return std::nullopt;
    return std::ldexp(*device, *frac_bits);
  }
};
using Quantities = std::vector<Quantity>;

/// A splat's share in a sheet, on either side.
struct Splat {
  std::uint32_t index;  ///< in the chain
  Quantities quantities;
};
/// A sheet, on either side. With every sample composited, a sample.
struct Sheet {
  int number = 0;
  std::vector<Splat> splats;
  Quantities quantities;
  bool real = false, device = false;  ///< whether the side composites it
};

/// What the fourth sum is: Gaussians have no optical depth.
const char* fourth_of(const stages::Chain& chain) { return chain.gaussians() == nullptr ? "tau" : "alpha"; }

/// Pairs what both sides have.
class Pairs {
 public:
  Pairs(const PixelReport& report, const stages::Chain& chain)
      : report_(report), config_(chain.config()), description_(chain.scene().description), fourth_(fourth_of(chain)) {
    if (config_.index() == cmodel::IndexKind::Rlut && !chain.shaped()) distance_bits_ = config_.rlut_guard_bits;
    for (const std::size_t side : {0, 1}) take(side);
  }

  std::vector<Sheet> sheets() const {
    std::vector<Sheet> out;
    for (const auto& [key, sides] : sheets_) out.push_back(paired(sides));
    return out;
  }
  Quantities out() const {
    Quantities all;
    for (std::size_t c = 0; c < 4; ++c)
      all.push_back({kChannels[c], config_.pixel_frac_bits, report_.real.out[c], report_.device.out[c]});
    return all;
  }

 private:
  struct Key {
    int sheet;
    std::uint32_t sample;  ///< with every sample composited, its splat
    auto operator<=>(const Key&) const = default;
  };
  using Sides = std::array<const SheetTrace*, 2>;  ///< real, device

  const PixelTrace& trace(std::size_t side) const { return side == 0 ? report_.real : report_.device; }
  bool xray() const { return description_.method == scene::Method::XRay; }

  void take(std::size_t side) {
    const PixelTrace& trace = this->trace(side);
    const bool samples = driver::every_sample(description_);
    for (const SplatTrace& splat : trace.splats) splats_[splat.splat][side] = &splat;
    for (const SheetTrace& sheet : trace.sheets) {
      const std::uint32_t sample = samples ? trace.splats[sheet.shares.front().splat].splat : 0;
      sheets_[{sheet.sheet, sample}][side] = &sheet;
    }
  }
  template <class Of>
  static Quantity quantity(std::string name, int frac_bits, const Sides& sides, Of of) {
    const auto value = [&](const SheetTrace* side) {
      return side == nullptr ? std::nullopt : std::optional(of(*side));
    };
    return {std::move(name), frac_bits, value(sides[0]), value(sides[1])};
  }
  Sheet paired(const Sides& sides) const {
    Sheet out{.number = (sides[0] != nullptr ? sides[0] : sides[1])->sheet,
              .splats = {},
              .quantities = {},
              .real = sides[0] != nullptr,
              .device = sides[1] != nullptr};
    const int sf = config_.sheet_frac_bits, tf = config_.composite_frac_bits;
    for (const std::size_t c : {0, 1, 2, 3})
      out.quantities.push_back(quantity(std::string("sum ") + (c == 3 ? fourth_ : kChannels[c]), sf, sides,
                                        [c](const SheetTrace& s) { return s.sums[c]; }));
    if (!xray() && description_.slab_opacity == scene::SlabOpacity::Exponential)
      out.quantities.push_back(
          quantity("factor", config_.opacity_frac_bits, sides, [](const SheetTrace& s) { return s.factor; }));
    if (!xray()) {
      for (const std::size_t c : {0, 1, 2})
        out.quantities.push_back(quantity(std::string("slab ") + kChannels[c], tf, sides,
                                          [c](const SheetTrace& s) { return s.slab.colour[c]; }));
      out.quantities.push_back(quantity("slab A", tf, sides, [](const SheetTrace& s) { return s.slab.opacity; }));
    }
    for (const std::size_t c : {0, 1, 2, 3})
      out.quantities.push_back(quantity(c == 3 ? xray() ? "A" : "T" : kChannels[c], xray() ? sf : tf, sides,
                                        [c](const SheetTrace& s) { return s.after[c]; }));
    std::map<std::uint32_t, std::array<const stages::ShareTrace*, 2>> shares;
    std::vector<std::uint32_t> order;
    for (const std::size_t side : {0, 1}) {
      if (sides[side] == nullptr) continue;
      for (const stages::ShareTrace& share : sides[side]->shares) {
        const std::uint32_t splat = trace(side).splats[share.splat].splat;
        if (!shares.contains(splat)) order.push_back(splat);
        shares[splat][side] = &share;
      }
    }
    for (const std::uint32_t splat : order) out.splats.push_back({splat, of_splat(splat, shares[splat])});
    return out;
  }
  /// A side that has the splat at the pixel, but no share of it in the sheet, has the splat's own quantities.
  Quantities of_splat(std::uint32_t index, const std::array<const stages::ShareTrace*, 2>& shares) const {
    Quantities all;
    const auto add = [&](std::string name, std::optional<int> frac_bits, const auto& sides, auto of) {
      std::array<std::optional<double>, 2> values;
      for (const std::size_t side : {0, 1})
        if (sides[side] != nullptr) values[side] = of(*sides[side]);
      all.push_back({std::move(name), frac_bits, values[0], values[1]});
    };
    const auto& placed = splats_.at(index);
    using Value = std::optional<double>;
    add("x", config_.position_frac_bits, placed, [](const SplatTrace& s) { return Value(s.placed.x); });
    add("y", config_.position_frac_bits, placed, [](const SplatTrace& s) { return Value(s.placed.y); });
    add("radius", std::nullopt, placed, [](const SplatTrace& s) { return Value(s.placed.radius); });
    add("q", distance_bits_, placed, [](const SplatTrace& s) { return s.entries; });
    add("weight", config_.radial_frac_bits, placed, [](const SplatTrace& s) { return Value(s.weight); });
    for (const std::size_t c : {0, 1, 2, 3}) {
      const std::string name = c == 3 ? fourth_ : kChannels[c];
      add("share " + name, config_.colour_frac_bits, shares,
          [c](const stages::ShareTrace& s) { return Value(s.share[c]); });
      add("product " + name, config_.sheet_frac_bits, shares,
          [c](const stages::ShareTrace& s) { return Value(s.product[c]); });
    }
    return all;
  }

  const PixelReport& report_;
  const cmodel::Config& config_;
  const scene::SceneDescription& description_;
  const char* fourth_;
  std::optional<int> distance_bits_;  ///< fraction bits of q, which is a word only if it comes from the RLUT
  std::map<std::uint32_t, std::array<const SplatTrace*, 2>> splats_;  ///< by number in the chain
  std::map<Key, Sides> sheets_;
};

/// The quantities that belong to the splat itself, or to its share in a sheet.
Quantities part_of(const Quantities& all, bool share) {
  Quantities out;
  std::ranges::copy_if(all, std::back_inserter(out), [share](const Quantity& one) {
    return (one.name.starts_with("share ") || one.name.starts_with("product ")) == share;
  });
  return out;
}

Json json_of(const Quantities& quantities) {
  const auto value = [](const std::optional<double>& at) { return at ? Json(*at) : Json(nullptr); };
  Json json = Json::object();
  for (const Quantity& one : quantities)
    json[one.name] = {{"real", value(one.real)}, {"device", value(one.device)}, {"word", value(one.word())}};
  return json;
}

void add_formats(Json& json, const Quantities& quantities) {
  for (const Quantity& one : quantities)
    if (one.frac_bits) json[one.name] = *one.frac_bits;
}

/// "voxel", or "gaussian": which one in its file.
struct Origin {
  const char* kind;
  std::vector<std::int64_t> numbers;
};
Origin origin_of(const stages::Chain& chain, std::uint32_t splat) {
  if (chain.gaussians() != nullptr) return {"gaussian", {chain.gaussians()->number_of(splat)}};
  const glm::ivec3 voxel = stages::voxel_of(*chain.scene().volume, chain.list().splats[splat]);
  return {"voxel", {voxel.x, voxel.y, voxel.z}};
}

/// What the text calls a sheet: its number, or a Gaussian's in the file.
std::int64_t label_of(const Sheet& sheet, const stages::Chain& chain) {
  return chain.gaussians() == nullptr ? sheet.number : origin_of(chain, sheet.splats.front().index).numbers.front();
}
const char* kind_of(const stages::Chain& chain) { return chain.gaussians() == nullptr ? "sheet" : "Gaussian"; }

const Quantity& named(const Quantities& all, const std::string& name) {
  return *std::ranges::find(all, name, &Quantity::name);
}

std::string cell(const std::optional<double>& value) {
  if (!value) return "-";
  return *value == std::round(*value) ? fmt::format("{:.0f}", *value) : fmt::format("{:.6g}", *value);
}

/// Names of quantities, and three lines of values: real, device, word.
std::string names_of(const Quantities& quantities) {
  std::string text = fmt::format("  {:<22}", "");
  for (const Quantity& one : quantities) text += fmt::format(" {:>11}", one.name);
  return text + "\n";
}
std::string three_lines(const std::string& what, const Quantities& quantities) {
  std::string real = fmt::format("  {:<15} real  ", what), device = fmt::format("  {:<15} device", ""),
              word = fmt::format("  {:<15} word  ", "");
  for (const Quantity& one : quantities) {
    real += fmt::format(" {:>11}", cell(one.real));
    device += fmt::format(" {:>11}", cell(one.device));
    word += fmt::format(" {:>11}", cell(one.word()));
  }
  return real + "\n" + device + "\n" + word + "\n";
}

/// Without the two other colours.
Quantities of_channel(const Quantities& all, std::size_t channel) {
  Quantities out;
  std::ranges::copy_if(all, std::back_inserter(out), [&](const Quantity& one) {
    const std::string last = one.name.substr(one.name.rfind(' ') + 1);
    return (last != "R" && last != "G" && last != "B") || last == kChannels[channel];
  });
  return out;
}

/// Whether its last quantity is T, which falls as alpha rises.
bool named_t(const Sheet& sheet) { return sheet.quantities.back().name == "T"; }

/// What the sides have so far, and the device's word.
struct Light {
  std::optional<double> real, device, word;
};
Light light_of(const Sheet& sheet, std::size_t channel) {
  const Quantity& one = channel == 3 ? sheet.quantities.back() : named(sheet.quantities, kChannels[channel]);
  const auto alpha = [&](const std::optional<double>& at) {
    return at && channel == 3 && named_t(sheet) ? 1.0 - *at : at;
  };
  return {alpha(one.real), alpha(one.device), one.word()};
}

/// The channel's error behind each sheet: a side without the sheet keeps what it has.
std::vector<double> errors_behind(const std::vector<Sheet>& sheets, std::size_t channel) {
  std::vector<double> out;
  double real = 0.0, device = 0.0;
  for (const Sheet& sheet : sheets) {
    const Light light = light_of(sheet, channel);
    real = light.real.value_or(real);
    device = light.device.value_or(device);
    out.push_back(device - real);
  }
  return out;
}

/// Where the error grows most.
std::size_t worst_of(const std::vector<double>& errors) {
  std::size_t worst = 0;
  double most = -1.0;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const double growth = std::abs(errors[i] - (i == 0 ? 0.0 : errors[i - 1]));
    if (growth > most) most = growth, worst = i;
  }
  return worst;
}

/// The splats of a sheet, the brightest `most` first.
std::string splats_of(const Sheet& sheet, const stages::Chain& chain, std::size_t channel, std::size_t most) {
  std::string text = fmt::format("\n{} {}{}\n", kind_of(chain), label_of(sheet, chain),
                                 sheet.real && sheet.device ? ""
                                 : sheet.real               ? ", which only the real side composites"
                                                            : ", which only the device composites");
  const std::string product = std::string("product ") + (channel == 3 ? fourth_of(chain) : kChannels[channel]);
  std::vector<const Splat*> splats;
  for (const Splat& splat : sheet.splats) splats.push_back(&splat);
  std::ranges::stable_sort(splats, std::greater{}, [&](const Splat* splat) {
    const Quantity& one = named(splat->quantities, product);
    return std::max(one.real.value_or(0.0), one.device.value_or(0.0));
  });
  if (!splats.empty()) text += names_of(of_channel(splats.front()->quantities, channel));
  for (std::size_t i = 0; i < std::min(most, splats.size()); ++i) {
    text += three_lines(fmt::format("{}", fmt::join(origin_of(chain, splats[i]->index).numbers, ",")),
                        of_channel(splats[i]->quantities, channel));
  }
  if (splats.size() > most)
    text += fmt::format("  fainter ones: {} (--sheet {} shows them)\n", splats.size() - most, label_of(sheet, chain));
  const Quantities sums = of_channel(sheet.quantities, channel);
  return text + names_of(sums) + three_lines("together", sums);
}

}  // namespace

golden::Sums PixelReport::error() const { return minus(device.out, real.out); }

PixelReport explain(const stages::Chain& chain, int x, int y, int threads) {
  const stages::PixelChain pixel(chain, x, y, threads);
  PixelReport out{.x = x, .y = y, .real = pixel({}), .device = pixel(stages::Mixture::all_device()), .parts = {}};
  stages::Mixture so_far;
  golden::Sums before = out.real.out;
  for (const stages::StepSet& set : chain.sets()) {
    so_far = so_far.with(set.steps);
    const golden::Sums after = pixel(so_far).out;
    out.parts.push_back({set, minus(after, before)});
    before = after;
  }
  const golden::Sums error = out.error();
  for (std::size_t c = 1; c < 4; ++c)
    if (std::abs(error[c]) > std::abs(error[out.channel])) out.channel = c;
  return out;
}

std::string to_text(const PixelReport& report, const stages::Chain& chain, const Details& details, int bits) {
  const double unit = lsb_per_unit(bits);
  const std::string lsb = fmt::format("LSB{}", bits);
  const Pairs pairs(report, chain);
  const std::vector<Sheet> sheets = pairs.sheets();
  const std::size_t c = report.channel;
  std::set<std::uint32_t> splats;  // of either side, as in the tables
  for (const Sheet& sheet : sheets)
    for (const Splat& splat : sheet.splats) splats.insert(splat.index);
  std::string text =
      fmt::format("pixel {},{}: {}{}\n\n", report.x, report.y,
                  chain.gaussians() != nullptr ? fmt::format("{} Gaussians", sheets.size())
                                               : fmt::format("{} splats, {} sheets", splats.size(), sheets.size()),
                  report.device.terminated ? ", then terminated" : "");
  text += fmt::format("{:<8} {:>11} {:>11} {:>11} {:>13}\n", "channel", "real", "device", "word", "error, " + lsb);
  for (const Quantity& one : pairs.out())
    text += fmt::format("{:<8} {:>11} {:>11} {:>11} {:>+13.4f}\n", one.name, cell(one.real), cell(one.device),
                        cell(one.word()), (*one.device - *one.real) * unit);
  std::vector<const PixelPart*> parts;
  for (const PixelPart& part : report.parts)
    if (std::abs(part.error[c] * unit) >= kShown) parts.push_back(&part);
  std::ranges::stable_sort(parts, std::greater{}, [&](const PixelPart* part) { return std::abs(part->error[c]); });
  text +=
      parts.empty() ? "\nno step changes the pixel\n" : fmt::format("\nerror of {} by step, {}:", kChannels[c], lsb);
  for (const PixelPart* part : parts)
    text += fmt::format(" {} {:+.4f}{}", part->set.name, part->error[c] * unit, part == parts.back() ? "\n" : ",");
  if (sheets.empty()) return text;

  text += fmt::format("\n{:>8} {:>7} {:>11} {:>11} {:>11} {:>11} {:>11} {:>13}\n", kind_of(chain), "splats", "opacity",
                      "device's", fmt::format("{} so far", kChannels[c]), "device's",
                      c == 3 && named_t(sheets.front()) ? "word of T" : "word", "error, " + lsb);
  const auto asked_for = [&](const Sheet& sheet) { return details.sheet == label_of(sheet, chain); };
  if (details.sheet && !std::ranges::any_of(sheets, asked_for)) {
    throw_usage({.where = "--sheet",
                 .what = chain.gaussians() != nullptr ? "this Gaussian has no sample at the pixel"
                                                      : "no splat of the pixel is in this sheet",
                 .expected = chain.gaussians() != nullptr
                                 ? "a Gaussian that the text lists"
                                 : fmt::format("{} to {}", sheets.front().number, sheets.back().number),
                 .got = std::to_string(*details.sheet),
                 .fix = "leave it out to see all of them"});
  }
  const std::vector<double> errors = errors_behind(sheets, c);
  const std::size_t worst = worst_of(errors);
  std::string story;
  for (std::size_t i = 0; i < sheets.size(); ++i) {
    const Sheet& sheet = sheets[i];
    const auto slab = std::ranges::find(sheet.quantities, "slab A", &Quantity::name);
    const bool xray = slab == sheet.quantities.end();
    const Light light = light_of(sheet, c);
    text += fmt::format("{:>8} {:>7} {:>11} {:>11} {:>11} {:>11} {:>11} {:>+13.4f}\n", label_of(sheet, chain),
                        sheet.splats.size(), xray ? "-" : cell(slab->real), xray ? "-" : cell(slab->device),
                        cell(light.real), cell(light.device), cell(light.word), errors[i] * unit);
    const bool asked = details.all || asked_for(sheet);
    if (asked || (!details.sheet && i == worst))
      story += splats_of(sheet, chain, c, asked ? sheet.splats.size() : kSplats);
  }
  return text + story;
}

Json to_json(const PixelReport& report, const stages::Chain& chain) {
  const Pairs pairs(report, chain);
  Json json{{"schema", "fastsplat.pixel/1"},
            {"x", report.x},
            {"y", report.y},
            {"channel", kChannels[report.channel]},
            {"terminated", report.device.terminated},
            {"pixel", json_of(pairs.out())}};
  const auto lsb = [](const golden::Sums& error) {
    Json out = Json::array();
    for (const double value : error) out.push_back(value * lsb_per_unit(8));
    return out;
  };
  json["error_lsb8"] = lsb(report.error());
  json["steps"] = Json::array();
  for (const PixelPart& part : report.parts)
    json["steps"].push_back({{"name", part.set.name},
                             {"by", part.set.by},
                             {"keys", stages::facts(part.set.steps.back()).keys},
                             {"error_lsb8", lsb(part.error)}});
  Json formats = Json::object(), splats = Json::array(), sheets = Json::array();
  std::map<std::uint32_t, std::size_t> numbers;  // place in `splats` by index
  for (const Sheet& sheet : pairs.sheets()) {
    add_formats(formats, sheet.quantities);
    Json shares = Json::array();
    for (const Splat& splat : sheet.splats) {
      add_formats(formats, splat.quantities);
      const auto [found, fresh] = numbers.emplace(splat.index, splats.size());
      if (fresh) {
        const Origin origin = origin_of(chain, splat.index);
        Json one;
        one[origin.kind] = origin.numbers.size() == 1 ? Json(origin.numbers.front()) : Json(origin.numbers);
        one["values"] = json_of(part_of(splat.quantities, false));
        splats.push_back(one);
      }
      shares.push_back({{"splat", found->second}, {"values", json_of(part_of(splat.quantities, true))}});
    }
    sheets.push_back({{"sheet", sheet.number}, {"shares", shares}, {"together", json_of(sheet.quantities)}});
  }
  json["frac_bits"] = formats;
  json["splats"] = splats;
  json["sheets"] = sheets;
  return json;
}

}  // namespace fastsplat::analysis
