// SPDX-License-Identifier: Apache-2.0
// Oblique grids are drawn in their place in the body. An object scanned by a pitched or sheared grid looks as if
// scanned by a straight one, in every method of both engines. Shading uses the same surface.
#include <cmath>
#include <numbers>

#include "driver/config/config_file.hpp"
#include "driver/tiles/render.hpp"
#include "golden/render.hpp"
#include "scene/volume/volume_file.hpp"
#include "tests/driver/scenes_helper.hpp"
#include "tests/volume/volume_testing.hpp"

namespace fastsplat::driver {
namespace {

constexpr int kSide = 40;
const double kPitch = 18.0 * std::numbers::pi / 180.0;

/// A body with a nose and one ear, smooth enough for any grid; mm.
double body(const glm::dvec3& p) {
  struct Blob {
    glm::dvec3 centre, size;
    double value;
  };
  static const Blob blobs[] = {{{0, 0, 0}, {6, 8, 6}, 1.0}, {{0, 9, 1}, {3, 3, 3}, 0.7}, {{7, -1, 3}, {3, 3, 4}, 0.6}};
  double sum = 0.0;
  for (const Blob& blob : blobs) {
    const glm::dvec3 r = (p - blob.centre) / blob.size;
    sum += blob.value * std::exp(-glm::dot(r, r));
  }
  return sum;
}

class Oblique : public volume::TemporaryFolder {
 protected:
  /// The body sampled by a grid with these axes, from a file as a scanner writes it; its header's axes may be ignored.
  std::shared_ptr<const volume::Volume> scanned(const glm::dmat3& axes, const std::string& ending,
                                                bool heard = true) const {
    volume::Volume grid = volume::make_volume(glm::ivec3(kSide), {1.0, 1.0, 1.0}, volume::VoxelType::F32,
                                              [](int, int, int) { return 0.0; });
    grid.placed = true;
    if (axes != glm::dmat3(1.0)) grid.turn(axes);
    for (int k = 0; k < kSide; ++k) {
      for (int j = 0; j < kSide; ++j) {
        for (int i = 0; i < kSide; ++i)
          grid.voxels[grid.index(i, j, k)] = static_cast<float>(body(grid.position(i, j, k)));
      }
    }
    const auto path = folder_ / ("scan" + ending);
    volume::save_volume(grid, path, volume::VoxelType::F32);
    auto read = std::make_shared<volume::Volume>(volume::load_volume(path.string()));
    EXPECT_EQ(read->oblique, axes != glm::dmat3(1.0));
    if (!heard) read->oblique = false;
    return read;
  }
  static scene::SceneDescription view(scene::Method method) {
    scene::SceneDescription d = view_of("none", 96);
    d.transfer_function = "default";
    d.method = method;
    d.shading = method == scene::Method::XRay ? 0 : 1;
    d.camera.azimuth = 60.0;
    d.camera.elevation = 10.0;
    return d;
  }
  static scene::Scene scene_of(scene::Method method, const std::shared_ptr<const volume::Volume>& volume,
                               const volume::Volume& reference) {
    scene::SceneDescription d = view(method);
    d.camera.zoom = volume->bounding_radius() / reference.bounding_radius();  // the same scale, of a sheared box, too
    if (method == scene::Method::XRay) d.xray_exposure = 0.05;
    return scene::build_scene(d, volume);
  }
};

const std::pair<const char*, scene::Method> kMethods[] = {{"image_aligned", scene::Method::ImageAligned},
                                                          {"axis_aligned", scene::Method::AxisAligned},
                                                          {"westover", scene::Method::Westover},
                                                          {"raycast", scene::Method::RayCast},
                                                          {"xray", scene::Method::XRay}};

glm::dmat3 pitched() {
  return {{1, 0, 0}, {0, std::cos(kPitch), std::sin(kPitch)}, {0, -std::sin(kPitch), std::cos(kPitch)}};
}

// N-8-4.
TEST_F(Oblique, APitchedScanStandsUprightInEveryMethodAndEngine) {
  const auto straight = scanned(glm::dmat3(1.0), ".nii");
  const auto config = load_config("base");
  for (const char* ending : {".nii", ".nrrd", ".mha"}) {
    const auto turned = scanned(pitched(), ending), unheard = scanned(pitched(), ending, false);
    for (const auto& [name, method] : kMethods) {
      if (std::string(ending) != ".nii" && method != scene::Method::ImageAligned) continue;
      SCOPED_TRACE(std::string(name) + ending);
      const auto picture = [&, its_method = method](const std::shared_ptr<const volume::Volume>& volume) {
        return golden::render(scene_of(its_method, volume, *straight));
      };
      const Image truth = picture(straight);
      const double upright = distance(picture(turned), truth).psnr_db;
      const double lying = distance(picture(unheard), truth).psnr_db;
      figure(std::string("pitched_18_degrees_golden_") + name + ending, upright,
             "dB (axes unheard: " + std::to_string(lying) + ")");
      EXPECT_GT(upright, 54.0);
      EXPECT_GT(upright, lying + 15.0);
      if (method == scene::Method::Westover || method == scene::Method::RayCast) continue;
      const auto words = [&, its_method = method](const std::shared_ptr<const volume::Volume>& volume) {
        return to_image(render(scene_of(its_method, volume, *straight), config).frame);
      };
      const double device = distance(words(turned), words(straight)).psnr_db;
      const double engines = distance(words(turned), picture(turned)).psnr_db;
      figure(std::string("pitched_18_degrees_cmodel_") + name + ending, device,
             "dB; against golden " + std::to_string(engines));
      EXPECT_GT(device, 54.0);
      EXPECT_GT(engines, 60.0);
    }
  }
}

// N-8-4, N-8-7: the smaller cell.
TEST_F(Oblique, AShearedScanIsDrawnInPlaceWithAWarning) {
  const glm::dmat3 tilted{{1, 0, 0}, {0, 1, 0}, {0, std::sin(kPitch), std::cos(kPitch)}};  // a CT's tilted gantry
  const auto straight = scanned(glm::dmat3(1.0), ".nii");
  const auto sheared = scanned(tilted, ".nii"), unheard = scanned(tilted, ".nii", false);
  ASSERT_EQ(sheared->remarks.size(), 1u);
  EXPECT_THAT(sheared->remarks[0], ::testing::HasSubstr("two axes are 18.0 degrees off a right angle"));
  const Image truth = golden::render(scene_of(scene::Method::ImageAligned, straight, *straight));
  const double heard =
      distance(golden::render(scene_of(scene::Method::ImageAligned, sheared, *straight)), truth).psnr_db;
  const double deaf =
      distance(golden::render(scene_of(scene::Method::ImageAligned, unheard, *straight)), truth).psnr_db;
  figure("sheared_18_degrees_golden", heard, "dB (axes unheard: " + std::to_string(deaf) + ")");
  EXPECT_GT(heard, 50.0);
  EXPECT_GT(heard, deaf + 15.0);
}

// N-8-20.
TEST_F(Oblique, GradientsAreTheBodys) {
  for (const glm::dmat3& axes : {pitched(), glm::dmat3{{1, 0, 0}, {0, 1, 0}, {0, 0.3, 0.954}}}) {
    const auto grid = scanned(axes, ".nrrd");
    double worst = 0.0, largest = 0.0;
    for (int n = 12; n < 28; ++n) {
      const glm::dvec3 at = grid->position(n, 15, 40 - n);
      glm::dvec3 exact;
      for (int c = 0; c < 3; ++c) {
        glm::dvec3 step(0.0);
        step[c] = 1e-3;
        exact[c] = (body(at + step) - body(at - step)) / 2e-3;
      }
      worst = std::max(worst, glm::length(exact - glm::dvec3(volume::gradient(*grid, n, 15, 40 - n))));
      largest = std::max(largest, glm::length(exact));
    }
    figure("oblique_gradient_error", worst / largest, "of the largest (limit 0.06)");
    EXPECT_LT(worst, 0.06 * largest);
  }
}

}  // namespace
}  // namespace fastsplat::driver
