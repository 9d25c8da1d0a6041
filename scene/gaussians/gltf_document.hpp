// SPDX-License-Identifier: Apache-2.0
// The JSON of a glTF file, its buffers, and numbers in them.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace fastsplat::scene {

inline constexpr int kGltfFloat = 5126;  ///< a componentType

/// Numbers of an accessor, as floats.
struct GltfNumbers {
  std::string_view bytes;  ///< from its first element
  std::size_t count = 0, stride = 0;
  std::size_t width = 1;  ///< numbers an element
  int type = kGltfFloat;  ///< glTF's componentType
  bool normalized = false;

  float at(std::size_t element, std::size_t number) const;
};

/// Every refusal is a UserError (Input) that names the file.
class GltfDocument {
 public:
  /// `bytes`: a .glb or .gltf, which outlives it. `path`: its name; its buffers are in that folder.
  GltfDocument(std::string_view bytes, std::filesystem::path path);

  const nlohmann::json& json() const { return json_; }
  std::size_t size() const;  ///< bytes of the file and of the buffers read from elsewhere
  /// An element of the array `list` at the top.
  const nlohmann::json& item(const char* list, std::size_t index) const;
  /// A whole number, not negative, that `of` holds; `what` names it in messages.
  std::size_t number(const nlohmann::json& of, const char* key, const std::string& what) const;
  std::size_t number_or(const nlohmann::json& of, const char* key, std::size_t otherwise,
                        const std::string& what) const;
  /// An accessor of elements of `width` numbers. Sparse accessors and views of compressed data are refused.
  GltfNumbers numbers(std::size_t accessor, std::size_t width, const std::string& what);

  [[noreturn]] void refuse(const std::string& what, const std::string& expected, const std::string& got,
                           const std::string& fix = "write the file again, for example as .ply") const;

 private:
  std::string_view buffer(std::size_t index);

  std::filesystem::path path_;
  std::size_t bytes_;
  nlohmann::json json_;
  std::string_view binary_;                      ///< of a .glb
  std::map<std::size_t, std::string> loaded_{};  ///< buffers from elsewhere
};

}  // namespace fastsplat::scene
