// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/version.hpp"
#include "scene/gaussians/axis_flips.hpp"
#include "scene/gaussians/byte_words.hpp"
#include "scene/gaussians/gltf_file.hpp"
#include "scene/gaussians/harmonics.hpp"

namespace fastsplat::scene {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr int kFloat = 5126, kByte = 5121;

/// Collects attributes: bytes, and their place in JSON.
class GlbParts {
 public:
  explicit GlbParts(std::size_t count) : count_(count) {}

  OrderedJson& add(const std::string& name, const char* shape, int type, const std::string& bytes) {
    json["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes.size()}, {"target", 34962}});
    json["accessors"].push_back(
        {{"bufferView", attributes.size()}, {"componentType", type}, {"count", count_}, {"type", shape}});
    attributes[name] = json["accessors"].size() - 1;
    binary += bytes;
    return json["accessors"].back();
  }

  OrderedJson json, attributes;
  std::string binary;  ///< every attribute is a multiple of 4 bytes

 private:
  std::size_t count_;
};

void append_chunk(std::string& to, const char* type, std::string bytes, char padding) {
  bytes.resize((bytes.size() + 3) / 4 * 4, padding);
  append_word(to, static_cast<std::uint32_t>(bytes.size()));
  to.append(type, 4);
  to += bytes;
}

}  // namespace

std::string glb_bytes(const GaussianCloud& cloud) {
  const std::size_t count = cloud.gaussians.size(), each = static_cast<std::size_t>(harmonic_count(cloud.degree));
  std::string positions, colours, rotations, scales, opacities;
  std::vector<std::string> coefficients(each);
  glm::vec3 low(std::numeric_limits<float>::infinity()), high(-low);
  std::vector<glm::vec3> harmonics;
  for (std::size_t i = 0; i < count; ++i) {
    const Gaussian& one = cloud.gaussians[i];
    glm::vec3 position = one.position;
    glm::dvec4 rotation(one.rotation);
    harmonics.assign(cloud.harmonics_of(i).begin(), cloud.harmonics_of(i).end());
    flip_axes(kFlipsOfLuf, position, rotation, harmonics);
    low = glm::min(low, position), high = glm::max(high, position);
    for (int axis = 0; axis < 3; ++axis) {
      append_float(positions, position[axis]);
      append_float(scales, one.scale[axis]);
      append_byte(colours,
                  nearest_step(255.0 * (0.5 + kConstantHarmonic * static_cast<double>(harmonics[0][axis])), 255.0));
      for (std::size_t h = 0; h < each; ++h) append_float(coefficients[h], harmonics[h][axis]);
    }
    append_byte(colours, nearest_step(255.0 * static_cast<double>(one.opacity), 255.0));
    for (const int k : {1, 2, 3, 0}) append_float(rotations, static_cast<float>(rotation[k]));
    append_float(opacities, one.opacity);
  }
  GlbParts parts(count);
  OrderedJson& position = parts.add("POSITION", "VEC3", kFloat, positions);
  position["min"] = {low.x, low.y, low.z};
  position["max"] = {high.x, high.y, high.z};
  parts.add("COLOR_0", "VEC4", kByte, colours)["normalized"] = true;
  parts.add("KHR_gaussian_splatting:ROTATION", "VEC4", kFloat, rotations);
  parts.add("KHR_gaussian_splatting:SCALE", "VEC3", kFloat, scales);
  parts.add("KHR_gaussian_splatting:OPACITY", "SCALAR", kFloat, opacities);
  for (int degree = 0, h = 0; degree <= cloud.degree; ++degree)
    for (int k = 0; k <= 2 * degree; ++k, ++h)
      parts.add(fmt::format("KHR_gaussian_splatting:SH_DEGREE_{}_COEF_{}", degree, k), "VEC3", kFloat,
                coefficients[static_cast<std::size_t>(h)]);
  if (parts.binary.size() > std::numeric_limits<std::uint32_t>::max() - (std::size_t{1} << 20))
    throw_input({.where = cloud.name,
                 .what = "too many Gaussians for .glb",
                 .expected = "at most 4 GiB",
                 .got = {},
                 .fix = "write .ply"});

  OrderedJson json{{"asset", {{"version", "2.0"}, {"generator", "fastsplat " + std::string(program_version())}}},
                   {"extensionsUsed", {"KHR_gaussian_splatting"}},
                   {"scene", 0},
                   {"scenes", OrderedJson::array({{{"nodes", {0}}}})},
                   {"nodes", OrderedJson::array({{{"mesh", 0}}})},
                   {"buffers", OrderedJson::array({{{"byteLength", parts.binary.size()}}})}};
  json.update(parts.json);
  OrderedJson primitive{{"attributes", parts.attributes}, {"mode", 0}};
  primitive["extensions"]["KHR_gaussian_splatting"] = {
      {"kernel", "ellipse"}, {"colorSpace", cloud.linear ? "lin_rec709_display" : "srgb_rec709_display"}};
  json["meshes"].push_back({{"primitives", OrderedJson::array({primitive})}});
  std::string chunks;
  append_chunk(chunks, "JSON", json.dump(), ' ');
  append_chunk(chunks, "BIN\0", parts.binary, '\0');
  std::string out = "glTF";
  append_word(out, 2);
  append_word(out, static_cast<std::uint32_t>(12 + chunks.size()));
  return out + chunks;
}

}  // namespace fastsplat::scene
