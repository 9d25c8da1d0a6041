// SPDX-License-Identifier: Apache-2.0
// docs/floats.md, section 3: the table of integers against floats is measured anew, but for scenes from outside.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <sstream>

#include "analysis/errors/attribution.hpp"
#include "base/number_text.hpp"
#include "base/read_file.hpp"
#include "scene/gaussians/synthetic_gaussians.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/driver/scenes_helper.hpp"
#include "tests/paths.hpp"

namespace fastsplat::analysis {
namespace {

using stages::Chain, stages::float_format, stages::FloatNumbers, stages::Mixture;

/// The columns behind that of integers, in order.
const std::vector<FloatNumbers>& columns() {
  static const auto numbers = [](const char* operands, const char* sums, bool tile_centres) {
    return FloatNumbers{
        .operands = float_format(operands, ""), .sums = float_format(sums, ""), .tile_centres = tile_centres};
  };
  static const std::vector<FloatNumbers> kColumns{numbers("fp16", "fp16", false), numbers("fp16", "fp16", true),
                                                  numbers("fp16", "fp32", true), numbers("bf16", "fp32", true),
                                                  numbers("e5m2", "fp16", true)};
  return kColumns;
}

std::vector<double> measured(const Chain& chain) {
  const auto real = chain(Mixture{}, 0);
  const auto psnr = [&](const Mixture& mixture) {
    return -20.0 * std::log10(amount_of(difference(chain(mixture, 0), real)).rms);
  };
  std::vector<double> out{psnr(Mixture::all_device())};
  for (const FloatNumbers& numbers : columns()) out.push_back(psnr(Mixture::all_floats(numbers)));
  return out;
}

/// By the row's name.
std::map<std::string, std::vector<double>> rows_of_the_page() {
  std::istringstream lines(read_text_file(FASTSPLAT_SOURCE_DIR "/docs/floats.md"));
  std::map<std::string, std::vector<double>> rows;
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("| scene |")) inside = true;
    if (inside && line.empty()) break;
    std::istringstream cells(line);
    std::string cell, name;
    std::getline(cells, cell, '|');
    std::getline(cells, name, '|');
    std::vector<double> values;
    while (std::getline(cells, cell, '|')) {
      const auto from = cell.find_first_not_of(' '), to = cell.find_last_not_of(' ');
      if (from == std::string::npos) continue;
      if (const auto value = number_from(cell.substr(from, to - from + 1))) values.push_back(*value);
    }
    if (inside && !values.empty()) rows[name.substr(1, name.size() - 2)] = values;
  }
  return rows;
}

/// Every figure as the page rounds it.
void expect_row(const std::string& name, const Chain& chain) {
  static const auto page = rows_of_the_page();
  const auto row = page.find(name);
  ASSERT_NE(row, page.end()) << name;
  const auto values = measured(chain);
  ASSERT_EQ(row->second.size(), values.size()) << name;
  std::printf("[figure] %s:", name.c_str());
  for (const double value : values) std::printf(" %.1f", value);
  std::printf(" dB\n");
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_NEAR(values[i], row->second[i], 0.0501) << name << ", " << i;
}

TEST(FloatsPage, GaussiansAreAsMeasured) {
  cmodel::Config config = test::named_config("ellipse");
  config.composite_every_sample = 1;
  config.freeze_below = 7;
  for (const std::string name : {"shells:20000", "outdoor:100000:1"}) {
    scene::GaussianDescription description;
    description.camera.projection = scene::Projection::Perspective;
    description.width = description.height = 512;
    description.up = scene::UpAxis::Z;
    const auto scene = scene::build_gaussian_scene(
        description, std::make_shared<scene::GaussianCloud>(scene::make_synthetic_gaussians(name)));
    expect_row("Gaussians `" + name + "`", Chain(scene, config));
  }
}

TEST(FloatsPage, TheHeadIsAsMeasured) {
  std::string why_not;
  const auto head = driver::head_scan(why_not);
  if (!head) GTEST_SKIP() << "the scan is not installed: " << why_not;
  auto description = driver::view_of("ch2bet", 256, "mri-head");
  const auto expect = [&](const char* name, const cmodel::Config& config) {
    const auto scene = scene::build_scene(description, head);
    expect_row(std::string("head, ") + name, Chain(scene, config));
  };
  const cmodel::Config base = test::named_config("base");
  expect("sheets", base);
  description.method = scene::Method::XRay;
  expect("X-ray", base);
  description.method = scene::Method::Westover;
  cmodel::Config samples = base;
  samples.composite_every_sample = 1;
  expect("every sample", samples);
  description.method = scene::SceneDescription{}.method;
  description.classify = scene::ClassifyOrder::Post;
  cmodel::Config densities = test::named_config("fine");
  densities.classify_segment_bits = 9;
  expect("densities", densities);
}

}  // namespace
}  // namespace fastsplat::analysis
