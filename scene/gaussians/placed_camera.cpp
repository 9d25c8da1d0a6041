// SPDX-License-Identifier: Apache-2.0
#include "scene/gaussians/placed_camera.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/json_file.hpp"
#include "base/json_text.hpp"
#include "base/lower_case.hpp"
#include "base/number_text.hpp"
#include "base/printable.hpp"

namespace fastsplat::scene {
namespace {

using Json = nlohmann::json;

/// Files store rotations in few digits; matrices farther from a rotation are refused.
constexpr double kRotationError = 1e-3;
constexpr int kMostSide = 1 << 20;

/// The nearest rotation, or nullopt.
std::optional<glm::dmat3> rotation_from(glm::dmat3 axes) {
  const glm::dmat3 square = glm::transpose(axes) * axes;
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row)
      if (!(std::abs(square[column][row] - (column == row ? 1.0 : 0.0)) <= kRotationError)) return std::nullopt;
  if (!(glm::determinant(axes) > 0.0)) return std::nullopt;
  // Newton's iteration for the polar factor squares the error at each step.
  for (int step = 0; step < 4; ++step) axes = 0.5 * (axes + glm::inverse(glm::transpose(axes)));
  return axes;
}

class Reader {
 public:
  Reader(const std::filesystem::path& path, const std::optional<glm::ivec2>& size) : path_(path), size_(size) {}
  CameraFile read();

 private:
  [[noreturn]] void refuse(const std::string& what, const std::string& expected, const std::string& got,
                           const std::string& fix = {}) const {
    throw_input({.where = where_.empty() ? path_.string() : path_.string() + ": " + where_,
                 .what = what,
                 .expected = expected,
                 .got = got,
                 .fix = fix});
  }
  double number(const Json& value, const std::string& name) const {
    if (!value.is_number() || !std::isfinite(value.get<double>()))
      refuse(name + " is invalid", "a finite number", short_text(value));
    return value.get<double>();
  }
  /// Of `own`, else of the file.
  std::optional<double> number_of(const Json& own, const char* key) const {
    for (const Json* object : {&own, static_cast<const Json*>(&file_)})
      if (object->is_object() && object->contains(key)) return number(object->at(key), key);
    return std::nullopt;
  }
  int side(const Json& own, const char* key, int usual) const {
    const auto value = number_of(own, key);
    if (!value && usual == 0) refuse("the size of the picture is missing", key, "nothing", "add --size");
    if (!value) return usual;
    if (!(*value >= 1.0 && *value <= kMostSide && *value == std::floor(*value)))
      refuse(std::string(key) + " is invalid", fmt::format("an integer from 1 to {}", kMostSide),
             fmt::format("{}", *value));
    return static_cast<int>(*value);
  }
  glm::dvec2 focal(double x, double y) const {
    if (!(x > 0.0 && y > 0.0))
      refuse("a focal length is invalid", "more than 0 pixels", fmt::format("{} and {}", x, y));
    return {x, y};
  }
  /// At least `rows` rows of `columns` numbers.
  std::vector<double> matrix(const Json& object, const char* key, std::size_t rows, std::size_t columns) const;
  PlacedCamera placed(const std::vector<double>& numbers, const char* key) const;
  static std::string name_of(const Json& object, const char* key) {
    const auto name = object.find(key);
    return name != object.end() && name->is_string() ? name->get<std::string>() : std::string{};
  }
  static std::string short_text(const Json& value) {
    const std::string text = json_text(value, -1);
    return text.size() <= 40 ? text : text.substr(0, 37) + "...";
  }

  PlacedCamera of_trainer(const Json& one) const;
  /// Of a frame of transforms.json, or of the file.
  void require_pinhole(const Json& own) const;
  PlacedCamera of_transforms(const Json& frame);

  const std::filesystem::path& path_;
  std::optional<glm::ivec2> size_;
  Json file_;
  std::string where_;  ///< "camera 3"
  bool distorted_ = false;
};

std::vector<double> Reader::matrix(const Json& object, const char* key, std::size_t rows, std::size_t columns) const {
  std::vector<double> out;
  const auto found = object.find(key);
  const bool fits = found != object.end() && found->is_array() && found->size() >= rows &&
                    std::all_of(found->begin(), found->end(),
                                [columns](const Json& row) { return row.is_array() && row.size() == columns; });
  if (!fits)
    refuse(std::string(key) + " is invalid", fmt::format("{} rows of {} numbers", rows, columns),
           found == object.end() ? "nothing" : short_text(*found));
  for (const Json& row : *found)
    for (const Json& value : row) out.push_back(number(value, key));
  return out;
}

PlacedCamera Reader::placed(const std::vector<double>& numbers, const char* key) const {
  const auto out = camera_from_matrix(numbers);
  if (!out)
    refuse(std::string(key) + " is not a rotation", "three orthogonal unit columns, not mirrored", "another matrix");
  return *out;
}

PlacedCamera Reader::of_trainer(const Json& one) const {
  const auto r = matrix(one, "rotation", 3, 3);
  const auto position = one.find("position");
  if (position == one.end() || !position->is_array() || position->size() != 3)
    refuse("position is invalid", "three numbers", position == one.end() ? "nothing" : short_text(*position));
  const glm::ivec2 usual = size_.value_or(glm::ivec2(0));
  const int width = side(one, "width", usual.x), height = side(one, "height", usual.y);
  const auto fx = number_of(one, "fx"), fy = number_of(one, "fy");
  if (!fx || !fy) refuse("a focal length is missing", "fx and fy", "nothing");
  std::vector<double> numbers;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) numbers.push_back(r[3 * row + column]);
    numbers.push_back(number((*position)[row], "position"));
  }
  PlacedCamera out = placed(numbers, "rotation");
  out.name = name_of(one, "img_name");
  out.intrinsics = Intrinsics{focal(*fx, *fy), {0.5 * (width - 1), 0.5 * (height - 1)}, width, height};
  return out;
}

void Reader::require_pinhole(const Json& own) const {
  constexpr std::array kPinholes{"opencv", "pinhole", "simple_pinhole", "simple_radial", "radial", "perspective"};
  for (const Json* object : {&own, &file_}) {
    for (const char* key : {"camera_model", "camera_type"}) {
      const auto model = object->find(key);
      if (model == object->end()) continue;
      if (!model->is_string() ||
          std::find(kPinholes.begin(), kPinholes.end(), lower_case(model->get<std::string>())) == kPinholes.end())
        refuse("the camera model is not supported", "a pinhole", short_text(*model));
    }
    for (const char* key : {"is_fisheye", "orthographic", "equirectangular"}) {
      const auto is = object->find(key);
      if (is != object->end() && *is != false) refuse("the camera model is not supported", "a pinhole", key);
    }
  }
}

PlacedCamera Reader::of_transforms(const Json& frame) {
  require_pinhole(frame);
  auto numbers = matrix(frame, "transform_matrix", 3, 4);
  // These files have x right, y up, z back, and the first pixel's centre at (0.5, 0.5).
  for (std::size_t row = 0; row < 3; ++row)
    for (const std::size_t column : {1U, 2U}) numbers[4 * row + column] *= -1.0;
  PlacedCamera out = placed(numbers, "transform_matrix");
  const glm::ivec2 usual = size_.value_or(glm::ivec2(0));
  const int width = side(frame, "w", usual.x), height = side(frame, "h", usual.y);
  const auto fl_x = number_of(frame, "fl_x"), fl_y = number_of(frame, "fl_y");
  const auto angle_x = number_of(frame, "camera_angle_x"), angle_y = number_of(frame, "camera_angle_y");
  const auto of_angle = [&](double angle, int pixels) {
    if (!(angle > 0.0 && angle < 3.0)) refuse("a field of view is invalid", "0 to 3 radians", fmt::format("{}", angle));
    return 0.5 * pixels / std::tan(0.5 * angle);
  };
  if (!fl_x && !angle_x) refuse("a focal length is missing", "fl_x or camera_angle_x", "nothing");
  const double x = fl_x ? *fl_x : of_angle(*angle_x, width);
  const double y = fl_y ? *fl_y : angle_y && !fl_x ? of_angle(*angle_y, height) : x;
  const auto cx = number_of(frame, "cx"), cy = number_of(frame, "cy");
  for (const char* key : {"k1", "k2", "k3", "k4", "p1", "p2"})
    distorted_ = distorted_ || number_of(frame, key).value_or(0.0) != 0.0;
  out.name = name_of(frame, "file_path");
  out.intrinsics =
      Intrinsics{focal(x, y), {cx.value_or(0.5 * width) - 0.5, cy.value_or(0.5 * height) - 0.5}, width, height};
  return out;
}

CameraFile Reader::read() {
  const JsonKind kind{
      .what = "not a file of cameras", .expected = "cameras.json of a trainer or transforms.json", .fix = {}};
  file_ = from_json_file<Json>(path_, kind, [](Json json) { return json; });
  const bool of_trainer_file = file_.is_array();
  if (!of_trainer_file && !(file_.is_object() && file_.contains("frames") && file_["frames"].is_array()))
    refuse(kind.what, kind.expected, "JSON without a list of cameras");
  CameraFile out;
  const Json list = of_trainer_file ? file_ : file_["frames"];
  for (const Json& one : list) {
    where_ = fmt::format("camera {}", out.cameras.size());
    if (!one.is_object()) refuse("not a camera", "an object", short_text(one));
    out.cameras.push_back(of_trainer_file ? of_trainer(one) : of_transforms(one));
  }
  where_.clear();
  if (out.cameras.empty()) refuse("no cameras", "at least one", "an empty list");
  if (distorted_)
    out.remarks.push_back("the lens distortion in " + path_.filename().string() +
                          " is not drawn: cameras are pinholes");
  return out;
}

}  // namespace

CameraFile load_cameras(const std::filesystem::path& path, const std::optional<glm::ivec2>& size) {
  return Reader(path, size).read();
}

std::size_t find_camera(const CameraFile& file, const std::string& name) {
  const auto& cameras = file.cameras;
  const auto named = [&](const PlacedCamera& one) { return one.name == name; };
  const auto of_file = [&](const PlacedCamera& one) {
    const std::filesystem::path path(one.name);
    return !one.name.empty() && (path.filename() == name || path.stem() == name);
  };
  const auto refuse = [&](const char* what) {
    throw_usage({.where = "--view",
                 .what = what,
                 .expected = fmt::format("0 to {}, or a name such as '{}'", cameras.size() - 1,
                                         printable(cameras.front().name.empty() ? "0" : cameras.front().name)),
                 .got = "'" + printable(name) + "'",
                 .fix = "use one of these"});
  };
  auto found = std::find_if(cameras.begin(), cameras.end(), named);
  if (std::count_if(cameras.begin(), cameras.end(), named) > 1) refuse("several cameras have this name");
  if (found == cameras.end()) {
    found = std::find_if(cameras.begin(), cameras.end(), of_file);
    if (std::count_if(cameras.begin(), cameras.end(), of_file) > 1) refuse("several cameras have this file name");
  }
  if (found != cameras.end()) return static_cast<std::size_t>(found - cameras.begin());
  const auto number = integer_from<std::size_t>(name);
  // "007" is a name.
  if (!number || *number >= cameras.size() || std::to_string(*number) != name) refuse("no such camera");
  return *number;
}

Intrinsics resized(const Intrinsics& intrinsics, int width, int height) {
  const double factor =
      std::min(static_cast<double>(width) / intrinsics.width, static_cast<double>(height) / intrinsics.height);
  const glm::dvec2 from(0.5 * (intrinsics.width - 1), 0.5 * (intrinsics.height - 1)),
      to(0.5 * (width - 1), 0.5 * (height - 1));
  return {factor * intrinsics.focal, to + factor * (intrinsics.centre - from), width, height};
}

std::optional<PlacedCamera> camera_from_matrix(const std::vector<double>& m) {
  if (m.size() != 12 && m.size() != 16) return std::nullopt;
  if (m.size() == 16 && !(m[12] == 0.0 && m[13] == 0.0 && m[14] == 0.0 && m[15] == 1.0)) return std::nullopt;
  const auto axes = rotation_from(glm::dmat3(m[0], m[4], m[8], m[1], m[5], m[9], m[2], m[6], m[10]));
  if (!axes) return std::nullopt;
  return PlacedCamera{.eye = {m[3], m[7], m[11]}, .axes = *axes};
}

}  // namespace fastsplat::scene
