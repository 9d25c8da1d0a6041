// SPDX-License-Identifier: Apache-2.0
#include "analysis/errors/file_errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/error_values.hpp"
#include "analysis/errors/matched_gaussians.hpp"
#include "golden/gaussians.hpp"

namespace fastsplat::analysis {
namespace {

using scene::GaussianCloud;
using stages::Picture;
using Json = nlohmann::ordered_json;

/// In the order in which they join. The last is everything else: Gaussians without a match, and anti-aliasing.
enum Attribute { Position, Rotation, Scale, Opacity, Constant, Degree1, Degree2, Degree3, Rest, kAttributes };
constexpr std::array<const char*, kAttributes> kNames{
    "position", "rotation", "scale", "opacity", "colour", "harmonics 1", "harmonics 2", "harmonics 3", "lost, added"};
using Attributes = std::array<bool, kAttributes>;

/// The same with harmonics to a higher degree, which are 0.
GaussianCloud raised(const GaussianCloud& cloud, int degree) {
  GaussianCloud out = cloud;
  out.degree = degree;
  out.harmonics.clear();
  for (std::size_t i = 0; i < cloud.gaussians.size(); ++i) {
    const auto own = cloud.harmonics_of(i);
    out.harmonics.insert(out.harmonics.end(), own.begin(), own.end());
    out.harmonics.resize((i + 1) * static_cast<std::size_t>(scene::harmonic_count(degree)));
  }
  return out;
}

/// `original` with some attributes of `encoded`; both have the same degree.
GaussianCloud mixed(const GaussianCloud& original, const GaussianCloud& encoded,
                    const std::vector<std::optional<std::uint32_t>>& matches, const Attributes& taken) {
  if (std::ranges::find(taken, false) == taken.end()) return encoded;
  const bool rest = taken[Rest];
  GaussianCloud out = original;
  out.antialiased = (rest ? encoded : original).antialiased, out.linear = (rest ? encoded : original).linear;
  out.gaussians.clear(), out.harmonics.clear();
  std::vector<char> used(encoded.gaussians.size(), 0);
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (!matches[i] && rest) continue;
    scene::Gaussian one = original.gaussians[i];
    const auto before = original.harmonics_of(i);
    std::vector<glm::vec3> harmonics(before.begin(), before.end());
    if (matches[i]) {
      used[*matches[i]] = 1;
      const scene::Gaussian& other = encoded.gaussians[*matches[i]];
      if (taken[Position]) one.position = other.position;
      if (taken[Rotation]) one.rotation = other.rotation;
      if (taken[Scale]) one.scale = other.scale;
      if (taken[Opacity]) one.opacity = other.opacity;
      const auto after = encoded.harmonics_of(*matches[i]);
      for (int degree = 0; degree <= original.degree; ++degree) {
        if (!taken[static_cast<std::size_t>(Constant + degree)]) continue;
        for (auto k = static_cast<std::size_t>(degree == 0 ? 0 : scene::harmonic_count(degree - 1));
             k < static_cast<std::size_t>(scene::harmonic_count(degree)); ++k)
          harmonics[k] = after[k];
      }
    }
    out.gaussians.push_back(one);
    out.harmonics.insert(out.harmonics.end(), harmonics.begin(), harmonics.end());
  }
  for (std::size_t e = 0; rest && e < used.size(); ++e) {
    if (used[e] != 0) continue;
    out.gaussians.push_back(encoded.gaussians[e]);
    const auto own = encoded.harmonics_of(e);
    out.harmonics.insert(out.harmonics.end(), own.begin(), own.end());
  }
  return out;
}

scene::GaussianScene with_cloud(const scene::GaussianScene& scene, GaussianCloud cloud) {
  scene::GaussianScene out = scene;
  out.cloud = std::make_shared<const GaussianCloud>(std::move(cloud));
  scene::GaussianDescription description = scene.description;
  description.order = scene.order;  // whatever order the other file declares
  return scene::seen_by(description, out);
}

Picture golden_picture(const scene::GaussianScene& scene, int threads) {
  const Image image =
      golden::render_gaussians(scene, scene::project_all(scene, nullptr, threads), {.threads = threads});
  Picture out{image.width, image.height, std::vector<golden::Sums>(image.data.size() / 4)};
  for (std::size_t i = 0; i < image.data.size(); ++i) out.pixels[i / 4][i % 4] = static_cast<double>(image.data[i]);
  return out;
}

double decibels(const Amount& amount) { return -20.0 * std::log10(amount.rms); }
std::string decibels_text(const Amount& amount) {
  return amount.rms > 0.0 ? fmt::format("{:.1f}", decibels(amount)) : "equal";
}

}  // namespace

FileErrors file_errors(const scene::GaussianScene& original, const GaussianCloud& other, const cmodel::Config& config,
                       int threads, const Progress& progress) {
  const int degree = std::max(original.cloud->degree, other.degree);
  const GaussianCloud cloud = raised(*original.cloud, degree), encoded = raised(other, degree);
  const auto matches = matched_gaussians(cloud, encoded);
  FileErrors out{
      .original = cloud.gaussians.size(),
      .encoded = encoded.gaussians.size(),
      .matched = static_cast<std::size_t>(std::ranges::count_if(matches, [](const auto& m) { return m.has_value(); })),
      .parts = {},
      .file = {},
      .device = {},
      .total = {},
      .report = {}};
  std::vector<Attribute> present;
  for (int a = 0; a < kAttributes; ++a) {
    const bool missing = a > Constant && a < Rest && a - Constant > degree;
    if (!missing) present.push_back(static_cast<Attribute>(a));
  }
  std::size_t done = 0;
  const std::size_t frames = 2 * present.size() + 1;
  const auto draw = [&](const Attributes& taken) {
    const Picture picture = golden_picture(with_cloud(original, mixed(cloud, encoded, matches, taken)), threads);
    if (progress) progress(++done, 2 * frames);
    return picture;
  };
  const Picture first = draw({});
  Attributes so_far{};
  so_far.fill(true);
  for (const Attribute a : present) so_far[a] = false;
  Picture before = first;
  std::vector<Picture> increments;
  for (const Attribute a : present) {
    FileError part{.name = kNames[a], .of_device = false, .share = 0.0, .increment = {}, .only = {}};
    Attributes alone{};
    alone[a] = true;
    part.only = amount_of(difference(draw(alone), first));
    so_far[a] = true;
    Picture after = draw(so_far);
    increments.push_back(difference(after, before));
    before = std::move(after);
    out.parts.push_back(std::move(part));
  }
  out.file = amount_of(difference(before, first));

  const scene::GaussianScene other_scene = with_cloud(original, encoded);
  const stages::Chain chain(other_scene, config, threads);
  out.report = driver::GaussianFrame(other_scene, chain.gaussians()->gaussians(), config, threads).report();
  Progress second_half;
  if (progress) second_half = [&](std::size_t at, std::size_t total) { progress(total + at, 2 * total); };
  const Attribution device = attribute(chain, {.quick = true, .threads = threads, .progress = second_half});
  out.device = device.total;
  for (std::size_t k = 0; k < device.steps.size(); ++k) {
    out.parts.push_back(
        {.name = device.steps[k].set.name, .of_device = true, .share = 0.0, .increment = {}, .only = {}});
    increments.push_back(device.increments[k]);
  }
  // Golden's picture has floats, the chain's begins in doubles: what lies between belongs to neither.
  const Picture error = difference(device.device, first);
  out.total = amount_of(error);
  for (std::size_t k = 0; k < out.parts.size(); ++k) {
    out.parts[k].increment = amount_of(increments[k]);
    out.parts[k].share = share_of(increments[k], error);
  }
  return out;
}

std::string to_text(const FileErrors& errors, int lsb_bits) {
  const double lsb = lsb_per_unit(lsb_bits);
  std::string text =
      fmt::format("{} Gaussians became {}; {} matched\n\n", errors.original, errors.encoded, errors.matched);
  text += fmt::format("{:<14} {:>8} {:>12} {:>12} {:>9}\n", "", "share", fmt::format("rms LSB{}", lsb_bits),
                      fmt::format("max LSB{}", lsb_bits), "alone dB");
  double file = 0.0, device = 0.0;
  const auto line = [&](const std::string& name, double share, const Amount& amount, const std::string& alone) {
    return fmt::format("{:<14} {:>6.1f} % {:>12.4f} {:>12.3f} {:>9}\n", name,
                       std::abs(share) < 5e-4 ? 0.0 : 100.0 * share, amount.rms * lsb, amount.greatest * lsb, alone);
  };
  for (const FileError& part : errors.parts) {
    (part.of_device ? device : file) += part.share;
    if (!part.of_device) text += line(part.name, part.share, part.increment, decibels_text(part.only));
  }
  text += line("= file", file, errors.file, decibels_text(errors.file));
  for (const FileError& part : errors.parts)
    if (part.of_device) text += line(part.name, part.share, part.increment, "");
  text += line("= device", device, errors.device, decibels_text(errors.device));
  return text + line("both", file + device, errors.total, decibels_text(errors.total));
}

Json to_json(const FileErrors& errors) {
  const auto amount = [](const Amount& of) {
    return Json{{"rms_lsb8", of.rms * lsb_per_unit(8)},
                {"max_lsb8", of.greatest * lsb_per_unit(8)},
                {"psnr_db", of.rms > 0.0 ? Json(decibels(of)) : Json()}};
  };
  Json json{{"original", errors.original},
            {"encoded", errors.encoded},
            {"matched", errors.matched},
            {"parts", Json::array()}};
  for (const FileError& part : errors.parts) {
    Json one{{"name", part.name}, {"by", part.of_device ? "device" : "file"}, {"share", part.share}};
    one.update(amount(part.increment));
    if (!part.of_device) one["alone"] = amount(part.only);
    json["parts"].push_back(std::move(one));
  }
  json["file"] = amount(errors.file), json["device"] = amount(errors.device), json["total"] = amount(errors.total);
  return json;
}

}  // namespace fastsplat::analysis
