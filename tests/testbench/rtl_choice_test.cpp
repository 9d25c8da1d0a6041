// RTL is chosen by the configuration's hash; what the configuration is called says nothing.
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "base/hash_text.hpp"
#include "driver/config_file.hpp"
#include "testbench/device/rtl_device.hpp"

namespace fastsplat::testbench {
namespace {

TEST(RtlChoice, ByHashWhateverTheName) {
  int made = 0;
  for (const auto& name : rtl_config_names()) {
    auto config = driver::load_config(name);
    // A name of its own, and that of another configuration: the device's own hash register is compared when it is made.
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

TEST(RtlChoice, OtherNumbersUnderAKnownNameAreRefusedInOneLine) {
  auto config = driver::load_config("tiny");
  config.radial_entries = 128;
  // The way out that a verb has beside it is the verb's to say: verify has none.
  cmodel::NullPixels pixels;
  EXPECT_THROW(make_rtl_device(config, pixels), UserError);
  try {
    require_rtl(config, "use --engine cmodel");
    FAIL() << "is there";
  } catch (const UserError& error) {
    EXPECT_EQ(error.code(), ExitCode::Usage);
    const std::string said = error.what();
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
    const auto tiny = hash_text(cmodel::config_hash(driver::load_config("tiny")));
    for (const std::string& word : {hash_text(cmodel::config_hash(config)), "tiny (" + tiny + ")",
                                    std::string("--engine cmodel"), std::string("FASTSPLAT_RTL_CONFIGS")})
      EXPECT_NE(said.find(word), std::string::npos) << "'" << word << "' is not in: " << said;
  }
}

}  // namespace
}  // namespace fastsplat::testbench
