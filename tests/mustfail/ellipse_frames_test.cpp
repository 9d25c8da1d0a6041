// SPDX-License-Identifier: Apache-2.0
// Whole frames of ellipses, as the driver sends them, through the healthy device: tap for tap and cycle for cycle.
#include <gtest/gtest.h>

#include <cstdio>

#include "testbench/check/verify.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/mustfail/campaign_helper.hpp"
#include "tests/testbench/scene_beats_helper.hpp"

namespace fastsplat::test {
namespace {

struct Blur {
  const char* name;
  void (*apply)(scene::SceneDescription&);
};
void perspective(scene::SceneDescription& d) {
  d.camera.projection = scene::Projection::Perspective;
  d.footprint.shape = scene::FootprintShape::Ellipse;
}
const Blur kBlurs[] = {
    {"perspective", perspective},
    {"motion", [](scene::SceneDescription& d) { d.motion.orbit = 20.0; }},
    {"X-ray, lens",
     [](scene::SceneDescription& d) {
       perspective(d);
       d.method = scene::Method::XRay;
       d.lens.depth_of_field = scene::DepthOfField::Splats;
       d.lens.aperture = 3.0;
     }},
};

TEST(EllipseFrames, TheDeviceEqualsTheModel) {
  const cmodel::Config config = named_config("faults/mustfail");
  for (const Blur& blur : kBlurs) {
    scene::SceneDescription description;
    description.volume = "shells:10";
    description.width = description.height = 40;
    blur.apply(description);
    const auto beats = scene_beats(description, config);
    std::uint64_t ellipses = 0;
    for (const auto& beat : beats)
      ellipses += get(beat, cmodel::layout::kOpcode) == static_cast<std::int64_t>(cmodel::Opcode::Ellipse) ? 1 : 0;
    testbench::VerifyOptions options;
    options.config = config;
    options.scope = cmodel::StreamScope::Subset;
    options.ready = "random-50";
    options.input = "burst-16";
    options.device = [&](cmodel::PixelSink& pixels, const testbench::RtlOptions& rtl) {
      return faulty(Fault::None, Assertions::On)(config, pixels, rtl);
    };
    const auto result = testbench::verify(testbench::source_of(beats), options);
    std::printf("[figure] %s: %llu comparisons, %llu ellipses, %s\n", blur.name,
                static_cast<unsigned long long>(result.check.comparisons), static_cast<unsigned long long>(ellipses),
                to_string(result.verdict));
    // The weight of every lane of every window: M-ellipse-3, M-ellipse-4, M-ellipse-5.
    EXPECT_EQ(result.verdict, testbench::Verdict::Pass) << blur.name << ": " << result.error;
    EXPECT_GT(ellipses, 100u) << blur.name;
    EXPECT_GT(result.check.comparisons, 1000u) << blur.name;
  }
}

}  // namespace
}  // namespace fastsplat::test
