// SPDX-License-Identifier: Apache-2.0
// Cameras anywhere: pixels against the formula of a pinhole, files of trainers, and what is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "scene/gaussians/projected_gaussian.hpp"
#include "scene/gaussians/synthetic_gaussians.hpp"
#include "tests/scene/gaussian_helper.hpp"

namespace fastsplat::scene {
namespace {

using Json = nlohmann::json;

std::shared_ptr<const GaussianCloud> cloud(const char* name = "cloud:300") {
  return std::make_shared<GaussianCloud>(make_synthetic_gaussians(name));
}

/// A camera with everything that a pinhole has: an oblique view, two focal lengths, a principal point off the middle.
struct Oblique {
  glm::dvec3 eye{0.3, -0.9, -2.1}, right, down, forward;
  double fx = 410.0, fy = 395.0, cx = 330.0, cy = 40.5;  ///< of the convention in which the first centre is 0.5
  int width = 400, height = 220;

  Oblique() {
    forward = glm::normalize(glm::dvec3(-0.2, 0.35, 1.0));
    right = glm::normalize(glm::cross(glm::dvec3(0.1, 1.0, 0.0), forward));
    down = glm::cross(forward, right);
  }
  /// By the definition of a pinhole camera.
  glm::dvec2 pixel(const glm::dvec3& point) const {
    const glm::dvec3 from = point - eye;
    const double z = glm::dot(from, forward);
    return {fx * glm::dot(from, right) / z + cx - 0.5, fy * glm::dot(from, down) / z + cy - 0.5};
  }
  Json row(int axis) const { return {right[axis], down[axis], forward[axis]}; }
  Json of_trainer() const {
    return {{"id", 0},
            {"img_name", "IMG_7"},
            {"width", width},
            {"height", height},
            {"fx", fx},
            {"fy", fy},
            {"position", {eye.x, eye.y, eye.z}},
            {"rotation", {row(0), row(1), row(2)}}};
  }
  Json of_transforms() const {
    Json rows = Json::array();
    for (int axis = 0; axis < 3; ++axis) rows.push_back({right[axis], -down[axis], -forward[axis], eye[axis]});
    rows.push_back({0, 0, 0, 1});
    return {{"file_path", "images/IMG_7.png"}, {"transform_matrix", rows}};
  }
  Json transforms() const {
    return {
        {"w", width}, {"h", height}, {"fl_x", fx}, {"fl_y", fy}, {"cx", cx}, {"cy", cy}, {"frames", {of_transforms()}}};
  }
};

GaussianDescription seen_by(const PlacedCamera& camera, UpAxis up = UpAxis::MinusY) {
  GaussianDescription description;
  description.placed = camera;
  description.up = up;
  if (camera.intrinsics) description.width = camera.intrinsics->width, description.height = camera.intrinsics->height;
  return description;
}

/// Largest distance in pixels between the centres and those of the formula, over the Gaussians before the eye.
double worst_distance(const GaussianScene& scene, const Oblique& camera, double middle_x, double middle_y) {
  double worst = 0.0;
  std::size_t seen = 0;
  for (std::uint32_t i = 0; i < scene.cloud->gaussians.size(); ++i) {
    ProjectedGaussian splat;
    if (!project(scene, i, splat)) continue;
    glm::dvec2 at = camera.pixel(glm::dvec3(scene.cloud->gaussians[i].position));
    at += glm::dvec2(middle_x - (camera.cx - 0.5), middle_y - (camera.cy - 0.5));
    worst = std::max(worst, glm::distance(at, {splat.x, splat.y}));
    ++seen;
  }
  EXPECT_GT(seen, 200U);
  return worst;
}

std::string refusal_of_cameras(const Json& json, const std::optional<glm::ivec2>& size = {}) {
  const TestFile file(".json", json.dump());
  try {
    load_cameras(file.path(), size);
  } catch (const UserError& error) {
    EXPECT_EQ(error.code(), ExitCode::Input);
    return error.what();
  }
  ADD_FAILURE() << "read: " << json.dump().substr(0, 200);
  return {};
}

TEST(PlacedCamera, OfEveryFileIsThePinholesFormula) {
  const Oblique camera;
  const TestFile trainers(".json", Json::array({camera.of_trainer()}).dump());
  const TestFile transforms(".json", camera.transforms().dump());
  for (const UpAxis up : {UpAxis::X, UpAxis::MinusY, UpAxis::Z, UpAxis::MinusZ}) {
    const auto one = load_cameras(trainers.path(), {}).cameras.at(0);
    EXPECT_EQ(one.name, "IMG_7");
    const GaussianScene middle = build_gaussian_scene(seen_by(one, up), cloud());
    const double of_trainer = worst_distance(middle, camera, 199.5, 109.5);
    const auto two = load_cameras(transforms.path(), {}).cameras.at(0);
    const double of_transforms =
        worst_distance(build_gaussian_scene(seen_by(two, up), cloud()), camera, camera.cx - 0.5, camera.cy - 0.5);
    figure("cameras.json: largest distance in pixels", of_trainer);
    figure("transforms.json: largest distance in pixels", of_transforms);
    EXPECT_LT(of_trainer, 1e-9);
    EXPECT_LT(of_transforms, 1e-9);
  }
}

// The footprint is the derivative of the formula: J Sigma J^T from differences of the pinhole's pixels.
TEST(PlacedCamera, FootprintsFollowBothFocalLengths) {
  const Oblique camera;
  const TestFile file(".json", camera.transforms().dump());
  const GaussianScene scene = build_gaussian_scene(seen_by(load_cameras(file.path(), {}).cameras.at(0)), cloud());
  double worst = 0.0;
  std::size_t compared = 0;
  for (const ProjectedGaussian& splat : project_all(scene)) {
    const Gaussian& gaussian = scene.cloud->gaussians[splat.number];
    const glm::dvec3 at(gaussian.position);
    if (std::abs(splat.x - 200.0) > 200.0 || std::abs(splat.y - 110.0) > 110.0) continue;  // linearised elsewhere
    glm::dvec3 row_x, row_y;
    for (int axis = 0; axis < 3; ++axis) {
      glm::dvec3 step(0.0);
      step[axis] = 1e-5;
      const glm::dvec2 change = (camera.pixel(at + step) - camera.pixel(at - step)) / 2e-5;
      row_x[axis] = change.x, row_y[axis] = change.y;
    }
    const glm::dmat3 sigma = covariance(gaussian);
    const double low_pass = scene.description.low_pass;
    const ScreenShape numeric{glm::dot(row_x, sigma * row_x), glm::dot(row_x, sigma * row_y),
                              glm::dot(row_y, sigma * row_y)};
    for (const double apart :
         {splat.shape.xx - low_pass - numeric.xx, splat.shape.xy - numeric.xy, splat.shape.yy - low_pass - numeric.yy})
      worst = std::max(worst, std::abs(apart) / (numeric.xx + numeric.yy));
    ++compared;
  }
  figure("footprints compared", static_cast<double>(compared));
  figure("largest relative difference", worst);
  EXPECT_GT(compared, 100U);
  EXPECT_LT(worst, 1e-7);
}

// An orbiting camera written down and read is the same view: centres, footprints, colours, order.
TEST(PlacedCamera, AnOrbitsViewWrittenDownIsTheSame) {
  double worst = 0.0;
  std::size_t compared = 0;
  for (const UpAxis up : {UpAxis::Y, UpAxis::MinusX, UpAxis::Z}) {
    GaussianDescription orbit;
    orbit.camera = {
        .projection = Projection::Perspective, .azimuth = 40.0, .elevation = -12.0, .roll = 9.0, .zoom = 1.4};
    orbit.width = 320, orbit.height = 200, orbit.up = up;
    const GaussianScene from = build_gaussian_scene(orbit, cloud("shells:500"));
    const glm::dmat3 back = glm::transpose(from.turn);
    GaussianDescription placed = orbit;
    placed.near = from.near;
    const double focal = from.camera.scale_at(0.0) * from.camera.eye_distance();
    placed.placed =
        PlacedCamera{.eye = back * from.camera.eye() + from.middle,
                     .axes = back * glm::dmat3(from.camera.right(), from.camera.down(), from.camera.direction()),
                     .intrinsics = Intrinsics{{focal, focal}, {159.5, 99.5}, 320, 200}};
    GaussianDescription looking = placed;  // upright, from its field of view
    looking.placed = PlacedCamera{.eye = placed.placed->eye};
    for (const GaussianDescription& other : {placed, looking}) {
      const auto a = project_all(from), b = project_all(build_gaussian_scene(other, from.cloud));
      ASSERT_EQ(a.size(), b.size());
      for (std::size_t i = 0; i < a.size(); ++i) {
        ASSERT_EQ(a[i].number, b[i].number);
        for (const double apart :
             {a[i].x - b[i].x, a[i].y - b[i].y, a[i].shape.xx - b[i].shape.xx, a[i].shape.xy - b[i].shape.xy,
              a[i].opacity - b[i].opacity, glm::distance(a[i].colour, b[i].colour)})
          worst = std::max(worst, std::abs(apart));
        ++compared;
      }
    }
  }
  figure("Gaussians compared", static_cast<double>(compared));
  figure("largest difference", worst);
  EXPECT_GT(compared, 2000U);
  EXPECT_LT(worst, 1e-9);
}

TEST(PlacedCamera, AnotherSizeShowsTheSame) {
  const Intrinsics whole{{800.0, 790.0}, {310.0, 245.0}, 640, 480};
  const Intrinsics half = resized(whole, 320, 240), wide = resized(whole, 1000, 240);
  // A pixel's place in the picture, from its left and upper edge.
  for (const double x : {-0.7, 0.0, 0.4}) {
    const double before = whole.focal.x * x + whole.centre.x + 0.5, after = half.focal.x * x + half.centre.x + 0.5;
    EXPECT_NEAR(after, 0.5 * before, 1e-12);
    EXPECT_NEAR(wide.focal.x * x + wide.centre.x - 499.5, after - 0.5 - 159.5, 1e-12) << "in the middle";
  }
  EXPECT_DOUBLE_EQ(half.focal.y, 395.0);
}

TEST(PlacedCamera, NearPlaneIsInTheScenesUnit) {
  auto one = std::make_shared<GaussianCloud>(make_synthetic_gaussians("shells:300"));
  GaussianDescription description = seen_by({.eye = {0.0, 0.0, 0.0}, .look_at = glm::dvec3(0.0, 0.0, 1.0)}, UpAxis::Y);
  for (const double near : {0.0, 0.05, 0.3}) {
    if (near > 0.0) description.near = near;
    ProjectionReport report;
    project_all(build_gaussian_scene(description, one), &report);
    const double least = near > 0.0 ? near : kNearPlaced;
    const auto before = std::ranges::count_if(
        one->gaussians, [&](const Gaussian& g) { return g.position.z < static_cast<float>(least); });
    std::printf("[figure] near %.2f: %llu of %zu Gaussians are nearer\n", least,
                static_cast<unsigned long long>(report.near), one->gaussians.size());
    EXPECT_EQ(report.near, static_cast<std::uint64_t>(before));
    EXPECT_GT(before, 0);
  }
  description.near = -1.0;
  EXPECT_THROW(build_gaussian_scene(description, one), UserError);
  description = seen_by({.eye = {1.0, 2.0, 3.0}, .look_at = glm::dvec3(1.0, 2.0, 3.0)});
  EXPECT_THROW(build_gaussian_scene(description, one), UserError);
  description.placed->look_at = glm::dvec3(1.0, 0.0, 3.0);  // along the axis that points up
  EXPECT_NO_THROW(build_gaussian_scene(description, one));
}

TEST(PlacedCamera, FilesOfBlenderHaveAnAngleAndNoSize) {
  const Oblique camera;
  Json json{{"camera_angle_x", 0.69}, {"frames", {camera.of_transforms()}}};
  const TestFile file(".json", json.dump());
  const auto read = load_cameras(file.path(), glm::ivec2(800, 600)).cameras.at(0).intrinsics.value();
  EXPECT_NEAR(read.focal.x, 400.0 / std::tan(0.345), 1e-9);
  EXPECT_EQ(read.focal.x, read.focal.y);
  EXPECT_EQ(read.centre, glm::dvec2(399.5, 299.5));
  EXPECT_NE(refusal_of_cameras(json).find("add --size"), std::string::npos);
  json["camera_angle_y"] = 0.5;
  const TestFile both(".json", json.dump());
  EXPECT_NEAR(load_cameras(both.path(), glm::ivec2(800, 600)).cameras.at(0).intrinsics->focal.y, 300.0 / std::tan(0.25),
              1e-9);
}

TEST(PlacedCamera, CamerasAreFoundByNameAndNumber) {
  CameraFile file;
  for (const char* name : {"images/a.png", "images/b.png", "0", "b", "left/c.png", "right/c.png", "d"})
    file.cameras.push_back({.name = name});
  EXPECT_EQ(find_camera(file, "images/b.png"), 1U);
  EXPECT_EQ(find_camera(file, "a"), 0U);
  EXPECT_EQ(find_camera(file, "a.png"), 0U);
  EXPECT_EQ(find_camera(file, "b"), 3U) << "a whole name comes first";
  EXPECT_EQ(find_camera(file, "0"), 2U) << "a name comes before a number";
  EXPECT_EQ(find_camera(file, "1"), 1U);
  EXPECT_EQ(find_camera(file, "left/c.png"), 4U);
  for (const char* none : {"7", "01", "-1", "c", "c.png", "e", ""})
    EXPECT_THROW(find_camera(file, none), UserError) << none;
  file.cameras.push_back({.name = "d"});
  EXPECT_THROW(find_camera(file, "d"), UserError) << "two have this name";
}

TEST(PlacedCamera, DamagedFilesAreRefusedInOneLine) {
  const Oblique camera;
  const Json good = camera.of_trainer(), frame = camera.of_transforms(), whole = camera.transforms();
  const auto with = [](Json json, const char* key, const Json& value) {
    value.is_null() ? static_cast<void>(json.erase(key)) : static_cast<void>(json[key] = value);
    return json;
  };
  const auto list = [](const Json& one) { return Json::array({one}); };
  const auto frames = [&](const Json& one) { return with(whole, "frames", list(one)); };
  const Json mirrored{{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, large{{2, 0, 0}, {0, 2, 0}, {0, 0, 2}};
  const std::vector<std::pair<Json, std::string>> cases{
      {Json(3), "JSON without a list"},
      {Json::array(), "no cameras"},
      {list(7), "not a camera"},
      {list(with(good, "rotation", mirrored)), "not a rotation"},
      {list(with(good, "rotation", large)), "not a rotation"},
      {list(with(good, "rotation", {{1, 0}, {0, 1}})), "3 rows of 3 numbers"},
      {list(with(good, "rotation", {})), "got nothing"},
      {list(with(good, "position", {1, 2})), "three numbers"},
      {list(with(good, "position", {1, 2, "x"})), "a finite number"},
      {list(with(good, "fx", 0)), "more than 0 pixels"},
      {list(with(good, "fy", {})), "fx and fy"},
      {list(with(good, "width", 0)), "an integer from 1"},
      {list(with(good, "height", 20.5)), "an integer from 1"},
      {list(with(good, "width", 1e12)), "an integer from 1"},
      {frames(with(frame, "transform_matrix", {{1, 2}, {3, 4}})), "3 rows of 4 numbers"},
      {frames(with(frame, "transform_matrix", {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 1, 0}})),
       "not a rotation"},
      {frames(with(frame, "fl_x", "wide")), "a finite number"},
      {with(with(whole, "fl_x", {}), "fl_y", {}), "fl_x or camera_angle_x"},
      {with(with(with(whole, "fl_x", {}), "fl_y", {}), "camera_angle_x", 3.2), "0 to 3 radians"},
      {with(whole, "camera_model", "OPENCV_FISHEYE"), "a pinhole"},
      {with(whole, "is_fisheye", true), "a pinhole"},
      {with(whole, "camera_type", "equirectangular"), "a pinhole"},
      {frames(with(frame, "camera_model", "OPENCV_FISHEYE")), "a pinhole"},
      {with(whole, "w", {}), "add --size"},
  };
  for (const auto& [json, word] : cases) {
    const std::string message = refusal_of_cameras(json);
    std::printf("[figure] %s\n", message.substr(message.rfind('/') + 1).c_str());
    EXPECT_NE(message.find(word), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
  }
  const TestFile bent(".json", with(whole, "k1", -0.1).dump()), text(".json", "[{\"id\": ");
  EXPECT_EQ(load_cameras(bent.path(), {}).remarks.size(), 1U);
  EXPECT_THROW(load_cameras(text.path(), {}), UserError);
}

TEST(PlacedCamera, AMatrixIsARotationAndAPosition) {
  const std::vector<double> twelve{0, 0, 1, 4, 0, -1, 0, 5, 1, 0, 0, 6};
  const auto camera = camera_from_matrix(twelve);
  ASSERT_TRUE(camera);
  EXPECT_EQ(camera->eye, glm::dvec3(4, 5, 6));
  EXPECT_EQ((*camera->axes)[2], glm::dvec3(1, 0, 0)) << "the third column points forward";
  std::vector<double> sixteen = twelve;
  sixteen.insert(sixteen.end(), {0, 0, 0, 1});
  EXPECT_EQ(camera_from_matrix(sixteen)->eye, camera->eye);
  sixteen[12] = 1;
  EXPECT_FALSE(camera_from_matrix(sixteen)) << "a projection";
  std::vector<double> rounded = twelve;
  rounded[1] = 3e-4;
  const glm::dmat3 axes = *camera_from_matrix(rounded)->axes;
  EXPECT_NEAR(glm::length(axes[1]), 1.0, 1e-15);
  EXPECT_NEAR(glm::dot(axes[0], axes[1]), 0.0, 1e-15);
  rounded[1] = 0.1;
  EXPECT_FALSE(camera_from_matrix(rounded));
  rounded.pop_back();
  EXPECT_FALSE(camera_from_matrix(rounded));
}

// The order of distances from the eye, recomputed from positions.
TEST(PlacedCamera, GaussiansAreSortedByDistanceIfAsked) {
  for (const Projection projection : {Projection::Perspective, Projection::Orthographic}) {
    GaussianDescription description;
    description.camera.projection = projection;
    description.camera.fov = 70.0;
    description.order = GaussianSort::Distance;
    const GaussianScene scene = build_gaussian_scene(description, cloud("cloud:4000"));
    std::size_t otherwise = 0, pairs = 0;
    const auto all = project_all(scene);
    const auto distance = [&](const ProjectedGaussian& splat) {
      const glm::dvec3 at = scene.turn * (glm::dvec3(scene.cloud->gaussians[splat.number].position) - scene.middle);
      return projection == Projection::Perspective ? glm::distance(at, scene.camera.eye()) : splat.depth;
    };
    for (std::size_t i = 1; i < all.size(); ++i, ++pairs) {
      ASSERT_LE(distance(all[i - 1]), distance(all[i]) + 1e-12);
      otherwise += all[i - 1].depth > all[i].depth ? 1U : 0U;
    }
    std::printf("[figure] neighbours in another order than that of depths: %zu of %zu\n", otherwise, pairs);
    EXPECT_EQ(otherwise > 500, projection == Projection::Perspective);
    GaussianCloud declared = *scene.cloud;
    declared.by_distance = true;
    GaussianDescription open = description;
    open.order.reset();
    EXPECT_EQ(build_gaussian_scene(open, scene.cloud).order, GaussianSort::Depth);
    EXPECT_EQ(build_gaussian_scene(open, std::make_shared<GaussianCloud>(declared)).order, GaussianSort::Distance);
  }
}

TEST(PlacedCamera, ABoxKeepsTheGaussiansWithTheirCentresInIt) {
  const GaussianCloud whole = make_synthetic_gaussians("cloud:500");
  const RealBox box = *real_box_from("-0.25..0.5,-1..0,-10..1e1");
  GaussianCloud part = whole;
  crop(part, box);
  std::size_t at = 0;
  for (std::size_t i = 0; i < whole.gaussians.size(); ++i) {
    const glm::vec3& p = whole.gaussians[i].position;
    if (p.x < -0.25F || p.x > 0.5F || p.y < -1.0F || p.y > 0.0F) continue;
    ASSERT_LT(at, part.gaussians.size());
    EXPECT_EQ(part.gaussians[at], whole.gaussians[i]);
    EXPECT_EQ(part.number_of(at), i);
    EXPECT_TRUE(std::ranges::equal(part.harmonics_of(at), whole.harmonics_of(i)));
    ++at;
  }
  std::printf("[figure] %zu of %zu Gaussians are in the box\n", at, whole.gaussians.size());
  EXPECT_EQ(at, part.gaussians.size());
  // Ends are included as the floats that positions are: 0.1 is less than its float.
  GaussianCloud edge = whole;
  edge.gaussians[7].position = {0.1F, 0.1F, 0.1F};
  crop(edge, *real_box_from("0.1..0.1,0.1..0.1,0.1..0.1"));
  EXPECT_EQ(edge.gaussians.size(), 1U);
  EXPECT_GT(at, 50U);
  EXPECT_THROW(crop(part, *real_box_from("7..8,7..8,7..8")), UserError);
  for (const char* none :
       {"", "1..2", "1..2,3..4", "2..1,0..1,0..1", "a..b,0..1,0..1", "0..1,0..1,0..1,0..1", "nan..1,0..1,0..1"})
    EXPECT_FALSE(real_box_from(none)) << none;
}

}  // namespace
}  // namespace fastsplat::scene
