// SPDX-License-Identifier: Apache-2.0
#include "analysis/index_kinds/head.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "analysis/error_values.hpp"
#include "analysis/errors/attribution.hpp"
#include "analysis/pipeline/chain.hpp"
#include "base/error.hpp"
#include "driver/tiles/render.hpp"
#include "golden/render.hpp"
#include "scene/volume/volume_file.hpp"

namespace fastsplat::analysis {
namespace {

using cmodel::IndexKind;
using stages::Mixture;
using stages::Picture;
using stages::Step;

constexpr int kPicture = 128;  // pixels

/// A device's or golden's floats as a picture.
Picture picture_of(const Image& image) {
  Picture out{image.width, image.height, std::vector<golden::Sums>(image.data.size() / 4)};
  for (std::size_t i = 0; i < image.data.size(); ++i) out.pixels[i / 4][i % 4] = image.data[i];
  return out;
}

/// Whole percents; never "-0".
std::string percents(double part) { return fmt::format("{:.0f} %", std::round(100.0 * part) + 0.0); }

/// Changes of the picture by positions and index alone. Kinds with one grid share both; the index only among kinds over
/// the squared distance, as the words of distances stay real.
class Parts {
 public:
  Parts(const scene::Scene& scene, int threads) : scene_(scene), threads_(threads) {}

  const Picture& place(const cmodel::Config& config) {
    const auto [at, is_new] = places_.try_emplace(config.grid());
    if (is_new) {
      const stages::Chain chain(scene_, config);
      if (real_.pixels.empty()) real_ = chain(Mixture{}, threads_);
      at->second.picture = chain(Mixture{Step::Position, Step::Snap}, threads_);
      at->second.change = difference(at->second.picture, real_);
    }
    return at->second.change;
  }
  const Picture& index(const cmodel::Config& config) {
    place(config);
    const auto [at, is_new] =
        indices_.try_emplace({config.grid(), config.radial_entries, config.index() == IndexKind::Linear});
    if (is_new) {
      const stages::Chain chain(scene_, config);
      at->second = difference(chain(Mixture{Step::Position, Step::Snap, Step::Index}, threads_),
                              places_.at(config.grid()).picture);
    }
    return at->second;
  }

 private:
  struct Place {
    Picture picture, change;
  };
  const scene::Scene& scene_;
  int threads_;
  Picture real_;
  std::map<int, Place> places_;
  std::map<std::tuple<int, int, bool>, Picture> indices_;
};

}  // namespace

HeadScene head_scene() {
  scene::SceneDescription description;
  description.width = description.height = kPicture;
  description.volume = "ch2bet";
  description.transfer_function = "mri-head";
  const auto with_radius = [](scene::Scene scene, bool is_scan) {
    const double radius = scene.kernel.radius() * scene.volume->kernel_unit() * scene.camera.scale_at(0.0);
    return HeadScene{.scene = std::move(scene), .is_scan = is_scan, .radius = radius};
  };
  try {
    return with_radius(scene::build_scene(description), true);
  } catch (const UserError&) {  // the scan is a package that need not be installed
    description.volume = "shells:64";
    description.transfer_function.clear();
    return with_radius(scene::build_scene(description), false);
  }
}

HeadRange whole_head() {
  return {.kinds = {IndexKind::Linear, IndexKind::Squared, IndexKind::Blit2d, IndexKind::Rlut, IndexKind::Separable},
          .grids = {4, 8, 16, 32, 64},
          .entries = {256, 1024}};
}

std::vector<HeadCell> head_table(const HeadScene& head, const HeadRange& range, int threads, const Progress& progress) {
  const Picture reference = picture_of(golden::render(head.scene, {.threads = threads, .progress = {}}));
  std::vector<HeadCell> cells;
  const int radius = std::max(1, static_cast<int>(std::ceil(head.radius)));
  for (const IndexKind kind : range.kinds) {
    for (const int grid : range.grids) {
      for (const int entries : has_radial_table(kind) ? range.entries : std::vector{range.entries.back()}) {
        HeadCell cell;
        cell.config = family_config(kind, grid, radius, entries);
        cell.has_table = has_radial_table(kind);
        cells.push_back(cell);
      }
    }
  }
  Parts parts(head.scene, threads);
  std::size_t done = 0;
  for (HeadCell& cell : cells) {
    const auto drawn = driver::render(head.scene, cell.config, {.threads = threads, .counters = false});
    const Picture error = difference(picture_of(driver::to_image(drawn.frame)), reference);
    const Amount amount = amount_of(error);
    const double unit = lsb_per_unit(8);
    cell.error = {.largest = unit * amount.greatest, .rms = unit * amount.rms, .bias = unit * amount.bias};
    cell.place_share = share_of(parts.place(cell.config), error);
    if (cell.has_table) cell.index_share = share_of(parts.index(cell.config), error);
    if (progress) progress(++done, cells.size());
  }
  return cells;
}

std::string head_row(const HeadCell& cell) {
  return fmt::format("| {} | {} | {} | {:.2f} | {:.3f} | {:+.3f} | {} | {} |\n", name_of(cell.config.index()),
                     cell.config.grid(), cell.has_table ? std::to_string(cell.config.radial_entries) : "-",
                     cell.error.largest, cell.error.rms, cell.error.bias, percents(cell.place_share),
                     cell.has_table ? percents(cell.index_share) : "-");
}

std::string head_section(const HeadScene& head, const std::vector<HeadCell>& cells) {
  std::string text = fmt::format(
      "## The head\n\n"
      "{} at {} x {} by the integer model (base, index of each kind) against\n"
      "golden: footprints of {:.2f} pixels radius, all values of the picture, 1/255.\n"
      "`fastsplat family --head` makes this section.\n\n"
      "The last columns are the shares of the splats' places (position and snap) and of the index after\n"
      "them, E[d e] / E[e^2] of [errors.md](errors.md), section 2; they can be negative. The rest is the\n"
      "other steps'. squared_elliptic has the words of squared.\n\n",
      head.is_scan ? "The head scan (ch2bet, mri-head)" : "**The scan is not installed: shells:64 instead**", kPicture,
      kPicture, head.radius);
  text += "| kind | K | N | max | rms | bias | places | index |\n|---|---|---|---|---|---|---|---|\n";
  for (const HeadCell& cell : cells) text += head_row(cell);
  return text + "\n";
}

}  // namespace fastsplat::analysis
