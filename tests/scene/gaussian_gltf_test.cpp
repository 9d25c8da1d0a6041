// SPDX-License-Identifier: Apache-2.0
// glTF with KHR_gaussian_splatting: written and read again, quantised and interleaved attributes, nodes, damage.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "scene/gaussians/gaussian_file.hpp"
#include "scene/gaussians/harmonics.hpp"
#include "scene/gaussians/synthetic_gaussians.hpp"
#include "tests/scene/gaussian_helper.hpp"

namespace fastsplat::scene {
namespace {

using Json = nlohmann::json;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// The two chunks of a .glb.
struct Chunks {
  Json json;
  std::string binary;
};
std::uint32_t word(const std::string& bytes, std::size_t at) {
  std::uint32_t out = 0;
  for (std::size_t i = 0; i < 4; ++i) out |= std::uint32_t{static_cast<unsigned char>(bytes[at + i])} << (8 * i);
  return out;
}
std::string word(std::size_t value) {
  std::string out;
  for (unsigned i = 0; i < 4; ++i) out.push_back(static_cast<char>((value >> (8 * i)) & 0xFFU));
  return out;
}
Chunks chunks_of(const std::string& glb) {
  const std::size_t length = word(glb, 12);
  return {Json::parse(glb.substr(20, length)), glb.substr(28 + length)};
}
std::string glb(const Chunks& chunks) {
  std::string json = chunks.json.dump();
  json.resize((json.size() + 3) / 4 * 4, ' ');
  return "glTF" + word(2) + word(28 + json.size() + chunks.binary.size()) + word(json.size()) + "JSON" + json +
         word(chunks.binary.size()) + std::string("BIN\0", 4) + chunks.binary;
}
Chunks written(const GaussianCloud& cloud) {
  const TestFile file(".glb", "");
  save_gaussians(cloud, file.path());
  return chunks_of(bytes_of(file.path()));
}
GaussianCloud read(const std::string& ending, const std::string& bytes) {
  const TestFile file(ending, bytes);
  return load_gaussians(file.path());
}
std::string base64(const std::string& bytes) {
  static const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k)
      three = three << 8U | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (unsigned k = 0; k < 4; ++k) out += i + k > bytes.size() ? '=' : digits[(three >> (18 - 6 * k)) & 63U];
  }
  return out;
}

TEST(Gltf, IsWrittenAndReadWithoutLoss) {
  for (const char* name : {"shells:300", "cloud:300"}) {
    GaussianCloud cloud = make_synthetic_gaussians(name);
    cloud.linear = true;
    const TestFile file(".glb", "");
    save_gaussians(cloud, file.path());
    const GaussianCloud again = load_gaussians(file.path());
    const double worst = difference(again, cloud);
    std::printf("[figure] %s: worst difference = %.2g, bytes a Gaussian = %.1f\n", name, worst,
                double(bytes_of(file.path()).size()) / 300.0);
    EXPECT_LE(worst, 1.2e-7);  // rotations are made unit length again
    EXPECT_TRUE(again.linear);
    EXPECT_THAT(again.remarks, ElementsAre());
  }
}

// y points up and x to the left, so both change sign, and so do harmonics that are odd in one of them.
TEST(Gltf, AxesAreThoseOfTheFormat) {
  const GaussianCloud cloud = make_synthetic_gaussians("shells:50");
  const Chunks chunks = written(cloud);
  const Json& position = chunks.json["accessors"][0];
  float x = 0.0F;
  std::memcpy(&x, chunks.binary.data(), sizeof x);
  EXPECT_EQ(x, -cloud.gaussians[0].position.x);
  EXPECT_EQ(position["min"].size(), 3U);
  const auto at = [](const GaussianCloud& from, const glm::dvec3& direction) {
    return colour_at(from.harmonics_of(7), glm::normalize(direction));
  };
  // Read without the change: the colour towards the changed direction is the same.
  GaussianCloud raw = cloud;
  raw.harmonics.clear();
  for (std::size_t i = 0; i < 50; ++i)
    for (std::size_t h = 0; h < 16; ++h) {
      const std::size_t view = chunks.json["meshes"][0]["primitives"][0]["attributes"].size() - 16 + h;
      const std::size_t offset = chunks.json["bufferViews"][view]["byteOffset"].get<std::size_t>() + 12 * i;
      glm::vec3 value;
      std::memcpy(&value, chunks.binary.data() + offset, sizeof value);
      raw.harmonics.push_back(value);
    }
  double worst = 0.0;
  for (const glm::dvec3& d : {glm::dvec3(0.3, 0.5, 0.7), glm::dvec3(-0.9, 0.2, 0.1), glm::dvec3(0.1, -0.8, -0.4)})
    worst = std::max(worst, glm::length(at(cloud, d) - at(raw, {-d.x, -d.y, d.z})));
  std::printf("[figure] colours by direction = %.2g\n", worst);
  EXPECT_LT(worst, 1e-7);
}

TEST(Gltf, TextWithDataAndWithAFileBeside) {
  const GaussianCloud cloud = make_synthetic_gaussians("cloud:40");
  Chunks chunks = written(cloud);
  chunks.json["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64(chunks.binary);
  EXPECT_LE(difference(read(".gltf", chunks.json.dump()), cloud), 1.2e-7);
  const TestFile beside(" more.bin", chunks.binary);
  const TestFile scene(".gltf", "");
  std::string name = beside.path().filename().string();
  chunks.json["buffers"][0]["uri"] = name.replace(name.find(' '), 1, "%20");
  EXPECT_LE(difference(read(".gltf", chunks.json.dump()), cloud), 1.2e-7);
  // An output may not replace the buffer.
  std::ofstream(scene.path()) << chunks.json.dump();
  EXPECT_THAT(files_of_gaussians(scene.path()), ElementsAre(scene.path(), beside.path()));
  const std::string with_zero("none.bin\0x", 10);
  for (const std::string& elsewhere : {std::string("/etc/passwd"), std::string("../secret.bin"),
                                       std::string("a/../../b.bin"), std::string(), with_zero}) {
    chunks.json["buffers"][0]["uri"] = elsewhere;
    EXPECT_THAT(refusal_of(".gltf", chunks.json.dump()), HasSubstr("in the header's folder"));
  }
  chunks.json["buffers"][0]["uri"] = "http://example.org/a.bin";
  EXPECT_THAT(refusal_of(".gltf", chunks.json.dump()),
              AllOf(HasSubstr("remote uri"), HasSubstr("http://example.org/a.bin")));
  chunks.json["buffers"][0]["uri"] = "none.bin";
  EXPECT_THAT(refusal_of(".gltf", chunks.json.dump()), AllOf(HasSubstr("is missing"), HasSubstr("none.bin")));
}

// Positions may be integers only with KHR_mesh_quantization.
TEST(Gltf, QuantisedPositions) {
  Chunks chunks = written(make_synthetic_gaussians("cloud:40"));
  chunks.json["accessors"][0]["componentType"] = 5122;
  EXPECT_THAT(refusal_of(".glb", glb(chunks)), HasSubstr("POSITION has an invalid componentType"));
  chunks.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  std::int16_t x = 0;
  std::memcpy(&x, chunks.binary.data(), sizeof x);
  EXPECT_EQ(read(".glb", glb(chunks)).gaussians[0].position.x, -static_cast<float>(x));
}

// A rotation as signed bytes and an opacity as unsigned shorts, in one interleaved view.
TEST(Gltf, QuantisedAndInterleaved) {
  const GaussianCloud cloud = make_synthetic_gaussians("cloud:40");
  Chunks chunks = written(cloud);
  std::string packed;
  for (const Gaussian& one : cloud.gaussians) {
    for (const int k : {1, 2, 3, 0}) {
      const double flip = k == 1 || k == 2 ? -1.0 : 1.0;  // x and y
      packed.push_back(static_cast<char>(std::lround(flip * 127.0 * double(one.rotation[k]))));
    }
    packed += word(static_cast<std::size_t>(std::lround(65535.0 * double(one.opacity))));
  }
  const std::size_t view = chunks.json["bufferViews"].size();
  chunks.json["bufferViews"].push_back(
      {{"buffer", 0}, {"byteOffset", chunks.binary.size()}, {"byteLength", packed.size()}, {"byteStride", 8}});
  chunks.binary += packed;
  chunks.json["buffers"][0]["byteLength"] = chunks.binary.size();
  chunks.json["accessors"][2] = {
      {"bufferView", view}, {"componentType", 5120}, {"normalized", true}, {"count", 40}, {"type", "VEC4"}};
  chunks.json["accessors"][4] = {{"bufferView", view}, {"byteOffset", 4}, {"componentType", 5123},
                                 {"normalized", true}, {"count", 40},     {"type", "SCALAR"}};
  const Apart off = apart(read(".glb", glb(chunks)), cloud);
  print("bytes and shorts", off);
  EXPECT_LE(off.opacity, 0.5 / 65535.0 + 1e-7);
  EXPECT_LE(off.rotation, 4.0 * 0.5 / 127.0 / 127.0);  // four components off by half a step
  EXPECT_EQ(off.position, 0.0);
}

// Nodes move, turn and scale; covariances and colours follow.
TEST(Gltf, NodesAreApplied) {
  const GaussianCloud cloud = make_synthetic_gaussians("shells:60");
  Chunks chunks = written(cloud);
  const glm::dquat turn = glm::normalize(glm::dquat(0.3, -0.5, 0.7, 0.2));
  chunks.json["nodes"] = Json::array({{{"children", {1}}, {"translation", {1.0, 2.0, 3.0}}, {"scale", {2.0, 2.0, 2.0}}},
                                      {{"mesh", 0}, {"rotation", {turn.x, turn.y, turn.z, turn.w}}}});
  const GaussianCloud moved = read(".glb", glb(chunks));
  // The same in PLY's axes: x and y change sign before and after.
  const glm::dmat3 flip(glm::dvec3(-1, 0, 0), glm::dvec3(0, -1, 0), glm::dvec3(0, 0, 1));
  const glm::dmat3 own = flip * glm::mat3_cast(turn) * flip;
  double place = 0.0, shape = 0.0, colour = 0.0;
  for (std::size_t i = 0; i < 60; ++i) {
    const glm::dvec3 wanted = 2.0 * own * glm::dvec3(cloud.gaussians[i].position) + flip * glm::dvec3(1, 2, 3);
    place = std::max(place, glm::length(wanted - glm::dvec3(moved.gaussians[i].position)));
    const glm::dmat3 a = 4.0 * own * covariance(cloud.gaussians[i]) * glm::transpose(own);
    const glm::dmat3 b = covariance(moved.gaussians[i]);
    for (int k = 0; k < 3; ++k) shape = std::max(shape, glm::length(a[k] - b[k]));
    for (const glm::dvec3& d : {glm::dvec3(0.6, 0.0, 0.8), glm::dvec3(-0.48, 0.6, 0.64), glm::dvec3(0.0, -1.0, 0.0)})
      colour = std::max(colour,
                        glm::length(colour_at(cloud.harmonics_of(i), d) - colour_at(moved.harmonics_of(i), own * d)));
  }
  std::printf("[figure] turned: position %.2g, covariance %.2g, colour %.2g\n", place, shape, colour);
  EXPECT_LT(place, 1e-6);
  EXPECT_LT(shape, 1e-6);
  EXPECT_LT(colour, 1e-6);
  chunks.json["nodes"][0]["scale"] = {2.0, 2.0, 1.0};
  EXPECT_THAT(refusal_of(".glb", glb(chunks)), HasSubstr("stretches"));
  chunks.json["nodes"][0]["scale"] = {2.0, 2.0, -2.0};
  EXPECT_THAT(refusal_of(".glb", glb(chunks)), HasSubstr("mirrors"));
}

TEST(Gltf, DraftsStoredLogarithms) {
  const GaussianCloud cloud = make_synthetic_gaussians("cloud:40");
  Chunks chunks = written(cloud);
  const std::size_t offset = chunks.json["bufferViews"][3]["byteOffset"];
  for (std::size_t at = offset; at < offset + 40 * 12; at += 4) {
    float scale = 0.0F;
    std::memcpy(&scale, chunks.binary.data() + at, 4);
    scale = std::log(scale);
    std::memcpy(chunks.binary.data() + at, &scale, 4);
  }
  const GaussianCloud again = read(".glb", glb(chunks));
  EXPECT_LT(difference(again, cloud), 1e-6);
  EXPECT_THAT(again.remarks, ElementsAre(HasSubstr("logarithms")));
}

TEST(Gltf, OpacitiesBesideOneAreRounding) {
  Chunks chunks = written(make_synthetic_gaussians("cloud:8"));
  const Json& attributes = chunks.json["meshes"][0]["primitives"][0]["attributes"];
  const Json& accessor = chunks.json["accessors"][attributes["KHR_gaussian_splatting:OPACITY"].get<std::size_t>()];
  const Json& view = chunks.json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
  const auto at = view.value("byteOffset", std::size_t{0}) + accessor.value("byteOffset", std::size_t{0});
  const auto set = [&](std::size_t i, float value) {
    chunks.binary.replace(at + 4 * i, 4, word(std::bit_cast<std::uint32_t>(value)));
  };
  set(1, 1.000001F), set(2, -1e-7F), set(3, 2.0F);
  const GaussianCloud cloud = read(".glb", glb(chunks));
  ASSERT_EQ(cloud.gaussians.size(), 7U);
  EXPECT_EQ(cloud.gaussians[1].opacity, 1.0F);
  EXPECT_EQ(cloud.gaussians[2].opacity, 0.0F);
  EXPECT_THAT(cloud.remarks, ElementsAre(AllOf(HasSubstr("Gaussian 3"), HasSubstr("opacity is outside 0..1"))));
}

TEST(Gltf, HarmonicsAboveDegreeThreeAreNamed) {
  Chunks chunks = written(make_synthetic_gaussians("shells:8"));
  Json& attributes = chunks.json["meshes"][0]["primitives"][0]["attributes"];
  attributes["KHR_gaussian_splatting:SH_DEGREE_4_COEF_0"] = attributes["POSITION"];
  const GaussianCloud cloud = read(".glb", glb(chunks));
  EXPECT_EQ(cloud.degree, 3);
  EXPECT_THAT(cloud.remarks, ElementsAre("harmonics above degree 3 are not drawn"));
}

TEST(Gltf, WhatIsDeclaredIsFollowedOrNamed) {
  Chunks chunks = written(make_synthetic_gaussians("cloud:8"));
  Json& splatting = chunks.json["meshes"][0]["primitives"][0]["extensions"]["KHR_gaussian_splatting"];
  splatting["kernel"] = "box", splatting["sortingMethod"] = "byName", splatting["projection"] = "fisheye";
  splatting["colorSpace"] = "lin_p3";
  chunks.json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}});
  EXPECT_THAT(read(".glb", glb(chunks)).remarks,
              ElementsAre(HasSubstr("'box'"), HasSubstr("'lin_p3'"), HasSubstr("'fisheye'"), HasSubstr("'byName'"),
                          HasSubstr("1 primitives")));
}

TEST(Gltf, ManyNodesWithOneMeshAreRefusedBeforeTheyFillMemory) {
  Chunks chunks = written(make_synthetic_gaussians("cloud:400"));
  for (int node = 1; node < 20000; ++node) {
    chunks.json["nodes"].push_back({{"mesh", 0}});
    chunks.json["scenes"][0]["nodes"].push_back(node);
  }
  EXPECT_THAT(refusal_of(".glb", glb(chunks)), HasSubstr("at most 256 times"));
}

TEST(Gltf, DamageIsNamed) {
  const Chunks whole = written(make_synthetic_gaussians("shells:30"));
  const auto changed = [&](const std::function<void(Json&)>& change) {
    Chunks chunks = whole;
    change(chunks.json);
    return glb(chunks);
  };
  const std::string bytes = glb(whole);
  const struct {
    std::string bytes;
    const char* said;
  } files[] = {
      {bytes.substr(0, 16), "header of a .glb"},
      {patched(bytes, 4, word(1)), "version of glTF"},
      {patched(bytes, 12, word(0xFFFFFFF0U)), "first chunk"},
      {bytes.substr(0, bytes.size() - 4), "the length in the header of a .glb file is not the file's"},
      {patched(bytes.substr(0, bytes.size() - 4), 8, word(bytes.size() - 4)), "shorter than its binary chunk"},
      {patched(bytes, 20, "["), "invalid JSON"},
      {patched(bytes, 20, "{\"a\":" + std::string(100, '[')), "nested more than"},
      {patched(bytes, 20, "{\"a\":1e999,"), "number overflow"},
      {changed([](Json& json) { json["nodes"] = 3; }), "no nodes ("},
      {changed([](Json& json) { json["scene"] = 7; }), "scenes[7]"},
      {changed([](Json& json) { json["scene"] = -1; }), "no valid scene"},
      {changed([](Json& json) { json["nodes"][0]["children"] = {0}; }), "two parents"},
      {changed([](Json& json) { json["nodes"][0]["mesh"] = 1e300; }), "no valid mesh"},
      {changed([](Json& json) {
         json["nodes"][0]["matrix"] = {1, 2, 3};
       }),
       "matrix is invalid"},
      {changed([](Json& json) { json["accessors"][0]["count"] = std::size_t{1} << 62U; }), "outside its buffer"},
      {changed([](Json& json) { json["accessors"][0]["count"] = 29; }), "differ in number"},
      {changed([](Json& json) { json["accessors"][0]["byteOffset"] = 999999999; }), "outside its buffer view"},
      {changed([](Json& json) { json["accessors"][0]["type"] = "VEC4"; }), "wrong shape"},
      {changed([](Json& json) { json["accessors"][0]["componentType"] = 5127; }), "unknown componentType"},
      {changed([](Json& json) { json["accessors"][0]["normalized"] = true; }), "5126 normalized"},
      {changed([](Json& json) { json["accessors"][2]["componentType"] = 5120; }),
       "ROTATION has an invalid componentType"},
      {changed([](Json& json) { json["accessors"][3]["componentType"] = 5125; }), "SCALE has an invalid componentType"},
      {changed([](Json& json) { json["accessors"][4]["componentType"] = 5121; }),
       "OPACITY has an invalid componentType"},
      {changed([](Json& json) { json["accessors"][5]["componentType"] = 5122; }),
       "COEF_0 has an invalid componentType"},
      {changed([](Json& json) { json["asset"]["version"] = "1.0"; }), "asset.version"},
      {changed([](Json& json) { json["asset"]["minVersion"] = "3.0"; }), "asset.minVersion"},
      {changed([](Json& json) {
         json["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
         json["nodes"][0]["scale"] = {2, 2, 2};
       }),
       "two transformations"},
      {changed([](Json& json) { json["asset"]["version"] = 2; }), "asset.version"},
      {changed([](Json& json) { json.erase("asset"); }), "asset.version"},
      {changed([](Json& json) {
         json["nodes"][0]["rotation"] = {0, 0, 0, 0};
       }),
       "rotation is invalid"},
      {changed([](Json& json) { json["accessors"][0]["sparse"] = Json::object(); }), "sparse"},
      {changed([](Json& json) { json["accessors"][0].erase("bufferView"); }), "sparse or has no data"},
      {changed([](Json& json) { json["bufferViews"][0]["byteLength"] = ~std::uint64_t{0}; }), "outside its buffer"},
      {changed([](Json& json) { json["bufferViews"][0]["byteStride"] = 4; }), "invalid byteStride (expected 12 to"},
      {changed([](Json& json) { json["asset"]["minVersion"] = "2.5"; }), "asset.minVersion"},
      {changed([](Json& json) { json["nodes"][0]["matrix"] = {1, 0, 0, 0.1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}; }),
       "no affine transformation"},
      {changed([](Json& json) {
         Json& attributes = json["meshes"][0]["primitives"][0]["attributes"];
         for (const char* k : {"0", "1", "2", "3", "4"})
           attributes.erase("KHR_gaussian_splatting:SH_DEGREE_2_COEF_" + std::string(k));
       }),
       "SH_DEGREE_2_COEF_0"},
      {changed([](Json& json) {
         json["bufferViews"][0]["extensions"] = {{"EXT_meshopt_compression", 1}};
       }),
       "compressed"},
      {changed([](Json& json) { json["buffers"][0]["byteLength"] = 999999; }), "shorter than declared"},
      {changed([](Json& json) { json["extensionsRequired"] = {"KHR_draco_mesh_compression"}; }), "draco"},
      {changed([](Json& json) {
         json["meshes"][0]["primitives"][0]["extensions"]["KHR_gaussian_splatting"]["extensions"] = {
             {"KHR_gaussian_splatting_compression_spz_2", {{"bufferView", 0}}}};
       }),
       "compression_spz_2"},
      {changed([](Json& json) { json["meshes"][0]["primitives"][0].erase("mode"); }), "points"},
      {changed([](Json& json) { json["meshes"][0]["primitives"][0]["attributes"].erase("POSITION"); }), "POSITION"},
      {changed([](Json& json) {
         json["meshes"][0]["primitives"][0]["attributes"].erase("KHR_gaussian_splatting:SH_DEGREE_1_COEF_2");
       }),
       "SH_DEGREE_1_COEF_2"},
      {changed([](Json& json) { json["meshes"][0]["primitives"][0].erase("extensions"); }), "holds no 3-D Gaussians"},
  };
  for (const auto& one : files) EXPECT_THAT(refusal_of(".glb", one.bytes), HasSubstr(one.said));
}

}  // namespace
}  // namespace fastsplat::scene
