// SPDX-License-Identifier: Apache-2.0
// Scenes and measures shared by the driver's tests.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "base/image.hpp"
#include "cmodel/numbers/config.hpp"
#include "cmodel/stream/frame.hpp"
#include "scene/scene.hpp"
#include "scene/volume/volume.hpp"

namespace fastsplat::driver {

/// A square orthographic view of a built-in volume with the papers' kernel.
scene::SceneDescription view_of(const std::string& volume, int size, const std::string& transfer_function = "default");

/// The head scan of Debian's mricron-data; null, with the reason, if it is not installed.
std::shared_ptr<const volume::Volume> head_scan(std::string& why_not);

struct WordDifference {
  std::uint64_t compared = 0;
  std::uint64_t different = 0;
  std::uint32_t largest = 0;  ///< in output words
};
WordDifference difference(const cmodel::Frame& a, const cmodel::Frame& b);

/// Largest |a-b| over all values, and the root mean square, in units of 1/255.
struct Lsb8 {
  double largest = 0.0;
  double rms = 0.0;
  double psnr_db = 0.0;  ///< peak 1
};
Lsb8 distance(const Image& a, const Image& b);

/// The device's words of the scene are equal in smaller tiles.
void expect_tiles_never_show(const scene::SceneDescription& description, cmodel::Config config);

/// Prints "[figure] name = value unit" and records it with the test.
void figure(const std::string& name, double value, const std::string& unit = "");

}  // namespace fastsplat::driver
