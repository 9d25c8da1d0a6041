// SPDX-License-Identifier: Apache-2.0
#include "tests/driver/scenes_helper.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/error.hpp"
#include "driver/tiles/render.hpp"
#include "scene/volume/volume_file.hpp"

namespace fastsplat::driver {

scene::SceneDescription view_of(const std::string& volume, int size, const std::string& transfer_function) {
  scene::SceneDescription description;
  description.volume = volume;
  description.transfer_function = transfer_function;
  description.width = description.height = size;
  return description;
}

std::shared_ptr<const volume::Volume> head_scan(std::string& why_not) {
  try {
    return std::make_shared<const volume::Volume>(volume::load_volume("ch2bet"));
  } catch (const UserError& error) {
    why_not = error.what();
    return nullptr;
  }
}

WordDifference difference(const cmodel::Frame& a, const cmodel::Frame& b) {
  WordDifference out;
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.words.size(), b.words.size());
  for (std::size_t i = 0; i < std::min(a.words.size(), b.words.size()); ++i) {
    const std::uint32_t apart = a.words[i] > b.words[i] ? a.words[i] - b.words[i] : b.words[i] - a.words[i];
    ++out.compared;
    out.different += apart != 0 ? 1 : 0;
    out.largest = std::max(out.largest, apart);
  }
  return out;
}

Lsb8 distance(const Image& a, const Image& b) {
  EXPECT_EQ(a.data.size(), b.data.size());
  Lsb8 out;
  double sum = 0.0;
  for (std::size_t i = 0; i < std::min(a.data.size(), b.data.size()); ++i) {
    const double apart = static_cast<double>(a.data[i]) - b.data[i];
    out.largest = std::max(out.largest, 255.0 * std::abs(apart));
    sum += apart * apart;
  }
  const double mean = sum / static_cast<double>(a.data.size());
  out.rms = 255.0 * std::sqrt(mean);
  out.psnr_db = -10.0 * std::log10(mean);
  return out;
}

void expect_tiles_never_show(const scene::SceneDescription& description, cmodel::Config config) {
  const auto scene = scene::build_scene(description);
  const auto whole = render(scene, config);
  config.tile_width = 2 * config.lanes;
  config.tile_height = 3 * config.lanes;
  const auto cut = render(scene, config);
  const WordDifference apart = difference(whole.frame, cut.frame);
  figure("words compared", static_cast<double>(apart.compared));
  EXPECT_GT(apart.compared, 0u);
  EXPECT_EQ(apart.different, 0u);
  EXPECT_GT(cut.counters.tiles, whole.counters.tiles);
}

void figure(const std::string& name, double value, const std::string& unit) {
  std::printf("[figure] %s = %.6g %s\n", name.c_str(), value, unit.c_str());
  ::testing::Test::RecordProperty(name, std::to_string(value));
}

}  // namespace fastsplat::driver
