// SPDX-License-Identifier: Apache-2.0
// RTL is chosen by the configuration's hash, not by its name.
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "driver/config/config_file.hpp"
#include "testbench/device/rtl_device.hpp"

namespace fastsplat::testbench {
namespace {

TEST(RtlChoice, ByHashWhateverTheName) {
  int made = 0;
  for (const std::string name : {"tiny", "small", "base"}) {
    auto config = driver::load_config(name);
    // A new name, and that of another configuration: the device's own hash register is compared when it is created.
    for (const char* called : {"mine", name == "tiny" ? "small" : "tiny"}) {
      config.name = called;
      cmodel::NullPixels pixels;
      EXPECT_NE(make_rtl_device(config, pixels), nullptr) << name << " called " << called;
      ++made;
    }
  }
  std::printf("[figure] devices made under another name = %d (limit > 0)\n", made);
  EXPECT_GT(made, 0);
}

}  // namespace
}  // namespace fastsplat::testbench
