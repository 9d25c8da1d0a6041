#include "analysis/family/head.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "base/error.hpp"
#include "driver/render.hpp"
#include "golden/render.hpp"
#include "stages/chain.hpp"
#include "volume/volume_file.hpp"

namespace fastsplat::analysis {
namespace {

using cmodel::IndexKind;
using stages::Mixture;
using stages::Picture;
using stages::Step;

constexpr int kPicture = 128;  // pixels

bool has_table_of(IndexKind kind) { return kind != IndexKind::Blit2d && kind != IndexKind::Separable; }

/// Signed differences of two pictures' values.
std::vector<double> apart(const Picture& a, const Picture& b) {
  std::vector<double> out;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    for (std::size_t c = 0; c < 4; ++c) out.push_back(a.pixels[i][c] - b.pixels[i][c]);
  }
  return out;
}

double share(const std::vector<double>& part, const std::vector<double>& error) {
  double both = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < error.size(); ++i) {
    both += part[i] * error[i];
    squares += error[i] * error[i];
  }
  return squares > 0.0 ? both / squares : 0.0;
}

FieldError error_of(const std::vector<double>& error) {
  FieldError out;
  for (const double value : error) {
    out.largest = std::max(out.largest, 255.0 * std::abs(value));
    out.rms += value * value;
    out.bias += 255.0 * value / static_cast<double>(error.size());
  }
  out.rms = 255.0 * std::sqrt(out.rms / static_cast<double>(error.size()));
  return out;
}

/// Whole ones; never "-0".
std::string percents(double part) { return fmt::format("{:.0f} %", std::round(100.0 * part) + 0.0); }

/// What places and indices alone do to the picture. Both are the same for kinds that have one grid, and of kinds over
/// the squared distance the index is the same, too: the words of distances are left real.
class Parts {
 public:
  Parts(const scene::Scene& scene, int threads) : scene_(scene), threads_(threads) {}

  const std::vector<double>& place(const cmodel::Config& config) {
    const auto [at, is_new] = places_.try_emplace(config.grid());
    if (is_new) {
      const stages::Chain chain(scene_, config);
      if (real_.pixels.empty()) real_ = chain(Mixture{}, threads_);
      at->second.picture = chain(Mixture{Step::Position, Step::Snap}, threads_);
      at->second.change = apart(at->second.picture, real_);
    }
    return at->second.change;
  }
  const std::vector<double>& index(const cmodel::Config& config) {
    place(config);
    const auto [at, is_new] =
        indices_.try_emplace({config.grid(), config.radial_entries, config.index() == IndexKind::Linear});
    if (is_new) {
      const stages::Chain chain(scene_, config);
      at->second =
          apart(chain(Mixture{Step::Position, Step::Snap, Step::Index}, threads_), places_.at(config.grid()).picture);
    }
    return at->second;
  }

 private:
  struct Place {
    Picture picture;
    std::vector<double> change;
  };
  const scene::Scene& scene_;
  int threads_;
  Picture real_;
  std::map<int, Place> places_;
  std::map<std::tuple<int, int, bool>, std::vector<double>> indices_;
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
  const Image reference = golden::render(head.scene, {.threads = threads, .progress = {}});
  std::vector<HeadCell> cells;
  const int radius = std::max(1, static_cast<int>(std::ceil(head.radius)));
  for (const IndexKind kind : range.kinds) {
    for (const int grid : range.grids) {
      for (const int entries : has_table_of(kind) ? range.entries : std::vector{range.entries.back()}) {
        HeadCell cell;
        cell.config = family_config(kind, grid, radius, entries);
        cell.has_table = has_table_of(kind);
        cells.push_back(cell);
      }
    }
  }
  Parts parts(head.scene, threads);
  std::size_t done = 0;
  for (HeadCell& cell : cells) {
    const Image image =
        driver::to_image(driver::render(head.scene, cell.config, {.threads = threads, .progress = {}}).frame);
    std::vector<double> error;
    for (std::size_t i = 0; i < image.data.size(); ++i)
      error.push_back(static_cast<double>(image.data[i]) - static_cast<double>(reference.data[i]));
    cell.error = error_of(error);
    cell.place_share = share(parts.place(cell.config), error);
    if (cell.has_table) cell.index_share = share(parts.index(cell.config), error);
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
      "{} at {} x {} by the integer model (base, index of each kind) against golden: footprints of {:.2f} pixels "
      "radius, all values of the picture, 1/255.\n"
      "Beside the error the part of it that the splats' places have (position and snap), and that the index has "
      "after them: E[d e] / E[e^2] of [errors.md](errors.md),\n"
      "section 2; it can be negative. The rest is the other steps'. squared_elliptic has the "
      "words of squared. `fastsplat family --head` makes this section.\n\n",
      head.is_scan ? "The head scan (ch2bet, mri-head)" : "**The scan is not installed: shells:64 instead**", kPicture,
      kPicture, head.radius);
  text += "| kind | K | N | max | rms | bias | places | index |\n|---|---|---|---|---|---|---|---|\n";
  for (const HeadCell& cell : cells) text += head_row(cell);
  return text + "\n";
}

}  // namespace fastsplat::analysis
