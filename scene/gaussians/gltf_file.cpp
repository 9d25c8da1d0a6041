// SPDX-License-Identifier: Apache-2.0
#include "scene/gaussians/gltf_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_access.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>

#include "scene/gaussians/axis_flips.hpp"
#include "scene/gaussians/gaussian_rows.hpp"
#include "scene/gaussians/gltf_document.hpp"
#include "scene/gaussians/harmonic_rotation.hpp"
#include "scene/gaussians/packed_bytes.hpp"

namespace fastsplat::scene {
namespace {

using Json = nlohmann::json;

constexpr const char* kExtension = "KHR_gaussian_splatting";

/// The accessors of a primitive.
struct GltfSplats {
  GltfNumbers position, rotation, scale, opacity;
  std::vector<GltfNumbers> harmonics;
  std::size_t node = 0;
  int degree() const { return static_cast<int>(std::sqrt(static_cast<double>(harmonics.size())) + 0.5) - 1; }
};

class Gltf {
 public:
  Gltf(const std::string& bytes, GaussianCloud& to) : file_(bytes, to.source), to_(to) {}
  void read();

 private:
  void check_required();
  void walk(std::size_t node, const glm::dmat4& parent);
  glm::dmat4 transformation(const Json& node) const;
  std::vector<double> list(const Json& node, const char* key, std::size_t size) const;
  void take(const Json& primitive, std::size_t node);
  void follow(const Json& extension);
  void remark(const std::string& text);  ///< once
  void add(const GltfSplats& splats, GaussianRows& rows);
  bool logarithms() const;

  GltfDocument file_;
  GaussianCloud& to_;
  std::vector<GltfSplats> found_;
  std::vector<std::optional<glm::dmat4>> world_;  ///< of nodes that were visited
  std::size_t others_ = 0;
  bool logarithms_ = false;
  bool quantised_ = false;  ///< positions may be integers
};

void Gltf::check_required() {
  for (const char* key : {"version", "minVersion"}) {
    const auto place = Json::json_pointer("/asset") / key;
    if (std::string_view(key) == "minVersion" && !file_.json().contains(place)) continue;
    const Json version = file_.json().contains(place) ? file_.json()[place] : Json();
    const std::string text = version.is_string() ? version.get<std::string>() : "";
    if (key == std::string("minVersion") ? text != "2.0" : !text.starts_with("2."))
      file_.refuse(fmt::format("unsupported asset.{} of glTF", key), "2.0", version.dump().substr(0, 40),
                   "export it as glTF 2.0");
  }
  const auto required = file_.json().find("extensionsRequired");
  if (required == file_.json().end() || !required->is_array()) return;
  for (const Json& name : *required) {
    const std::string text = name.is_string() ? name.get<std::string>() : "";
    quantised_ |= text == "KHR_mesh_quantization";
    if (text != kExtension && text != "KHR_mesh_quantization")
      file_.refuse("the glTF file requires an extension that is not supported", kExtension, text,
                   "export it without compression or other extensions");
  }
}

std::vector<double> Gltf::list(const Json& node, const char* key, std::size_t size) const {
  std::vector<double> out;
  const auto found = node.find(key);
  if (found == node.end()) return out;
  if (found->is_array())
    for (const Json& value : *found)
      if (value.is_number()) out.push_back(value.get<double>());
  if (out.size() != size)
    file_.refuse(fmt::format("a node's {} is invalid", key), fmt::format("{} numbers", size), "others");
  return out;
}

glm::dmat4 Gltf::transformation(const Json& node) const {
  glm::dmat4 out(1.0);
  if (const auto matrix = list(node, "matrix", 16); !matrix.empty()) {
    for (const char* key : {"rotation", "scale", "translation"})
      if (node.contains(key))
        file_.refuse("a node has two transformations", "a matrix or TRS", fmt::format("matrix and {}", key));
    for (int column = 0; column < 4; ++column)
      for (int row = 0; row < 4; ++row) out[column][row] = matrix[static_cast<std::size_t>(4 * column + row)];
    if (glm::row(out, 3) != glm::dvec4(0.0, 0.0, 0.0, 1.0))
      file_.refuse("a node's matrix is no affine transformation", "a last row of 0, 0, 0, 1", "another");
    return out;
  }
  if (const auto turn = list(node, "rotation", 4); !turn.empty()) {
    const glm::dquat quaternion(turn[3], turn[0], turn[1], turn[2]);
    const double length = glm::length(quaternion);
    if (!(length > 0.0 && std::isfinite(length)))
      file_.refuse("a node's rotation is invalid", "a unit quaternion", fmt::format("one of length {:g}", length));
    out = glm::mat4_cast(quaternion / length);
  }
  if (const auto scale = list(node, "scale", 3); !scale.empty())
    for (int axis = 0; axis < 3; ++axis) out[axis] *= scale[static_cast<std::size_t>(axis)];
  if (const auto move = list(node, "translation", 3); !move.empty()) out[3] = {move[0], move[1], move[2], 1.0};
  return out;
}

void Gltf::walk(std::size_t first, const glm::dmat4& parent) {
  std::vector<std::pair<std::size_t, glm::dmat4>> open{{first, parent}};
  while (!open.empty()) {
    const auto [index, above] = open.back();
    open.pop_back();
    const Json& node = file_.item("nodes", index);
    if (world_[index]) file_.refuse("a node has two parents", "a tree of nodes", fmt::format("nodes[{}]", index));
    world_[index] = above * transformation(node);
    if (const auto children = node.find("children"); children != node.end() && children->is_array())
      for (const Json& child : *children)
        if (child.is_number_unsigned()) open.emplace_back(child.get<std::size_t>(), *world_[index]);
    if (!node.contains("mesh")) continue;
    const Json& mesh = file_.item("meshes", file_.number(node, "mesh", "a node"));
    const auto primitives = mesh.find("primitives");
    if (primitives == mesh.end() || !primitives->is_array()) continue;
    for (const Json& primitive : *primitives) {
      const auto extensions = primitive.find("extensions");
      if (extensions != primitive.end() && extensions->is_object() && extensions->contains(kExtension)) {
        follow((*extensions)[kExtension]);
        take(primitive, index);
      } else {
        ++others_;
      }
    }
  }
}

void Gltf::remark(const std::string& text) {
  if (std::ranges::find(to_.remarks, text) == to_.remarks.end()) to_.remarks.push_back(text);
}

void Gltf::follow(const Json& extension) {
  const auto word = [&](const char* key, const char* usual) {
    const auto found = extension.find(key);
    return found != extension.end() && found->is_string() ? found->get<std::string>() : std::string(usual);
  };
  if (const auto more = extension.find("extensions"); more != extension.end() && more->is_object() && !more->empty())
    file_.refuse("the Gaussians of the glTF file are compressed or extended", kExtension, more->begin().key(),
                 "export them without this extension");
  if (const std::string kernel = word("kernel", "ellipse"); kernel != "ellipse")
    remark("the kernel '" + kernel.substr(0, 40) + "' is not supported: drawn as 'ellipse'");
  const std::string space = word("colorSpace", "srgb_rec709_display");
  to_.linear = space == "lin_rec709_display";
  if (!to_.linear && space != "srgb_rec709_display")
    remark("the colour space '" + space.substr(0, 40) + "' is not supported: colours are read as sRGB");
  if (const std::string method = word("projection", "perspective"); method != "perspective")
    remark("the projection '" + method.substr(0, 40) + "' is not supported");
  const std::string method = word("sortingMethod", "cameraDistance");
  to_.by_distance = method == "cameraDistance";
  if (!to_.by_distance) remark("the sorting method '" + method.substr(0, 40) + "' is not supported");
}

void Gltf::take(const Json& primitive, std::size_t node) {
  if (file_.number_or(primitive, "mode", 4, "a primitive") != 0)
    file_.refuse("Gaussians must be points", "mode 0", "another mode");
  const auto attributes = primitive.find("attributes");
  if (attributes == primitive.end() || !attributes->is_object())
    file_.refuse("a primitive has no attributes", "POSITION and others", "none");
  /// `integers`: component types besides float; those of fractions must be normalized.
  const auto numbers = [&](const std::string& name, std::size_t width, const std::vector<int>& integers = {},
                           bool fractions = false) {
    GltfNumbers out = file_.numbers(file_.number(*attributes, name.c_str(), "a primitive of Gaussians"), width, name);
    const bool integer = std::ranges::find(integers, out.type) != integers.end() && (out.normalized || !fractions);
    if (!integer && (out.type != kGltfFloat || out.normalized))
      file_.refuse(name + " has an invalid componentType",
                   fmt::format("5126{}{}",
                               integers.empty() ? ""
                               : fractions      ? ", or normalized "
                                                : ", ",
                               fmt::join(integers, ", ")),
                   fmt::format("{}{}", out.type, out.normalized ? " normalized" : ""));
    return out;
  };
  const std::string prefix = std::string(kExtension) + ":";
  const std::vector<int> any{5120, 5121, 5122, 5123};
  GltfSplats splats{.position = numbers("POSITION", 3, quantised_ ? any : std::vector<int>{}),
                    .rotation = numbers(prefix + "ROTATION", 4, {5120, 5122}, true),
                    .scale = numbers(prefix + "SCALE", 3, any),
                    .opacity = numbers(prefix + "OPACITY", 1, {5121, 5123}, true),
                    .harmonics = {},
                    .node = node};
  int most = 0;
  for (const auto& [name, accessor] : attributes->items())
    for (int degree = 1; degree <= kMostDegree + 1; ++degree)
      if (name.starts_with(fmt::format("{}SH_DEGREE_{}_", prefix, degree))) most = std::max(most, degree);
  if (most > kMostDegree) remark(fmt::format("harmonics above degree {} are not drawn", kMostDegree));
  for (int degree = 0; degree <= kMostDegree; ++degree) {
    const std::string stem = fmt::format("{}SH_DEGREE_{}_COEF_", prefix, degree);
    if (degree > most) break;
    for (int k = 0; k <= 2 * degree; ++k) splats.harmonics.push_back(numbers(stem + std::to_string(k), 3));
  }
  const std::size_t count = splats.position.count;
  const auto same = [count](const GltfNumbers& one) { return one.count == count; };
  if (!same(splats.rotation) || !same(splats.scale) || !same(splats.opacity) ||
      !std::ranges::all_of(splats.harmonics, same))
    file_.refuse("the attributes of the Gaussians differ in number", fmt::format("{} each", count), "others");
  found_.push_back(std::move(splats));
}

/// Scales are not negative; drafts before 2026 stored their logarithms, which mostly are.
bool Gltf::logarithms() const {
  for (const GltfSplats& splats : found_)
    for (std::size_t i = 0; i < splats.scale.count; ++i)
      for (std::size_t k = 0; k < 3; ++k)
        if (splats.scale.at(i, k) < 0.0F) return true;
  return false;
}

void Gltf::add(const GltfSplats& splats, GaussianRows& rows) {
  const glm::dmat4& world = *world_[splats.node];
  const glm::dmat3 linear(world);
  const double size = glm::length(linear[0]);
  glm::dmat3 turn = linear / (size > 0.0 ? size : 1.0);
  const glm::dmat3 square = glm::transpose(turn) * turn;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (!(std::abs(square[i][j] - (i == j ? 1.0 : 0.0)) < 1e-4) || !(glm::determinant(turn) > 0.0))
        file_.refuse("a node stretches, shears or mirrors its Gaussians", "one scale for all axes", "others",
                     "apply the node's transformation in the program that wrote the file");
  const glm::dquat quaternion = glm::normalize(glm::quat_cast(turn));
  const HarmonicRotation rotation_of_harmonics(turn);
  const bool turned = turn != glm::dmat3(1.0);
  std::vector<glm::vec3> harmonics(static_cast<std::size_t>(harmonic_count(to_.degree)));
  for (std::size_t i = 0; i < splats.position.count; ++i) {
    Gaussian one;
    std::ranges::fill(harmonics, glm::vec3(0.0F));
    glm::dvec3 position;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<int>(k);
      position[axis] = static_cast<double>(splats.position.at(i, k));
      const auto scale = static_cast<double>(splats.scale.at(i, k));
      one.scale[axis] = static_cast<float>(size * (logarithms_ ? std::exp(scale) : scale));
      for (std::size_t h = 0; h < splats.harmonics.size(); ++h) harmonics[h][axis] = splats.harmonics[h].at(i, k);
    }
    constexpr float kRounding = 1e-5F;  // of a writer
    const float opacity = splats.opacity.at(i, 0), within = std::clamp(opacity, 0.0F, 1.0F);
    one.opacity = std::abs(opacity - within) < kRounding ? within : opacity;
    one.position = linear * position + glm::dvec3(world[3]);
    const auto part = [&](std::size_t k) { return static_cast<double>(splats.rotation.at(i, k)); };
    glm::dquat own(part(3), part(0), part(1), part(2));
    if (turned) {
      own = quaternion * own;
      rotation_of_harmonics.apply(harmonics);
    }
    glm::dvec4 rotation(own.w, own.x, own.y, own.z);
    flip_axes(kFlipsOfLuf, one.position, rotation, harmonics);
    rows.add(one, rotation, harmonics);
  }
}

void Gltf::read() {
  check_required();
  const Json& json = file_.json();
  const auto nodes = json.find("nodes");
  if (nodes == json.end() || !nodes->is_array()) file_.refuse("the glTF file has no nodes", "nodes", "none");
  world_.resize(nodes->size());
  const Json& scene = file_.item("scenes", file_.number_or(json, "scene", 0, "the file"));
  if (const auto roots = scene.find("nodes"); roots != scene.end() && roots->is_array())
    for (const Json& root : *roots)
      if (root.is_number_unsigned()) walk(root.get<std::size_t>(), glm::dmat4(1.0));
  std::size_t count = 0;
  for (const GltfSplats& splats : found_) {
    to_.degree = std::max(to_.degree, splats.degree());
    count += splats.position.count;
  }
  // Nodes may share a mesh.
  check_growth(count * (sizeof(Gaussian) + sizeof(glm::vec3) * static_cast<std::size_t>(harmonic_count(to_.degree))),
               file_.size(), to_.source);
  if (count == 0)
    file_.refuse("the glTF file holds no 3-D Gaussians", std::string("a primitive with ") + kExtension,
                 fmt::format("{} others", others_), "export the Gaussians, not meshes or points");
  logarithms_ = logarithms();
  if (logarithms_)
    to_.remarks.emplace_back(
        "some scales are negative: all are read as logarithms, as drafts of KHR_gaussian_splatting stored them");
  if (others_ > 0) to_.remarks.push_back(fmt::format("{} primitives other than Gaussians are not drawn", others_));
  GaussianRows rows(to_, to_.source);
  for (const GltfSplats& splats : found_) add(splats, rows);
  rows.end();
}

}  // namespace

bool is_gltf(std::string_view head) {
  return head.starts_with("glTF") || (head.starts_with("{") && head.find("\"asset\"") != head.npos &&
                                      head.find("\"version\"") != head.npos && head.find("\"means\"") == head.npos);
}

void read_gltf(const std::string& bytes, GaussianCloud& to) { Gltf(bytes, to).read(); }

}  // namespace fastsplat::scene
